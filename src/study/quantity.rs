//! One number of a whole history: last, extremes, means, integrals, sums.
//!
//! A step *counts* if its values in all columns named are numbers, and `over` and `within` admit it. With values `v`, weights `w`
//! (1 if none are given) and places `x` (column `along`) of the steps, and sums over all pairs of neighbouring steps that both count,
//!
//! ```text
//! integral = sum 1/2 (v_i + v_j) (x_j - x_i)
//! mean     = sum 1/2 (w_i v_i + w_j v_j) |x_j - x_i|  /  sum 1/2 (w_i + w_j) |x_j - x_i|
//! ```
//!
//! so that the mean of `mu_global` with the weight `fy` is mean resistance over mean support. Where no two neighbours count, or
//! `along` stands still, a mean is that of the steps by themselves, `sum w v / sum w`. Nothing that counts: `nan`.

use std::path::Path;

use super::spec::{QuantitySpec, Steps, Take};
use crate::output::OutputError;
use crate::output::tables::read_columns;

/// Round-off allowed at the ends of a window, as a share of it.
const AT_THE_END: f64 = 1e-9;

/// All quantities of one `history.csv`, in order.
///
/// # Errors
/// A table that cannot be read.
pub(super) fn collect(history: &Path, specs: &[QuantitySpec]) -> Result<Vec<f64>, OutputError> {
    let mut names: Vec<&str> = specs.iter().flat_map(columns).collect();
    names.sort_unstable();
    names.dedup();
    let columns = read_columns(history, &names)?;
    let of = |name: &str| names.iter().position(|known| *known == name).map_or(&[][..], |k| &columns[k]);
    Ok(specs.iter().map(|spec| Samples::new(spec, of).take(spec.take)).collect())
}

/// The columns that a quantity reads.
fn columns(spec: &QuantitySpec) -> Vec<&str> {
    let mut names = vec![spec.column.as_str(), spec.along.as_str()];
    names.extend(spec.weight.as_deref());
    names.extend(spec.within.keys().map(String::as_str));
    names.extend(match spec.over {
        Steps::All => None,
        Steps::Contact => Some("contact_length"),
        Steps::Slipping => Some("fully_slipping"),
    });
    names
}

/// One step: whether it counts, value, weight, place.
#[derive(Clone, Copy)]
struct Sample {
    counts: bool,
    value: f64,
    weight: f64,
    place: f64,
}

struct Samples(Vec<Sample>);

impl Samples {
    fn new<'a>(spec: &QuantitySpec, of: impl Fn(&str) -> &'a [f64]) -> Self {
        let (value, place) = (of(&spec.column), of(&spec.along));
        let weight = spec.weight.as_deref().map(&of);
        let windows: Vec<(&[f64], [f64; 2])> = spec.within.iter().map(|(name, window)| (of(name), *window)).collect();
        let flag = match spec.over {
            Steps::All => None,
            Steps::Contact => Some(of("contact_length")),
            Steps::Slipping => Some(of("fully_slipping")),
        };
        let sample = |k: usize| {
            let (value, weight, place) = (value[k], weight.map_or(1.0, |w| w[k]), place[k]);
            let counts = [value, weight, place].iter().all(|number| number.is_finite())
                && flag.is_none_or(|flag| flag[k] > 0.0)
                && windows.iter().all(|(column, window)| inside(column[k], *window));
            Sample { counts, value, weight, place }
        };
        Self((0..value.len()).map(sample).collect())
    }

    fn take(&self, take: Take) -> f64 {
        let counting = || self.0.iter().filter(|sample| sample.counts);
        let best = |better: fn(f64, f64) -> f64| counting().map(|s| s.value).reduce(better).unwrap_or(f64::NAN);
        match take {
            Take::Last => counting().next_back().map_or(f64::NAN, |sample| sample.value),
            Take::Min => best(f64::min),
            Take::Max => best(f64::max),
            Take::Sum => counting().map(|sample| sample.value).reduce(|a, b| a + b).unwrap_or(f64::NAN),
            Take::Integral if counting().next().is_none() => f64::NAN,
            Take::Integral => self.pairs().map(|(a, b)| 0.5 * (a.value + b.value) * (b.place - a.place)).sum(),
            Take::Mean => self.mean(),
        }
    }

    fn mean(&self) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (a, b) in self.pairs() {
            let half = 0.5 * (b.place - a.place).abs();
            sum += half * (a.weight * a.value + b.weight * b.value);
            weight += half * (a.weight + b.weight);
        }
        if weight == 0.0 {
            for sample in self.0.iter().filter(|sample| sample.counts) {
                sum += sample.weight * sample.value;
                weight += sample.weight;
            }
        }
        sum / weight
    }

    fn pairs(&self) -> impl Iterator<Item = (Sample, Sample)> {
        self.0.windows(2).filter(|pair| pair[0].counts && pair[1].counts).map(|pair| (pair[0], pair[1]))
    }
}

