//! What comes out of a search, or why nothing does.

use super::Estimate;
use super::front::Cost;
use super::measure::{Measured, Role};
use crate::output::OutputError;

/// Share of the effort that the reference may take.
pub(super) const REFERENCE_SHARE: f64 = 0.35;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No change of one choice is left that might help.
    Complete,
    /// The effort is spent.
    EffortSpent,
    /// Stopped from outside; the same command goes on.
    Interrupted,
}

/// Why a search came to nothing.
#[derive(Debug, thiserror::Error)]
pub enum Stop {
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
    /// A file that cannot be written or read back.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The reference would take more than the effort allows, by so many seconds.
    #[error("the reference alone would take about {0:.0} s of CPU time, {share:.0} % of the effort are meant for it", share = 100.0 * REFERENCE_SHARE)]
    TooLittle(f64),
    /// There is nothing to measure against.
    #[error("no reference: {0}")]
    NoReference(String),
}

/// What was measured.
#[derive(Debug)]
pub struct Found {
    /// All settings, in the order in which they were measured.
    pub points: Vec<Measured>,
    /// The quantities whose errors count, as numbers into [`QUANTITIES`](super::norm::QUANTITIES).
    pub quantities: Vec<usize>,
    /// Number of the scene as it is, where it was measured.
    pub given: Option<usize>,
    /// Number of the reference.
    pub reference: usize,
    /// Its own error, for each of [`QUANTITIES`](super::norm::QUANTITIES).
    pub estimates: Vec<Estimate>,
    /// CPU time of all runs in seconds.
    pub spent: f64,
    /// How the search ended.
    pub ending: Ending,
}

impl Found {
    /// Largest error of a setting over the quantities that count.
    pub fn error(&self, point: &Measured) -> f64 {
        self.quantities.iter().map(|k| point.errors[*k]).fold(0.0, larger)
    }

    /// What its true error is taken to be: errors below that of the reference count as that, and that of the reference is added.
    pub fn bound(&self, point: &Measured) -> f64 {
        let bound = |k: &usize| larger(point.errors[*k], self.estimates[*k].error) + self.estimates[*k].error;
        self.quantities.iter().map(bound).fold(0.0, larger)
    }

    /// Cost and bound of all settings; no error where a setting may not be recommended.
    pub fn costs(&self) -> Vec<Cost> {
        let cost = |point: &Measured| {
            let counts = point.role == Role::Candidate && point.done();
            Cost { cpu_s: point.status.cpu_s, error: if counts { self.bound(point) } else { f64::NAN } }
        };
        self.points.iter().map(cost).collect()
    }

    /// The smallest error that can be told: twice that of the reference.
    pub fn floor(&self) -> f64 {
        2.0 * self.quantities.iter().map(|k| self.estimates[*k].error).fold(0.0, larger)
    }
}

/// The larger of two numbers, `nan` if one of them is.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
