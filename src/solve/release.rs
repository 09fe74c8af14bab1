//! Converged steps that are looked at twice.
//!
//! *Over a snap*: the end may be an equilibrium of another path. Without a snap the work of the drives is stored and dissipated, but for
//! the error of the step: the work of a force that changes monotonically lies within (change of force) * (way) of any rule. What is
//! set free beyond that is a snap, or a step too long for the energies. Half the step tells them apart: the error falls to an
//! eighth, the energy of a snap stays.
//!
//! *To another flank*: a site that carries pressure at both ends, but on different flanks of the mortar curve, was released and came
//! into contact anew; shorter steps see both.

use crate::model::{Model, Motion, State};

use super::convergence::tolerance;
use super::failure::StepFailure;
use super::newton::NewtonReport;

/// Energy set free, of the energy stored, from which a step is suspected.
const SUSPECT: f64 = 0.02;
/// The same of the work and the dissipation since the beginning: less is not worth a word.
const FAINT: f64 = 1e-3;
/// Step, of the nominal one, that is not halved again to find out.
pub const FINEST: f64 = 0.125;

/// What is wrong with a converged step, if anything.
pub fn leap(model: &Model, start: &State, found: &NewtonReport) -> Option<StepFailure> {
    let round_off = tolerance(model, &found.evaluation) * model.size();
    // inertia and viscosity have a place in the ledger for what a snap sets free
    let released = if model.has_rates() { 0.0 } else { unexplained(model, start, &found.state, round_off) };
    if released > 0.0 {
        return Some(StepFailure::Leapt(released));
    }
    let jumped = || found.evaluation.interfaces.iter().flat_map(|i| &i.sites).filter(|site| site.jumped);
    let x = jumped().next()?.x;
    Some(StepFailure::Jumped { sites: jumped().count(), x: x.x, y: x.y })
}

/// The energy set free in a step, where it is more than the step explains and than `round_off`; else zero.
fn unexplained(model: &Model, start: &State, end: &State, round_off: f64) -> f64 {
    let (before, after) = (&start.ledger, &end.ledger);
    let way = |m: &Motion| m.travel([start.time, end.time], [&start.u, &end.u]);
    let change = before.forces.iter().zip(&after.forces).map(|(a, b)| b - a);
    let error: f64 = model.motions.iter().zip(change).map(|(motion, change)| (change * way(motion)).abs()).sum();
    let released = after.released_since(before);
    let stored = before.strain_energy.abs().max(after.strain_energy.abs());
    let since = stored.max(after.external_work.abs()).max(after.dissipated.abs());
    let least = (error + SUSPECT * stored).max(FAINT * since).max(round_off);
    if released > least { released } else { 0.0 }
}
