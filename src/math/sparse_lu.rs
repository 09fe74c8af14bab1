//! Sparse LU of the whole Newton matrix: the reference solver.

use std::sync::Arc;

use faer::linalg::solvers::SolveCore;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::{Conj, MatMut, Par};

use super::condensed::view;
use super::solver::{Counters, SolverMemory, checked};
use super::{LinearSolver, Pattern, SolveError, SparseMatrix, System};

/// faer's sparse LU (COLAMD order). The symbolic analysis is kept while the pattern stays the same.
#[derive(Default)]
pub struct SparseLu {
    symbolic: Option<(Arc<Pattern>, SymbolicLu<usize>)>,
    counters: Counters,
}

impl SparseLu {
    fn symbolic(&mut self, matrix: &SparseMatrix) -> Result<SymbolicLu<usize>, SolveError> {
        if let Some((pattern, symbolic)) = &self.symbolic
            && **pattern == *matrix.pattern
        {
            return Ok(symbolic.clone());
        }
        let symbolic =
            SymbolicLu::try_new(view(&matrix.pattern)).map_err(|e| SolveError::TooLarge(format!("{e:?}")))?;
        self.symbolic = Some((matrix.pattern.clone(), symbolic.clone()));
        Ok(symbolic)
    }
}

impl LinearSolver for SparseLu {
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        faer::set_global_parallelism(Par::Seq);
        let matrix = system.assemble();
        let symbolic = self.symbolic(&matrix)?;
        let faer_matrix = SparseColMatRef::new(view(&matrix.pattern), &matrix.values);
        let lu =
            Lu::try_new_with_symbolic(symbolic, faer_matrix).map_err(|e| SolveError::Singular(format!("{e:?}")))?;
        self.counters.factorisations += 1;
        checked(system, rhs, |x| {
            let n = x.len();
            lu.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(x, n, 1));
        })
    }

    fn counters(&self) -> Counters {
        self.counters
    }
    // the symbolic analysis follows from the pattern alone
    fn memory(&self) -> SolverMemory {
        SolverMemory { counters: self.counters, ..SolverMemory::default() }
    }

    fn recall(&mut self, memory: SolverMemory) {
        self.counters = memory.counters;
    }
}
