//! What an audit found: the worst value over all steps, and what it means.

use std::fmt;

use serde::{Deserialize, Serialize};

/// What a violated tolerance means for the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The result is wrong: exit code 4.
    Failure,
    /// The result is less accurate than it could be, or should be looked at.
    Warning,
}

/// Outcome of one audit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Name of the audit.
    pub name: &'static str,
    /// Largest value over all steps judged (dimensionless); `NaN` where a record held no number.
    pub worst: f64,
    /// Nominal step of the largest value; `None` where no step could be judged.
    pub step: Option<usize>,
    /// Number of steps judged; the audit says nothing where it is 0.
    pub judged: usize,
    /// Largest value accepted.
    pub tolerance: f64,
    /// True where the tolerance holds.
    pub passed: bool,
    /// What it is if it does not hold.
    pub severity: Severity,
    /// What is compared, and what a violation means.
    pub meaning: &'static str,
}

impl Finding {
    /// True where the result must not be trusted.
    pub fn failed(&self) -> bool {
        !self.passed && self.severity == Severity::Failure
    }

    /// True where the result should be looked at.
    pub fn warns(&self) -> bool {
        !self.passed && self.severity == Severity::Warning
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = self.step.map_or_else(|| "at no step".to_string(), |step| format!("at step {step}"));
        let (name, worst, tolerance) = (self.name, self.worst, self.tolerance);
        write!(f, "{name}: {worst:.2e} {step}, accepted {tolerance:.0e}: {}", self.meaning)
    }
}

/// A tolerance and its words: all of a [`Finding`] that is known beforehand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Criterion {
    pub name: &'static str,
    pub tolerance: f64,
    pub severity: Severity,
    pub meaning: &'static str,
}

/// Largest value so far.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Worst {
    value: f64,
    step: Option<usize>,
    judged: usize,
}

impl Worst {
    /// Takes the value of a step. What is no number is worse than any number.
    pub fn take(&mut self, step: usize, value: f64) {
        self.judged += 1;
        let worse = self.step.is_none() || value.is_nan() || value > self.value;
        if worse && !self.value.is_nan() {
            (self.value, self.step) = (value, Some(step));
        }
    }

    /// Judges the largest value in units of `scale`.
    pub fn judge(&self, criterion: &Criterion, scale: f64) -> Finding {
        let worst = if self.value == 0.0 { 0.0 } else { self.value / scale };
        Finding {
            name: criterion.name,
            worst,
            step: self.step,
            judged: self.judged,
            tolerance: criterion.tolerance,
            passed: worst <= criterion.tolerance,
            severity: criterion.severity,
            meaning: criterion.meaning,
        }
    }
}
