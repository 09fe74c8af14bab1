//! Properties of the form of a law: its record, its serialised form, its units.

use super::{
    ensure,
    path::same,
    probe::{Answer, Sample, Step, ask, initial, quantities, walk},
};
use crate::{FrictionLaw, InterfacePoint, Kind, LawInfo, Unit, find, validate};
use std::collections::BTreeSet;
use toml::{Table, Value};

/// Powers of two, so that only functions that see a dimensional argument can tell.
const SCALES: [f64; 4] = [1024.0, 1.0 / 128.0, 32.0, 8.0];

pub(super) fn documentation(law: &dyn FrictionLaw, info: &LawInfo) -> Result<(), String> {
    let table = Table::try_from(law).map_err(|error| error.to_string())?;
    let optional = info.parameters.iter().filter(|p| p.default.is_some()).map(|p| p.name);
    let declared: BTreeSet<_> = info.parameters.iter().map(|p| p.name).collect();
    let present: BTreeSet<_> = table.keys().map(String::as_str).filter(|key| *key != "type").chain(optional).collect();
    ensure(declared == present, || format!("parameters declared {declared:?}, serialised {present:?}"))?;
    let names: BTreeSet<_> = law.variables().into_iter().map(|v| v.name).collect();
    ensure(names.len() == law.variables().len(), || "two internal variables of one name".into())?;
    validate(law).map_err(|error| error.to_string())?;
    let found = ask(law, &InterfacePoint::new(1.0, 0.0, 1.0), &initial(law)).response.kind();
    ensure(found == info.kind || info.kind == Kind::Either, || {
        format!("declared {:?}, answers as {found:?}", info.kind)
    })
}

pub(super) fn round_trip(law: &dyn FrictionLaw) -> Result<(), String> {
    let text = |error: &dyn std::fmt::Display| error.to_string();
    let json = serde_json::to_string(law).map_err(|e| text(&e))?;
    let table = toml::to_string(law).map_err(|e| text(&e))?;
    let again: [Box<dyn FrictionLaw>; 2] =
        [serde_json::from_str(&json).map_err(|e| text(&e))?, toml::from_str(&table).map_err(|e| text(&e))?];
    for copy in again {
        let found = serde_json::to_string(&copy).map_err(|e| text(&e))?;
        ensure(found == json, || format!("{json} comes back as {found}"))?;
        ensure(copy.variables() == law.variables(), || "other variables after a round trip".into())?;
        let at = InterfacePoint::new(1.0, 0.5, 0.25);
        let answer = |law: &dyn FrictionLaw| ask(law, &at, &initial(law)).all();
        ensure(answer(law) == answer(copy.as_ref()), || "other answer after a round trip".into())?;
    }
    Ok(())
}

pub(super) fn units(law: &dyn FrictionLaw, sample: &Sample) -> Result<(), String> {
    let Some(scaled_law) = rescaled(law)? else { return Ok(()) };
    let scale = |step: &Step| Step {
        pressure: step.pressure * SCALES[0],
        slip: step.slip * SCALES[1],
        dt: step.dt * SCALES[2],
    };
    let scaled = Sample {
        history: sample.history.iter().map(scale).collect(),
        last: scale(&sample.last),
        temperature: sample.temperature.map(|t| t * SCALES[3]),
    };
    let end = |law: &dyn FrictionLaw, sample: &Sample| ask(law, &sample.at(sample.last), &walk(law, sample));
    let (one, other) = (end(law, sample), end(scaled_law.as_ref(), &scaled));
    let factors =
        std::iter::once(Unit::STRESS).chain(law.variables().into_iter().map(|v| v.unit)).map(|u| u.factor(SCALES));
    let values = |answer: &Answer| answer.all().into_iter().map(|(value, _)| value).collect::<Vec<_>>();
    for ((a, b), factor) in values(&one).into_iter().zip(values(&other)).zip(factors) {
        ensure(same(a * factor, b, b.abs()), || {
            format!(
                "in units divided by {SCALES:?} (stress, length, time, temperature) {a} should be {}, is {b}",
                a * factor
            )
        })?;
    }
    Ok(())
}

/// The law with its parameters expressed in the other units; `None` if a unit is not known.
fn rescaled(law: &dyn FrictionLaw) -> Result<Option<Box<dyn FrictionLaw>>, String> {
    let mut table = Table::try_from(law).map_err(|error| error.to_string())?;
    for (key, unit) in find(law.typetag_name()).map_or(vec![], |info| quantities(law, info)) {
        let Some(factor) = unit.map(|unit| unit.factor(SCALES)) else { return Ok(None) };
        let mut keys = key.split('.');
        let first = keys.next().and_then(|key| table.get_mut(key));
        let value = keys.fold(first, |value, key| value?.get_mut(key));
        if let Some(value) = value.filter(|_| factor != 1.0) {
            multiply(value, factor);
        }
    }
    table.try_into().map(Some).map_err(|error: toml::de::Error| error.to_string())
}

fn multiply(value: &mut Value, factor: f64) {
    match value {
        Value::Float(x) => *x *= factor,
        Value::Integer(i) => *value = Value::Float(*i as f64 * factor),
        Value::Array(items) => items.iter_mut().for_each(|item| multiply(item, factor)),
        _ => {}
    }
}
