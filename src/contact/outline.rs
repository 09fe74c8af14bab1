//! A curve as a fine polygon: where a search begins, and which ways cross the curve.

use crate::geometry::{Curve, Point};
use crate::math::{Vec2, rot90};

/// Samples of a span.
const SAMPLES_PER_SPAN: usize = 3;

/// A place on the curve.
pub struct Sample {
    /// Parameter.
    pub xi: f64,
    /// Position.
    pub y: Point,
    /// Tangent.
    pub a: Vec2,
    /// Outward normal, as long as the tangent.
    pub normal: Vec2,
}

/// A curve in one configuration, sampled.
pub struct Outline {
    /// Places in the order of the parameter.
    pub samples: Vec<Sample>,
    side: f64,
}

impl Outline {
    /// Samples the curve through the given control points.
    pub fn new(curve: &Curve, points: &[Point]) -> Self {
        let breaks = curve.basis.breaks();
        let mut samples = Vec::with_capacity(SAMPLES_PER_SPAN * curve.spans() + 1);
        for span in 0..curve.spans() {
            let last = span + 1 == curve.spans();
            for k in 0..SAMPLES_PER_SPAN + usize::from(last) {
                let xi = breaks[span] + (breaks[span + 1] - breaks[span]) * k as f64 / SAMPLES_PER_SPAN as f64;
                let shape = curve.shape(span, xi);
                let a = curve.place(&shape, 1, points);
                samples.push(Sample { xi, y: curve.place(&shape, 0, points), a, normal: rot90(a) * curve.side });
            }
        }
        Self { samples, side: curve.side }
    }

    /// True where the straight way from `x` to `y` enters the body behind the curve.
    ///
    /// The way from a point inside the counterpart back to its partner only leaves it. Behind a point outside there may be a
    /// place with an opposing normal, too, though no overlap is meant: the way back from the trailing flank of a steep
    /// asperity comes out at the leading one, enters the counterpart and ends at its far flank.
    pub fn entered(&self, x: Point, y: Point) -> bool {
        let way = y - x;
        self.samples.windows(2).any(|ends| {
            let (edge, to) = (ends[1].y - ends[0].y, ends[0].y - x);
            let slant = way.perp(&edge);
            let (fraction, place) = (to.perp(&edge) / slant, to.perp(&way) / slant);
            let met = (0.0..1.0).contains(&fraction) && (0.0..1.0).contains(&place);
            met && way.dot(&rot90(edge)) * self.side < 0.0
        })
    }
}
