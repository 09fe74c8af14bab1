//! A profile on its way to a mesh: heights above a straight edge.

use std::sync::Arc;

use super::BasisSpec;
use super::arcs::{Piece, arc, chain};
use super::mesh::Joint;
use crate::geometry::refine::{Homogeneous, combine, embed, interpolate};
use crate::geometry::{BSpline, Basis, GeometryError, Point};

/// Heights over `x`, with the places where an element has to end.
pub(super) struct Outline {
    kind: Kind,
    pub joints: Vec<Joint>,
}

enum Kind {
    /// A function h(x), interpolated at the nodes of the basis.
    Graph(Box<dyn Fn(f64) -> f64>),
    /// Lines and arcs, exact in a rational basis of degree 2 or more.
    Exact(BSpline, Vec<Homogeneous>),
}

impl Outline {
    /// Function of x; `smooth` lists where its second derivative jumps.
    pub(super) fn graph(height: impl Fn(f64) -> f64 + 'static, smooth: Vec<f64>) -> Self {
        let joint = |at| Joint { at, continuity: 1 };
        Self { kind: Kind::Graph(Box::new(height)), joints: smooth.into_iter().map(joint).collect() }
    }

    /// Chain of lines and arcs from the left to the right end of the edge; the parameter of a joint is its x.
    pub(super) fn exact(pieces: &[Piece], x: [f64; 2]) -> Result<Self, GeometryError> {
        let inner = pieces[1..].iter().map(|p| p.start.x);
        let breaks: Vec<f64> = [x[0]].into_iter().chain(inner).chain([x[1]]).collect();
        let (spline, net) = chain(pieces, &breaks)?;
        let joint = |&at: &f64| Joint { at, continuity: 0 };
        let joints = breaks[1..breaks.len() - 1].iter().map(joint).collect();
        Ok(Self { kind: Kind::Exact(spline, net), joints })
    }

    /// Straight lines between corners, of which the first and the last are the ends of the edge.
    pub(super) fn broken_line(corners: &[Point], x: [f64; 2]) -> Result<Self, GeometryError> {
        let line = |c: &[Point]| Piece::line(c[0], c[1]);
        let pieces: Vec<Piece> = corners.windows(2).map(line).collect();
        Self::exact(&pieces, x)
    }

    /// Equal bumps on a flat edge: `bump` is the chain of pieces of a bump centred at 0 with `half_width`.
    pub(super) fn bumps(
        bump: &[Piece],
        half_width: f64,
        centers: &[f64],
        x: [f64; 2],
        key: &str,
    ) -> Result<Self, GeometryError> {
        let tolerance = 1e-9 * (x[1] - x[0]);
        let mut pieces = Vec::new();
        let mut cursor = Point::new(x[0], 0.0);
        for &c in centers {
            if c - half_width < cursor.x - tolerance || c + half_width > x[1] + tolerance {
                let message = format!(
                    "bumps must lie side by side on the edge from {} to {}; the one at {c} reaches from {} to {}",
                    x[0],
                    x[1],
                    c - half_width,
                    c + half_width
                );
                return Err(GeometryError::shape(key, message));
            }
            let shift = Point::new(c, 0.0);
            if bump[0].start.x + c > cursor.x + tolerance {
                pieces.push(Piece::line(cursor, bump[0].start + shift));
            }
            pieces.extend(bump.iter().map(|p| Piece {
                start: p.start + shift,
                middle: p.middle + shift,
                end: p.end + shift,
                ..*p
            }));
            cursor = bump[bump.len() - 1].end + shift;
        }
        if cursor.x < x[1] - tolerance {
            pieces.push(Piece::line(cursor, Point::new(x[1], 0.0)));
        }
        pin_ends(&mut pieces, x);
        Self::exact(&pieces, x)
    }

    /// Control points of the edge at height `y`, pointing up (`sign` = 1) or down (-1).
    pub(super) fn control(&self, basis: &Arc<dyn Basis>, spec: &BasisSpec, y: f64, sign: f64) -> Vec<Homogeneous> {
        let basis = basis.as_ref();
        let at_nodes =
            |point: &dyn Fn(f64) -> Homogeneous| interpolate(basis, basis.nodes().into_iter().map(point).collect());
        let mut net = match &self.kind {
            Kind::Graph(height) => at_nodes(&|x| Homogeneous::new(x, height(x), 1.0)),
            Kind::Exact(spline, net) if exact_in(spec) => embed(spline, net, basis),
            Kind::Exact(spline, net) => at_nodes(&|x| {
                let h = combine(spline, net, x);
                h / h.z
            }),
        };
        for h in &mut net {
            h.y = y * h.z + sign * h.y;
        }
        net
    }
}

/// Whether a basis holds arcs exactly; others get their nodes on the arc.
fn exact_in(spec: &BasisSpec) -> bool {
    matches!(spec, BasisSpec::Nurbs { degree } if *degree >= 2)
}

/// Removes the round-off between the bumps and the ends of the edge.
fn pin_ends(pieces: &mut [Piece], x: [f64; 2]) {
    if let Some(first) = pieces.first_mut() {
        first.start.x = x[0];
    }
    if let Some(last) = pieces.last_mut() {
        last.end.x = x[1];
    }
}

/// Arc of a circle with its apex at (0, `height`) that meets h = 0 at both ends; `height` up to the radius.
pub(super) fn cap(radius: f64, height: f64) -> (Vec<Piece>, f64) {
    let half_width = (height * (2.0 * radius - height)).sqrt();
    let opening = half_width.atan2(radius - height);
    let center = Point::new(0.0, height - radius);
    let mut pieces = arc(center, radius, up(opening), up(-opening));
    level(&mut pieces, half_width);
    (pieces, half_width)
}

/// Rounded wedge: flanks at `slope` (rad) from h = 0 to a tip of the given radius whose apex is at `height`.
pub(super) fn wedge(height: f64, half_width: f64, slope: f64, radius: f64) -> Vec<Piece> {
    let center = Point::new(0.0, height - radius);
    let tip = arc(center, radius, up(slope), up(-slope));
    let mut pieces = vec![Piece::line(Point::new(-half_width, 0.0), tip[0].start)];
    let last = tip[tip.len() - 1].end;
    pieces.extend(tip);
    pieces.push(Piece::line(last, Point::new(half_width, 0.0)));
    pieces
}

/// Polar angle of the point of a circle whose normal leans to the left by `lean`.
fn up(lean: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 + lean
}

/// Puts the ends of a bump exactly on the flat edge.
fn level(pieces: &mut [Piece], half_width: f64) {
    if let Some(first) = pieces.first_mut() {
        first.start = Point::new(-half_width, 0.0);
    }
    if let Some(last) = pieces.last_mut() {
        last.end = Point::new(half_width, 0.0);
    }
}
