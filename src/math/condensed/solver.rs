//! Newton systems by condensation: the interior by Cholesky, contact unknowns and multipliers by dense LU.

use super::Condensed;
use crate::math::solver::{Counters, checked};
use crate::math::{DenseLu, DenseMatrix, LinearSolver, SolveError, SparseLu, System};

/// Solves `(K + C) x = b` with the bulk `K` condensed on the boundary of the [`System`] and a dense LU with partial pivoting of
/// `S + C` on boundary and multipliers. Springs of `C` on the diagonal of the interior join `K`. The sparse LU of the
/// whole takes over where the interior is not positive definite, where `C` reaches into it otherwise, and where the
/// answer is inaccurate; the counters tell how often.
#[derive(Default)]
pub struct CondensedSolver {
    condensed: Option<Condensed>,
    block: DenseMatrix,
    lu: DenseLu,
    springs: Vec<(usize, f64)>,
    /// Right-hand side of the dense block, then its solution.
    outer: Vec<f64>,
    reference: SparseLu,
    counters: Counters,
}

impl LinearSolver for CondensedSolver {
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        if !self.condensed.as_ref().is_some_and(|c| c.fits(&system.bulk.pattern, &system.boundary)) {
            self.condensed = Some(Condensed::new(system.bulk.pattern.clone(), system.boundary.clone())?);
        }
        if !self.split(system) {
            self.counters.coupled += 1;
            return self.reference.solve(system, rhs);
        }
        match self.condensed_solution(system, rhs) {
            Err(SolveError::Indefinite) => self.counters.indefinite += 1,
            Err(SolveError::Inaccurate(_)) => self.counters.inaccurate += 1,
            found => return found,
        }
        self.reference.solve(system, rhs)
    }

    fn counters(&self) -> Counters {
        let factorisations = self.counters.factorisations + self.reference.factorisations();
        Counters { factorisations, ..self.counters }
    }
}

impl CondensedSolver {
    /// Sets the springs aside; whether the rest of the interface stays out of the interior.
    fn split(&mut self, system: &System) -> bool {
        let condensed = self.condensed.as_ref().expect("analysed");
        let inside = |e: usize| e < system.bulk.pattern.n && condensed.slot(e).is_none();
        self.springs.clear();
        for &(i, j, v) in &system.interface {
            if inside(i) && i == j {
                self.springs.push((i, v));
            } else if inside(i) || inside(j) {
                return false;
            }
        }
        true
    }

    fn condensed_solution(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        let Self { condensed, block, lu, springs, outer, counters, .. } = self;
        let condensed = condensed.as_mut().expect("analysed");
        counters.factorisations += usize::from(condensed.factor(&system.bulk, springs)? > 0);
        let (inner, boundary) = (system.bulk.pattern.n, condensed.boundary().len());
        let order = boundary + system.n - inner;
        let row = |c: &Condensed, e: usize| if e < inner { c.slot(e) } else { Some(boundary + e - inner) };
        block.reset(order);
        condensed.add_condensed(block);
        for &(i, j, v) in &system.interface {
            if let (Some(i), Some(j)) = (row(condensed, i), row(condensed, j)) {
                block.add(i, j, v);
            }
        }
        lu.factor(block);
        outer.resize(order, 0.0);
        checked(system, rhs, |x| {
            let (bulk, multipliers) = x.split_at_mut(inner);
            condensed.reduce(bulk);
            outer.iter_mut().zip(condensed.boundary()).for_each(|(v, &e)| *v = bulk[e]);
            outer[boundary..].copy_from_slice(multipliers);
            lu.solve(outer);
            condensed.boundary().iter().zip(outer.iter()).for_each(|(&e, v)| bulk[e] = *v);
            multipliers.copy_from_slice(&outer[boundary..]);
            condensed.back_substitute(bulk);
        })
    }
}
