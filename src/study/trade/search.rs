//! In which order settings are measured, see [`super`].

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::front::{Cost, front};
use super::measure::{Event, Laboratory, Measured, Role};
use super::moves::{BASES, Experience};
use super::norm::{QUANTITIES, error};
use super::reference::Estimate;
use super::setting::{Choice, Setting};
use super::telling::telling;
use super::{Aim, Trade, Wish};
use crate::geometry::BasisSpec;
use crate::output::OutputError;

/// Share of the effort that the reference may take.
const REFERENCE_SHARE: f64 = 0.35;
/// Share of the effort that any other run may take.
const RUN_SHARE: f64 = 0.12;
/// Finest sizes that are looked at (half octaves): the first whose reference can be afforded.
const FINEST: [i32; 3] = [2, 0, -2];
/// Sizes below the finest one at which all bases are compared: octaves.
const CROSSED: [i32; 3] = [-4, -2, 0];
/// Coarsest size, and that of the first run.
const COARSEST: i32 = -4;
/// Settings with larger errors are not improved upon.
const HOPELESS: f64 = 0.15;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No change of one choice is left that might help.
    Complete,
    /// The effort is spent.
    EffortSpent,
    /// Stopped from outside; the same command goes on.
    Interrupted,
}

/// Why a search came to nothing.
#[derive(Debug, thiserror::Error)]
pub enum Stop {
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
    /// A file that cannot be written or read back.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The reference would take more than the effort allows, by so many seconds.
    #[error("the reference alone would take about {0:.0} s of CPU time, {share:.0} % of the effort are meant for it", share = 100.0 * REFERENCE_SHARE)]
    TooLittle(f64),
    /// There is nothing to measure against.
    #[error("no reference: {0}")]
    NoReference(String),
}

/// What was measured.
#[derive(Debug)]
pub struct Found {
    /// All settings, in the order in which they were measured.
    pub points: Vec<Measured>,
    /// The quantities whose errors count, as numbers into [`QUANTITIES`].
    pub quantities: Vec<usize>,
    /// Number of the scene as it is, where it was measured.
    pub given: Option<usize>,
    /// Number of the reference.
    pub reference: usize,
    /// Its own error, for each of [`QUANTITIES`].
    pub estimates: Vec<Estimate>,
    /// CPU time of all runs in seconds.
    pub spent: f64,
    /// How the search ended.
    pub ending: Ending,
}

impl Found {
    /// Largest error of a setting over the quantities that count.
    pub fn error(&self, point: &Measured) -> f64 {
        self.quantities.iter().map(|k| point.errors[*k]).fold(0.0, larger)
    }

    /// What its true error is taken to be: errors below that of the reference count as that, and that of the reference is added.
    pub fn bound(&self, point: &Measured) -> f64 {
        let bound = |k: &usize| larger(point.errors[*k], self.estimates[*k].error) + self.estimates[*k].error;
        self.quantities.iter().map(bound).fold(0.0, larger)
    }

    /// Cost and bound of all settings; no error where a setting may not be recommended.
    pub fn costs(&self) -> Vec<Cost> {
        let cost = |point: &Measured| {
            let counts = point.role == Role::Candidate && point.done();
            Cost { cpu_s: point.status.cpu_s, error: if counts { self.bound(point) } else { f64::NAN } }
        };
        self.points.iter().map(cost).collect()
    }

    /// The smallest error that can be told: twice that of the reference.
    pub fn floor(&self) -> f64 {
        2.0 * self.quantities.iter().map(|k| self.estimates[*k].error).fold(0.0, larger)
    }
}

/// The larger of two numbers, `nan` if one of them is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

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
    let finest = finest(&mut laboratory, wish)?;
    cross(&mut laboratory, wish, finest)?;
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

fn sized(basis: BasisSpec, elements: i32) -> Setting {
    Setting { basis: Some(basis), elements, ..Setting::default() }
}

