//! How long a step may be.

use crate::model::{Control, Model, Motion, State};

/// A step that must be halved more often for its drive to be followed is a slip of the pen.
const MOST_HALVINGS: usize = 12;

/// The time up to which no driven edge, or body in flight, travels farther than [`Model::stride`], at most `wanted`; `None` where
/// one outruns that by more than [`MOST_HALVINGS`].
pub fn within_stride(model: &Model, state: &State, wanted: f64) -> Option<f64> {
    let (time, speed) = (state.time, state.rates.velocity.iter().fold(0.0_f64, |m, v| m.max(v.amax())));
    let travel = |until: f64| {
        let of = |motion: &Motion| match &motion.control {
            Control::Displacement(table) => (table.at(until) - table.at(time)).abs(),
            Control::Force(_) => 0.0,
        };
        model.motions.iter().map(of).fold(speed * (until - time), f64::max)
    };
    let mut halved = std::iter::successors(Some(wanted), |until| Some(time + 0.5 * (until - time)));
    halved.by_ref().take(MOST_HALVINGS).find(|until| travel(*until) <= model.stride)
}
