//! Newton systems by condensation: the interior by Cholesky, contact unknowns and multipliers by dense LU.

use super::Condensed;
use super::extent::Extent;
use super::idle::Idle;
use crate::math::solver::{Counters, SolverMemory, checked};
use crate::math::{DenseLu, DenseMatrix, LinearSolver, SolveError, SparseLu, System};

/// Solves `(K + C) x = b` with the bulk `K` condensed on the boundary of the [`System`], or where that is large on the part of
/// it that is in contact, and a dense LU with partial pivoting of `S + C` on boundary and multipliers. Multipliers that carry
/// nothing are eliminated before. Springs of `C` on the diagonal of the interior join `K`. The sparse LU of the whole takes
/// over where the interior is not positive definite, where `C` reaches into it otherwise, and where the answer is
/// inaccurate; the counters tell how often.
#[derive(Default)]
pub struct CondensedSolver {
    analysed: Option<(Extent, Condensed)>,
    idle: Idle,
    block: DenseMatrix,
    lu: DenseLu,
    springs: Vec<(usize, f64)>,
    /// Right-hand side of the dense block, then its solution.
    outer: Vec<f64>,
    reference: SparseLu,
    counters: Counters,
    /// Memory of another solver until it is used.
    recalled: SolverMemory,
}

impl LinearSolver for CondensedSolver {
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        self.analyse(system)?;
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

    fn memory(&self) -> SolverMemory {
        let SolverMemory { choice, stiffness, .. } = self.recalled.clone();
        let (choice, stiffness) = match &self.analysed {
            Some((extent, condensed)) => (Some(extent.choice().clone()), condensed.checksum()),
            None => (choice, stiffness),
        };
        SolverMemory { counters: self.counters(), choice, stiffness }
    }

    fn recall(&mut self, memory: SolverMemory) {
        *self = Self { counters: memory.counters, recalled: memory, ..Self::default() };
    }
}

impl CondensedSolver {
    /// Makes sure of an analysis whose boundary covers the contact.
    fn analyse(&mut self, system: &System) -> Result<(), SolveError> {
        self.idle.eliminate(system);
        let pattern = &system.bulk.pattern;
        if let Some(extent) = self.recalled.choice.take().and_then(|choice| Extent::recall(system, choice)) {
            let condensed = Condensed::new(pattern.clone(), extent.boundary())?;
            self.analysed = Some((extent, condensed));
        }
        if !self.analysed.as_ref().is_some_and(|(extent, _)| extent.fits(system)) {
            let condensed = Condensed::new(pattern.clone(), system.boundary.clone())?;
            self.analysed = Some((Extent::new(system, condensed.operations()), condensed));
            self.counters.analyses += 1;
        }
        let (extent, condensed) = self.analysed.as_mut().expect("analysed");
        if let Some(boundary) = extent.revise(system, self.idle.left().len(), condensed.operations()) {
            *condensed = Condensed::new(pattern.clone(), boundary)?;
            self.counters.analyses += 1;
        }
        Ok(())
    }

    /// Sets the springs aside; whether the rest of the interface stays out of the interior.
    fn split(&mut self, system: &System) -> bool {
        let (_, condensed) = self.analysed.as_ref().expect("analysed");
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
        let Self { analysed, idle, block, lu, springs, outer, counters, recalled, .. } = self;
        let (_, condensed) = analysed.as_mut().expect("analysed");
        let before = recalled.stiffness.take();
        let factored = condensed.factor(&system.bulk, springs)? > 0;
        let again = before.is_some() && condensed.checksum() == before;
        counters.factorisations += usize::from(factored && !again);
        let (inner, boundary) = (system.bulk.pattern.n, condensed.boundary().len());
        let order = boundary + idle.left().len();
        let row = |e: usize| if e < inner { condensed.slot(e) } else { idle.place(e).map(|k| boundary + k) };
        counters.dense_rows = counters.dense_rows.max(order);
        block.reset(order);
        condensed.add_condensed(block);
        idle.add_left(boundary, block);
        for &(i, j, v) in system.interface.iter().filter(|(i, j, _)| *i.min(j) < inner) {
            if let (Some(i), Some(j)) = (row(i), row(j)) {
                block.add(i, j, v);
            }
        }
        lu.factor(block);
        outer.resize(order, 0.0);
        checked(system, rhs, |x| {
            let (bulk, multipliers) = x.split_at_mut(inner);
            condensed.reduce(bulk);
            idle.reduce(multipliers);
            let at_boundary = condensed.boundary().iter().map(|&e| bulk[e]);
            let values = at_boundary.chain(idle.left().iter().map(|&k| multipliers[k]));
            outer.iter_mut().zip(values).for_each(|(v, x)| *v = x);
            lu.solve(outer);
            condensed.boundary().iter().zip(outer.iter()).for_each(|(&e, v)| bulk[e] = *v);
            idle.left().iter().zip(&outer[boundary..]).for_each(|(&k, v)| multipliers[k] = *v);
            condensed.back_substitute(bulk);
            idle.back_substitute(multipliers);
        })
    }
}
