//! Numerical choices of a contact pair that the user left open.
//!
//! # Corners of the mortar curve
//!
//! A mortar curve that is only continuous has corners at its element ends when it deforms. With linear elements the ray along
//! the nonmortar normal is all that is needed. With quadratic Lagrange elements three Gauss points and quadratic multipliers
//! see the corners as waves of the pressure, by 6 % on two cylinders however fine the mesh. Measured there (L2 error at 9 and
//! at 14 elements per half-width) and on passes of steep asperities (`papers/stability`):
//!
//! | integration | multipliers | points | cylinders | passes |
//! |---|---|---|---|---|
//! | element | quadratic | 3 | 4.8, 6.2 % | all found, snaps that are none |
//! | element | quadratic | 6 | 1.2, 1.4 % | all found, snaps that are none |
//! | element | linear | 6 | 0.6, 0.6 % | all found |
//! | segment | quadratic | 3 | 0.3, 0.1 % | lost at 40 degrees, mu = 1, and at 60 degrees, mu = 0 |
//!
//! Segments move with the bodies, and the contact points with them: what these remember goes over to the nearest new one, the
//! tangent leaves their motion out, and where large slip meets an end of the equilibrium path Newton's method is lost. So they are
//! for those who ask for them.

use std::sync::Arc;

use crate::contact::{Integration, Numerics, Projection, Sites};
use crate::geometry::{BSpline, Basis, Curve, Shape};

use super::build::PairSpec;

/// Points that a scene may ask for.
const MOST_POINTS: usize = 32;

/// Fills in the choices that the user left open.
pub fn resolve(spec: &PairSpec, edge: &Curve, target: &Curve) -> Numerics {
    let projection = if has_corners(target) { Projection::Ray } else { Projection::Closest };
    let integration = spec.integration.unwrap_or(Integration::Element);
    let r = spec.r.unwrap_or(1.0);
    Numerics {
        sites: spec.sites.unwrap_or(Sites::Quadrature),
        projection: spec.projection.unwrap_or(projection),
        integration,
        points: spec.points.unwrap_or_else(|| points(edge, target, integration)),
        r,
        r_tangential: spec.r_tangential.unwrap_or(r),
    }
}

/// Gauss points per element or segment.
fn points(edge: &Curve, target: &Curve, integration: Integration) -> usize {
    let few = (edge.basis.degree() + 1).max(3);
    match integration {
        Integration::Segment => few,
        Integration::Element => {
            let enough = if waves(target) { 2 * few } else { few };
            // one for each element of the counterpart at least; the shortest of either side: there graded meshes meet
            let contrast = edge.shortest_span() / target.shortest_span();
            enough.max(contrast.ceil() as usize).min(MOST_POINTS)
        }
    }
}

/// Multipliers other than the functions of the nonmortar edge, where these do not do.
pub fn multiplier(edge: &Curve, target: &Curve, integration: Integration) -> Option<Arc<dyn Basis>> {
    let quadratic = edge.basis.name() == "lagrange" && edge.basis.degree() == 2;
    let lower = quadratic && waves(target) && integration == Integration::Element;
    let linear = lower.then(|| BSpline::from_breaks(1, edge.basis.breaks(), |_| 1).ok())??;
    Some(Arc::new(linear))
}

/// True where corners of a curve let the pressure wave: those of curved elements.
fn waves(target: &Curve) -> bool {
    target.basis.degree() > 1 && has_corners(target)
}

/// True where the curve is only continuous at some element end: it then has corners when it deforms.
fn has_corners(curve: &Curve) -> bool {
    let breaks = curve.basis.breaks();
    (1..curve.spans()).any(|span| {
        let [before, after] = [span - 1, span].map(|s| curve.shape(s, breaks[span]));
        let slopes = |shape: &Shape| -> Vec<(usize, f64)> {
            (0..shape.count).map(|i| (shape.first + i, shape.d[1][i])).filter(|(_, v)| v.abs() > 1e-9).collect()
        };
        slopes(&before).len() != slopes(&after).len()
            || slopes(&before).iter().zip(slopes(&after)).any(|(a, b)| a.0 != b.0)
    })
}
