//! What a linear solver is, and the check that every solution passes.

use serde::{Deserialize, Serialize};

use super::System;
use super::condensed::Choice;

/// Why a linear system was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// No factorisation, or one with infinite or undefined entries.
    #[error("the tangent matrix is singular ({0})")]
    Singular(String),
    /// The solution does not satisfy the system.
    #[error("the linear solution is inaccurate: relative residual {0:.1e}")]
    Inaccurate(f64),
    /// The stiffness inside a body is not positive definite.
    #[error("the stiffness inside a body is not positive definite: it may have buckled")]
    Indefinite,
    /// Indices or memory do not suffice.
    #[error("the matrix cannot be analysed ({0})")]
    TooLarge(String),
}

/// What the solutions so far took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Symbolic analyses for the condensed solver: one per mesh, and one for each new choice of what is kept in the dense block.
    pub analyses: usize,
    /// Rows of the largest dense block that it factored.
    pub dense_rows: usize,
    /// Factorisations of the bulk stiffness, alone or as part of the whole matrix.
    pub factorisations: usize,
    /// Solutions by the sparse LU of the whole because the stiffness inside a body was not positive definite.
    pub indefinite: usize,
    /// As before, because the interface acts on unknowns inside a body.
    pub coupled: usize,
    /// As before, because the condensed solution was inaccurate.
    pub inaccurate: usize,
}

/// What a solver carries from one solution to the next, as far as later solutions or counters depend on it. A fresh solver that
/// recalls it goes on bit for bit like the one that gave it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SolverMemory {
    /// What it took so far.
    pub counters: Counters,
    /// Which unknowns are kept out of the interior; `None` before the first condensation. The order of elimination, and with it
    /// the round-off, follows from it.
    pub choice: Option<Choice>,
    /// Checksum of the stiffness that is factored: the same one is not factored, nor counted, again.
    pub stiffness: Option<u64>,
}

/// Solves Newton systems; keeps what can be reused from one to the next.
pub trait LinearSolver: Send {
    /// Solution of `system x = rhs`, finite and with its residual checked.
    ///
    /// # Errors
    /// A singular matrix or an inaccurate solution.
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// What it took so far.
    fn counters(&self) -> Counters;

    /// What it would need to go on elsewhere.
    fn memory(&self) -> SolverMemory;

    /// Goes on from what another solver of its kind remembered.
    fn recall(&mut self, memory: SolverMemory);

    /// Numeric factorisations so far.
    fn factorisations(&self) -> usize {
        self.counters().factorisations
    }
}

/// Largest accepted residual relative to `|A| |x| + |b|` (row-wise backward error).
const BACKWARD_ERROR: f64 = 1e-9;

/// Solves with `apply`, which replaces a right-hand side by a solution; checks that the answer is finite and its backward
/// error small, and refines once where it is not. (A factorisation of a singular matrix can come back without an error but
/// full of infinities.)
pub(super) fn checked(system: &System, rhs: &[f64], mut apply: impl FnMut(&mut [f64])) -> Result<Vec<f64>, SolveError> {
    let mut x = rhs.to_vec();
    apply(&mut x);
    let mut residual = vec![0.0; rhs.len()];
    let error = backward_error(system, &x, rhs, &mut residual)?;
    if error <= BACKWARD_ERROR {
        return Ok(x);
    }
    let mut correction = residual.clone();
    apply(&mut correction);
    x.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
    let error = backward_error(system, &x, rhs, &mut residual)?;
    if error <= BACKWARD_ERROR { Ok(x) } else { Err(SolveError::Inaccurate(error)) }
}

/// `max |r| / max(|A| |x| + |b|)` over all rows, with `r = b - A x` left in `residual`.
fn backward_error(system: &System, x: &[f64], rhs: &[f64], residual: &mut [f64]) -> Result<f64, SolveError> {
    if x.iter().any(|v| !v.is_finite()) {
        return Err(SolveError::Singular("the solution is not finite".into()));
    }
    residual.copy_from_slice(rhs);
    let mut scale: Vec<f64> = rhs.iter().map(|b| b.abs()).collect();
    system.for_each(|i, j, v| {
        let product = v * x[j];
        residual[i] -= product;
        scale[i] += product.abs();
    });
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    Ok(largest(residual) / largest(&scale).max(f64::MIN_POSITIVE))
}
