//! Through time: nominal steps, cut where Newton fails and regrown after.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::math::LinearSolver;
use crate::model::{
    Control as MotionControl, Drag, Evaluation, Model, Motion, Record, State, Tangent, evaluate, record, suggested_step,
};

use super::Strategy;
use super::crossing::cross;
use super::failure::StepFailure;
use super::limits;
use super::newton::{NewtonReport, Step, solve_dragged, solve_step};
use super::status::{Outcome, Status};
use super::witness::{Effort, Witness};

/// A law that suggests a step shorter than this share of the one taken has it repeated.
const VETO: f64 = 1.0 - 1e-9;

/// A step that must be halved more often for its drive to be followed is a slip of the pen.
const MOST_HALVINGS: usize = 12;

/// Iterations above which the next step is half as long: an easy step takes about four, so two of half the length cost no
/// more then (measured in `papers/cost`).
const HARD: usize = 8;

/// Cuts without a step between them after which the equilibrium path is taken to end.
const LOST: usize = 2;

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
    let mut march = March {
        model,
        strategy: control.strategy,
        tools,
        interrupt,
        nominal,
        smallest,
        failures: 0,
        drag: None,
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

/// The time up to which no driven edge, or body in flight, travels farther than [`Model::stride`], at most `wanted`; `None` where a drive outruns that by
/// more than [`MOST_HALVINGS`].
fn within_stride(model: &Model, state: &State, wanted: f64) -> Option<f64> {
    let (time, speed) = (state.time, state.rates.velocity.iter().fold(0.0_f64, |m, v| m.max(v.amax())));
    let travel = |until: f64| {
        let of = |motion: &Motion| match &motion.control {
            MotionControl::Displacement(table) => (table.at(until) - table.at(time)).abs(),
            MotionControl::Force(_) => 0.0,
        };
        model.motions.iter().map(of).fold(speed * (until - time), f64::max)
    };
    let mut halved = std::iter::successors(Some(wanted), |until| Some(time + 0.5 * (until - time)));
    halved.by_ref().take(MOST_HALVINGS).find(|until| travel(*until) <= model.stride)
}

/// A march under way.
struct March<'a, 't> {
    model: &'a Model,
    strategy: Strategy,
    tools: Tools<'t>,
    interrupt: &'a AtomicBool,
    nominal: f64,
    smallest: f64,
    /// Cuts since the last step.
    failures: usize,
    /// Made when it is needed first.
    drag: Option<Drag>,
    outcome: Outcome,
}

/// End of a nominal step.
struct Reached {
    evaluation: Evaluation,
    /// Largest [`super::NewtonReport::weakening`] of its sub-steps.
    weakening: f64,
}

impl March<'_, '_> {
    /// Sub-steps up to `target`.
    fn reach(&mut self, target: f64) -> Result<Reached, Status> {
        let mut weakening = 0.0_f64;
        loop {
            let time = self.outcome.state.time;
            if self.interrupt.load(Ordering::Relaxed) {
                return Err(Status::Interrupted { time });
            }
            // A remainder below half a sub-step joins the last one.
            let left = target - time;
            let wanted = if left <= 1.5 * self.outcome.dt { left } else { self.outcome.dt };
            let pieces = (wanted / self.outcome.law * VETO).ceil().max(1.0);
            let wanted = if wanted / pieces == left { target } else { time + wanted / pieces };
            let Some(next) = within_stride(self.model, &self.outcome.state, wanted) else {
                let stride = self.model.stride;
                let reason = format!(
                    "a driven edge or a body in flight moves so fast that steps of {stride:.1e} cannot follow it: take more steps"
                );
                return Err(Status::NotConverged { time, reason });
            };
            match self.step(next) {
                Ok(done) => {
                    weakening = weakening.max(done.weakening);
                    if next == target {
                        return Ok(Reached { evaluation: done.evaluation, weakening });
                    }
                }
                Err(StepFailure::Interrupted) => return Err(Status::Interrupted { time }),
                Err(failure) => {
                    self.outcome.cuts += 1;
                    self.failures += 1;
                    if self.failures == LOST && failure.lost() && self.cross(next) {
                        continue;
                    }
                    match failure {
                        StepFailure::Vetoed { step, .. } => self.outcome.law = step,
                        _ => self.outcome.dt = 0.5 * (next - time),
                    }
                    if self.outcome.dt.min(self.outcome.law) < self.smallest {
                        if failure.lost() && target - time > self.smallest && self.cross(target) {
                            continue;
                        }
                        let reason = failure.to_string() + &limits::reached(self.model, &self.outcome.state);
                        return Err(Status::NotConverged { time, reason });
                    }
                }
            }
        }
    }

    /// One step; accepted unless the law finds it too long.
    fn step(&mut self, next: f64) -> Result<NewtonReport, StepFailure> {
        let (clock, before) = (Instant::now(), self.outcome.iterations);
        let start = &self.outcome.state;
        let (solver, iterations) = (&mut *self.tools.solver, &mut self.outcome.iterations);
        let found = solve_step(self.model, start, next, self.strategy, solver, self.interrupt, iterations);
        let rescued = found.is_err();
        let mut done = found.or_else(|failure| self.rescue(next, failure))?;
        let (start, dt) = (&self.outcome.state, next - self.outcome.state.time);
        let (law, by) = suggested_step(self.model, start, &done.state, &done.evaluation);
        if law < VETO * dt {
            return Err(StepFailure::Vetoed { taken: dt, step: law, by });
        }
        let effort = Effort { iterations: self.outcome.iterations - before, wall_s: clock.elapsed().as_secs_f64() };
        self.tools.witness.accepted(self.model, start, &done, effort);
        self.outcome.steps += 1;
        self.outcome.lagged += usize::from(done.lagged);
        self.outcome.rescued += usize::from(rescued);
        let (hard, double) = (done.iterations > HARD, 2.0 * self.outcome.dt);
        self.outcome.dt = if hard { (0.5 * dt).max(self.smallest) } else { double.min(self.nominal) };
        self.outcome.law = law;
        self.failures = 0;
        std::mem::swap(&mut self.outcome.state, &mut done.state);
        Ok(done)
    }

    /// Asks the companion for another way to a step that failed.
    fn rescue(&mut self, next: f64, failure: StepFailure) -> Result<NewtonReport, StepFailure> {
        let Outcome { state: start, iterations, .. } = &mut self.outcome;
        // Once in a row of cuts: where it does not help, there may be no equilibrium.
        let asked = failure.lost() && self.failures == 0;
        let guess = asked.then(|| self.tools.witness.rescue(self.model, start, next, self.interrupt)).flatten();
        let Some(guess) = guess else { return Err(failure) };
        let solver = &mut *self.tools.solver;
        let mut step = Step::new(self.model, start, self.strategy, solver, self.interrupt, iterations);
        step.attempt(guess).map_err(|_| failure)
    }

    /// Goes over to the equilibrium behind a snap, before time `until`; false where there is none in reach, or where inertia or viscosity
    /// says how the bodies move.
    fn cross(&mut self, until: f64) -> bool {
        if self.model.has_rates() {
            return false;
        }
        let (model, start, interrupt) = (self.model, &self.outcome.state, self.interrupt);
        let drag = self.drag.get_or_insert_with(|| Drag::new(model));
        let (solver, iterations) = (&mut *self.tools.solver, &mut self.outcome.iterations);
        let solve = |from: &State, time, strength| {
            solve_dragged(model, from, time, (drag, strength), solver, interrupt, iterations)
        };
        let (Some(before), Ok(done)) =
            (evaluate(model, start, start, Tangent::None), cross(model, drag, start, until, solve))
        else {
            return false;
        };
        let supplied = done.state.ledger.external_work - start.ledger.external_work;
        let used = done.state.ledger.dissipated - start.ledger.dissipated;
        let loss = supplied - used - (done.evaluation.strain_energy - before.strain_energy);
        self.outcome.state = done.state;
        self.outcome.state.ledger.snap_loss += loss;
        self.outcome.snaps += 1;
        self.failures = 0;
        true
    }
}
