//! Solving: Newton for one step, and the march through time that cuts and regrows steps.

mod convergence;
mod crossing;
mod failure;
mod floating;
mod interface_loop;
mod limits;
mod march;
mod newton;
mod predictor;
mod recall;
mod status;
mod ways;
pub mod weakening;
mod witness;

pub use failure::StepFailure;
pub use interface_loop::Strategy;
pub use march::{Control, StepReport, Tools, march, proceed};
pub use newton::{NewtonReport, solve_step};
pub use predictor::predict;
pub use recall::{Recall, Seen};
pub use status::{Outcome, Status};
pub use ways::Ways;
pub use witness::{Effort, Witness};
