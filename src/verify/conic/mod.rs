//! The conic cross-check: a second method for a step, and the verdict on the first.
//!
//! It shares with the Newton method what is fixed by the problem (bodies, kinematics of the sites, laws) and nothing of how
//! its conditions are met: no projection onto the cone, no active set, no Newton loop on the multipliers. Where that method asks a
//! semismooth equation to vanish, this one asks Clarabel for the optimum of a convex programme ([`programme`]) at the current
//! linearisation, moves there, and linearises again, until displacements and contact forces satisfy the exact conditions
//! ([`Violation`]).
//!
//! # Why the outer iteration ends at the solution
//!
//! A programme at `u` has the exact forces of the bodies, the exact gaps and slips, and as rows the *virtual* gaps and slips of the
//! sites, along which contact forces work. When its increment vanishes, its stationarity is the equilibrium of the step and its
//! complementarity that of the sites, whatever symmetric positive definite matrix it had. Three things are approximate on the way
//! and make the convergence linear: the matrix (symmetric part of the geometric stiffness of contact), the rows (virtual gap and slip
//! for the derivatives of gap and slip), and the friction bound, which belongs to the pressures of the last iterate ([`Way`]).

mod acceleration;
mod answer;
mod bound;
mod certificate;
mod check;
mod companion;
mod conditions;
mod form;
pub mod programme;
mod stage;
mod step;
mod tally;
pub mod uniqueness;

pub use answer::{Answer, PairAnswer};
pub use certificate::{Certificate, certify};
pub use check::{Check, Claim, Difference, FORCE, STRESS, Verdict, check, from_start};
pub use companion::{Certified, Companion};
pub use conditions::Violation;
pub use stage::{Stage, Way};
pub use step::{Aim, GOAL, Solved, Unsolved, solve};
pub use tally::Tally;

use crate::contact::SiteLoad;
use crate::model::Model;

/// Stresses below this share of `E` are not told from zero.
const LEAST: f64 = 1e-6;

/// Largest difference of the pressures and of the tractions of the sites, of the peak pressure. Where segments moved so that the
/// sites are not the same ones the multipliers are compared.
fn differ(model: &Model, a: &[PairAnswer], b: &[PairAnswer]) -> [f64; 2] {
    let peak = a.iter().chain(b).flat_map(|pair| &pair.loads).map(|load| load.pressure);
    let peak = peak.fold(LEAST * model.modulus, f64::max);
    let largest = |a: &mut dyn Iterator<Item = f64>, b: &mut dyn Iterator<Item = f64>| {
        let worse = |m: f64, v: f64| if m.is_nan() || v.is_nan() { f64::NAN } else { m.max(v.abs() / peak) };
        a.zip(b).map(|(a, b)| a - b).fold(0.0, worse)
    };
    let mut worst = [0.0_f64; 2];
    for (a, b) in a.iter().zip(b) {
        let found = if a.loads.len() == b.loads.len() {
            let of = |kind: fn(&SiteLoad) -> f64| largest(&mut a.loads.iter().map(kind), &mut b.loads.iter().map(kind));
            [of(|load| load.pressure), of(|load| load.traction)]
        } else {
            let of = |a: &[f64], b: &[f64]| largest(&mut a.iter().copied(), &mut b.iter().copied());
            [of(&a.pressure, &b.pressure), of(&a.traction, &b.traction)]
        };
        (0..2).for_each(|c| worst[c] = if found[c].is_nan() { f64::NAN } else { worst[c].max(found[c]) });
    }
    worst
}
