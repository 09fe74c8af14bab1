//! Conformance kit: what every friction law, built-in or foreign, must satisfy.
//!
//! ```
//! asperity_laws::conforms(&asperity_laws::builtin::Coulomb { friction: 0.3 }).unwrap();
//! ```
//!
//! Each property is tried on a few hundred random histories (pressures, slips, time steps) by `proptest`, always the same ones,
//! over [`Envelope`] and around the scales that the parameters of the law set; a failure is shrunk and comes with the history.
//!
//! | property | meaning |
//! |---|---|
//! | `documentation` | a [`LawInfo`](crate::LawInfo) with this name, kind and exactly these parameters; parameters in range |
//! | `finite` | response, states and their derivatives finite, bound `>= 0`; for `open` too |
//! | `committed` | `new` is written and never read; the answer depends on the arguments alone, bit for bit |
//! | `tangent` | derivatives of response and states against differences; at a kink between the one-sided ones |
//! | `limits` | response continuous as pressure or slip go to zero |
//! | `mirror` | reversed slip history: same bound, opposite traction |
//! | `dissipation` | a direct law never gives back more than was put in, at constant pressure from the virgin state |
//! | `refinement` | one path in ever more steps: response converges with first order |
//! | `units` | the law in other units of stress, length, time, temperature gives the same response in those units; left out for a law with a parameter whose unit nobody declared ([`FrictionLaw::units`]) |
//! | `round trip` | JSON and TOML give back a law with the same answers |

mod form;
mod path;
mod point;
mod probe;

use crate::{FrictionLaw, find};
pub use probe::{Sample, Step};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

/// Ranges of the magnitudes that are tried, besides zero and the scales of the law itself.
#[derive(Clone, Copy, Debug)]
pub struct Envelope {
    /// Pressure.
    pub pressure: [f64; 2],
    /// Slip increment of one step.
    pub slip: [f64; 2],
    /// Time step.
    pub dt: [f64; 2],
}

impl Default for Envelope {
    /// 1e-9 to 1e9 each.
    fn default() -> Self {
        Self { pressure: [1e-9, 1e9], slip: [1e-9, 1e9], dt: [1e-9, 1e9] }
    }
}

/// A property that a law does not have.
#[derive(Debug, Clone, thiserror::Error)]
#[error("law `{law}` violates `{property}`: {detail}{}", .sample.as_ref().map_or(String::new(), |s| format!("\n  at {s:?}")))]
pub struct Violation {
    /// Name of the law.
    pub law: String,
    /// Name of the property as in the table of [`crate::check`].
    pub property: &'static str,
    /// What was found and what was expected.
    pub detail: String,
    /// The simplest history found that shows it.
    pub sample: Option<Box<Sample>>,
}

type Sampled = fn(&dyn FrictionLaw, &Sample) -> Result<(), String>;

const SAMPLED: [(&str, u32, Sampled); 8] = [
    ("finite", 400, point::finite),
    ("committed", 100, point::committed),
    ("tangent", 400, point::tangent),
    ("limits", 200, point::limits),
    ("mirror", 100, path::mirror),
    ("dissipation", 300, path::dissipation),
    ("refinement", 40, path::refinement),
    ("units", 100, form::units),
];

/// Checks a law over the default [`Envelope`].
///
/// # Errors
/// The first property that it does not have.
pub fn conforms(law: &dyn FrictionLaw) -> Result<(), Violation> {
    conforms_within(law, &Envelope::default())
}

/// Checks a law over the given ranges, for a law that is made for a part of them only.
///
/// # Errors
/// The first property that it does not have.
pub fn conforms_within(law: &dyn FrictionLaw, envelope: &Envelope) -> Result<(), Violation> {
    let name = law.typetag_name();
    let violation = |property, detail, sample| Violation { law: name.into(), property, detail, sample };
    let missing = || violation("documentation", "no LawInfo submitted under this name".into(), None);
    let info = find(name).ok_or_else(missing)?;
    form::documentation(law, info).map_err(|detail| violation("documentation", detail, None))?;
    let samples = probe::samples(law, info, envelope);
    for (property, cases, holds) in SAMPLED {
        let outcome = runner(cases).run(&samples, |sample| holds(law, &sample).map_err(TestCaseError::fail));
        outcome.map_err(|error| match error {
            TestError::Fail(reason, sample) => violation(property, reason.message().into(), Some(sample.into())),
            TestError::Abort(reason) => violation(property, reason.message().into(), None),
        })?;
    }
    form::round_trip(law).map_err(|detail| violation("round trip", detail, None))
}

fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

/// `Err(message)` unless the condition holds.
fn ensure(condition: bool, message: impl FnOnce() -> String) -> Result<(), String> {
    if condition { Ok(()) } else { Err(message()) }
}
