//! Quadrature, sparse matrices and their factorisation.

mod checksum;
mod condensed;
mod dense;
mod quadrature;
mod solver;
mod sparse;
mod sparse_lu;

pub use checksum::checksum;
pub use condensed::{Condensed, CondensedSolver};
pub use dense::{DenseLu, DenseMatrix};
pub use quadrature::{GaussRule, gauss};
pub use solver::{Counters, LinearSolver, SolveError, SolverMemory};
pub use sparse::{Pattern, SparseMatrix, System, Triplets};
pub use sparse_lu::SparseLu;

/// Vector in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;

/// Euclidean norm.
pub fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Rotation by +90 degrees: `(x, y) -> (-y, x)`.
pub fn rot90(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}
