//! The ladder: what is tried, in which order, to reach the end of one step.
//!
//! Each rung is left for a reason, which is noted ([`Tried`]). [`Rung`] names them all; the last ones (the conic method, a shorter
//! step, the crossing of a snap) are those of the march.

use std::sync::atomic::AtomicBool;

use crate::math::LinearSolver;
use crate::model::{Model, State};

use super::convergence::balanced;
use super::easing::{decades, eased};
use super::failure::StepFailure;
use super::interface_loop::Strategy;
use super::log::{Rung, Tried};
use super::newton::{NewtonReport, Step};
use super::predictor::guesses;

/// Solves the step from `start` to `time`, from the best of the guesses and, where Newton fails, from the next; where all
/// fail, from each once more with contact settled in an inner loop, which costs more but cycles less; then, where the augmentations
/// are not `E/h`, from the solution with those.
/// A law that weakens with the slip rate has a second way, see [`super::weakening`]: it is taken where the exact tangent
/// fails, and where it ends in an unstable equilibrium. `iterations` counts the linear solves, failed attempts included.
///
/// # Errors
/// The first failure; `start` is untouched.
pub fn solve_step(
    model: &Model,
    start: &State,
    time: f64,
    strategy: Strategy,
    solver: &mut dyn LinearSolver,
    interrupt: &AtomicBool,
    iterations: &mut usize,
) -> Result<NewtonReport, StepFailure> {
    climb(&mut Step::new(model, start, strategy, solver, interrupt, iterations), time)
}

/// [`solve_step`] with the rungs that were left kept in `step`.
pub(super) fn climb(step: &mut Step, time: f64) -> Result<NewtonReport, StepFailure> {
    let mut failure = None;
    let (model, start) = (step.model, step.start);
    let mut guesses = guesses(model, start, time, |found| balanced(model, found));
    if guesses.first().is_some_and(|(_, forces)| balanced(model, forces)) {
        let (guess, forces) = guesses.swap_remove(0);
        return Ok(step.converged(guess, forces, vec![]));
    }
    let before = step.strategy;
    let again = (step.strategy == Strategy::Monolithic).then_some(Strategy::Interface);
    for strategy in [step.strategy].into_iter().chain(again) {
        let other = if strategy == step.strategy { Rung::Guess } else { Rung::Interface };
        step.strategy = strategy;
        for (k, (guess, _)) in guesses.iter().enumerate() {
            let rung = if k == 0 && other == Rung::Guess { Rung::Newton } else { other };
            match step.attempt(guess.clone(), rung) {
                Err(StepFailure::Interrupted) => return Err(StepFailure::Interrupted),
                Err(error) => failure = failure.or(Some(error)),
                done => return done,
            }
        }
    }
    step.strategy = before;
    if let (1.., Some((guess, _))) = (decades(model), guesses.first()) {
        match eased(step, guess.clone()) {
            Ok(guess) => match step.attempt(guess, Rung::Augmentation) {
                Err(StepFailure::Interrupted) => return Err(StepFailure::Interrupted),
                Err(_) => {}
                done => return done,
            },
            Err(StepFailure::Interrupted) => return Err(StepFailure::Interrupted),
            Err(error) => Tried::note(&mut step.tried, Rung::Augmentation, &error),
        }
    }
    Err(failure.unwrap_or(StepFailure::Inverted(0)))
}
