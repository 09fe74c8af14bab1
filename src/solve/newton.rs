//! Semismooth Newton for one step.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::math::{LinearSolver, SolveError};
use crate::model::{Drag, Evaluation, Linearised, Model, State, Tangent, evaluate, explain};

use super::convergence::{balanced, forecast, largest, norm, stalled, tolerance};
use super::failure::StepFailure;
use super::floating::{hint, support_floating};
use super::interface_loop::{Strategy, negative, settle};
use super::log::{Rung, Tried};
use super::predictor::{predict, trend};
use super::sets::Sets;
use super::weakening::{self, Linearisation};

/// Growth of the residual that a full step may show.
const GROWTH: f64 = 1.0 + 1e-6;
/// Lengths tried when a full step is no good: 1, 1/2, 1/4, ...
const HALVINGS: i32 = 7;

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
    /// The rung that found it.
    pub rung: Rung,
    /// Share of the bodies' tangential stiffness that friction takes away by falling with the slip rate; 0 where that is
    /// far from mattering. At 1 the quasi-static solution jumps.
    pub weakening: f64,
}

/// Solves the step from `start` to `time` against drag of the given strength.
///
/// # Errors
/// As [`solve_step`].
pub fn solve_dragged(
    model: &Model,
    start: &State,
    time: f64,
    drag: (&Drag, f64),
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    iterations: &mut usize,
) -> Result<NewtonReport, StepFailure> {
    let step = Step::new(model, start, Strategy::Monolithic, solver, interrupt, iterations);
    Step { drag: Some(drag), ..step }.attempt(predict(model, start, time), Rung::Newton)
}

/// A step being solved.
pub(super) struct Step<'a> {
    pub model: &'a Model,
    /// Start of the step.
    pub start: &'a State,
    /// How the next attempt treats contact.
    pub strategy: Strategy,
    solver: &'a mut dyn LinearSolver,
    interrupt: &'a AtomicBool,
    iterations: &'a mut usize,
    /// Rungs that were left.
    pub tried: Vec<Tried>,
    /// Whether friction fell with the slip rate at some iterate.
    weakens: bool,
    /// Drag with its strength.
    drag: Option<(&'a Drag, f64)>,
}

impl<'a> Step<'a> {
    /// Without drag; `iterations` counts on.
    pub fn new(
        model: &'a Model,
        start: &'a State,
        strategy: Strategy,
        solver: &'a mut dyn LinearSolver,
        interrupt: &'a AtomicBool,
        iterations: &'a mut usize,
    ) -> Self {
        Self { model, start, strategy, solver, interrupt, iterations, tried: vec![], weakens: false, drag: None }
    }
}

