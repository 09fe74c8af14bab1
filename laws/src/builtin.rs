//! The laws that come with the program, one file each.

mod bristle;
mod coulomb;
mod dahl;
mod elasto_plastic;
mod frictionless;
mod heated;
mod lugre;
mod ostermeyer;
mod rate_and_state;
mod regularised;
mod tresca;

pub use bristle::Damping;
pub use coulomb::Coulomb;
pub use dahl::Dahl;
pub use elasto_plastic::ElastoPlastic;
pub use frictionless::Frictionless;
pub use heated::{Fading, Heated};
pub use lugre::LuGre;
pub use ostermeyer::Ostermeyer;
pub use rate_and_state::{Evolution, RateAndState};
pub use regularised::{Regularised, Shape};
pub use tresca::Tresca;
