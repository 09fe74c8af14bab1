//! How an analysis ended, apart from errors in its input.

use serde::{Deserialize, Serialize};

use crate::model::State;

use super::log::Log;

/// How the march ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

/// End of a march, or where it stands: the last converged state, what it took, and what the next step starts from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Snaps that were crossed, see `solve::crossing`.
    pub snaps: usize,
    /// Steps that needed more than the first rung of the ladder.
    pub log: Log,
    /// Length of the step to be tried next; remembered from one nominal step to the next.
    pub dt: f64,
    /// Longest step that the law accepted last.
    pub law: f64,
}

impl Outcome {
    /// Nothing done yet.
    pub fn at(state: State) -> Self {
        let any = f64::INFINITY;
        Self {
            status: Status::Done,
            state,
            iterations: 0,
            steps: 0,
            cuts: 0,
            lagged: 0,
            rescued: 0,
            snaps: 0,
            log: Log::default(),
            dt: any,
            law: any,
        }
    }
}
