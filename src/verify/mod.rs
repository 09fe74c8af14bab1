//! Independent checks: of mesh and time plan before a run, of records once they are there.

mod audit;
pub mod conic;
mod criteria;
mod expectations;
mod finding;
mod guard;

pub use audit::Audit;
pub use expectations::Expectations;
pub use finding::{Finding, Severity};
pub use guard::warnings;
