//! Quadrature, sparse matrices and their factorisation.

mod quadrature;
mod solver;
mod sparse;

pub use quadrature::{GaussRule, gauss};
pub use solver::{LinearSolver, SolveError, SparseLu};
pub use sparse::{Pattern, SparseMatrix, System, Triplets};

/// Vector in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;

/// Rotation by +90 degrees: `(x, y) -> (-y, x)`.
pub fn rot90(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}
