//! Independent checks: of mesh and time plan before a run, of records once they are there.

mod accuracy;
mod audit;
pub mod conic;
mod criteria;
mod estimate;
mod expectations;
mod finding;
mod guard;

pub use accuracy::{Estimate, Quantity};
pub use audit::Audit;
pub use estimate::Estimator;
pub use expectations::Expectations;
pub use finding::{Finding, Severity};
pub use guard::warnings;
