//! Bodies: constitutive models and element assembly, total Lagrangian, plane strain, unit depth.

mod elements;
mod lumped;
mod material;
mod projected;
mod recovery;
mod stiffness;
mod volume;

pub use elements::{BulkForces, Elements};
pub use lumped::lumped_areas;
pub use material::{Dilatation, LinearElastic, Material, NeoHookean, StressResponse, lame};
pub use projected::Tau;
pub use recovery::{Recovery, StressError};
pub use volume::{VolumeSpace, confinement};
