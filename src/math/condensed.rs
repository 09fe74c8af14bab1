//! The stiffness of the bodies condensed on the unknowns that can come into contact.

mod analysis;
mod extent;
mod idle;
mod part;
mod solver;

use std::sync::Arc;

use super::{DenseMatrix, Pattern, SolveError, SparseMatrix, checksum};
use part::Part;

pub(super) use analysis::view;
pub use extent::Choice;
pub use solver::CondensedSolver;

/// Static condensation of a symmetric bulk stiffness `K` on its boundary unknowns B, the interior I eliminated by sparse
/// Cholesky:
///
/// ```text
/// [K_II K_IB] [x_I]   [f_I]         S x_B = g,   S = K_BB - K_BI K_II^-1 K_IB,   g = f_B - K_BI K_II^-1 f_I
/// [K_BI K_BB] [x_B] = [f_B]   <=>   K_II x_I = f_I - K_IB x_B
/// ```
///
/// Interface stiffness `C` that acts on B and on further unknowns (multipliers) is added to `S`, not to `K`: while `K` stays,
/// any number of systems `(S + C) x_B = g + ...` costs the dense block only. The steps are
///
/// 1. [`factor`](Self::factor) once per bulk stiffness,
/// 2. [`add_condensed`](Self::add_condensed) into the leading rows of a dense matrix, and `C` with it,
/// 3. [`reduce`](Self::reduce) the right-hand side, once per right-hand side of the bulk,
/// 4. solve for `x_B`, [`back_substitute`](Self::back_substitute).
///
/// Parts of the bulk that do not touch one another (the bodies) are factored each by itself, and not at all while their
/// values stay bit for bit the same: a body of linear material is condensed once per analysis.
pub struct Condensed {
    boundary: Arc<[usize]>,
    parts: Vec<Part>,
    /// For each part, where its boundary unknowns stand in `boundary`.
    slots: Vec<Vec<usize>>,
    /// Part of each unknown and its place there.
    homes: Vec<(usize, usize)>,
    /// Row of `S` of each unknown.
    rows: Vec<Option<usize>>,
}

impl Condensed {
    /// Analyses a pattern (symmetric, with its diagonal) for the given boundary: distinct unknowns, in any order.
    ///
    /// # Errors
    /// [`SolveError::TooLarge`].
    pub fn new(pattern: Arc<Pattern>, boundary: Arc<[usize]>) -> Result<Self, SolveError> {
        let mut rows = vec![None; pattern.n];
        boundary.iter().enumerate().for_each(|(row, &e)| rows[e] = Some(row));
        let (mut parts, mut slots, mut homes) = (Vec::new(), Vec::new(), vec![(0, 0); pattern.n]);
        for mut unknowns in components(&pattern) {
            unknowns.sort_unstable_by_key(|&e| (rows[e], e));
            let interior = unknowns.partition_point(|&e| rows[e].is_none());
            let part = Part::new(&pattern, unknowns, interior)?;
            part.unknowns().iter().enumerate().for_each(|(k, &e)| homes[e] = (parts.len(), k));
            slots.push(part.boundary().iter().filter_map(|&e| rows[e]).collect());
            parts.push(part);
        }
        Ok(Self { boundary, parts, slots, homes, rows })
    }

    /// Operations of a factorisation of the interior (sum of the squares of the column lengths).
    pub fn operations(&self) -> f64 {
        self.parts.iter().map(Part::operations).sum()
    }

    /// Unknown of the bulk behind each row of `S`.
    pub fn boundary(&self) -> &[usize] {
        &self.boundary
    }

    /// Row of `S` that belongs to an unknown of the bulk; `None` at the interior.
    pub fn slot(&self, unknown: usize) -> Option<usize> {
        self.rows[unknown]
    }

    /// Condenses `bulk` plus springs `(unknown, stiffness)` on its diagonal; number of parts that had to be factored. Only the
    /// lower half of the values is read.
    ///
    /// # Errors
    /// [`SolveError::Indefinite`] where `K_II` is not positive definite.
    pub fn factor(&mut self, bulk: &SparseMatrix, springs: &[(usize, f64)]) -> Result<usize, SolveError> {
        let mut factored = 0;
        for (k, part) in self.parts.iter_mut().enumerate() {
            let own = springs.iter().filter(|(e, _)| self.homes[*e].0 == k).map(|&(e, v)| (self.homes[e].1, v));
            factored += usize::from(part.factor(&bulk.values, own)?);
        }
        Ok(factored)
    }

    /// Checksum of the values that are factored; `None` where some part is not.
    pub fn checksum(&self) -> Option<u64> {
        self.parts.iter().map(Part::checksum).collect::<Option<Vec<_>>>().map(checksum)
    }

    /// Adds `S` to the leading rows and columns of `target`, in the order of [`Self::boundary`].
    pub fn add_condensed(&self, target: &mut DenseMatrix) {
        for (part, slots) in self.parts.iter().zip(&self.slots) {
            part.add_condensed(slots, target);
        }
    }

    /// Replaces a right-hand side of the bulk, in the order of its unknowns: `g` at the boundary, what
    /// [`Self::back_substitute`] needs at the interior.
    pub fn reduce(&mut self, f: &mut [f64]) {
        self.parts.iter_mut().for_each(|part| part.reduce(f));
    }

    /// Completes a solution: on entry `x_B` at the boundary and what [`Self::reduce`] left at the interior, on exit `x`.
    pub fn back_substitute(&mut self, x: &mut [f64]) {
        self.parts.iter_mut().for_each(|part| part.back_substitute(x));
    }
}

/// Unknowns that are coupled, directly or through others.
fn components(pattern: &Pattern) -> Vec<Vec<usize>> {
    let (mut seen, mut found) = (vec![false; pattern.n], Vec::new());
    for first in 0..pattern.n {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let mut component = vec![first];
        let mut next = 0;
        while let Some(&e) = component.get(next) {
            for &neighbour in &pattern.rows[pattern.columns[e]..pattern.columns[e + 1]] {
                if !std::mem::replace(&mut seen[neighbour], true) {
                    component.push(neighbour);
                }
            }
            next += 1;
        }
        found.push(component);
    }
    found
}
