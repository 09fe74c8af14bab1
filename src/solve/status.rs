//! How an analysis ended, apart from errors in its input.

use crate::model::State;

/// How the march ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// The end time was reached.
    Done,
    /// A step did not converge although it was cut as often as allowed.
    NotConverged {
        /// Time that was reached.
        time: f64,
        /// What happened at the last attempt.
        reason: String,
    },
    /// Stopped from outside.
    Interrupted {
        /// Time that was reached.
        time: f64,
    },
}

/// End of a march: the last converged state and what it took.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
    /// Last converged state.
    pub state: State,
    /// Linear solves, failed attempts included.
    pub iterations: usize,
    /// Accepted steps, sub-steps included.
    pub steps: usize,
    /// Steps thrown away.
    pub cuts: usize,
    /// Steps that only a lagged bound reached: friction falls with the slip rate, see [`super::weakening`].
    pub lagged: usize,
    /// Steps that only the conic method reached, see [`super::Witness`].
    pub rescued: usize,
}

impl Outcome {
    /// Nothing done yet.
    pub fn at(state: State) -> Self {
        Self { status: Status::Done, state, iterations: 0, steps: 0, cuts: 0, lagged: 0, rescued: 0 }
    }
}
