//! One choice changed at a time, from the settings that no other one dominates.

use std::collections::BTreeSet;

use super::found::{Ending, Found, Stop};
use super::front::front;
use super::levels::{judge, sized};
use super::measure::{Laboratory, Measured, Role};
use super::moves::{BASES, Experience, Move};
use super::search::{COARSEST, RUN_SHARE, attempt};
use super::setting::{Choice, Setting};
use super::{Aim, Wish};

/// Settings with larger errors are not improved upon.
const HOPELESS: f64 = 0.15;
/// Coarsest size that is looked at, below the coarsest of the crossing (half octaves).
const BELOW: i32 = 2;
/// How much dearer than what is good enough, or than the budget, a setting may be expected to be.
const DEARER: f64 = 1.5;

/// The scene as it is, its other bulk model, and then one choice at a time.
pub(super) fn explore(
    laboratory: &mut Laboratory,
    found: &mut Found,
    wish: &Wish,
    finest: i32,
) -> Result<Ending, Stop> {
    if finest >= 0 {
        found.given = attempt(laboratory, wish, &Setting::default())?;
    }
    let basis = laboratory.points[found.reference].setting.basis.unwrap_or(BASES[1]);
    let other = Setting { choices: BTreeSet::from([Choice::Material]), ..sized(basis, finest - 2) };
    laboratory.measure(&other, Role::OtherModel, RUN_SHARE * wish.effort)?;
    judge(laboratory, found);
    let (mut experience, mut tried, mut refused) = (Experience::new(), vec![], false);
    while let Some(next) = next(laboratory, found, wish, finest, &experience, &tried) {
        tried.push(next.setting.clone());
        let known = laboratory.points.len();
        match attempt(laboratory, wish, &next.setting)? {
            Some(point) if point >= known => {
                judge(laboratory, found);
                let useful = front(&found.costs()).contains(&point);
                experience.learn(next.step, next.start, useful, found.points[point].status.cpu_s);
            }
            Some(_) => {}
            None => refused |= next.setting.changes(laboratory.trade).is_some(),
        }
    }
    Ok(if refused { Ending::EffortSpent } else { Ending::Complete })
}

/// A setting to be tried.
struct Next {
    step: Move,
    setting: Setting,
    /// Error of the setting from which the move goes.
    start: f64,
}

/// The first change that is new and may help, from the settings of the front that matter most.
fn next(
    laboratory: &Laboratory,
    found: &Found,
    wish: &Wish,
    finest: i32,
    experience: &Experience,
    tried: &[Setting],
) -> Option<Next> {
    let costs = found.costs();
    let mut places = front(&costs);
    places.retain(|place| costs[*place].error < HOPELESS);
    // the smaller the sooner; for the whole front each half decade of errors gets its share of the effort
    let order = |place: &usize| match (wish.aim, costs[*place]) {
        (Aim::Front, cost) => experience.spent(cost.error),
        (Aim::Error(target), cost) => (cost.error / target).ln().abs(),
        (Aim::Budget(budget), cost) => (cost.cpu_s / budget).ln().abs(),
    };
    places.sort_by(|a, b| order(a).total_cmp(&order(b)));
    places.into_iter().find_map(|place| {
        let (from, start) = (&found.points[place].setting, costs[place].error);
        let fresh = |step: Move| {
            let setting = step.from(from, [COARSEST - BELOW, finest])?;
            let fresh = !tried.contains(&setting) && worthwhile(laboratory, found, wish, &setting);
            fresh.then_some(Next { step, setting, start })
        };
        experience.hopeful(start).find_map(fresh)
    })
}

/// False for settings that are expected to cost more than the budget, or than one whose error cannot be told from zero.
fn worthwhile(laboratory: &Laboratory, found: &Found, wish: &Wish, setting: &Setting) -> bool {
    let expected = laboratory.expected(setting).unwrap_or(f64::INFINITY);
    let at_floor = |point: &&Measured| {
        point.role == Role::Candidate && point.done() && found.bound(point) <= found.floor() * (1.0 + 1e-9)
    };
    let enough = found.points.iter().filter(at_floor).map(|point| point.status.cpu_s).fold(f64::INFINITY, f64::min);
    let budget = if let Aim::Budget(budget) = wish.aim { budget } else { f64::INFINITY };
    expected <= DEARER * enough.min(budget)
}
