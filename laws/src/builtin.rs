//! The laws that come with the program, one file each.

mod bengisu_akay;
mod cohesion_cap;
mod coulomb;
mod frictionless;
mod huemer;
mod logarithmic_rate;
mod persson;
mod power_rate;
mod pressure_power;
mod savkoor;
mod shaw;
mod stribeck;
mod thirion;
mod tresca;

pub use bengisu_akay::BengisuAkay;
pub use cohesion_cap::CohesionCap;
pub use coulomb::Coulomb;
pub use frictionless::Frictionless;
pub use huemer::Huemer;
pub use logarithmic_rate::LogarithmicRate;
pub use persson::Persson;
pub use power_rate::PowerRate;
pub use pressure_power::PressurePower;
pub use savkoor::Savkoor;
pub use shaw::{Shaw, Transition};
pub use stribeck::Stribeck;
pub use thirion::Thirion;
pub use tresca::Tresca;
