//! Bodies: constitutive models and element assembly, total Lagrangian, plane strain, unit depth.

mod elements;
mod lumped;
mod mass;
mod material;
mod projected;
mod recovery;
mod saint_venant;
mod stiffness;
mod volume;

pub use elements::{BulkForces, Elements};
pub use lumped::lumped_areas;
pub use mass::masses;
pub use material::{Dilatation, LinearElastic, Material, NeoHookean, StressResponse, lame};
pub use projected::Tau;
pub use recovery::{Recovery, StressError};
pub use saint_venant::SaintVenantKirchhoff;
pub use volume::{VolumeSpace, confinement};
