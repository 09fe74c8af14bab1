//! The reference, its own error from the levels below it, and the errors of all others against it.

use super::Wish;
use super::found::{Ending, Found, Stop, larger};
use super::measure::{Laboratory, Measured, Role};
use super::moves::{BASES, MOST_STEPS};
use super::norm::{QUANTITIES, error};
use super::reference::Estimate;
use super::search::reasons;
use super::setting::Setting;
use super::telling::telling;
use crate::geometry::BasisSpec;

/// Largest share of the effort for a reference of a basis that is dearer than the one it was planned with.
const MOST: f64 = 0.5;

/// A basis at a size, everything else as in the scene.
pub(super) fn sized(basis: BasisSpec, elements: i32) -> Setting {
    Setting { basis: Some(basis), elements, ..Setting::default() }
}

/// The reference of a basis: finer than the finest settings by an octave, in space and in time.
pub(super) fn refined(basis: BasisSpec, finest: i32) -> Setting {
    Setting { steps: MOST_STEPS + 1, ..sized(basis, finest + 2) }
}

/// Computes the reference, and judges all that was measured before.
pub(super) fn refer(laboratory: &mut Laboratory, wish: &Wish, finest: i32) -> Result<Found, Stop> {
    let quantities = telling(&laboratory.points, &wish.quantities).map_err(Stop::NoReference)?;
    for basis in ranked(laboratory, &quantities, finest) {
        let setting = refined(basis, finest);
        if laboratory.expected(&setting).is_none_or(|cost| cost > MOST * wish.effort) {
            continue;
        }
        let reference = laboratory.measure(&setting, Role::Reference, wish.effort)?;
        let Some(reference) = reference.filter(|k| laboratory.points[*k].done()) else { continue };
        // the levels below it, each coarser by an octave in space and in time
        let mut level = |below: i32| {
            let setting = Setting { steps: MOST_STEPS + 1 - below, ..sized(basis, finest + 2 - 2 * below) };
            let known = laboratory.measure(&setting, Role::Candidate, wish.effort)?;
            Ok::<_, Stop>(known.filter(|k| laboratory.points[*k].done()))
        };
        let (Some(fine), coarse) = (level(1)?, level(2)?) else { continue };
        let estimate = |k: usize| {
            let between = |run, finer| difference(&laboratory.points, run, finer, &[k]);
            Estimate::new(between(fine, reference), coarse.map_or(f64::NAN, |coarse| between(coarse, fine)))
        };
        let estimates = (0..QUANTITIES.len()).map(estimate).collect();
        let (points, spent) = (vec![], laboratory.spent);
        let mut found =
            Found { points, quantities, given: None, reference, estimates, spent, ending: Ending::Interrupted };
        judge(laboratory, &mut found);
        return Ok(found);
    }
    Err(Stop::NoReference(reasons(&laboratory.points)))
}

/// Bases, those first whose two finest sizes differ least.
fn ranked(laboratory: &Laboratory, quantities: &[usize], finest: i32) -> Vec<BasisSpec> {
    let points = &laboratory.points;
    let level = |basis, elements| points.iter().position(|p| p.setting == sized(basis, elements) && p.done());
    let change = |basis: BasisSpec| {
        let (fine, coarse) = (level(basis, finest)?, level(basis, finest - 2)?);
        Some((difference(points, coarse, fine, quantities), basis))
    };
    let mut order: Vec<_> = BASES.into_iter().filter_map(change).filter(|(change, _)| change.is_finite()).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.into_iter().map(|(_, basis)| basis).collect()
}

/// Largest error of one run against another.
fn difference(points: &[Measured], run: usize, finer: usize, quantities: &[usize]) -> f64 {
    quantities.iter().map(|k| error(&points[run].curves[*k], &points[finer].curves[*k])).fold(0.0, larger)
}

/// Errors of all points that have none yet, and a copy of the points for the result.
pub(super) fn judge(laboratory: &mut Laboratory, found: &mut Found) {
    let reference = laboratory.points[found.reference].curves.clone();
    for point in laboratory.points.iter_mut().filter(|point| point.done() && point.errors[0].is_nan()) {
        point.errors = point.curves.iter().zip(&reference).map(|(run, reference)| error(run, reference)).collect();
    }
    found.points.clone_from(&laboratory.points);
}
