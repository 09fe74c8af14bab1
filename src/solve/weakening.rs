//! Friction that falls with the slip rate against the stiffness that resists it.
//!
//! Over a step `dt` a rate-weakening law adds the tangential stiffness `p mu'(v)/dt < 0`. Where it outweighs that of the bodies the
//! quasi-static problem has no stable solution nearby: the slip jumps, another solution may exist beside the one found, and a
//! smaller step makes it worse, not better. With `K` the tangent and `K_0` the tangent without the falling slopes,
//!
//! ```text
//! K = K_0 (1 - M) ,     M = K_0^-1 (K_0 - K)
//! ```
//!
//! so `K` becomes singular when the largest eigenvalue of `M` reaches 1. `M` is also what multiplies the error of an
//! iteration with lagged bound, which therefore finds stable solutions only.

use crate::math::{LinearSolver, System, norm};
use crate::model::{Evaluation, Model, State, Tangent, evaluate};

use super::floating::support_floating;

/// Largest number of iterations with the exact tangent, and with a lagged bound.
const MAX_EXACT: usize = 20;
const MAX_LAGGED: usize = 60;
/// Residual (of the largest nodal force) below which a lagged iteration turns to the exact tangent; lowered where that fails.
const NEAR: f64 = 1e-3;
/// Power iterations: the eigenvalue is wanted to a digit.
const POWERS: usize = 8;
/// Integral of the falling slope over the contact, in units of `E`, below which the eigenvalue is far from 1. (It is about seven
/// times this number on the two-asperity problem.)
const FAINT: f64 = 0.05;

/// Which tangent an attempt uses.
pub struct Linearisation {
    /// Of the next evaluation.
    pub tangent: Tangent,
    /// Residual below which it is exact.
    near: f64,
    last: f64,
}

impl Linearisation {
    /// Newton's method.
    pub fn exact() -> Self {
        Self { tangent: Tangent::Exact, near: f64::INFINITY, last: f64::INFINITY }
    }

    /// Bound lagged by one iteration, exact at the end.
    pub fn lagged() -> Self {
        Self { tangent: Tangent::Lagged, near: NEAR, last: f64::INFINITY }
    }

    /// True for [`Self::lagged`].
    pub fn lags(&self) -> bool {
        self.near.is_finite()
    }

    /// Number of iterations granted.
    pub fn most(&self) -> usize {
        if self.lags() { MAX_LAGGED } else { MAX_EXACT }
    }

    /// Chooses the tangent of the next iterate from the residual of this one.
    pub fn choose(&mut self, residual: f64) {
        if self.lags() && self.tangent == Tangent::Exact && residual > self.last {
            self.near *= 0.1;
        }
        self.tangent = if residual <= self.near { Tangent::Exact } else { Tangent::Lagged };
        self.last = residual;
    }
}

/// True where friction falls with the slip at some site.
pub fn weakens(evaluation: &Evaluation) -> bool {
    evaluation.interfaces.iter().flat_map(|i| &i.sites).any(|site| site.weakening > 0.0)
}

/// [`largest`] at a converged state, 0 where the falling slopes are too faint to matter.
pub fn share(model: &Model, start: &State, end: &State, found: &Evaluation, solver: &mut dyn LinearSolver) -> f64 {
    let sites = found.interfaces.iter().flat_map(|i| &i.sites);
    let slope: f64 = sites.map(|site| site.weakening * site.weight).sum();
    if slope <= FAINT * model.modulus { 0.0 } else { largest(model, start, end, solver).unwrap_or(f64::NAN) }
}

/// Largest eigenvalue of `M` at a trial state: the share of the tangential stiffness of the bodies that falling friction takes
/// away. `None` where the systems cannot be solved.
pub fn largest(model: &Model, start: &State, trial: &State, solver: &mut dyn LinearSolver) -> Option<f64> {
    let system = |tangent| {
        let mut found = evaluate(model, start, trial, tangent)?;
        let mut system = found.system.take()?;
        support_floating(model, &found, &mut system.interface);
        Some(system)
    };
    let (exact, lagged) = (system(Tangent::Exact)?, system(Tangent::Lagged)?);
    let mut mode: Vec<f64> = difference(&lagged, &exact, &vec![1.0; lagged.n]);
    let mut share = 0.0;
    for _ in 0..POWERS {
        let size = norm(&mode);
        if size == 0.0 {
            return Some(0.0);
        }
        mode.iter_mut().for_each(|v| *v /= size);
        let next = solver.solve(&lagged, &difference(&lagged, &exact, &mode)).ok()?;
        share = next.iter().zip(&mode).map(|(a, b)| a * b).sum();
        mode = next;
    }
    Some(share)
}

/// `(a - b) v` for systems that differ in the interface alone.
fn difference(a: &System, b: &System, v: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.n];
    let signed = [(&a.interface, 1.0), (&b.interface, -1.0)];
    for (entries, sign) in signed {
        entries.iter().for_each(|&(i, j, value)| product[i] += sign * value * v[j]);
    }
    product
}