/// The reference of a basis: finer than the finest by an octave, in space and in time.
fn refined(basis: BasisSpec, finest: i32) -> Setting {
    Setting { steps: 1, ..sized(basis, finest + 2) }
}

/// The finest size whose refinement can be afforded.
fn finest(laboratory: &mut Laboratory, wish: &Wish) -> Result<i32, Stop> {
    let basis = BasisSpec::Nurbs { degree: 2 };
    for elements in COARSEST..=0 {
        let first = laboratory.measure(&sized(basis, elements), Role::Candidate, f64::INFINITY)?;
        if first.is_some_and(|k| laboratory.points[k].done()) {
            break;
        }
    }
    let expected = |finest: i32| laboratory.expected(&refined(basis, finest)).unwrap_or(f64::INFINITY);
    let affordable = |finest: &i32| expected(*finest) <= REFERENCE_SHARE * wish.effort;
    FINEST.into_iter().find(affordable).ok_or_else(|| match expected(FINEST[FINEST.len() - 1]) {
        cost if cost.is_finite() => Stop::TooLittle(cost),
        _ => Stop::NoReference(reasons(&laboratory.points)),
    })
}

fn reasons(points: &[Measured]) -> String {
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
fn attempt(laboratory: &mut Laboratory, wish: &Wish, setting: &Setting) -> Result<Option<usize>, Stop> {
    let most = (RUN_SHARE * wish.effort).min(wish.effort - laboratory.spent);
    let budget = if let Aim::Budget(budget) = wish.aim { 2.0 * budget } else { f64::INFINITY };
    match laboratory.expected(setting) {
        Some(cost) if cost > most.min(budget) => Ok(None),
        _ => laboratory.measure(setting, Role::Candidate, 2.0 * RUN_SHARE * wish.effort),
    }
}

/// The reference, its own error, and the errors of all that was measured before.
fn refer(laboratory: &mut Laboratory, wish: &Wish, finest: i32) -> Result<Found, Stop> {
    let quantities = telling(&laboratory.points, &wish.quantities).map_err(Stop::NoReference)?;
    let place = |laboratory: &mut Laboratory, setting: &Setting| {
        let known = laboratory.measure(setting, Role::Candidate, wish.effort)?;
        Ok::<_, Stop>(known.filter(|k| laboratory.points[*k].done()))
    };
    let mut order: Vec<(f64, BasisSpec, usize)> = vec![];
    for basis in BASES {
        let level = |elements: i32| {
            let same = |point: &Measured| point.setting == sized(basis, elements) && point.done();
            laboratory.points.iter().position(same)
        };
        if let (Some(fine), Some(coarse)) = (level(finest), level(finest - 2)) {
            order.push((difference(&laboratory.points, coarse, fine, &quantities), basis, fine));
        }
    }
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, basis, fine) in order.into_iter().filter(|(difference, ..)| difference.is_finite()) {
        let affordable = laboratory.expected(&refined(basis, finest)).is_some_and(|cost| cost <= 0.5 * wish.effort);
        let reference = match affordable {
            true => laboratory.measure(&refined(basis, finest), Role::Reference, wish.effort)?,
            false => None,
        };
        let Some(reference) = reference.filter(|k| laboratory.points[*k].done()) else { continue };
        let coarse = place(laboratory, &Setting { steps: -1, ..sized(basis, finest - 2) })?;
        let estimates = (0..QUANTITIES.len()).map(|k| {
            let between = |run, finer| difference(&laboratory.points, run, finer, &[k]);
            Estimate::new(between(fine, reference), coarse.map_or(f64::NAN, |coarse| between(coarse, fine)))
        });
        let estimates = estimates.collect();
        let mut found = Found {
            points: vec![],
            quantities,
            given: None,
            reference,
            estimates,
            spent: 0.0,
            ending: Ending::Interrupted,
        };
        judge(laboratory, &mut found);
        return Ok(found);
    }
    Err(Stop::NoReference(reasons(&laboratory.points)))
}