impl Step<'_> {
    /// The same step of another model with the same unknowns.
    pub fn with<'b>(&'b mut self, model: &'b Model) -> Step<'b> {
        Step::new(model, self.start, Strategy::Monolithic, self.solver, self.interrupt, self.iterations)
    }

    /// From one guess: with the exact tangent, then, for a law that weakens, with lagged bound where that failed or found
    /// an unstable equilibrium. What is given up is noted under `rung`.
    pub fn attempt(&mut self, guess: State, rung: Rung) -> Result<NewtonReport, StepFailure> {
        let exact = self.newton(guess.clone(), Linearisation::exact());
        let exact = exact.map(|found| NewtonReport { rung, ..found });
        match &exact {
            Ok(found) if found.weakening < 1.0 => return exact,
            Ok(found) => Tried::note(&mut self.tried, rung, &StepFailure::Unstable(found.weakening)),
            Err(StepFailure::Interrupted) => return exact,
            Err(failure) => Tried::note(&mut self.tried, rung, failure),
        }
        if !self.weakens {
            return exact;
        }
        match (exact, self.newton(guess, Linearisation::lagged())) {
            (_, Ok(lagged)) => Ok(NewtonReport { rung: Rung::Lagged, ..lagged }),
            (exact, Err(failure)) => {
                Tried::note(&mut self.tried, Rung::Lagged, &failure);
                exact.map_err(|_| failure)
            }
        }
    }

    fn newton(&mut self, mut trial: State, mut way: Linearisation) -> Result<NewtonReport, StepFailure> {
        let model = self.model;
        let mut evaluation = self.evaluate(&trial, way.tangent).ok_or(StepFailure::Inverted(0))?;
        let (mut residuals, mut sets) = (Vec::new(), Sets::default());
        loop {
            let iteration = residuals.len();
            let size = largest(model, &evaluation);
            residuals.push(size);
            sets.take(&evaluation);
            self.weakens |= weakening::weakens(&evaluation);
            if balanced(model, &evaluation) {
                return Ok(self.converged(trial, evaluation, residuals));
            }
            if size.is_nan()
                && let Some(why) = explain(model, self.start, &evaluation, trial.time - self.start.time)
            {
                return Err(StepFailure::Law(why));
            }
            let cycle = if way.lags() { None } else { sets.period(&residuals) };
            let stalls = cycle.is_some() || (!way.lags() && stalled(&residuals));
            if iteration == way.most() || size.is_nan() || stalls {
                let (iterations, residual) = (iteration, size / evaluation.force_scale);
                let hints =
                    [sets.unsettled(model, &evaluation), hint(model, &evaluation), self.weakening_hint(&trial, &way)];
                return Err(StepFailure::Iterations { iterations, residual, cycle, hint: hints.concat() });
            }
            if self.interrupt.load(Ordering::Relaxed) {
                return Err(StepFailure::Interrupted);
            }
            *self.iterations += 1;
            let increment = self.increment(&trial, &mut evaluation, &way)?;
            way.choose(size / evaluation.force_scale);
            let last = forecast(&residuals) <= tolerance(model, &evaluation);
            (trial, evaluation) = self
                .update(&trial, &increment, (norm(model, &evaluation), last), way.tangent)
                .ok_or(StepFailure::Inverted(iteration + 1))?;
        }
    }

    fn evaluate(&self, trial: &State, tangent: Tangent) -> Option<Evaluation> {
        let mut found = evaluate(self.model, self.start, trial, tangent)?;
        if let Some((drag, strength)) = self.drag {
            drag.add(strength, self.model, self.start, trial, &mut found);
        }
        Some(found)
    }

    /// The Newton increment; takes the system out of the evaluation.
    fn increment(
        &mut self,
        trial: &State,
        evaluation: &mut Evaluation,
        way: &Linearisation,
    ) -> Result<Vec<f64>, SolveError> {
        let mut system = evaluation.system.take().expect("evaluated with tangent");
        let before = system.interface.len();
        support_floating(self.model, evaluation, &mut system.interface);
        let floats = system.interface.len() > before;
        let increment = self.solver.solve(&system, &negative(&evaluation.residual))?;
        if floats || way.lags() || self.strategy == Strategy::Monolithic {
            return Ok(increment);
        }
        let bodies = Linearised::at(self.model, self.start, trial.clone(), evaluation, system);
        Ok(settle(bodies, increment, evaluation, self.solver))
    }

    /// Adds the increment. A step along which the residual grows beyond [`GROWTH`] is halved a few times and the best length
    /// taken (the residual of a semismooth system need not fall, so that is no failure); one that turns a body inside out
    /// is halved until it does not. With lagged bound the residual may grow: the iteration contracts in the slip. The tangent
    /// is left out of what is expected to be, and is, the `last` iterate.
    fn update(
        &self,
        trial: &State,
        increment: &[f64],
        (before, last): (f64, bool),
        tangent: Tangent,
    ) -> Option<(State, Evaluation)> {
        let moved = |factor: f64| {
            let mut next = trial.clone();
            next.advance(self.model, increment, factor);
            next
        };
        let full = moved(1.0);
        if last && let Some(found) = self.evaluate(&full, Tangent::None).filter(|found| balanced(self.model, found)) {
            return Some((full, found));
        }
        let found = self.evaluate(&full, tangent);
        let size = |found: &Evaluation| norm(self.model, found);
        let mut best = found.as_ref().map(|found| (size(found), 1.0));
        let accepted = |size: f64| tangent == Tangent::Lagged || size <= GROWTH * before;
        if best.is_some_and(|(size, _)| accepted(size)) {
            return Some((full, found?));
        }
        for k in 1..HALVINGS {
            let factor = 0.5_f64.powi(k);
            if let Some(size) = self.evaluate(&moved(factor), Tangent::None).as_ref().map(size) {
                if best.is_none_or(|(smallest, _)| size < smallest) {
                    best = Some((size, factor));
                }
                if size <= before {
                    break;
                }
            }
        }
        let factor = best?.1;
        if factor == 1.0 {
            return Some((full, found?));
        }
        let next = moved(factor);
        self.evaluate(&next, tangent).map(|evaluation| (next, evaluation))
    }

    /// The trial state as the new committed one: internal variables, forces and work.
    pub fn converged(&mut self, mut trial: State, evaluation: Evaluation, residuals: Vec<f64>) -> NewtonReport {
        let share = weakening::share(self.model, self.start, &trial, &evaluation, self.solver);
        trial.commit(self.model, self.start, &evaluation);
        trial.trend = Some(trend(self.model, self.start, &trial));
        let iterations = residuals.len().saturating_sub(1);
        NewtonReport { state: trial, evaluation, iterations, residuals, rung: Rung::Newton, weakening: share }
    }

    fn weakening_hint(&mut self, trial: &State, way: &Linearisation) -> String {
        match way.lags().then(|| weakening::largest(self.model, self.start, trial, self.solver)).flatten() {
            Some(share) => format!(
                "; friction falls with the slip rate and takes {share:.2} times the tangential stiffness of the bodies (from 1 on the \
                 slip jumps, and smaller steps make it worse): take longer steps, a slower drive, or a law with direct effect"
            ),
            None => String::new(),
        }
    }
}
