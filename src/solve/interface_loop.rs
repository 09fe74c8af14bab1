//! Contact settled while the bodies stay linearised: the inner loop of a Newton iteration.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::LinearSolver;
use crate::model::{Evaluation, Linearised};

/// Inner iterations at most.
const MOST: usize = 10;
/// Reduction below which an inner iteration is taken to cycle.
const STALLED: f64 = 0.5;
/// Inner residual wanted, of the outer one, far from the solution; near it the outer residual relative to the largest nodal
/// force, so that the outer iteration stays quadratic.
const LOOSE: f64 = 0.1;

/// How a Newton iteration treats contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Strategy {
    /// Bodies and contact in one linear system.
    #[default]
    Monolithic,
    /// The same, then contact alone until its conditions hold for the linearised bodies.
    Interface,
}

/// Continues an increment by Newton iterations on the interface alone. Where these do not settle the increment itself is
/// the answer.
pub fn settle(
    mut bodies: Linearised,
    increment: Vec<f64>,
    outer: &Evaluation,
    solver: &mut dyn LinearSolver,
) -> Vec<f64> {
    let size = outer.norm();
    let goal = size * f64::min(LOOSE, size / outer.force_scale);
    bodies.advance(&increment);
    let mut before = bodies.norm();
    for _ in 0..MOST {
        if before <= goal {
            return bodies.moved().to_vec();
        }
        let Ok(more) = solver.solve(&bodies.system, &negative(&bodies.residual)) else { break };
        bodies.advance(&more);
        let now = bodies.norm();
        if now > goal && (now.is_nan() || now > STALLED * before) {
            break;
        }
        before = now;
    }
    increment
}

/// `-v`.
pub fn negative(v: &[f64]) -> Vec<f64> {
    v.iter().map(|x| -x).collect()
}
