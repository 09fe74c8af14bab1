//! The laws that come with the program, one file each.

mod coulomb;
mod expression;
mod frictionless;
mod tresca;

pub use coulomb::Coulomb;
pub use expression::Expression;
pub use frictionless::Frictionless;
pub use tresca::Tresca;
