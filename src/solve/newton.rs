//! Semismooth Newton for one step.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::contact::ContactStatus;
use crate::math::{LinearSolver, SolveError};
use crate::model::{Control, Evaluation, Model, State, evaluate};

use super::predictor::{guesses, trend};

/// Largest number of iterations from one guess.
const MAX_ITERATIONS: usize = 20;
/// Accepted residual relative to the largest nodal force.
const RELATIVE: f64 = 1e-9;
/// Accepted residual relative to `E` times the size of the model: round-off of a translated body.
const ROUND_OFF: f64 = 1e-14;

/// Growth of the residual that a full step may show.
const GROWTH: f64 = 1.0 + 1e-6;
/// Lengths tried when a full step is no good: 1, 1/2, 1/4, ...
const HALVINGS: i32 = 7;

/// Smallest spring of a floating body in units of `E`.
const FAINTEST_SPRING: f64 = 1e-10;

/// Why a step was thrown away.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// No convergence.
    #[error(
        "Newton's method did not converge in {iterations} iterations (residual {residual:.1e} of the largest nodal force){hint}"
    )]
    Iterations {
        /// Linear solves.
        iterations: usize,
        /// Last residual over the largest nodal force.
        residual: f64,
        /// What the last iterate suggests, starting with a separator; may be empty.
        hint: String,
    },
    /// A body was turned inside out and no shorter step helped.
    #[error("a body is turned inside out (det F <= 0) in iteration {0}")]
    Inverted(usize),
    /// The linear system could not be solved.
    #[error("{0}")]
    Linear(#[from] SolveError),
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}

/// A converged step.
pub struct NewtonReport {
    /// State at the end of the step, ledger included.
    pub state: State,
    /// Evaluation there.
    pub evaluation: Evaluation,
    /// Linear solves.
    pub iterations: usize,
    /// Largest residual entry of every iterate.
    pub residuals: Vec<f64>,
}

/// Solves the step from `start` to `time`, from the best of the guesses and, where Newton fails, from the next.
/// `iterations` counts the linear solves, failed attempts included.
///
/// # Errors
/// The first failure; `start` is untouched.
pub fn solve_step(
    model: &Model,
    start: &State,
    time: f64,
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    iterations: &mut usize,
) -> Result<NewtonReport, StepFailure> {
    let mut failure = StepFailure::Inverted(0);
    for (k, guess) in guesses(model, start, time).into_iter().enumerate() {
        match newton(model, start, guess, solver, interrupt, iterations) {
            Err(StepFailure::Interrupted) => return Err(StepFailure::Interrupted),
            Err(error) if k == 0 => failure = error,
            Err(_) => {}
            done => return done,
        }
    }
    Err(failure)
}

/// Newton's method from one guess.
fn newton(
    model: &Model,
    start: &State,
    mut trial: State,
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    iterations: &mut usize,
) -> Result<NewtonReport, StepFailure> {
    let mut evaluation = evaluate(model, start, &trial, true).ok_or(StepFailure::Inverted(0))?;
    let mut residuals = Vec::new();
    let floor = ROUND_OFF * model.modulus * model.size();
    for iteration in 0..=MAX_ITERATIONS {
        let size = evaluation.residual.iter().fold(0.0_f64, |m, v| if v.is_nan() { f64::NAN } else { m.max(v.abs()) });
        residuals.push(size);
        if size <= RELATIVE * evaluation.force_scale + floor {
            let state = commit(model, start, trial, &evaluation);
            return Ok(NewtonReport { state, evaluation, iterations: iteration, residuals });
        }
        if iteration == MAX_ITERATIONS || size.is_nan() {
            let residual = size / evaluation.force_scale;
            let hint = hint(model, &evaluation);
            return Err(StepFailure::Iterations { iterations: iteration, residual, hint });
        }
        if interrupt.load(Ordering::Relaxed) {
            return Err(StepFailure::Interrupted);
        }
        *iterations += 1;
        let increment = increment(model, &mut evaluation, solver)?;
        (trial, evaluation) =
            update(model, start, &trial, &increment, evaluation.norm()).ok_or(StepFailure::Inverted(iteration + 1))?;
    }
    unreachable!("the last iteration returns")
}

/// The Newton increment; takes the system out of the evaluation.
fn increment(
    model: &Model,
    evaluation: &mut Evaluation,
    solver: &mut dyn LinearSolver,
) -> Result<Vec<f64>, SolveError> {
    let right: Vec<f64> = evaluation.residual.iter().map(|v| -v).collect();
    let mut system = evaluation.system.take().expect("evaluated with tangent");
    support_floating(model, evaluation, &mut system.interface);
    solver.solve(&system, &right)
}

