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

mod answer;
mod bound;
mod certificate;
mod check;
mod conditions;
pub mod programme;
mod stage;
mod step;
pub mod uniqueness;

pub use answer::{Answer, PairAnswer};
pub use certificate::{Certificate, certify};
pub use check::{Check, Claim, Difference, FORCE, STRESS, Verdict, check};
pub use conditions::Violation;
pub use stage::Way;
pub use step::{Solved, Unsolved, solve};

use crate::model::Model;

/// Stresses below this share of `E` are not told from zero.
const LEAST: f64 = 1e-6;

/// Largest difference of the pressures and of the tractions of the sites, of the peak pressure; `NaN` where the sites are not the
/// same ones.
fn differ(model: &Model, a: &[PairAnswer], b: &[PairAnswer]) -> [f64; 2] {
    let sites = |pairs: &[PairAnswer]| pairs.iter().map(|pair| pair.loads.len()).collect::<Vec<_>>();
    if sites(a) != sites(b) {
        return [f64::NAN; 2];
    }
    let loads = || a.iter().flat_map(|pair| &pair.loads).zip(b.iter().flat_map(|pair| &pair.loads));
    let peak = loads().fold(LEAST * model.modulus, |m, (a, b)| m.max(a.pressure).max(b.pressure));
    loads().fold([0.0; 2], |[p, q], (a, b)| {
        let worse = |m: f64, v: f64| if v.is_nan() { v } else { m.max(v.abs() / peak) };
        [worse(p, a.pressure - b.pressure), worse(q, a.traction - b.traction)]
    })
}
