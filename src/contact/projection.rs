//! Projection of nonmortar points onto the current mortar curve, with a safeguarded search.
//!
//! A coarse pass over samples of the curve brackets the partner; a Newton iteration that falls back to bisection
//! finishes. Only partners with opposing normals are admissible, and behind a point only those from inside the body; points whose partner would lie beyond the ends of the curve have none.

use crate::geometry::{Curve, Point, Shape};
use crate::math::{Vec2, rot90};

use super::interface::Projection;
use super::outline::{Outline, Sample};

/// A partner on the mortar curve.
#[derive(Clone, Copy, Debug)]
pub struct Partner {
    /// Span of the mortar curve.
    pub span: usize,
    /// Parameter.
    pub xi: f64,
    /// Mortar shape functions there.
    pub shape: Shape,
}

/// A point that looks for its partner: position, unit tangent and outward normal of the nonmortar curve.
#[derive(Clone, Copy, Debug)]
pub struct Seeker {
    /// Position.
    pub x: Point,
    /// Unit tangent.
    pub tangent: Vec2,
    /// Outward unit normal.
    pub normal: Vec2,
}

/// A mortar curve in one configuration.
pub struct Target<'a> {
    curve: &'a Curve,
    points: &'a [Point],
    projection: Projection,
    outline: Outline,
    low: Point,
    high: Point,
    reach: f64,
}

impl<'a> Target<'a> {
    /// Samples the curve. Partners farther away than `reach` are not looked for.
    pub fn new(curve: &'a Curve, points: &'a [Point], projection: Projection, reach: f64) -> Self {
        let outline = Outline::new(curve, points);
        let fold = |f: fn(f64, f64) -> f64, start: f64| {
            outline.samples.iter().fold(Point::new(start, start), |m, s| Point::new(f(m.x, s.y.x), f(m.y, s.y.y)))
        };
        let (low, high) = (fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY));
        Self { curve, points, projection, outline, low, high, reach }
    }

    /// True where a partner within reach is possible at all.
    pub fn near(&self, x: Point) -> bool {
        (0..2).all(|c| x[c] > self.low[c] - self.reach && x[c] < self.high[c] + self.reach)
    }

    /// The admissible partner at the smallest distance.
    pub fn project(&self, seeker: &Seeker) -> Option<Partner> {
        if !self.near(seeker.x) {
            return None;
        }
        match self.projection {
            Projection::Closest => self.closest(seeker),
            Projection::Ray => self.ray(seeker),
        }
    }

    fn shape(&self, xi: f64) -> Shape {
        self.curve.shape(self.curve.span_of(xi), xi)
    }

    fn partner(&self, xi: f64, seeker: &Seeker) -> Option<Partner> {
        let span = self.curve.span_of(xi);
        let shape = self.curve.shape(span, xi);
        let distance = (self.curve.place(&shape, 0, self.points) - seeker.x).norm();
        let normal = rot90(self.curve.place(&shape, 1, self.points)) * self.curve.side;
        (normal.dot(&seeker.normal) < 0.0 && distance < self.reach).then_some(Partner { span, xi, shape })
    }

    /// From the nearest sample, and from every other sample nearer than its neighbours that may lead to a nearer place:
    /// valleys have two flanks, rough edges many.
    fn closest(&self, seeker: &Seeker) -> Option<Partner> {
        let distance = |s: &Sample| (s.y - seeker.x).norm_squared();
        let opposes = |s: &Sample| s.normal.dot(&seeker.normal) < 0.0;
        let all = self.outline.samples.iter().enumerate();
        let (nearest, _) =
            all.filter(|(_, s)| opposes(s)).min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
        let mut best = Some(self.descend(nearest, seeker)?).filter(|found| self.meant(found, seeker));
        let mut reached = best.as_ref().map_or(f64::INFINITY, |found| self.distance(found, seeker));
        for (k, near) in self.outline.samples.windows(3).enumerate() {
            let here = distance(&near[1]);
            if here > distance(&near[0]) || here > distance(&near[2]) || k + 1 == nearest || !opposes(&near[1]) {
                continue;
            }
            let step = (near[1].y - near[0].y).norm().max((near[2].y - near[1].y).norm());
            if here.sqrt() - step < reached
                && let Some(other) = self.descend(k + 1, seeker)
                && self.distance(&other, seeker) < reached
                && self.meant(&other, seeker)
            {
                (reached, best) = (self.distance(&other, seeker), Some(other));
            }
        }
        best
    }

    /// False for what lies behind a point that is not inside the body, see [`Outline::entered`].
    fn meant(&self, partner: &Partner, seeker: &Seeker) -> bool {
        let (x, y) = (seeker.x, self.curve.place(&partner.shape, 0, self.points));
        (y - x).dot(&seeker.normal) >= 0.0 || !self.outline.entered(x, y)
    }

    fn distance(&self, partner: &Partner, seeker: &Seeker) -> f64 {
        (self.curve.place(&partner.shape, 0, self.points) - seeker.x).norm()
    }

    /// The minimum of the distance next to a sample.
    fn descend(&self, best: usize, seeker: &Seeker) -> Option<Partner> {
        // f = (x - y).a falls through zero at a minimum of the distance.
        let value = |xi: f64| {
            let shape = self.shape(xi);
            let [y, a, b] = [0, 1, 2].map(|k| self.curve.place(&shape, k, self.points));
            ((seeker.x - y).dot(&a), (seeker.x - y).dot(&b) - a.norm_squared())
        };
        let at = |k: usize| (seeker.x - self.outline.samples[k].y).dot(&self.outline.samples[k].a);
        let mut low = best.saturating_sub(1);
        let mut high = (best + 1).min(self.outline.samples.len() - 1);
        while low > 0 && at(low) < 0.0 {
            low -= 1;
        }
        while high + 1 < self.outline.samples.len() && at(high) > 0.0 {
            high += 1;
        }
        let [low, high] = [low, high].map(|k| (self.outline.samples[k].xi, at(k)));
        let xi = root(value, low, high, self.outline.samples[best].xi)?;
        self.partner(xi, seeker)
    }

    fn ray(&self, seeker: &Seeker) -> Option<Partner> {
        let value = |xi: f64| {
            let shape = self.shape(xi);
            let [y, a] = [0, 1].map(|k| self.curve.place(&shape, k, self.points));
            (-(y - seeker.x).dot(&seeker.tangent), -a.dot(&seeker.tangent))
        };
        let offset = |s: &Sample| (s.y - seeker.x).dot(&seeker.tangent);
        let mut best: Option<(f64, Partner)> = None;
        for pair in self.outline.samples.windows(2) {
            let (low, high) = (offset(&pair[0]), offset(&pair[1]));
            if low * high > 0.0 || pair.iter().all(|s| s.normal.dot(&seeker.normal) >= 0.0) {
                continue;
            }
            let farther = |d: f64| {
                let beyond = d + (pair[1].y - pair[0].y).norm();
                pair.iter().all(|s| (s.y - seeker.x).norm() > beyond)
            };
            if best.as_ref().is_some_and(|(d, _)| farther(*d)) {
                continue;
            }
            let sign = if low < high { 1.0 } else { -1.0 };
            let oriented = |xi: f64| {
                let (f, df) = value(xi);
                (sign * f, sign * df)
            };
            let ends = [(pair[0].xi, -sign * low), (pair[1].xi, -sign * high)];
            let found = root(oriented, ends[0], ends[1], 0.5 * (pair[0].xi + pair[1].xi))
                .and_then(|xi| self.partner(xi, seeker));
            if let Some(partner) = found {
                let distance = self.distance(&partner, seeker);
                let nearer = best.as_ref().is_none_or(|(d, _)| distance < *d);
                if nearer && self.meant(&partner, seeker) {
                    best = Some((distance, partner));
                }
            }
        }
        best.map(|(_, partner)| partner)
    }
}

