//! Geometry in the reference configuration: bases, curves, patches and the shapes a scene can name.
//!
//! A body is one tensor-product [`Patch`] over two univariate bases (trait [`Basis`]: NURBS or Lagrange); its four
//! edges are [`Curve`]s with an outward side. Everything is plain `f64` and immutable after construction; the deformed
//! configuration is obtained by evaluating the same shape functions with moved control points.
//!
//! Parameters: `u` runs along x (from left to right), `v` upwards, so a patch with positive Jacobian is oriented
//! counter-clockwise. Control point `(i, j)` has index `i + j * nu`.

pub mod basis;
pub mod bspline;
pub mod curve;
pub mod error;
pub mod lagrange;
pub mod patch;
pub mod refine;
pub mod shapes;

pub use basis::{Basis, MAX_DEGREE, Shape, rational};
pub use bspline::BSpline;
pub use curve::Curve;
pub use error::GeometryError;
pub use lagrange::Lagrange;
pub use patch::{Edge, Patch, PatchShape};
pub use shapes::{BasisSpec, Grading, Profile, ShapeSpec, build, build_edge};

/// A point or vector of the plane, in the length unit of the scene.
pub type Point = nalgebra::Vector2<f64>;
