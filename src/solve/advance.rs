//! From one nominal step to the next: sub-steps, cut where they fail and regrown after.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::model::{Drag, Evaluation, Model, State, suggested_step};

use super::Strategy;
use super::crossing::cross;
use super::ending;
use super::failure::StepFailure;
use super::ladder::climb;
use super::log::{Event, Rung, Tried};
use super::march::Tools;
use super::newton::{NewtonReport, Step, solve_dragged};
use super::pace::within_stride;
use super::release::{FINEST, leap, negligible, pace};
use super::status::{Outcome, Status};
use super::witness::Effort;

/// A law that suggests a step shorter than this share of the one taken has it repeated.
const VETO: f64 = 1.0 - 1e-9;

/// Iterations above which the next step is half as long: an easy step takes about four, so two of half the length cost no
/// more then (measured in `papers/cost`).
const HARD: usize = 8;

/// Cuts without a step between them after which the equilibrium path is taken to end.
const LOST: usize = 2;

/// A march under way.
pub struct Advance<'a, 't> {
    pub model: &'a Model,
    pub strategy: Strategy,
    pub tools: Tools<'t>,
    pub interrupt: &'a AtomicBool,
    pub nominal: f64,
    pub smallest: f64,
    /// Cuts since the last step.
    pub failures: usize,
    /// Made when it is needed first.
    pub drag: Option<Drag>,
    /// Rungs that were left in the step under way.
    pub tried: Vec<Tried>,
    /// A step that leapt over a snap, for the case that nothing better comes, with the energy set free.
    pub leapt: Option<(NewtonReport, f64)>,
    pub outcome: Outcome,
}

/// End of a nominal step.
pub struct Reached {
    pub evaluation: Evaluation,
    /// Largest [`super::NewtonReport::weakening`] of its sub-steps.
    pub weakening: f64,
}

