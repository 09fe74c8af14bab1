//! Properties of a law at one point and step.

use super::{
    ensure,
    probe::{Answer, Sample, Step, ask, ask_with, walk},
};
use crate::{Dual, FrictionLaw, Response, dual::derivatives};

/// Wrong derivatives show in this digit.
const TANGENT: f64 = 1e-6;
const FAINT: f64 = 1e-200;
/// Increments over which differences at zero must have come nearer to the slope.
const DECADE: usize = 10;

pub(super) fn finite(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let old = walk(law, sample);
    let answer = ask(law, &sample.at(sample.last), &old);
    for (index, (value, slopes)) in answer.all().into_iter().enumerate() {
        let good = value.is_finite() && slopes.iter().all(|x| x.is_finite());
        ensure(good, || format!("{} is {value} with derivatives {slopes:?}", name(law, index)))?;
    }
    if let Response::Threshold(bound) = answer.response {
        ensure(bound.re >= 0.0, || format!("bound on the traction is negative, {}", bound.re))?;
        ensure(bound.re == 0.0 || !law.frictionless(), || "says frictionless but has a bound".into())?;
    } else {
        ensure(!law.frictionless(), || "says frictionless but is a direct law".into())?;
    }
    let mut new = vec![f64::NAN; old.len()];
    law.open(&sample.at(Step { pressure: 0.0, slip: 0.0, ..sample.last }), &old, &mut new);
    ensure(new.iter().all(|x| x.is_finite()), || format!("`open` gives the states {new:?}"))?;
    let step = law.suggested_step(&sample.at(sample.last), &old);
    ensure(step.is_none_or(|dt| dt > 0.0), || format!("suggested step {step:?}"))
}

pub(super) fn committed(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let old = walk(law, sample);
    let at = sample.at(sample.last);
    let bits = |answer: Answer| -> Vec<u64> {
        answer.all().iter().flat_map(|(x, d)| [x.to_bits(), d[0].to_bits(), d[1].to_bits()]).collect()
    };
    let first = bits(ask(law, &at, &old));
    ensure(first == bits(ask_with(law, &at, &old, 1.0)), || "some of `new` is not written, or read".into())?;
    ask(law, &sample.at(Step { slip: 3.0 * sample.last.slip + 1.0, ..sample.last }), &old);
    ensure(first == bits(ask(law, &at, &old)), || "the answer depends on earlier calls".into())
}

pub(super) fn limits(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let old = walk(law, sample);
    let at =
        |pressure, slip| ask(law, &sample.at(Step { pressure, slip, dt: sample.last.dt }), &old).response.value().re;
    let Step { pressure: p, slip: s, .. } = sample.last;
    // half way (in decades) tells a law that vanishes at both ends from one that jumps
    let half = FAINT.sqrt();
    let pairs = [
        ("pressure", at(0.0, s), at(FAINT * p, s), at(half * p, s)),
        ("slip", at(p, 0.0), at(p, FAINT * s), at(p, half * s)),
    ];
    pairs.iter().try_for_each(|(what, limit, nearby, halfway)| {
        let scale = at(p, s).abs() + limit.abs() + nearby.abs() + halfway.abs();
        ensure((limit - nearby).abs() <= 1e-3 * scale, || {
            format!("response jumps as the {what} vanishes: {nearby} just before, {limit} at zero")
        })
    })
}

pub(super) fn tangent(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let old = walk(law, sample);
    let count = ask(law, &sample.at(sample.last), &old).all().len();
    for (variable, what) in ["pressure", "slip"].into_iter().enumerate() {
        let value = |index: usize, shift: f64| {
            let mut step = sample.last;
            *[&mut step.pressure, &mut step.slip][variable] += shift;
            let answer = ask(law, &sample.at(step), &old);
            let x: Dual = if index == 0 { answer.response.value() } else { answer.states[index - 1] };
            derivatives(&x)
        };
        let x = [sample.last.pressure, sample.last.slip][variable];
        for index in 0..count {
            let slope = value(index, 0.0).1[variable];
            compare(x, slope, variable == 0, |shift| value(index, shift).0).map_err(|found| {
                format!("derivative of {} by {what} is {slope}, differences give {found}", name(law, index))
            })?;
        }
    }
    Ok(())
}

/// Whether `slope` lies between the one-sided differences of `f` for some increment at which round-off is small; else the
/// differences at the last such increment, as text. `one_sided`: `x` must not become negative.
fn compare(x: f64, slope: f64, one_sided: bool, f: impl Fn(f64) -> f64) -> Result<(), String> {
    let increments: Vec<f64> = match x.abs() {
        0.0 => (0..110).map(|k| 10f64.powi(6 - k)).collect(),
        size => (3..8).map(|k| size * 10f64.powi(-k)).collect(),
    };
    let middle = f(0.0);
    let jitter = (1..4).map(|k| (f(f64::from(k) * f64::EPSILON * x) - middle).abs()).fold(0.0, f64::max);
    let noise = 4.0 * jitter + 1e-14 * middle.abs();
    let (mut found, mut deviations) = (None, vec![]);
    for h in increments {
        let ahead = (f(h) - middle) / h;
        let behind = if one_sided && x < h { ahead } else { (middle - f(-h)) / h };
        let (low, high) = (ahead.min(behind), ahead.max(behind));
        let size = slope.abs().max(low.abs()).max(high.abs());
        if noise / h > 1e-3 * size {
            continue;
        }
        let slack = TANGENT * size + noise / h;
        if low - slack <= slope && slope <= high + slack {
            return Ok(());
        }
        found = Some(format!("{behind} and {ahead} at increment {h}"));
        deviations.push((slope - 0.5 * (behind + ahead)).abs());
    }
    // a tangent of higher order at zero, |x|^1.5: the differences are of one sign but tend to the slope
    let early = deviations.iter().rev().nth(DECADE);
    let tends = x == 0.0 && early.is_some_and(|early| deviations[deviations.len() - 1] <= 0.5 * early);
    if tends {
        return Ok(());
    }
    found.map_or(Ok(()), Err)
}

fn name(law: &dyn FrictionLaw, index: usize) -> String {
    match index {
        0 => "the response".into(),
        _ => law.variables().get(index - 1).map_or("a state".into(), |v| format!("state `{}`", v.name)),
    }
}
