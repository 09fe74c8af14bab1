//! What may look over the shoulder of a march: it sees every accepted step and may offer another way to one that failed.

use std::sync::atomic::AtomicBool;

use crate::model::{Model, State};

use super::NewtonReport;

/// What a step took, failed guesses included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Linear solves.
    pub iterations: usize,
    /// Wall time in seconds.
    pub wall_s: f64,
}

/// A companion of a march. All methods do nothing by default, as `()` does.
pub trait Witness {
    /// Asked before the step from `start` to `time`: a state that may be its end as it is. It counts if it is in equilibrium.
    fn foresee(&mut self, start: &State, time: f64) -> Option<State> {
        let _ = (start, time);
        None
    }

    /// Sees a step from `start` that was accepted.
    fn accepted(&mut self, model: &Model, start: &State, found: &NewtonReport, effort: Effort) {
        let _ = (model, start, found, effort);
    }

    /// Asked where no guess led Newton's method to the end of the step from `start` to `time`: a state near it, from which Newton's
    /// method then starts once more. The step counts only if that converges.
    fn rescue(&mut self, model: &Model, start: &State, time: f64, interrupt: &AtomicBool) -> Option<State> {
        let _ = (model, start, time, interrupt);
        None
    }
}

impl Witness for () {}
