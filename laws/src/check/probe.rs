//! Random contact histories and how a law is called along them.

use super::Envelope;
use crate::{
    Dual, FrictionLaw, InterfacePoint, LawInfo, Response, Unit,
    dual::{constant, derivatives},
};
use proptest::prelude::*;

/// One time step of a contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// True pressure, `>= 0`.
    pub pressure: f64,
    /// Slip increment, signed.
    pub slip: f64,
    /// Length of the step.
    pub dt: f64,
}

/// A history from the virgin state and the step at which the law is examined.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Steps taken before; one without pressure is an open point.
    pub history: Vec<Step>,
    /// The step examined.
    pub last: Step,
    /// Temperature of the interface where the scene has one.
    pub temperature: Option<f64>,
}

impl Sample {
    pub(super) fn at(&self, step: Step) -> InterfacePoint {
        InterfacePoint { temperature: self.temperature, ..InterfacePoint::new(step.pressure, step.slip, step.dt) }
    }
}

/// What a law answered: response, and states at the end of the step.
pub(super) struct Answer {
    pub(super) response: Response,
    pub(super) states: Vec<Dual>,
}

impl Answer {
    /// Response and states with their derivatives, in this order.
    pub(super) fn all(&self) -> Vec<(f64, [f64; 2])> {
        std::iter::once(&self.response.value()).chain(&self.states).map(derivatives).collect()
    }

    pub(super) fn values(&self) -> Vec<f64> {
        self.states.iter().map(|x| x.re).collect()
    }
}

/// Asks the law, with `new` filled with `poison` before.
pub(super) fn ask_with(law: &dyn FrictionLaw, at: &InterfacePoint, old: &[f64], poison: f64) -> Answer {
    let mut states = vec![constant(poison); old.len()];
    let response = law.response(at, old, &mut states);
    Answer { response, states }
}

pub(super) fn ask(law: &dyn FrictionLaw, at: &InterfacePoint, old: &[f64]) -> Answer {
    ask_with(law, at, old, f64::NAN)
}

pub(super) fn initial(law: &dyn FrictionLaw) -> Vec<f64> {
    law.variables().iter().map(|v| v.initial).collect()
}

/// States after the history.
pub(super) fn walk(law: &dyn FrictionLaw, sample: &Sample) -> Vec<f64> {
    sample.history.iter().fold(initial(law), |old, step| {
        let at = sample.at(*step);
        if step.pressure > 0.0 {
            return ask(law, &at, &old).values();
        }
        let mut new = vec![f64::NAN; old.len()];
        law.open(&sample.at(Step { slip: 0.0, ..*step }), &old, &mut new);
        new
    })
}

/// Histories whose steps lie within a decade of one pressure, slip and time step each, which roam over the envelope or lie near
/// the scales set by the parameters of the law.
pub(super) fn samples(law: &dyn FrictionLaw, info: &LawInfo, envelope: &Envelope) -> BoxedStrategy<Sample> {
    let hints = |unit| hints(law, info, unit);
    let slips = [hints(Unit::LENGTH), hints(Unit::ONE.per(Unit::LENGTH)).iter().map(|k| 1.0 / k).collect()].concat();
    let pressure = magnitude(envelope.pressure, hints(Unit::STRESS));
    let slip = magnitude(envelope.slip, slips);
    let dt = magnitude(envelope.dt, hints(Unit::TIME));
    let speeds = hints(Unit::VELOCITY);
    let speed = if speeds.is_empty() { Just(None).boxed() } else { proptest::option::of(near(speeds)).boxed() };
    let temperature = proptest::option::of(200.0..500.0);
    (pressure, slip, dt, speed, temperature)
        .prop_flat_map(|(pressure, slip, dt, speed, temperature)| {
            let base = Step { pressure, slip, dt: speed.map_or(dt, |v| slip / v) };
            (proptest::collection::vec(step(base), 0..6), step(base), Just(temperature))
        })
        .prop_map(|(history, last, temperature)| Sample { history, last, temperature })
        .boxed()
}

fn step(base: Step) -> impl Strategy<Value = Step> {
    let factor = || prop_oneof![1 => Just(0.0), 9 => (-1.0..1.0).prop_map(|x: f64| 10f64.powf(x))];
    (factor(), factor(), -1.0..1.0, any::<bool>()).prop_map(move |(p, s, t, back)| Step {
        pressure: p * base.pressure,
        slip: if back { -s } else { s } * base.slip,
        dt: base.dt * 10f64.powf(t),
    })
}

fn magnitude(range: [f64; 2], hints: Vec<f64>) -> BoxedStrategy<f64> {
    let roaming = (range[0].log10()..=range[1].log10()).prop_map(|x: f64| 10f64.powf(x));
    if hints.is_empty() { roaming.boxed() } else { prop_oneof![roaming, near(hints)].boxed() }
}

fn near(hints: Vec<f64>) -> impl Strategy<Value = f64> {
    (proptest::sample::select(hints), -2.0..2.0).prop_map(|(scale, x): (f64, f64)| scale * 10f64.powf(x))
}

/// Dotted keys of the parameters with their units, where these are known.
pub(super) fn quantities(law: &dyn FrictionLaw, info: &LawInfo) -> Vec<(String, Option<Unit>)> {
    law.units().unwrap_or_else(|| info.parameters.iter().map(|p| (p.name.into(), Some(p.unit))).collect())
}

/// Values of the parameters of this unit.
fn hints(law: &dyn FrictionLaw, info: &LawInfo, unit: Unit) -> Vec<f64> {
    let table = toml::Value::try_from(law).ok();
    let value = |key: &str| key.split('.').try_fold(table.as_ref()?, |value, key| value.get(key))?.as_float();
    let keys = quantities(law, info).into_iter().filter(|(_, known)| *known == Some(unit));
    keys.filter_map(|(key, _)| value(&key)).map(f64::abs).filter(|x| *x > 0.0 && x.is_finite()).collect()
}
