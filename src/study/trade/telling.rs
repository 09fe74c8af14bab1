//! Which quantities of a scene say something about accuracy.

use super::measure::Measured;
use super::norm::{QUANTITIES, error};
use crate::output::tables::number;

/// Shares of a peak below this are round-off or prescribed.
const NOTHING: f64 = 1e-6;
/// Asked for unless others are: first choice, and what is left where a load is prescribed and nothing rubs.
const USUAL: [&[&str]; 2] = [&["fx", "fy", "mu_global"], &["pressure_max", "strain_energy"]];
/// Quantities of one kind: what vanishes beside the largest of them is round-off.
const KINDS: [&[&str]; 3] = [&["fx", "fy"], &["strain_energy", "external_work", "dissipated"], &["drive_x", "drive_y"]];

/// Numbers of the quantities wanted (of the usual ones if none are) that neither vanish nor are the same in all runs.
///
/// # Errors
/// None is left; what was found in words.
pub(super) fn telling(points: &[Measured], wanted: &[usize]) -> Result<Vec<usize>, String> {
    let runs: Vec<&Measured> = points.iter().filter(|point| point.done()).collect();
    let Some(last) = runs.last() else { return Err("no run converged".into()) };
    if last.curves.iter().all(|curve| curve.peak() == 0.0) {
        return Err("the bodies never touch".into());
    }
    let tells = |k: &usize| {
        let differs = |run: &&Measured| error(&run.curves[*k], &last.curves[*k]) > NOTHING;
        !vanishes(last, *k) && runs.iter().any(differs)
    };
    let usual = USUAL.map(|names| names.iter().filter_map(|name| place(name)).collect::<Vec<_>>());
    let choices = if wanted.is_empty() { usual.to_vec() } else { vec![wanted.to_vec()] };
    let mut left = choices.into_iter().map(|numbers| numbers.into_iter().filter(tells).collect::<Vec<_>>());
    left.find(|numbers| !numbers.is_empty()).ok_or_else(|| {
        let peaks = wanted.iter().map(|k| format!("{} (peak {})", QUANTITIES[*k], number(last.curves[*k].peak())));
        format!("{}: zero, or the same in all runs; ask for others", peaks.collect::<Vec<_>>().join(", "))
    })
}

fn place(name: &str) -> Option<usize> {
    QUANTITIES.iter().position(|known| *known == name)
}

fn vanishes(run: &Measured, k: usize) -> bool {
    let peak = |name: &&str| place(name).map_or(0.0, |k| run.curves[k].peak());
    let kind = KINDS.into_iter().find(|names| names.contains(&QUANTITIES[k]));
    let largest = kind.map_or(1.0, |names| names.iter().map(peak).fold(0.0, f64::max));
    let own = match QUANTITIES[k] {
        "pressure_max" | "contact_length" => return run.curves[k].peak() == 0.0,
        "mu_global" => peak(&"fx") / peak(&"fy"),
        _ => run.curves[k].peak(),
    };
    own.is_nan() || own <= NOTHING * largest
}