/// Adds the increment. A step along which the residual grows beyond [`GROWTH`] is halved a few times and the best length
/// taken (the residual of a semismooth system need not fall, so that is no failure); one that turns a body inside out
/// is halved until it does not.
fn update(model: &Model, start: &State, trial: &State, increment: &[f64], before: f64) -> Option<(State, Evaluation)> {
    let moved = |factor: f64| {
        let mut next = trial.clone();
        next.advance(model, increment, factor);
        next
    };
    let full = moved(1.0);
    if let Some(evaluation) = evaluate(model, start, &full, true)
        && evaluation.norm() <= GROWTH * before
    {
        return Some((full, evaluation));
    }
    let mut best: Option<(f64, f64)> = None;
    for k in 0..HALVINGS {
        let factor = 0.5_f64.powi(k);
        if let Some(size) = evaluate(model, start, &moved(factor), false).as_ref().map(Evaluation::norm) {
            if best.is_none_or(|(smallest, _)| size < smallest) {
                best = Some((size, factor));
            }
            if size <= before {
                break;
            }
        }
    }
    let next = moved(best?.1);
    evaluate(model, start, &next, true).map(|evaluation| (next, evaluation))
}

/// Springs for bodies that nothing holds at this iterate: those without a prescribed displacement while they touch nothing
/// or nothing sticks (no stiffness against rigid motion), and load equations of guided bodies that touch nothing. A spring
/// lets the body travel by about one element length per iteration until it is held. It acts on the increment alone, never
/// on the solution, and fades with the residual, so that convergence stays quadratic.
fn support_floating(model: &Model, evaluation: &Evaluation, entries: &mut crate::math::Triplets) {
    for k in 0..model.bodies.len() {
        let motions = || model.motions.iter().zip(&model.equations.of_motion).filter(|(m, _)| m.body == k);
        let guided = motions().any(|(m, _)| matches!(m.control, Control::Displacement(_)));
        let loaded: Vec<usize> = motions().filter_map(|(_, equation)| *equation).collect();
        if (guided && loaded.is_empty()) || model.bodies[k].is_rigid() && loaded.is_empty() {
            continue;
        }
        let holds = |status: ContactStatus| match status {
            ContactStatus::Open => false,
            ContactStatus::Stick => true,
            ContactStatus::Slip => guided,
        };
        let held = evaluation.statuses_of(model, k).any(holds);
        if held {
            continue;
        }
        let equations = if guided { loaded } else { equations_of(model, k) };
        let load = equations.iter().fold(0.0_f64, |m, &e| m.max(evaluation.residual[e].abs()));
        let stiffness = load / (model.element_size * equations.len() as f64);
        let spring = stiffness.max(FAINTEST_SPRING * model.modulus);
        entries.extend(equations.into_iter().map(|e| (e, e, spring)));
    }
}

/// Names a body that only forces and contact hold and that slips wherever it touches: its load may exceed what friction
/// can carry.
fn hint(model: &Model, evaluation: &Evaluation) -> String {
    let free = |k: usize| {
        let mut motions = model.motions.iter().filter(|m| m.body == k).peekable();
        motions.peek().is_some() && motions.all(|m| matches!(m.control, Control::Force(_)))
    };
    let sticks = |k: usize| evaluation.statuses_of(model, k).any(|status| status == ContactStatus::Stick);
    match (0..model.bodies.len()).find(|&k| free(k) && !sticks(k)) {
        Some(k) => format!(
            "; body `{}` is held by forces and contact alone and sticks nowhere: friction may be too weak for an equilibrium",
            model.bodies[k].name
        ),
        None => String::new(),
    }
}

/// Displacement unknowns of a body, each once.
fn equations_of(model: &Model, body: usize) -> Vec<usize> {
    let nodes = model.bodies[body].nodes();
    let mut equations: Vec<usize> =
        nodes.flat_map(|i| (0..2).filter_map(move |c| model.equations.unknown(i, c))).collect();
    equations.sort_unstable();
    equations.dedup();
    equations
}

/// The trial state as the new committed one: internal variables, forces and work.
fn commit(model: &Model, start: &State, mut trial: State, evaluation: &Evaluation) -> State {
    for (pair, found) in trial.pairs.iter_mut().zip(&evaluation.interfaces) {
        pair.sites.clone_from(&found.memory);
        trial.ledger.dissipated += found.dissipated;
    }
    trial.trend = Some(trend(model, start, &trial));
    trial.ledger.settle(model, start, &trial.u, trial.time, evaluation);
    trial
}
