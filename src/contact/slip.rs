//! Finite slip: arc length of the current mortar curve between the old and the new partner.

use crate::geometry::{Curve, Point};
use crate::math::GaussRule;

/// Signed arc length and, where asked for, its derivative at fixed ends.
#[derive(Clone, Debug, Default)]
pub struct Path {
    /// Arc length from the old to the new parameter, positive along the tangent.
    pub length: f64,
    /// First mortar control point of `gradient`.
    pub first: usize,
    /// Derivative of the length with respect to the mortar control points from `first` on.
    pub gradient: Vec<Point>,
}

/// `s = int_{from}^{to} |y'| dxi`, Gauss on each span, and `ds/dy_B = int t M_B' dxi`: a common rigid motion of both
/// bodies leaves it unchanged (theory 2.7).
pub fn path(curve: &Curve, points: &[Point], rule: &GaussRule, from: f64, to: f64, gradient: bool) -> Path {
    let (low, high, sign) = if from <= to { (from, to, 1.0) } else { (to, from, -1.0) };
    let (first_span, last_span) = (curve.span_of(low), curve.span_of(high));
    let breaks = curve.basis.breaks();
    let first = curve.shape(first_span, low).first;
    let last = curve.shape(last_span, high);
    let mut out = Path { length: 0.0, first, gradient: vec![] };
    if gradient {
        out.gradient = vec![Point::zeros(); last.first + last.count - first];
    }
    for span in first_span..=last_span {
        let (a, b) = (low.max(breaks[span]), high.min(breaks[span + 1]));
        for (s, w) in rule.points.iter().zip(&rule.weights) {
            let shape = curve.shape(span, a + s * (b - a));
            let tangent = curve.place(&shape, 1, points);
            let weight = sign * w * (b - a);
            out.length += weight * tangent.norm();
            if gradient {
                let unit = tangent / tangent.norm();
                for i in 0..shape.count {
                    out.gradient[shape.first + i - first] += unit * (weight * shape.d[1][i]);
                }
            }
        }
    }
    out
}