fn inside(value: f64, [low, high]: [f64; 2]) -> bool {
    let slack = AT_THE_END * (high - low).abs();
    (low - slack..=high + slack).contains(&value)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    /// `x^2` at unequal steps, with gaps in what counts.
    fn of(name: &str) -> &'static [f64] {
        match name {
            "fx" => &[f64::NAN, 1.0, 4.0, 16.0, 25.0, 36.0],
            "drive_x" => &[0.0, 1.0, 2.0, 4.0, 5.0, 6.0],
            "fy" => &[1.0, 2.0, 2.0, 2.0, 0.0, 1.0],
            "contact_length" => &[1.0, 1.0, 1.0, 1.0, 0.0, 1.0],
            _ => &[0.0; 6],
        }
    }

    fn take(take: Take, over: Steps, weight: Option<&str>, within: &[(&str, [f64; 2])]) -> f64 {
        let within: BTreeMap<_, _> = within.iter().map(|(name, window)| (name.to_string(), *window)).collect();
        let (column, along, weight) = ("fx".into(), "drive_x".into(), weight.map(str::to_owned));
        let spec = QuantitySpec { name: "q".into(), column, take, over, within, along, weight };
        Samples::new(&spec, of).take(spec.take)
    }

    #[test]
    fn numbers_by_hand() {
        let trapezoids = 0.5 * 5.0 * 1.0 + 0.5 * 20.0 * 2.0;
        assert_eq!(take(Take::Integral, Steps::Contact, None, &[]), trapezoids);
        assert_eq!(take(Take::Integral, Steps::All, None, &[]), trapezoids + 20.5 + 30.5);
        assert_eq!(take(Take::Mean, Steps::Contact, None, &[]), trapezoids / 3.0);
        // equal weights cancel
        assert_eq!(take(Take::Mean, Steps::Contact, Some("fy"), &[]), trapezoids / 3.0);
        assert_eq!(take(Take::Last, Steps::All, None, &[]), 36.0);
        assert_eq!(take(Take::Max, Steps::All, None, &[("drive_x", [1.0, 4.0])]), 16.0);
        assert_eq!(take(Take::Min, Steps::All, None, &[("drive_x", [1.5, 4.0])]), 4.0);
        assert_eq!(take(Take::Sum, Steps::Contact, None, &[]), 57.0);
    }

    #[test]
    fn lonely_steps_are_their_own_mean_and_nothing_is_nan() {
        assert_eq!(take(Take::Mean, Steps::All, None, &[("drive_x", [6.0, 7.0])]), 36.0);
        for what in [Take::Mean, Take::Last, Take::Min, Take::Max, Take::Integral, Take::Sum] {
            assert!(take(what, Steps::Slipping, None, &[("drive_x", [7.0, 8.0])]).is_nan());
        }
    }
}
