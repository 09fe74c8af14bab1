//! A patch spelled out in the scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mesh::Master;
use super::{finite, positive};
use crate::geometry::refine::lift;
use crate::geometry::{BSpline, Basis, GeometryError, MAX_DEGREE, Point};

/// Explicit NURBS patch. It is raised to the degree of the body's basis and refined to `elements`, which must allow for
/// its own knot spans; the geometry stays as it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Nurbs {
    /// Degrees in `u` and `v`, 1 to 8.
    pub degrees: [usize; 2],
    /// Knots in `u` and `v`: non-decreasing, the ends repeated `degree + 1` times, others at most `degree` times.
    pub knots: [Vec<f64>; 2],
    /// Control points `[x, y]`, `u` running fastest; the edges of the parameter square must run counter-clockwise.
    pub points: Vec<[f64; 2]>,
    /// Positive weight of each control point, 1 if omitted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weights: Option<Vec<f64>>,
}

impl Nurbs {
    pub(super) fn master(&self) -> Result<Master, GeometryError> {
        if self.degrees.iter().any(|p| !(1..=MAX_DEGREE).contains(p)) {
            let message = format!("must be 1 to {MAX_DEGREE}, are {:?}", self.degrees);
            return Err(GeometryError::shape("degrees", message));
        }
        let basis = [self.direction(0)?, self.direction(1)?];
        finite("points", self.points.as_flattened())?;
        let count = basis[0].len() * basis[1].len();
        if self.points.len() != count {
            let message = format!(
                "degrees and knots ask for {} x {} = {count} points, there are {}",
                basis[0].len(),
                basis[1].len(),
                self.points.len()
            );
            return Err(GeometryError::shape("points", message));
        }
        let weights = self.weights.clone().unwrap_or_else(|| vec![1.0; count]);
        if weights.len() != count {
            let message = format!("there must be {count}, one for each point, there are {}", weights.len());
            return Err(GeometryError::shape("weights", message));
        }
        weights.iter().try_for_each(|&w| positive("weights", w))?;
        let points: Vec<Point> = self.points.iter().map(|&p| Point::from(p)).collect();
        Ok(Master { basis, net: lift(&points, &weights) })
    }

    /// Basis of one direction, continuous.
    fn direction(&self, direction: usize) -> Result<BSpline, GeometryError> {
        let degree = self.degrees[direction];
        let spline = BSpline::new(degree, self.knots[direction].clone())?;
        let breaks = spline.breaks();
        let inner = &breaks[1..breaks.len() - 1];
        if let Some(t) = inner.iter().find(|&&t| spline.multiplicity(t) > degree) {
            let message = format!("knot {t} occurs more than {degree} times: the patch would fall apart there");
            return Err(GeometryError::shape("knots", message));
        }
        Ok(spline)
    }
}
