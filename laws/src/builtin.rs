//! The laws that come with the program, one file each.

mod bengisu_akay;
mod cohesion_cap;
mod coulomb;
mod frictionless;
mod shaw;
mod stribeck;
mod tresca;

pub use bengisu_akay::BengisuAkay;
pub use cohesion_cap::CohesionCap;
pub use coulomb::Coulomb;
pub use frictionless::Frictionless;
pub use shaw::{Shaw, Transition};
pub use stribeck::Stribeck;
pub use tresca::Tresca;
