//! Converged steps that are looked at twice.
//!
//! *Over a snap*: the end may be an equilibrium of another path. Without a snap the work of the drives is stored and dissipated, but for
//! the error of the step: the work of a force that changes monotonically lies within (change of force) * (way) of any rule. What is
//! set free beyond that is a snap, or a step too long for the energies. Half the step tells them apart: the error falls to an
//! eighth, the energy of a snap stays.
//!
//! *To another flank*: a site that carries pressure at both ends, but on different flanks of the mortar curve, was released and came
//! into contact anew; shorter steps see both.
//!
//! *Over many elements*: forces bear that well, but what friction does to sites that come and go within the step is lost. Passes of 38
//! degrees with steps of 3.6, 1.8, 1.0 and 0.5 elements of slip (mu = 0.3) dissipate 25, 4.9, 1.5 and 0.15 % too little, while Fx
//! changes by less than 1e-4 of its peak.

use crate::contact::{SiteMemory, SiteRecord};
use crate::geometry::Point;
use crate::model::{ContactStatus, Ledger, Model, Motion, Pair, Side, State};

use super::convergence::tolerance;
use super::failure::StepFailure;
use super::newton::NewtonReport;

/// Energy set free, of the energy stored, from which a step is suspected.
const SUSPECT: f64 = 0.02;
/// Energy set free, of all energies so far, that is worth a word: less is an error of the time steps.
const FAINT: f64 = 1e-3;
/// Step, of the nominal one, that is not halved again to find out.
pub const FINEST: f64 = 0.125;

/// Slip in a step, in elements, that is aimed at, and beyond which a step is repeated.
const SLIP: [f64; 2] = [2.0, 3.0];

/// Longest step that keeps the slip within what is aimed at, going on at the rate of the step found; infinite where nothing slips.
pub fn pace(found: &NewtonReport, dt: f64) -> f64 {
    dt * SLIP[0] / slip(found)
}

/// Largest slip of a site that rubs, in elements.
fn slip(found: &NewtonReport) -> f64 {
    let closed = sites(found).filter(|site| site.status != ContactStatus::Open && site.traction != 0.0);
    closed.fold(0.0, |m, site| m.max(site.slip.abs() / site.element))
}

fn sites(found: &NewtonReport) -> impl Iterator<Item = &SiteRecord> {
    found.evaluation.interfaces.iter().flat_map(|interface| &interface.sites)
}

/// Energy not worth a word beside what was stored, dissipated and supplied until then.
pub fn negligible(ledger: &Ledger) -> f64 {
    FAINT * ledger.strain_energy.abs().max(ledger.external_work.abs()).max(ledger.dissipated.abs())
}

/// What is wrong with a converged step, if anything.
pub fn leap(model: &Model, start: &State, found: &NewtonReport) -> Option<StepFailure> {
    let round_off = tolerance(model, &found.evaluation) * model.size();
    // inertia and viscosity have a place in the ledger for what a snap sets free
    let released = if model.has_rates() { 0.0 } else { unexplained(model, start, &found.state, round_off) };
    if released > 0.0 && !ran_off(model, start, found) {
        return Some(StepFailure::Leapt(released));
    }
    let jumped = || sites(found).filter(|site| site.jumped);
    if let Some(first) = jumped().next() {
        return Some(StepFailure::Jumped { sites: jumped().count(), x: first.x.x, y: first.x.y });
    }
    Some(slip(found)).filter(|slip| *slip > SLIP[1]).map(StepFailure::Slid)
}

/// True where a site that carried pressure has no partner any more beside an end of the mortar curve: what it held is set free there,
/// not by a snap.
fn ran_off(model: &Model, start: &State, found: &NewtonReport) -> bool {
    let pairs = model.pairs.iter().zip(&start.pairs).zip(&found.evaluation.interfaces);
    let lost = |sites: &[SiteMemory], now: &[SiteRecord]| {
        sites.iter().zip(now).any(|(before, now)| before.closure > 0.0 && now.gap.is_nan())
    };
    pairs.into_iter().any(|((pair, start_of), now)| lost(&start_of.sites, &now.sites) && beside_end(model, pair, start))
}

/// True where an end of the mortar curve is no farther from the nonmortar curve than its control points are from one another.
fn beside_end(model: &Model, pair: &Pair, at: &State) -> bool {
    let place = |side: &Side, k: usize| {
        let body = &model.bodies[side.body];
        body.points[side.nodes[k] - body.offset] + at.u[side.nodes[k]]
    };
    let edge: Vec<Point> = (0..pair.nonmortar.nodes.len()).map(|k| place(&pair.nonmortar, k)).collect();
    let spacing = edge.windows(2).map(|p| (p[1] - p[0]).norm()).fold(0.0, f64::max);
    let ends = [0, pair.mortar.nodes.len() - 1].map(|k| place(&pair.mortar, k));
    ends.iter().any(|end| edge.iter().any(|x| (x - end).norm() <= spacing))
}

/// The energy set free in a step, where it is more than the step explains and than `round_off`; else zero.
fn unexplained(model: &Model, start: &State, end: &State, round_off: f64) -> f64 {
    let (before, after) = (&start.ledger, &end.ledger);
    let way = |m: &Motion| m.travel([start.time, end.time], [&start.u, &end.u]);
    let change = before.forces.iter().zip(&after.forces).map(|(a, b)| b - a);
    let error: f64 = model.motions.iter().zip(change).map(|(motion, change)| (change * way(motion)).abs()).sum();
    let released = after.released_since(before);
    let stored = before.strain_energy.abs().max(after.strain_energy.abs());
    let least = (error + SUSPECT * stored).max(negligible(after)).max(round_off);
    if released > least { released } else { 0.0 }
}
