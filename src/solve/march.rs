//! Through time: the nominal steps and what is reported of each.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use crate::math::LinearSolver;
use crate::model::{Evaluation, Model, Record, State, record};

use super::Strategy;
use super::advance::Advance;
use super::status::{Outcome, Status};
use super::witness::Witness;

/// Time plan of an analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// End time.
    pub end: f64,
    /// Nominal steps of equal length; reports land on their ends.
    pub steps: usize,
    /// How often a nominal step may be halved.
    pub max_cuts: u32,
    /// How a Newton iteration treats contact.
    pub strategy: Strategy,
}

/// A nominal step that was reached.
pub struct StepReport<'a> {
    /// Its state.
    pub state: &'a State,
    /// Its evaluation.
    pub evaluation: &'a Evaluation,
    /// Its row of the history.
    pub record: Record,
    /// Where the march stands: what [`proceed`] goes on from.
    pub outcome: &'a Outcome,
    /// Its solver.
    pub solver: &'a dyn LinearSolver,
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
    report: impl FnMut(StepReport) -> Result<(), E>,
) -> Result<Outcome, E> {
    proceed(model, Outcome::at(start), control, Tools { solver, witness: &mut () }, interrupt, report)
}

/// What a march works with.
pub struct Tools<'a> {
    /// Solver of the linear systems.
    pub solver: &'a mut dyn LinearSolver,
    /// Its companion.
    pub witness: &'a mut dyn Witness,
}

/// Goes on from the end of a nominal step, bit for bit like the march that reported it; the solver must recall what that of
/// the other march remembered there.
///
/// # Errors
/// As [`march`].
pub fn proceed<E>(
    model: &Model,
    from: Outcome,
    control: &Control,
    tools: Tools,
    interrupt: &AtomicBool,
    mut report: impl FnMut(StepReport) -> Result<(), E>,
) -> Result<Outcome, E> {
    let nominal = control.end / control.steps as f64;
    let first = (from.state.time / nominal).round() as usize;
    let smallest = nominal * 0.5_f64.powi(control.max_cuts as i32);
    let mut march = Advance {
        model,
        strategy: control.strategy,
        tools,
        interrupt,
        nominal,
        smallest,
        failures: 0,
        drag: None,
        tried: vec![],
        outcome: Outcome { status: Status::Done, ..from },
    };
    for step in first + 1..=control.steps {
        let clock = Instant::now();
        let target = if step == control.steps { control.end } else { step as f64 * nominal };
        let before = (march.outcome.iterations, march.outcome.cuts, march.outcome.snaps);
        match march.reach(target) {
            Ok(found) => {
                let outcome = &march.outcome;
                let record = Record {
                    step,
                    newton_iterations: outcome.iterations - before.0,
                    cuts: outcome.cuts - before.1,
                    snaps: outcome.snaps - before.2,
                    wall_s: clock.elapsed().as_secs_f64(),
                    weakening: found.weakening,
                    ..record(model, &outcome.state, &found.evaluation)
                };
                let (state, evaluation, solver) = (&outcome.state, &found.evaluation, &*march.tools.solver);
                report(StepReport { state, evaluation, record, outcome, solver })?;
            }
            Err(status) => {
                march.outcome.status = status;
                break;
            }
        }
    }
    Ok(march.outcome)
}
