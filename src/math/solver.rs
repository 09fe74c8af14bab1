//! Sparse direct solution of the Newton system, checked after every solve.

use std::sync::Arc;

use faer::Par;
use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

use super::{Pattern, SparseMatrix, System};

/// Why a linear system was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// No factorisation, or one with infinite or undefined entries.
    #[error("the tangent matrix is singular ({0})")]
    Singular(String),
    /// The solution does not satisfy the system.
    #[error("the linear solution is inaccurate: relative residual {0:.1e}")]
    Inaccurate(f64),
}

/// Solves Newton systems; keeps what can be reused from one to the next.
pub trait LinearSolver: Send {
    /// Solution of `system x = rhs`, finite and with its residual checked.
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError>;
    /// Numeric factorisations so far.
    fn factorisations(&self) -> usize;
}

/// Largest accepted residual relative to `|A| |x| + |b|` (row-wise backward error).
const BACKWARD_ERROR: f64 = 1e-9;

/// faer's sparse LU (COLAMD order). The symbolic analysis is kept while the pattern stays the same.
#[derive(Default)]
pub struct SparseLu {
    symbolic: Option<(Arc<Pattern>, SymbolicLu<usize>)>,
    factorisations: usize,
}

impl SparseLu {
    fn symbolic(&mut self, matrix: &SparseMatrix) -> Result<SymbolicLu<usize>, SolveError> {
        if let Some((pattern, symbolic)) = &self.symbolic
            && **pattern == *matrix.pattern
        {
            return Ok(symbolic.clone());
        }
        let symbolic =
            SymbolicLu::try_new(view(&matrix.pattern)).map_err(|e| SolveError::Singular(format!("{e:?}")))?;
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
        self.factorisations += 1;
        let apply = |b: &[f64]| -> Vec<f64> {
            let column = faer::ColRef::from_slice(b);
            lu.solve(column).iter().copied().collect()
        };
        checked(&matrix, rhs, apply)
    }

    fn factorisations(&self) -> usize {
        self.factorisations
    }
}

fn view(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    SymbolicSparseColMatRef::new_checked(pattern.n, pattern.n, &pattern.columns, None, &pattern.rows)
}

/// Solves, checks that the answer is finite and its backward error small, and refines once where it is not.
/// (A factorisation of a singular matrix can come back without an error but full of infinities.)
fn checked(matrix: &SparseMatrix, rhs: &[f64], apply: impl Fn(&[f64]) -> Vec<f64>) -> Result<Vec<f64>, SolveError> {
    let mut x = apply(rhs);
    for attempt in 0..2 {
        if x.iter().any(|v| !v.is_finite()) {
            return Err(SolveError::Singular("the solution is not finite".into()));
        }
        let ax = matrix.times(&x);
        let residual: Vec<f64> = rhs.iter().zip(&ax).map(|(b, a)| b - a).collect();
        let error = backward_error(matrix, &x, rhs, &residual);
        if error <= BACKWARD_ERROR {
            return Ok(x);
        }
        if attempt == 1 {
            return Err(SolveError::Inaccurate(error));
        }
        let correction = apply(&residual);
        x.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
    }
    unreachable!("the second attempt returns")
}

/// `max |r| / max(|A| |x| + |b|)`, norms over all rows.
fn backward_error(matrix: &SparseMatrix, x: &[f64], rhs: &[f64], residual: &[f64]) -> f64 {
    let mut scale: Vec<f64> = rhs.iter().map(|b| b.abs()).collect();
    let pattern = &matrix.pattern;
    for (range, xj) in pattern.columns.windows(2).zip(x) {
        for k in range[0]..range[1] {
            scale[pattern.rows[k]] += (matrix.values[k] * xj).abs();
        }
    }
    let largest = scale.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(*v));
    residual.iter().fold(0.0_f64, |m, r| m.max(r.abs())) / largest
}
