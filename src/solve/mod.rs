//! Solving: Newton for one step, and the march through time that cuts and regrows steps.

mod advance;
mod convergence;
mod crossing;
mod easing;
mod ending;
mod failure;
mod floating;
mod interface_loop;
mod ladder;
mod limits;
mod log;
mod march;
mod newton;
mod pace;
mod predictor;
mod release;
mod sets;
mod status;
pub mod weakening;
mod witness;

pub use failure::StepFailure;
pub use interface_loop::Strategy;
pub use ladder::solve_step;
pub use log::{Event, Log, Rung, Tried};
pub use march::{Control, StepReport, Tools, march, proceed};
pub use newton::NewtonReport;
pub use predictor::predict;
pub use status::{Outcome, Status};
pub use witness::{Effort, Witness};
