//! Why a march ended, in words: what failed and where, a physical limit, what was tried, what may be changed.

use crate::model::{Control, Model};

use super::failure::StepFailure;
use super::limits;
use super::log::{Rung, Tried};
use super::status::Outcome;

/// Inclination of the contact force, in degrees from the vertical, from which flanks and friction are taken to interlock.
const INTERLOCKED: f64 = 80.0;

/// The report of the last failure; `tried` are the rungs of the last attempt, those before are in the log.
pub fn words(model: &Model, outcome: &Outcome, tried: &[Tried], failure: &StepFailure) -> String {
    let limit = limits::reached(model, &outcome.state);
    let advice = advice(model, outcome, failure).join("; ");
    format!("{failure}{limit}; tried since the last step: {}; to change: {advice}", attempts(outcome, tried))
}

/// Every rung that was left since the last accepted step, with the number of attempts.
fn attempts(outcome: &Outcome, tried: &[Tried]) -> String {
    let time = outcome.state.time;
    let events = || outcome.log.events.iter().rev().take_while(|event| event.time == time);
    let before = || events().flat_map(|event| &event.tried);
    let count = |rung: Rung| before().chain(tried).filter(|t| t.rung == rung).map(|t| t.attempts).sum::<usize>();
    let cuts = events().filter(|event| event.reached == Some(Rung::Cut)).count();
    let counts = Rung::ALL.into_iter().map(|rung| (rung, if rung == Rung::Cut { cuts } else { count(rung) }));
    let said: Vec<String> = counts.filter(|(_, n)| *n > 0).map(|(rung, n)| format!("{} ({n})", rung.name())).collect();
    said.join(", ")
}

fn advice(model: &Model, outcome: &Outcome, failure: &StepFailure) -> Vec<String> {
    let mut advice = vec![];
    let mine = || model.motions.iter().zip(&outcome.state.ledger.forces).filter(|(m, _)| m.body == model.driven);
    let force = |c: usize| mine().filter(|(m, _)| m.component == c).map(|(_, f)| *f).sum::<f64>().abs();
    let angle = force(0).atan2(force(1)).to_degrees();
    if angle > INTERLOCKED {
        advice.push(format!(
            "flanks and friction interlock (the contact force is inclined by {angle:.0} degrees: flank angle and friction angle add up to \
             about 90): gentler flanks or less friction"
        ));
    }
    if mine().any(|(m, _)| matches!(m.control, Control::Force(_))) {
        advice.push(
            "drive by displacement instead of force, which has no equilibrium beyond the most the contact bears".into(),
        );
    }
    advice.push(match failure {
        StepFailure::Vetoed { .. } | StepFailure::Law(_) => "more time.steps, or other parameters of the law".into(),
        _ => "more time.steps or time.max_cuts, finer elements along the contact edges".into(),
    });
    advice
}
