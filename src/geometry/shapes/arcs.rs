//! Lines and circular arcs as pieces of rational quadratic curves.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::refine::Homogeneous;
use crate::geometry::{BSpline, GeometryError, Point};

/// Rational quadratic Bezier piece; the weights of its ends are 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub start: Point,
    /// Middle control point.
    pub middle: Point,
    /// Weight of the middle control point.
    pub weight: f64,
    pub end: Point,
}

impl Piece {
    /// Straight line.
    pub(super) fn line(start: Point, end: Point) -> Self {
        Self { start, middle: (start + end) * 0.5, weight: 1.0, end }
    }

    /// Homogeneous control points.
    pub(super) fn net(&self) -> [Homogeneous; 3] {
        let lift = |p: Point, w: f64| Homogeneous::new(p.x * w, p.y * w, w);
        [lift(self.start, 1.0), lift(self.middle, self.weight), lift(self.end, 1.0)]
    }
}

/// Point of a circle at an angle (rad, counter-clockwise from x).
pub(super) fn on_circle(center: Point, radius: f64, angle: f64) -> Point {
    center + Point::new(angle.cos(), angle.sin()) * radius
}

/// Circular arc from angle `from` to angle `to` in equal pieces of at most a quarter circle. An arc of half opening
/// `d` has its middle control point where the end tangents meet, at radius `r / cos d`, with weight `cos d` (Piegl &
/// Tiller, section 7.3).
pub(super) fn arc(center: Point, radius: f64, from: f64, to: f64) -> Vec<Piece> {
    let count = ((to - from).abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let step = (to - from) / count;
    let weight = (0.5 * step).cos();
    (0..count as usize)
        .map(|i| {
            let start = from + step * i as f64;
            Piece {
                start: on_circle(center, radius, start),
                middle: on_circle(center, radius / weight, start + 0.5 * step),
                weight,
                end: on_circle(center, radius, start + step),
            }
        })
        .collect()
}

/// Joins pieces into one quadratic spline; piece `i` occupies the parameters from `breaks[i]` to `breaks[i + 1]`.
pub(super) fn chain(pieces: &[Piece], breaks: &[f64]) -> Result<(BSpline, Vec<Homogeneous>), GeometryError> {
    let spline = BSpline::from_breaks(2, breaks, |_| 2)?;
    let mut net: Vec<Homogeneous> = pieces.iter().flat_map(|p| p.net()[..2].to_vec()).collect();
    net.extend(pieces.last().map(|p| p.net()[2]));
    Ok((spline, net))
}
