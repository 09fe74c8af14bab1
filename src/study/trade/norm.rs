//! The error of a curve over the pass, in one number.
//!
//! ```text
//! error = sqrt( sum w_k (v_k - r_k)^2 / sum w_k )  /  max |r|
//! ```
//!
//! `v` is the curve of the run, `r` that of the reference, both at the nominal times `t_k` of the one with fewer steps, straight lines
//! between the nominal times of the other. `w_k` is the length of time that `t_k` stands for where the reference is in
//! contact, 0 elsewhere; for `mu_global`, which means nothing where `fy` vanishes, it is that times `|fy|` of the reference, and 0
//! where this is below 2 % of its peak. Where the run has no value (`mu_global` without contact) it counts as 0.

use std::path::Path;

use crate::output::OutputError;
use crate::output::figures::CONTACT_THRESHOLD;
use crate::output::tables::read_columns;

/// Columns of `history.csv` whose error can be asked for.
pub const QUANTITIES: [&str; 10] = [
    "fx",
    "fy",
    "mu_global",
    "pressure_max",
    "dissipated",
    "contact_length",
    "strain_energy",
    "external_work",
    "drive_x",
    "drive_y",
];

/// A quantity over the nominal times of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Nominal times, increasing.
    pub time: Vec<f64>,
    /// Value at each time; `nan` where there is none.
    pub value: Vec<f64>,
    /// What counts, and how much, if this is the reference: at least 0.
    pub weight: Vec<f64>,
}

impl Curve {
    /// Largest magnitude where the weight is positive; 0 if it never is.
    pub fn peak(&self) -> f64 {
        let counting =
            self.value.iter().zip(&self.weight).filter(|(value, weight)| **weight > 0.0 && value.is_finite());
        counting.fold(0.0, |peak, (value, _)| peak.max(value.abs()))
    }

    /// Value and weight at a time, straight lines between the nominal times.
    fn at(&self, time: f64) -> [f64; 2] {
        let last = self.time.len() - 1;
        let above = self.time.partition_point(|t| *t < time).clamp(1.min(last), last);
        let below = above.saturating_sub(1);
        let length = self.time[above] - self.time[below];
        let share = if length > 0.0 { ((time - self.time[below]) / length).clamp(0.0, 1.0) } else { 1.0 };
        // the end of a line is its value there, whatever the other end holds
        let line = |values: &[f64]| match share {
            0.0 => values[below],
            1.0 => values[above],
            _ => (1.0 - share) * values[below] + share * values[above],
        };
        [line(&self.value), line(&self.weight)]
    }
}

/// Error of a run's curve against that of the reference, see the head of this file; `nan` where nothing of the reference counts.
pub fn error(run: &Curve, reference: &Curve) -> f64 {
    let times = if run.time.len() < reference.time.len() { &run.time } else { &reference.time };
    if run.time.is_empty() || reference.time.is_empty() {
        return f64::NAN;
    }
    let (mut sum, mut weights) = (0.0, 0.0);
    for (k, time) in times.iter().enumerate() {
        let [wanted, weight] = reference.at(*time);
        if !(weight > 0.0 && wanted.is_finite()) {
            continue;
        }
        let length = 0.5 * (times[(k + 1).min(times.len() - 1)] - times[k.saturating_sub(1)]);
        let weight = weight * if times.len() > 1 { length } else { 1.0 };
        let value = Some(run.at(*time)[0]).filter(|value| value.is_finite()).unwrap_or(0.0);
        sum += weight * (value - wanted).powi(2);
        weights += weight;
    }
    (sum / weights).sqrt() / reference.peak()
}

/// Curves of all quantities of one `history.csv`, in the order of [`QUANTITIES`].
///
/// # Errors
/// A table that cannot be read.
pub fn read(history: &Path) -> Result<Vec<Curve>, OutputError> {
    let mut names = vec!["time", "contact_length", "fy"];
    names.extend(QUANTITIES);
    let mut columns = read_columns(history, &names)?;
    let values = columns.split_off(3);
    let [time, contact, support] = [&columns[0], &columns[1], &columns[2]];
    let peak = support.iter().fold(0.0_f64, |peak, fy| peak.max(fy.abs()));
    let touching: Vec<f64> = contact.iter().map(|length| f64::from(u8::from(*length > 0.0))).collect();
    let loaded = |fy: &f64| if fy.abs() > CONTACT_THRESHOLD * peak { fy.abs() } else { 0.0 };
    let weight = |name: &str| match name {
        "mu_global" => support.iter().map(loaded).collect(),
        _ => touching.clone(),
    };
    let curve = |(value, name): (Vec<f64>, &str)| Curve { time: time.clone(), value, weight: weight(name) };
    Ok(values.into_iter().zip(QUANTITIES).map(curve).collect())
}
