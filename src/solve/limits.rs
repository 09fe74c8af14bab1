//! A physical limit that a state has come to: words for the end of a march.
//!
//! The surface of a soft body compressed below 0.65 of its length folds into itself (Hong, Zhao and Suo, Appl. Phys. Lett. 95 (2009)
//! 111901; incompressible, plane strain; a guide for other solids); the smooth solution itself loses stability at 0.544 (Biot
//! 1963). Friction compresses it ahead of a contact. Neither figure was checked against its source.

use crate::geometry::{Curve, Edge, Point};
use crate::model::{Body, Model, State};

/// Stretch of a surface below which it creases.
const CREASE: f64 = 0.65;
/// Stretch of a surface below which no smooth surface is stable.
const WRINKLE: f64 = 0.544;
/// Points of a span at which its stretch is looked at.
const SAMPLES: usize = 5;

/// Where the surfaces in contact are compressed that far, in words that start with a separator; else empty.
pub fn reached(model: &Model, state: &State) -> String {
    let Some((stretch, body, at)) = shortest(model, state).filter(|(stretch, ..)| *stretch < CREASE) else {
        return String::new();
    };
    let beyond = if stretch < WRINKLE { ", and no smooth surface is stable below 0.544" } else { "" };
    format!(
        "; at the last equilibrium the surface of body `{}` is compressed to {stretch:.2} of its length at ({:.3}, {:.3}): a soft \
         solid creases below about 0.65{beyond}",
        body.name, at.x, at.y
    )
}

/// Smallest stretch along the edges in contact, its body and where it is now.
fn shortest<'a>(model: &'a Model, state: &State) -> Option<(f64, &'a Body, Point)> {
    let sides = model.pairs.iter().flat_map(|pair| [&pair.nonmortar, &pair.mortar]);
    let stretches = sides.filter_map(|side| {
        let body = &model.bodies[side.body];
        let local = |node: &usize| node - body.offset;
        let edges = [Edge::Bottom, Edge::Right, Edge::Top, Edge::Left];
        let curve = edges
            .into_iter()
            .filter_map(|e| body.edge(e))
            .find(|c| c.nodes.iter().copied().eq(side.nodes.iter().map(local)))?;
        let now: Vec<Point> = side.nodes.iter().zip(&curve.points).map(|(&i, x)| x + state.u[i]).collect();
        smallest_stretch(&curve, &now).map(|(stretch, at)| (stretch, body, at))
    });
    stretches.min_by(|a, b| a.0.total_cmp(&b.0))
}

fn smallest_stretch(curve: &Curve, now: &[Point]) -> Option<(f64, Point)> {
    let breaks = curve.basis.breaks();
    let samples =
        (0..curve.spans()).flat_map(|span| (0..SAMPLES).map(move |k| (span, (k as f64 + 0.5) / SAMPLES as f64)));
    let stretches = samples.map(|(span, part)| {
        let shape = curve.shape(span, breaks[span] + part * (breaks[span + 1] - breaks[span]));
        let length = |points: &[Point]| curve.place(&shape, 1, points).norm();
        (length(now) / length(&curve.points), curve.place(&shape, 0, now))
    });
    stretches.min_by(|a, b| a.0.total_cmp(&b.0))
}