/// Largest error of one run against another.
fn difference(points: &[Measured], run: usize, finer: usize, quantities: &[usize]) -> f64 {
    quantities.iter().map(|k| error(&points[run].curves[*k], &points[finer].curves[*k])).fold(0.0, larger)
}

/// Errors of all points that have none yet, and a copy of the points for the result.
fn judge(laboratory: &mut Laboratory, found: &mut Found) {
    let reference = laboratory.points[found.reference].curves.clone();
    for point in laboratory.points.iter_mut().filter(|point| point.done() && point.errors[0].is_nan()) {
        point.errors = point.curves.iter().zip(&reference).map(|(run, reference)| error(run, reference)).collect();
    }
    found.points.clone_from(&laboratory.points);
}

/// The scene as it is, its other bulk model, and then one choice at a time.
fn explore(laboratory: &mut Laboratory, found: &mut Found, wish: &Wish, finest: i32) -> Result<Ending, Stop> {
    if finest >= 0 {
        found.given = attempt(laboratory, wish, &Setting::default())?;
    }
    let basis = laboratory.points[found.reference].setting.basis.unwrap_or(BASES[1]);
    let other = Setting { choices: BTreeSet::from([Choice::Material]), ..sized(basis, finest - 2) };
    laboratory.measure(&other, Role::OtherModel, RUN_SHARE * wish.effort)?;
    judge(laboratory, found);
    let (mut experience, mut tried, mut refused) = (Experience::new(), BTreeSet::new(), false);
    loop {
        let mut places = front(&found.costs());
        places.retain(|k| found.error(&found.points[*k]) < HOPELESS);
        places.sort_by(|a, b| distance(found, wish.aim, *a).total_cmp(&distance(found, wish.aim, *b)));
        let next = places.iter().find_map(|place| {
            let from = &found.points[*place].setting;
            let fresh = |step: super::moves::Move| {
                let setting = step.from(from, [COARSEST - 2, finest])?;
                let worthwhile = worthwhile(laboratory, found, &setting) && !tried.contains(&format!("{setting:?}"));
                worthwhile.then_some((step, setting))
            };
            let moved = experience.hopeful(found.bound(&found.points[*place])).find_map(fresh);
            moved.map(|(step, setting)| (step, setting, found.bound(&found.points[*place])))
        });
        let Some((step, setting, start)) = next else {
            return Ok(if refused { Ending::EffortSpent } else { Ending::Complete });
        };
        tried.insert(format!("{setting:?}"));
        let known = laboratory.points.len();
        let Some(point) = attempt(laboratory, wish, &setting)? else {
            refused |= setting.changes(laboratory.trade).is_some();
            continue;
        };
        if point >= known {
            judge(laboratory, found);
            experience.learn(step, start, front(&found.costs()).contains(&point));
        }
    }
}

/// How far a setting is from what is aimed at; for the whole front cheap ones come first.
fn distance(found: &Found, aim: Aim, point: usize) -> f64 {
    let (cost, bound) = (found.points[point].status.cpu_s, found.bound(&found.points[point]));
    match aim {
        Aim::Front => cost,
        Aim::Error(target) => (bound / target).ln().abs(),
        Aim::Budget(budget) => (cost / budget).ln().abs(),
    }
}

/// False for settings that are expected to cost more than one whose error cannot be told from zero.
fn worthwhile(laboratory: &Laboratory, found: &Found, setting: &Setting) -> bool {
    let expected = laboratory.expected(setting).unwrap_or(f64::INFINITY);
    let at_floor = |point: &&Measured| {
        point.role == Role::Candidate && point.done() && found.bound(point) <= found.floor() * (1.0 + 1e-9)
    };
    let enough = found.points.iter().filter(at_floor).map(|point| point.status.cpu_s).fold(f64::INFINITY, f64::min);
    expected <= 1.5 * enough
}
