//! In which order settings are measured, see [`super`].

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::explore::explore;
use super::found::{Ending, Found, REFERENCE_SHARE, Stop};
use super::levels::{refer, refined, sized};
use super::measure::{Event, Laboratory, Measured, Role};
use super::moves::BASES;
use super::setting::{Choice, Setting};
use super::{Trade, Wish};
use crate::geometry::BasisSpec;

/// Share of the effort that any other run may take.
pub(super) const RUN_SHARE: f64 = 0.12;
/// A run that takes so many times what was expected is given up.
const PATIENCE: f64 = 10.0;
/// Finest sizes that are looked at (half octaves): the first whose reference can be afforded.
const FINEST: [i32; 3] = [2, 0, -2];
/// Sizes below the finest one at which all bases are compared: octaves.
const CROSSED: [i32; 3] = [-4, -2, 0];
/// Basis by which the reference is planned.
const PLANNED: BasisSpec = BasisSpec::Nurbs { degree: 2 };
/// Coarsest size, and that of the first run.
pub(super) const COARSEST: i32 = -4;

/// Measures settings of a scene below the folder `root`, and tells `watch` on the way.
///
/// # Errors
/// Nothing could be measured against a reference, and why.
pub fn search(
    trade: &Trade,
    wish: &Wish,
    root: &Path,
    interrupt: &AtomicBool,
    watch: &mut dyn FnMut(Event),
) -> Result<Found, Stop> {
    let mut laboratory = Laboratory::new(trade, root, interrupt, watch);
    let mut finest = finest(&mut laboratory, wish)?;
    cross(&mut laboratory, wish, finest)?;
    // what the coarsest run foretold may have been too much
    while finest < FINEST[0] && affordable(&laboratory, wish, finest + 2) {
        finest += 2;
        cross(&mut laboratory, wish, finest)?;
    }
    let mut found = refer(&mut laboratory, wish, finest)?;
    let ending = explore(&mut laboratory, &mut found, wish, finest);
    found.ending = match ending {
        Ok(ending) => ending,
        Err(Stop::Interrupted) => Ending::Interrupted,
        Err(other) => return Err(other),
    };
    found.spent = laboratory.spent;
    Ok(found)
}

/// The finest size whose refinement can be afforded.
fn finest(laboratory: &mut Laboratory, wish: &Wish) -> Result<i32, Stop> {
    for elements in COARSEST..=0 {
        let first = laboratory.measure(&sized(PLANNED, elements), Role::Candidate, f64::INFINITY)?;
        if first.is_some_and(|k| laboratory.points[k].done()) {
            break;
        }
    }
    let least = FINEST[FINEST.len() - 1];
    FINEST.into_iter().find(|finest| affordable(laboratory, wish, *finest)).ok_or_else(|| {
        match laboratory.expected(&refined(PLANNED, least)) {
            Some(cost) => Stop::TooLittle(cost),
            None => Stop::NoReference(reasons(&laboratory.points)),
        }
    })
}

/// Whether the reference above this finest size is expected to stay within its share.
fn affordable(laboratory: &Laboratory, wish: &Wish, finest: i32) -> bool {
    let expected = laboratory.expected(&refined(PLANNED, finest));
    expected.is_some_and(|cost| cost <= REFERENCE_SHARE * wish.effort)
}

/// Why runs failed, each reason once.
pub(super) fn reasons(points: &[Measured]) -> String {
    let mut said: Vec<&str> = points.iter().map(|point| point.status.reason.as_str()).collect();
    said.dedup();
    said.join("; ")
}

/// Every basis at every size, with both integrations.
fn cross(laboratory: &mut Laboratory, wish: &Wish, finest: i32) -> Result<(), Stop> {
    for below in CROSSED {
        for basis in BASES {
            let usual = sized(basis, finest + below);
            let other = Setting { choices: BTreeSet::from([Choice::Integration]), ..usual.clone() };
            attempt(laboratory, wish, &usual)?;
            attempt(laboratory, wish, &other)?;
        }
    }
    Ok(())
}

/// Measures a candidate if it is not expected to take too much; the number of its point.
pub(super) fn attempt(laboratory: &mut Laboratory, wish: &Wish, setting: &Setting) -> Result<Option<usize>, Stop> {
    let most = (RUN_SHARE * wish.effort).min(wish.effort - laboratory.spent);
    let expected = laboratory.expected(setting);
    let patience = expected.map_or(f64::INFINITY, |cost| PATIENCE * cost);
    let limit = patience.clamp(0.1 * RUN_SHARE * wish.effort, 2.0 * RUN_SHARE * wish.effort);
    match expected {
        Some(cost) if cost > most => Ok(None),
        _ => laboratory.measure(setting, Role::Candidate, limit),
    }
}
