//! The conic method at the side of a march: it rescues steps and certifies what was accepted.

use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::model::{Model, State};
use crate::solve::{Effort, NewtonReport, Witness};

use super::check::{Check, Claim, check, from_start};
use super::stage::Stage;
use super::step::GOAL;

/// A certified step.
#[derive(Clone, Debug)]
pub struct Certified {
    /// What was found.
    pub check: Check,
    /// What Newton's method took.
    pub newton: Effort,
}

/// Offers the conic solution where Newton's method fails and, where asked to, certifies every accepted step.
pub struct Companion<'a> {
    /// Steps certified since they were last taken; `None`: nothing is certified.
    pub certified: Option<&'a RefCell<Vec<Certified>>>,
    /// Stops a certificate under way.
    pub interrupt: &'a AtomicBool,
    /// What is kept from one programme to the next.
    pub stage: Stage,
}

impl Witness for Companion<'_> {
    fn accepted(&mut self, model: &Model, start: &State, found: &NewtonReport, effort: Effort) {
        if let Some(certified) = self.certified
            && !self.interrupt.load(Ordering::Relaxed)
        {
            let claim = Claim { state: &found.state, evaluation: &found.evaluation };
            let check = check(model, start, claim, &mut self.stage, self.interrupt);
            certified.borrow_mut().push(Certified { check, newton: effort });
        }
    }

    fn rescue(&mut self, model: &Model, start: &State, time: f64, interrupt: &AtomicBool) -> Option<State> {
        // a stage of its own: what was analysed before must not show in the last bits, a resumed run has not
        let solved = from_start(model, start, (time, GOAL), &mut Stage::default(), interrupt).ok()?;
        Some(solved.answer.state(model, start, time))
    }
}
