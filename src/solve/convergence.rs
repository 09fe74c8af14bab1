//! When a Newton iteration has converged, and when it will not.

use crate::model::{Evaluation, Model};

/// Accepted residual relative to the largest nodal force.
const RELATIVE: f64 = 1e-9;
/// Round-off of a translated body, relative to its `E` times the size of the model. Near incompressibility it grows with the
/// stiffness against changes of volume.
const ROUND_OFF: f64 = 1e-14;
/// Iterations without a residual below half of the best before, after which the next guess is tried.
const PATIENCE: usize = 5;

/// True where the residual is as small as is asked for.
pub fn balanced(model: &Model, evaluation: &Evaluation) -> bool {
    largest(model, evaluation) <= RELATIVE * evaluation.force_scale
}

/// The residual beyond round-off, entry by entry: that of a stiff body may be far above what a soft one bears.
fn beyond<'a>(model: &'a Model, evaluation: &'a Evaluation) -> impl Iterator<Item = f64> + 'a {
    let unit = ROUND_OFF * model.size();
    evaluation.residual.iter().enumerate().map(move |(e, r)| {
        let left = r.abs() - unit * model.stiffness_at(e, evaluation.dt);
        if left < 0.0 { 0.0 } else { left } // NaN stays
    })
}

/// Largest residual beyond round-off; `NaN` if there is one.
pub fn largest(model: &Model, evaluation: &Evaluation) -> f64 {
    beyond(model, evaluation).fold(0.0_f64, |m, v| if v.is_nan() || m.is_nan() { f64::NAN } else { m.max(v) })
}

/// Euclidean norm of the residual beyond round-off.
pub fn norm(model: &Model, evaluation: &Evaluation) -> f64 {
    beyond(model, evaluation).map(|v| v * v).sum::<f64>().sqrt()
}

/// The residual asked for of the softest body.
pub fn tolerance(model: &Model, evaluation: &Evaluation) -> f64 {
    RELATIVE * evaluation.force_scale + ROUND_OFF * model.modulus * model.confinement * model.size()
}

/// True where the best residual is [`PATIENCE`] iterations old: the active set cycles.
pub fn stalled(residuals: &[f64]) -> bool {
    let (old, new) = residuals.split_at(residuals.len().saturating_sub(PATIENCE));
    let best = |part: &[f64]| part.iter().fold(f64::INFINITY, |m, v| m.min(*v));
    !old.is_empty() && best(new) > 0.5 * best(old)
}

/// The next residual, should the convergence be quadratic.
pub fn forecast(residuals: &[f64]) -> f64 {
    match residuals {
        [.., before, last] => last * (last / before).powi(2),
        _ => f64::INFINITY,
    }
}
