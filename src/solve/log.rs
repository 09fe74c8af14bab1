//! The rungs of the ladder, and a log of the steps that needed more than the first.

use serde::{Deserialize, Serialize};

use super::failure::StepFailure;

/// Events that are kept, the latest ones: a checkpoint holds them all.
const MOST: usize = 100;

/// A way to a step, in the order in which they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rung {
    /// Newton's method with the exact tangent and a line search, from the best of the first guesses.
    Newton,
    /// The same from the other guesses.
    Guess,
    /// The bound of friction lagged by one iteration, for laws that weaken.
    Lagged,
    /// Contact settled in an inner loop, from every guess.
    Interface,
    /// The same step with the augmentations `E/h`, and Newton's method from its solution.
    Augmentation,
    /// The conic method, see [`super::Witness`], and Newton's method from what it finds.
    Conic,
    /// The step is tried again with half of its length, or with that which the law asks for.
    Cut,
    /// The path ends: the equilibrium behind the snap is sought, see `solve::crossing`.
    Crossing,
}

impl Rung {
    /// All, in order.
    pub const ALL: [Self; 8] = [
        Self::Newton,
        Self::Guess,
        Self::Lagged,
        Self::Interface,
        Self::Augmentation,
        Self::Conic,
        Self::Cut,
        Self::Crossing,
    ];

    /// As it stands in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Newton => "Newton's method",
            Self::Guess => "other first guesses",
            Self::Lagged => "lagged bound",
            Self::Interface => "inner loop on the interface",
            Self::Augmentation => "augmentation E/h first",
            Self::Conic => "conic method",
            Self::Cut => "shorter step",
            Self::Crossing => "crossing of a snap",
        }
    }
}

/// A rung that was left.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    /// The way.
    pub rung: Rung,
    /// How often it was tried: once for each first guess.
    pub attempts: usize,
    /// Why it was given up the first time.
    pub reason: String,
}

impl Tried {
    /// Notes one more attempt; those of one rung in a row are one entry.
    pub fn note(tried: &mut Vec<Self>, rung: Rung, reason: &StepFailure) {
        match tried.last_mut() {
            Some(last) if last.rung == rung => last.attempts += 1,
            _ => tried.push(Self { rung, attempts: 1, reason: reason.to_string() }),
        }
    }
}

impl std::fmt::Display for Tried {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let times = if self.attempts > 1 { format!(" ({} times)", self.attempts) } else { String::new() };
        write!(f, "{}{times}: {}", self.rung.name(), self.reason)
    }
}

/// A step that the first rung did not reach.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Start of the step.
    pub time: f64,
    /// Its end.
    pub until: f64,
    /// The rungs that were left, in their order.
    pub tried: Vec<Tried>,
    /// The rung that went on; `None` where the march ended.
    pub reached: Option<Rung>,
}

/// Events of a march.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Log {
    /// The latest ones.
    pub events: Vec<Event>,
    /// Earlier ones, which are not kept.
    pub dropped: usize,
}

impl Log {
    /// Adds an event.
    pub fn push(&mut self, event: Event) {
        if self.events.len() == MOST {
            self.events.remove(0);
            self.dropped += 1;
        }
        self.events.push(event);
    }
}
