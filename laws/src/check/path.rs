//! Properties of a law along a path.

use super::{
    ensure,
    probe::{Sample, Step, ask, initial, walk},
};
use crate::{FrictionLaw, Response};

const ROUND_OFF: f64 = 1e-9;

pub(super) fn mirror(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let flip = |step: &Step| Step { slip: -step.slip, ..*step };
    let mirrored = Sample { history: sample.history.iter().map(flip).collect(), last: flip(&sample.last), ..*sample };
    let end = |sample: &Sample| ask(law, &sample.at(sample.last), &walk(law, sample)).response;
    let (right, left) = (end(sample), end(&mirrored));
    let (a, b) = (right.value().re, left.value().re);
    match right {
        Response::Threshold(_) => ensure(same(a, b, a.abs()), || format!("bound {a} to one side, {b} to the other")),
        Response::Traction(_) => ensure(same(a, -b, a.abs()), || format!("traction {a} to one side, {b} to the other")),
    }
}

pub(super) fn dissipation(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let (mut old, mut work, mut turnover) = (initial(law), 0.0, 0.0);
    for step in sample.history.iter().chain([&sample.last]) {
        let answer = ask(law, &sample.at(Step { pressure: sample.last.pressure, ..*step }), &old);
        let Response::Traction(traction) = answer.response else { return Ok(()) };
        work += traction.re * step.slip;
        turnover += (traction.re * step.slip).abs();
        ensure(work >= -ROUND_OFF * turnover, || {
            format!("net work {work} of a turnover of {turnover}: energy from nothing")
        })?;
        old = answer.values();
    }
    Ok(())
}

pub(super) fn refinement(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let start = walk(law, sample);
    let ends: Vec<_> = (6..11).map(|k| end(law, sample, &start, 1 << k)).collect();
    let change = |k: usize| (ends[k + 1] - ends[k]).abs();
    let scale = ends.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let converges = change(3) <= 0.6 * change(2) || change(3) <= 1e-8 * scale;
    ensure(converges, || format!("response after the same path in 64, 128, .. 1024 steps: {ends:?}"))
}

/// Response at the end of the last step, taken in `count` equal ones.
fn end(law: &dyn FrictionLaw, sample: &Sample, start: &[f64], count: u32) -> f64 {
    let Step { pressure, slip, dt } = sample.last;
    let at = sample.at(Step { pressure, slip: slip / f64::from(count), dt: dt / f64::from(count) });
    let (mut old, mut response) = (start.to_vec(), 0.0);
    for _ in 0..count {
        let answer = ask(law, &at, &old);
        (old, response) = (answer.values(), answer.response.value().re);
    }
    response
}

pub(super) fn same(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= ROUND_OFF * scale
}
