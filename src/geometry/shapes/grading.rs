//! Where elements are small.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::{Edge, GeometryError};

/// Refinement towards an edge and/or along it; the number of elements stays `elements`.
///
/// `toward = "top", ratio = 8.0`: seen across the body, the element size at `top` is one eighth of the size at the
/// opposite edge and grows geometrically in between. `along = { center, half_width, ratio }`: along that edge (along
/// `u` without `toward`), elements within `half_width` of `center` are uniform, outside they grow geometrically up to
/// `ratio` times that size at the farther end. Coordinates are those of the parameter: x of the body (before
/// `position`) along the bottom and top of a block, the knots of an explicit patch, 0 to 1 otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grading {
    /// Edge at which the elements are smallest; needs `ratio`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub toward: Option<Edge>,
    /// Size at the opposite edge over size at the edge, at least 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ratio: Option<f64>,
    /// Fine zone along the edge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub along: Option<Along>,
}

/// Fine zone along an edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Along {
    /// Middle of the fine zone.
    pub center: f64,
    /// Half the length of the fine zone, at least 0.
    pub half_width: f64,
    /// Largest over smallest element size, at least 1.
    pub ratio: f64,
}

impl Grading {
    pub(super) fn check(&self) -> Result<(), GeometryError> {
        if self.toward.is_some() != self.ratio.is_some() {
            let key = if self.ratio.is_some() { "toward" } else { "ratio" };
            return Err(fail(key, "`toward` and `ratio` must be given together"));
        }
        check_ratio("ratio", self.ratio.unwrap_or(1.0))?;
        if let Some(along) = self.along {
            check_ratio("along.ratio", along.ratio)?;
            if !along.center.is_finite() {
                return Err(fail("along.center", "must be a finite number"));
            }
            if !(along.half_width.is_finite() && along.half_width >= 0.0) {
                return Err(fail("along.half_width", "must be a finite number, 0 or more"));
            }
        }
        Ok(())
    }

    /// Size function in direction 0 (`u`) or 1 (`v`) on the range `[lo, hi]`.
    pub(super) fn density(grading: Option<&Self>, direction: usize, range: [f64; 2]) -> Result<Density, GeometryError> {
        let [lo, hi] = range;
        let Some(grading) = grading else {
            return Ok(Density::new(range, range, 1.0));
        };
        let edge = grading.toward.map_or(0, Edge::direction);
        if direction != edge {
            let zone = match grading.toward {
                Some(Edge::Bottom | Edge::Left) => [lo, lo],
                Some(Edge::Top | Edge::Right) => [hi, hi],
                None => range,
            };
            return Ok(Density::new(range, zone, grading.ratio.unwrap_or(1.0)));
        }
        let Some(along) = grading.along else {
            return Ok(Density::new(range, range, 1.0));
        };
        let zone = [(along.center - along.half_width).max(lo), (along.center + along.half_width).min(hi)];
        if zone[0] > zone[1] {
            let message = format!("the fine zone must touch the edge, which runs from {lo} to {hi}");
            return Err(fail("along.center", message));
        }
        Ok(Density::new(range, zone, along.ratio))
    }
}

fn fail(key: &str, message: impl Into<String>) -> GeometryError {
    GeometryError::outside("grading", key, message)
}

fn check_ratio(key: &str, ratio: f64) -> Result<(), GeometryError> {
    if ratio.is_finite() && ratio >= 1.0 {
        return Ok(());
    }
    Err(fail(key, format!("must be a finite number, 1 or more, is {ratio}")))
}

/// Relative element size `s(x) = 1 + k d(x)` with the distance `d` from the fine zone: a size that grows linearly with
/// the distance is a geometric series of elements. `k` makes `s = ratio` at the farthest point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    range: [f64; 2],
    zone: [f64; 2],
    growth: f64,
}

impl Density {
    fn new(range: [f64; 2], zone: [f64; 2], ratio: f64) -> Self {
        let farthest = (zone[0] - range[0]).max(range[1] - zone[1]);
        let growth = if farthest > 0.0 { (ratio - 1.0) / farthest } else { 0.0 };
        Self { range, zone, growth }
    }

    /// `int dx / s` from the start of the fine zone, proportional to a number of elements.
    fn count(&self, x: f64) -> f64 {
        let [a, b] = self.zone;
        let outside = |d: f64| {
            let grown = self.growth * d;
            if grown < 1e-9 { d } else { grown.ln_1p() / self.growth }
        };
        if x < a {
            -outside(a - x)
        } else if x > b {
            b - a + outside(x - b)
        } else {
            x - a
        }
    }

    fn position(&self, count: f64) -> f64 {
        let [a, b] = self.zone;
        let outside = |n: f64| {
            let grown = self.growth * n;
            if grown < 1e-9 { n } else { grown.exp_m1() / self.growth }
        };
        if count < 0.0 {
            a - outside(-count)
        } else if count > b - a {
            b + outside(count - (b - a))
        } else {
            a + count
        }
    }

    /// Share of the range, measured in elements, that lies between `a` and `b`.
    pub(super) fn share(&self, a: f64, b: f64) -> f64 {
        (self.count(b) - self.count(a)) / (self.count(self.range[1]) - self.count(self.range[0]))
    }

    /// Divides `[a, b]` into `n` elements and appends the ends but the first.
    pub(super) fn divide(&self, a: f64, b: f64, n: usize, breaks: &mut Vec<f64>) {
        let (start, end) = (self.count(a), self.count(b));
        for i in 1..n {
            let t = i as f64 / n as f64;
            breaks.push(self.position(start + (end - start) * t));
        }
        breaks.push(b);
    }
}
