//! The laws that come with the program, one file each.

mod coulomb;
mod dahl;
mod frictionless;
mod rate_and_state;
mod regularised;
mod tresca;

pub use coulomb::Coulomb;
pub use dahl::Dahl;
pub use frictionless::Frictionless;
pub use rate_and_state::{Evolution, RateAndState};
pub use regularised::{Regularised, Shape};
pub use tresca::Tresca;
