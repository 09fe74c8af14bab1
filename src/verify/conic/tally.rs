//! The certified steps of a run as findings.

use super::super::finding::{Criterion, Finding, Severity, Worst};
use super::check::{Check, FORCE, STRESS, Verdict};

/// A disagreement makes the result worthless.
const AGREEMENT: Criterion = Criterion {
    name: "conic_agreement",
    tolerance: 1.0,
    severity: Severity::Failure,
    meaning: "largest difference between the Newton and the conic solution of a step, or violation in its certificate, over \
              what is accepted (certify.csv); more means that one of the two is wrong",
};
/// A step without proof is told, not hidden.
const PROOF: Criterion = Criterion {
    name: "conic_inconclusive",
    tolerance: 0.0,
    severity: Severity::Warning,
    meaning: "1 at steps for which the conic method proves nothing: it found no solution, or the solution need not be unique; \
              certify.csv says why",
};

/// Findings over the certified steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    agreement: Worst,
    proof: Worst,
}

impl Tally {
    /// Takes the check of a step that belongs to a nominal one.
    pub fn take(&mut self, step: usize, check: &Check) {
        let inconclusive = matches!(check.verdict, Verdict::Inconclusive(_));
        self.proof.take(step, f64::from(u8::from(inconclusive)));
        if !inconclusive {
            self.agreement.take(step, excess(check));
        }
    }

    /// One finding for agreement, one for steps without proof.
    pub fn findings(&self) -> [Finding; 2] {
        [self.agreement.judge(&AGREEMENT, 1.0), self.proof.judge(&PROOF, 1.0)]
    }
}

/// Largest difference or violation over what is accepted.
fn excess(check: &Check) -> f64 {
    let difference = check.difference.map_or(0.0, |d| {
        [d.u / STRESS, d.p / STRESS, d.q / STRESS, d.force[0] / FORCE, d.force[1] / FORCE]
            .into_iter()
            .fold(0.0, |m: f64, v| if m.is_nan() || v.is_nan() { f64::NAN } else { m.max(v) })
    });
    let certificate = check.certificate.worst() / STRESS;
    if difference.is_nan() || certificate.is_nan() { f64::NAN } else { difference.max(certificate) }
}