/// The parameter on the same flank as `xi`: a local search from there for the point of the curve closest to `x`. Stops at
/// the ends of the curve.
pub fn parameter_near(curve: &Curve, points: &[Point], x: Point, mut xi: f64) -> f64 {
    let breaks = curve.basis.breaks();
    let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
    for _ in 0..20 {
        let shape = curve.shape(curve.span_of(xi), xi);
        let (y, a) = (curve.place(&shape, 0, points), curve.place(&shape, 1, points));
        let step = (x - y).dot(&a) / a.norm_squared();
        let next = (xi + step).clamp(start, end);
        let done = (next - xi).abs() < 1e-14 * (end - start);
        xi = next;
        if done {
            break;
        }
    }
    xi
}

/// Root of a function that falls from positive to negative over `[low, high]` (both with its value there): Newton, bisection
/// where Newton leaves the bracket. `None` without a change of sign.
fn root(
    f: impl Fn(f64) -> (f64, f64),
    (mut low, at_low): (f64, f64),
    (mut high, at_high): (f64, f64),
    start: f64,
) -> Option<f64> {
    let tolerance = 1e-15 * (high - low).abs().max(low.abs()).max(high.abs());
    if at_low < 0.0 || at_high > 0.0 {
        return None;
    }
    let mut xi = start;
    for _ in 0..80 {
        let (value, slope) = f(xi);
        if value > 0.0 {
            low = xi;
        } else {
            high = xi;
        }
        let newton = xi - value / slope;
        let next = if slope < 0.0 && newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let step = (next - xi).abs();
        xi = if value == 0.0 { xi } else { next };
        if step <= tolerance || value == 0.0 {
            break;
        }
    }
    Some(xi)
}