impl Advance<'_, '_> {
    /// Sub-steps up to `target`.
    pub fn reach(&mut self, target: f64) -> Result<Reached, Status> {
        let mut weakening = 0.0_f64;
        loop {
            let time = self.outcome.state.time;
            if self.interrupt.load(Ordering::Relaxed) {
                return Err(Status::Interrupted { time });
            }
            // A remainder below half a sub-step joins the last one.
            let left = target - time;
            let wanted = if left <= 1.5 * self.outcome.dt { left } else { self.outcome.dt };
            let pieces = (wanted / self.outcome.law.min(self.outcome.pace) * VETO).ceil().max(1.0);
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
                    self.note((time, next), Some(done.rung));
                    weakening = weakening.max(done.weakening);
                    if next == target {
                        return Ok(Reached { evaluation: done.evaluation, weakening });
                    }
                }
                Err(StepFailure::Interrupted) => return Err(Status::Interrupted { time }),
                Err(failure) => {
                    if let Some(evaluation) = self.shorten(next, target, &failure)? {
                        return Ok(Reached { evaluation, weakening });
                    }
                }
            }
        }
    }

    /// After a step that failed: the next try is shorter, or starts behind a snap; with an evaluation where that is at the target.
    ///
    /// # Errors
    /// That there is no way on.
    fn shorten(&mut self, next: f64, target: f64, failure: &StepFailure) -> Result<Option<Evaluation>, Status> {
        let time = self.outcome.state.time;
        self.outcome.cuts += 1;
        self.failures += usize::from(!matches!(failure, StepFailure::Slid(_)));
        if matches!(failure, StepFailure::Vetoed { .. }) {
            Tried::note(&mut self.tried, Rung::Newton, failure);
        }
        if self.failures == LOST && failure.lost() && self.cross(next) {
            self.note((time, next), Some(Rung::Crossing));
            return Ok(None);
        }
        match failure {
            StepFailure::Vetoed { step, .. } => self.outcome.law = *step,
            _ => self.outcome.dt = 0.5 * (next - time),
        }
        if self.outcome.dt.min(self.outcome.law) >= self.smallest {
            self.note((time, next), Some(Rung::Cut));
            return Ok(None);
        }
        let far = target - time > self.smallest;
        if failure.lost() && (far && self.cross(target) || self.leap()) {
            self.note((time, target), Some(Rung::Crossing));
            return Ok(self.landed(target));
        }
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(Status::Interrupted { time });
        }
        let reason = ending::words(self.model, &self.outcome, &self.tried, failure);
        self.note((time, next), None);
        Err(Status::NotConverged { time, reason })
    }

    /// Writes down what was left in a step, if anything was, and what went on.
    fn note(&mut self, (time, until): (f64, f64), reached: Option<Rung>) {
        let tried = std::mem::take(&mut self.tried);
        if !tried.is_empty() {
            self.outcome.log.push(Event { time, until, tried, reached });
        }
    }

    /// One step; accepted unless the law finds it too long.
    fn step(&mut self, next: f64) -> Result<NewtonReport, StepFailure> {
        let (clock, before) = (Instant::now(), self.outcome.iterations);
        let start = &self.outcome.state;
        let (solver, iterations) = (&mut *self.tools.solver, &mut self.outcome.iterations);
        let known = self.tools.witness.foresee(start, next);
        let mut step = Step::new(self.model, start, self.strategy, solver, self.interrupt, iterations);
        let known = known.and_then(|state| step.verify(state));
        self.outcome.recalled += usize::from(known.is_some());
        let found = known.map_or_else(|| climb(&mut step, next), Ok);
        self.tried = step.tried;
        let done = found.or_else(|failure| self.rescue(next, failure))?;
        let (start, dt) = (&self.outcome.state, next - self.outcome.state.time);
        let (law, by) = suggested_step(self.model, [start, &done.state], &done.evaluation, self.smallest);
        if law < VETO * dt {
            return Err(StepFailure::Vetoed { taken: dt, step: law, by });
        }
        let mut done = self.inspect(done, dt)?;
        let start = &self.outcome.state;
        let effort = Effort { iterations: self.outcome.iterations - before, wall_s: clock.elapsed().as_secs_f64() };
        self.tools.witness.accepted(self.model, start, &done, effort);
        self.outcome.steps += 1;
        self.outcome.lagged += usize::from(done.rung == Rung::Lagged);
        self.outcome.rescued += usize::from(done.rung == Rung::Conic);
        let (hard, double) = (done.iterations > HARD, 2.0 * self.outcome.dt);
        self.outcome.dt = if hard { (0.5 * dt).max(self.smallest) } else { double.min(self.nominal) };
        self.outcome.law = law;
        self.outcome.pace = pace(&done, dt).max(FINEST * self.nominal);
        self.failures = 0;
        std::mem::swap(&mut self.outcome.state, &mut done.state);
        Ok(done)
    }

    /// A converged step that leaps is thrown away, and taken for what it is only where it is short.
    fn inspect(&mut self, mut found: NewtonReport, dt: f64) -> Result<NewtonReport, StepFailure> {
        let Some(failure) = leap(self.model, &self.outcome.state, &found) else { return Ok(found) };
        self.tried.push(Tried { rung: found.rung, attempts: 1, reason: failure.to_string() });
        if dt > FINEST * self.nominal && 0.5 * dt >= self.smallest {
            if let StepFailure::Leapt(energy) = failure {
                self.leapt = Some((found, energy));
            }
            return Err(failure);
        }
        if let StepFailure::Leapt(energy) = failure {
            found.rung = Rung::Crossing;
            found.state.ledger.snap_loss += energy;
            self.outcome.snaps += 1;
        }
        Ok(found)
    }

    /// Goes where a step leapt to, should it lie ahead; false where none did.
    fn leap(&mut self) -> bool {
        let time = self.outcome.state.time;
        let Some((found, energy)) = self.leapt.as_ref().filter(|(found, _)| found.state.time > time) else {
            return false;
        };
        self.outcome.state.clone_from(&found.state);
        self.outcome.state.ledger.snap_loss += energy;
        self.outcome.snaps += 1;
        self.failures = 0;
        true
    }

    /// The evaluation of a leap that ended at the target.
    fn landed(&mut self, target: f64) -> Option<Evaluation> {
        let here = self.outcome.state.time == target;
        self.leapt.take_if(|(found, _)| here && found.state.time == target).map(|(found, _)| found.evaluation)
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
        let found = step.attempt(guess, Rung::Conic);
        self.tried.extend(step.tried);
        found.map_err(|_| failure)
    }

    /// Goes over to the equilibrium behind a snap, before time `until`; false where there is none in reach, or where inertia or
    /// viscosity says how the bodies move.
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
        let done = match cross(model, drag, start, until, solve) {
            Ok(done) => done,
            Err(failure) => {
                Tried::note(&mut self.tried, Rung::Crossing, &failure);
                return false;
            }
        };
        let loss = done.state.ledger.released_since(&start.ledger);
        let least = negligible(&start.ledger).max(negligible(&done.state.ledger));
        self.outcome.state = done.state;
        let ledger = &mut self.outcome.state.ledger;
        // what sets nothing free was no snap, but a step that only a little drag could settle
        if loss > least {
            ledger.snap_loss += loss;
            self.outcome.snaps += 1;
        }
        self.failures = 0;
        true
    }
}
