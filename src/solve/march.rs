//! Through time: nominal steps, cut where Newton fails and regrown after.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::math::LinearSolver;
use crate::model::{Control as MotionControl, Evaluation, Model, Motion, Record, State, record};

use super::newton::{StepFailure, solve_step};
use super::status::{Outcome, Status};

/// Time plan of an analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// End time.
    pub end: f64,
    /// Nominal steps of equal length; reports land on their ends.
    pub steps: usize,
    /// How often a nominal step may be halved.
    pub max_cuts: u32,
}

/// A nominal step that was reached.
pub struct StepReport<'a> {
    /// Its state.
    pub state: &'a State,
    /// Its evaluation.
    pub evaluation: &'a Evaluation,
    /// Its row of the history.
    pub record: Record,
}

/// Advances `start` through the nominal steps that lie after it and reports each. What `report` returns as an error
/// stops the march and is handed through.
///
/// # Errors
/// Only those of `report`; failures of the solver are an [`Outcome`].
pub fn march<E>(
    model: &Model,
    start: State,
    control: &Control,
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    mut report: impl FnMut(StepReport) -> Result<(), E>,
) -> Result<Outcome, E> {
    let nominal = control.end / control.steps as f64;
    let first = (start.time / nominal).round() as usize;
    let mut outcome =
        Outcome { status: Status::Done, state: start, iterations: 0, steps: 0, cuts: 0, factorisations: 0 };
    let mut dt = nominal;
    for step in first + 1..=control.steps {
        let clock = Instant::now();
        let target = if step == control.steps { control.end } else { step as f64 * nominal };
        let before = (outcome.iterations, outcome.cuts);
        let found = reach(model, target, nominal, control.max_cuts, &mut dt, solver, interrupt, &mut outcome);
        outcome.factorisations = solver.factorisations();
        match found {
            Ok(evaluation) => {
                let record = Record {
                    step,
                    newton_iterations: outcome.iterations - before.0,
                    cuts: outcome.cuts - before.1,
                    wall_s: clock.elapsed().as_secs_f64(),
                    ..record(model, &outcome.state, &evaluation)
                };
                report(StepReport { state: &outcome.state, evaluation: &evaluation, record })?;
            }
            Err(status) => {
                outcome.status = status;
                break;
            }
        }
    }
    Ok(outcome)
}

/// The time up to which no driven edge travels farther than [`Model::stride`], at most `wanted`.
fn within_stride(model: &Model, time: f64, mut wanted: f64) -> f64 {
    let travel = |until: f64| {
        let of = |motion: &Motion| match &motion.control {
            MotionControl::Displacement(table) => (table.at(until) - table.at(time)).abs(),
            MotionControl::Force(_) => 0.0,
        };
        model.motions.iter().map(of).fold(0.0, f64::max)
    };
    while travel(wanted) > model.stride {
        wanted = time + 0.5 * (wanted - time);
    }
    wanted
}

/// Sub-steps up to `target`; `dt` is remembered from one nominal step to the next.
#[allow(clippy::too_many_arguments)]
fn reach(
    model: &Model,
    target: f64,
    nominal: f64,
    max_cuts: u32,
    dt: &mut f64,
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    outcome: &mut Outcome,
) -> Result<Evaluation, Status> {
    let smallest = nominal * 0.5_f64.powi(max_cuts as i32);
    loop {
        let time = outcome.state.time;
        if interrupt.load(Ordering::Relaxed) {
            return Err(Status::Interrupted { time });
        }
        // A remainder below half a sub-step joins the last one.
        let left = target - time;
        let wanted = if left <= 1.5 * *dt { target } else { time + *dt };
        let next = within_stride(model, time, wanted);
        match solve_step(model, &outcome.state, next, solver, interrupt, &mut outcome.iterations) {
            Ok(done) => {
                outcome.state = done.state;
                outcome.steps += 1;
                *dt = (2.0 * *dt).min(nominal);
                if next == target {
                    return Ok(done.evaluation);
                }
            }
            Err(StepFailure::Interrupted) => return Err(Status::Interrupted { time }),
            Err(failure) => {
                outcome.cuts += 1;
                *dt = 0.5 * (next - time);
                if *dt < smallest {
                    return Err(Status::NotConverged { time, reason: failure.to_string() });
                }
            }
        }
    }
}
