//! The laws that come with the program, one file each.

mod coulomb;
mod frictionless;
mod rate_and_state;
mod tresca;

pub use coulomb::Coulomb;
pub use frictionless::Frictionless;
pub use rate_and_state::{Evolution, RateAndState};
pub use tresca::Tresca;
