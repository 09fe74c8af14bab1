//! Drives a law at one contact point, without finite elements, so that it is understood before it meets a mesh.
//!
//! | driver | given | found |
//! |---|---|---|
//! | [`follow()`] | pressure and slip of every step | traction, states, work |
//! | [`Slider`] | a spring that is pulled, with or without a mass | slip as well: stick-slip, creep, stability |
//!
//! ```
//! use asperity_laws::{builtin::Coulomb, drive::{Step, follow}};
//! let there_and_back = [Step { dt: 1.0, pressure: 2.0, slip: 0.1 }, Step { dt: 1.0, pressure: 2.0, slip: -0.1 }];
//! let history = follow(&Coulomb { friction: 0.3 }, None, &there_and_back);
//! assert_eq!(history.records[2].traction, -0.6);
//! ```
//!
//! A set-valued law slips with `q = b sign(s)` and sticks with any `|q| <= b`; a direct law answers `q`. Both drivers cut a step for
//! which a law has no answer and keep to [`FrictionLaw::suggested_step`]. Pure functions; quantities are per unit of area.

mod history;
mod root;
mod slider;

pub use history::{Failure, History, Record};
pub use slider::Slider;

use crate::{Dual, FrictionLaw, InterfacePoint, Response, dual};
use history::Reached;

/// One step of a prescribed path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Length of the step, `> 0` (time).
    pub dt: f64,
    /// Pressure at the end of the step, `>= 0` (stress).
    pub pressure: f64,
    /// Slip of the step, signed (length).
    pub slip: f64,
}

/// Drives a law along a path; `states` are the internal variables at the start, by default the law's own.
///
/// The first record is the start: at rest under the pressure of the first step, without traction. Pressure and slip run linearly
/// within a step. A set-valued law at rest (`s = 0`) keeps its traction as far as the bound allows.
pub fn follow(law: &dyn FrictionLaw, states: Option<&[f64]>, path: &[Step]) -> History {
    let pressure = path.first().map_or(0.0, |step| step.pressure);
    let mut history = History::from(Record::start(law, states, pressure));
    for step in path {
        let begin = history.last().clone();
        let end = begin.time + step.dt;
        let attempt = |from: &Record, dt: f64| {
            let share = (from.time + dt - begin.time) / step.dt;
            let pressure = begin.pressure + share * (step.pressure - begin.pressure);
            prescribed(law, from, Step { dt, pressure, slip: step.slip * dt / step.dt })
        };
        if !history.reach(end, attempt) {
            break;
        }
    }
    history
}

fn prescribed(law: &dyn FrictionLaw, from: &Record, step: Step) -> Result<Reached, String> {
    let at = point(step.pressure, step.slip, step.dt, from.slip);
    let answer = ask(law, &at, &from.states)?;
    let (traction, slipping) = match answer.response {
        Response::Threshold(bound) if step.slip == 0.0 => (from.traction.clamp(-bound.re, bound.re), false),
        Response::Threshold(bound) => (bound.re.copysign(step.slip), true),
        Response::Traction(traction) => (traction.re, step.slip != 0.0),
    };
    let record = Record {
        time: from.time + step.dt,
        slip: from.slip + step.slip,
        velocity: step.slip / step.dt,
        pressure: step.pressure,
        traction,
        force: traction,
        work: from.work + traction * step.slip,
        slipping,
        states: answer.states,
    };
    Ok(Reached { record, dt: step.dt, largest: law.suggested_step(&at, &from.states) })
}

/// Answer of a law with the values of its states.
struct Answer {
    response: Response,
    states: Vec<f64>,
}

/// The point of a step that begins at the slip `start`; it stands at the distance slipped.
fn point(pressure: f64, slip: f64, dt: f64, start: f64) -> InterfacePoint {
    InterfacePoint { position: [start + slip, 0.0], ..InterfacePoint::new(pressure, slip, dt) }
}

fn ask(law: &dyn FrictionLaw, at: &InterfacePoint, old: &[f64]) -> Result<Answer, String> {
    let mut new: Vec<Dual> = vec![dual::constant(f64::NAN); old.len()];
    let response = law.response(at, old, &mut new);
    let states: Vec<f64> = new.iter().map(|state| state.re).collect();
    if response.value().re.is_finite() && states.iter().all(|state| state.is_finite()) {
        return Ok(Answer { response, states });
    }
    let (pressure, slip, dt) = (at.pressure.re, at.slip.re, at.dt);
    Err(format!("the law has no answer at pressure {pressure:e}, slip {slip:e} in a step of {dt:e}, states {old:?}"))
}
