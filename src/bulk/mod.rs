//! Bodies: constitutive models and element assembly, total Lagrangian, plane strain, unit depth.

mod elements;
mod lumped;
mod material;
mod stiffness;

pub use elements::{BulkForces, Elements};
pub use lumped::lumped_areas;
pub use material::{LinearElastic, Material, NeoHookean, StressResponse, lame};
