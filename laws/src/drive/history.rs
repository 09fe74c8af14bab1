//! What a driver finds, and the march through one nominal step.

use crate::FrictionLaw;

/// A step that shrank to this share of the nominal one is given up.
const SMALLEST: f64 = 1e-12;
/// Most attempts within one nominal step.
const ATTEMPTS: usize = 1_000_000;
/// A remainder of this share of a step is taken with it.
const REMAINDER: f64 = 1e-9;

/// The point at the end of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time.
    pub time: f64,
    /// Slip since the start, signed (length).
    pub slip: f64,
    /// Slip velocity: of a slider with mass at the end of the step, else the mean of the step.
    pub velocity: f64,
    /// Pressure (stress).
    pub pressure: f64,
    /// Tangential traction against the slip (stress); of a sliding mass under a set-valued law that of the middle of the step.
    pub traction: f64,
    /// Force that moves the point (stress): that of the spring; on a prescribed path the traction.
    pub force: f64,
    /// Work done against friction since the start (stress * length); of a direct law in part stored.
    pub work: f64,
    /// False where it sticks, or where a direct law does not move.
    pub slipping: bool,
    /// Internal variables of the law.
    pub states: Vec<f64>,
}

impl Record {
    pub(super) fn start(law: &dyn FrictionLaw, states: Option<&[f64]>, pressure: f64) -> Self {
        let initial = || law.variables().iter().map(|variable| variable.initial).collect();
        let states = states.map_or_else(initial, <[f64]>::to_vec);
        Self {
            time: 0.0,
            slip: 0.0,
            velocity: 0.0,
            pressure,
            traction: 0.0,
            force: 0.0,
            work: 0.0,
            slipping: false,
            states,
        }
    }
}

/// Why and where a driver gave up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no step beyond time {time:e} (slip {slip:e}, pressure {pressure:e}): {reason}")]
pub struct Failure {
    /// Time reached.
    pub time: f64,
    /// Slip reached.
    pub slip: f64,
    /// Pressure there.
    pub pressure: f64,
    /// What went wrong in the last attempt.
    pub reason: String,
}

/// Everything up to the end, or up to a failure.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// The start and the end of every step, cut ones and events included. Never empty.
    pub records: Vec<Record>,
    /// What ended it early.
    pub failure: Option<Failure>,
}

/// What one attempt came to.
pub(super) struct Reached {
    pub record: Record,
    /// Length of the step that was taken: shorter than asked where an event ended it.
    pub dt: f64,
    /// The law's opinion of the step.
    pub largest: Option<f64>,
}

impl From<Record> for History {
    fn from(start: Record) -> Self {
        Self { records: vec![start], failure: None }
    }
}

impl History {
    /// The last record.
    pub fn last(&self) -> &Record {
        &self.records[self.records.len() - 1]
    }

    /// Goes on to the time `end`, in one step where `attempt` allows it; false where it does not get there.
    pub(super) fn reach(&mut self, end: f64, attempt: impl Fn(&Record, f64) -> Result<Reached, String>) -> bool {
        let nominal = end - self.last().time;
        let (mut dt, mut reason) = (nominal, String::new());
        for _ in 0..ATTEMPTS {
            let left = end - self.last().time;
            let trial = if dt >= left * (1.0 - REMAINDER) { left } else { dt };
            match attempt(self.last(), trial) {
                Ok(Reached { dt: taken, largest: Some(largest), .. }) if largest < taken * (1.0 - REMAINDER) => {
                    (dt, reason) = (largest, format!("the law asks for a step of {largest:e}"));
                }
                Ok(reached) => {
                    let arrived = reached.dt >= left;
                    dt = reached.largest.unwrap_or(2.0 * dt);
                    let time = if arrived { end } else { reached.record.time };
                    self.records.push(Record { time, ..reached.record });
                    if arrived {
                        return true;
                    }
                }
                Err(said) => (dt, reason) = (0.5 * trial, said),
            }
            if dt.is_nan() || dt < SMALLEST * nominal {
                break;
            }
        }
        let Record { time, slip, pressure, .. } = *self.last();
        self.failure = Some(Failure { time, slip, pressure, reason });
        false
    }
}
