//! Bodies: constitutive models and element assembly, total Lagrangian, plane strain, unit depth.

mod elements;
mod material;
mod stiffness;

pub use elements::{BulkForces, Elements};
pub use material::{LinearElastic, Material, NeoHookean, StressResponse, lame};
