//! Dense square matrices and their LU factorisation, with memory that is kept.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::lu::partial_pivoting::solve::{solve_in_place, solve_in_place_scratch};
use faer::perm::PermRef;
use faer::{MatMut, MatRef, Par};

/// A square matrix, column by column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DenseMatrix {
    n: usize,
    values: Vec<f64>,
}

impl DenseMatrix {
    /// Becomes the zero matrix with `n` rows.
    pub fn reset(&mut self, n: usize) {
        self.n = n;
        self.values.clear();
        self.values.resize(n * n, 0.0);
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.n
    }

    /// Adds to entry `(i, j)`.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        self.values[j * self.n + i] += value;
    }

    /// Entry `(i, j)`.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.values[j * self.n + i]
    }
}

/// `P A = L U` with partial pivoting.
pub struct DenseLu {
    n: usize,
    values: Vec<f64>,
    rows: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
}

impl Default for DenseLu {
    fn default() -> Self {
        let memory = MemBuffer::new(StackReq::EMPTY);
        Self { n: 0, values: Vec::new(), rows: Vec::new(), inverse: Vec::new(), memory }
    }
}

impl DenseLu {
    /// Factors a matrix. A singular one shows in the solutions, which are not finite.
    pub fn factor(&mut self, matrix: &DenseMatrix) {
        self.resize(matrix.n);
        self.values.copy_from_slice(&matrix.values);
        if self.n == 0 {
            return;
        }
        let lu = MatMut::from_column_major_slice_mut(&mut self.values, self.n, self.n);
        let memory = MemStack::new(&mut self.memory);
        lu_in_place(lu, &mut self.rows, &mut self.inverse, Par::Seq, memory, Default::default());
    }

    fn resize(&mut self, n: usize) {
        if self.n != n {
            let factor = lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
            let solve = solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
            self.memory = MemBuffer::new(factor.or(solve));
            self.values.resize(n * n, 0.0);
            self.rows.resize(n, 0);
            self.inverse.resize(n, 0);
            self.n = n;
        }
    }

    /// Replaces a right-hand side by the solution.
    pub fn solve(&mut self, x: &mut [f64]) {
        if self.n == 0 {
            return;
        }
        let lu = MatRef::from_column_major_slice(&self.values, self.n, self.n);
        let rows = PermRef::new_checked(&self.rows, &self.inverse, self.n);
        let x = MatMut::from_column_major_slice_mut(x, self.n, 1);
        solve_in_place(lu, lu, rows, x, Par::Seq, MemStack::new(&mut self.memory));
    }
}
