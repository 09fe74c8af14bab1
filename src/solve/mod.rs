//! Solving: Newton for one step, and the march through time that cuts and regrows steps.

mod march;
mod newton;
mod predictor;
mod status;

pub use march::{Control, StepReport, march};
pub use newton::{NewtonReport, StepFailure, solve_step};
pub use predictor::predict;
pub use status::{Outcome, Status};
