//! Across a snap.
//!
//! Soft, steep asperities lose their equilibrium path near or behind the apex: at a limit point of the drive the tangent
//! becomes singular, and the next equilibrium is a finite way off (theory 6.10). No cut of the step helps. In nature the bodies would
//! jump there, and inertia and damping take the energy set free. Here a drag (see [`Drag`]) leads them the same way without
//! inertia: small steps, each with
//!
//! ```text
//! R(u) + kappa E A/h^2 (u - u_before) = 0 ,
//! ```
//!
//! are backward Euler steps of a viscous motion down the energy, `1/kappa` being their length. The drag falls
//! from one to the next, and grows where Newton's method fails, until it is as small as a residual may be: then the state
//! is an equilibrium again. Each of these steps is committed, so slip and internal variables go along the path. What the jump sets free
//! is `external work - stored - dissipated` over the crossing.

use crate::model::{Drag, Model, State};

use super::convergence::tolerance;
use super::failure::StepFailure;
use super::newton::NewtonReport;

/// Steps in which a crossing must come to rest. The first takes half of the step that failed, so that the drive is beyond the end
/// of the path, the others share the rest.
const STEPS: usize = 256;
/// Factor by which the drag falls or grows at most from one step to the next, and by which it grows where one fails.
const FADE: f64 = 4.0;
/// Iterations of a step after which the drag stays; it is halved for each one less and doubled for each one more.
const EASY: i32 = 4;
/// Drag at which a crossing is given up: a body that does not move is no way out either.
const STRONGEST: f64 = 1e6;

/// Moves on from `start` under drag until the bodies are at rest, at the latest at time `until`; steps are solved by
/// `solve(start, time, strength of the drag)`.
///
/// # Errors
/// The last failure of a step, or that the bodies do not come to rest.
pub fn cross(
    model: &Model,
    drag: &Drag,
    start: &State,
    until: f64,
    mut solve: impl FnMut(&State, f64, f64) -> Result<NewtonReport, StepFailure>,
) -> Result<NewtonReport, StepFailure> {
    let half = 0.5 * (until - start.time);
    let mut strength = 1.0;
    let mut state = State { trend: None, ..start.clone() };
    let mut done = 0;
    while done < STEPS {
        match solve(&state, start.time + half * (1.0 + done as f64 / STEPS as f64), strength) {
            Ok(mut found) => {
                let force = drag.largest(strength, model, &state, &found.state);
                found.state.trend = None;
                if force <= tolerance(model, &found.evaluation) {
                    return Ok(found);
                }
                state = found.state;
                strength *= 2.0_f64.powi(found.iterations as i32 - EASY).clamp(1.0 / FADE, FADE);
                done += 1;
            }
            Err(StepFailure::Interrupted) => return Err(StepFailure::Interrupted),
            Err(failure) if strength * FADE > STRONGEST => return Err(failure),
            Err(_) => strength *= FADE,
        }
    }
    Err(StepFailure::Restless)
}
