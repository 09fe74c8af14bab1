//! A guess from a problem that is easier than that of the step: the same with other augmentations.
//!
//! Newton's method is at home at `E/h` (theory 6.2): much larger ones cycle, much smaller ones approach slowly. At nodal sites the
//! solution does not depend on them, at quadrature sites it moves with them a little.

use crate::contact::Numerics;
use crate::model::{Model, Pair, State};

use super::failure::StepFailure;
use super::log::Rung;
use super::newton::{NewtonReport, Step};

/// How many factors of ten the augmentations are away from `E/h`, rounded up.
pub fn decades(model: &Model) -> usize {
    let of = |pair: &Pair| {
        let Numerics { r, r_tangential, .. } = pair.contact.numerics();
        r.log10().abs().max(r_tangential.log10().abs()).ceil() as usize
    };
    model.pairs.iter().map(of).max().unwrap_or(0)
}

/// Solves the step with the augmentations `E/h`, then with ones nearer to those of the model by a factor of ten each time: the last
/// solution before them.
///
/// # Errors
/// The first failure.
pub fn eased(step: &mut Step, mut guess: State) -> Result<State, StepFailure> {
    let decades = decades(step.model);
    for k in 0..decades {
        let easier = step.model.eased(k as f64 / decades as f64);
        guess = as_guess(step.start, step.with(&easier).attempt(guess, Rung::Newton)?);
    }
    Ok(guess)
}

/// Displacements and multipliers of a solution, on the memory of the start of the step.
fn as_guess(start: &State, found: NewtonReport) -> State {
    let mut guess = State { ledger: start.ledger.clone(), trend: start.trend.clone(), ..found.state };
    guess.pairs.iter_mut().zip(&start.pairs).for_each(|(pair, start)| pair.sites.clone_from(&start.sites));
    guess
}
