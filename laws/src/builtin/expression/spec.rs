//! What the user writes.

use crate::{LawError, Unit};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use toml::Value;

/// The table of the law. Parameters and states are read further by [`parameter`] and [`state`], whose errors name the key.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spec {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) threshold: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) traction: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) temperature: Option<f64>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) parameters: BTreeMap<String, Value>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) states: BTreeMap<String, Value>,
}

/// A parameter: a number, a number with a unit, or a table over another quantity.
pub(super) enum Parameter {
    Number(f64),
    Quantity(Quantity),
    Table(Tabulated),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) unit: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tabulated {
    pub(super) over: String,
    pub(super) at: Vec<f64>,
    pub(super) value: Vec<f64>,
    pub(super) unit: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    pub(super) rate: String,
    #[serde(default)]
    pub(super) initial: f64,
    #[serde(default)]
    pub(super) open: Open,
    pub(super) unit: Option<String>,
}

/// What becomes of a state at an open point.
#[derive(Clone, Copy, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Open {
    /// Its rate goes on at no pressure and no slip.
    #[default]
    Age,
    /// It is set to its initial value.
    Reset,
}

pub(super) fn invalid(key: impl Into<String>, message: impl Into<String>) -> LawError {
    LawError::Invalid { law: "expression".into(), key: key.into(), message: message.into() }
}

pub(super) fn parameter(name: &str, value: &Value) -> Result<Parameter, LawError> {
    let key = format!("parameters.{name}");
    match value {
        Value::Float(x) => Ok(Parameter::Number(*x)),
        Value::Integer(i) => Ok(Parameter::Number(*i as f64)),
        Value::Table(table) if table.contains_key("over") => read(&key, value).map(Parameter::Table),
        Value::Table(_) => read(&key, value).map(Parameter::Quantity),
        _ => Err(invalid(key, "a number, { value, unit }, or a table { over, at, value }")),
    }
}

pub(super) fn state(name: &str, value: &Value) -> Result<State, LawError> {
    let state: State = read(&format!("states.{name}"), value)?;
    finite(&format!("states.{name}.initial"), state.initial)?;
    Ok(state)
}

pub(super) fn finite(key: &str, x: f64) -> Result<f64, LawError> {
    if x.is_finite() { Ok(x) } else { Err(invalid(key, format!("{x} is not a finite number"))) }
}

fn read<T: DeserializeOwned>(key: &str, value: &Value) -> Result<T, LawError> {
    value.clone().try_into().map_err(|error: toml::de::Error| {
        let unknown = error.message().strip_prefix("unknown field `").and_then(|rest| rest.split('`').next());
        invalid(unknown.map_or(key.into(), |field| format!("{key}.{field}")), error.message().trim())
    })
}

/// Reads a declared unit; dimensionless if there is none.
pub(super) fn unit(key: &str, text: Option<&String>) -> Result<Unit, LawError> {
    text.map_or(Ok(Unit::ONE), |text| text.parse().map_err(|message: String| invalid(format!("{key}.unit"), message)))
}

impl Spec {
    /// Dotted keys of all numbers with their units, where they are declared.
    pub(super) fn units(&self) -> Vec<(String, Option<Unit>)> {
        let temperature = self.temperature.map(|_| ("temperature".into(), Some(Unit::TEMPERATURE)));
        let states = self.states.iter().map(|(name, state)| (format!("states.{name}.initial"), declared(state)));
        let values = self.parameters.iter().map(|(name, value)| (format!("parameters.{name}.value"), declared(value)));
        let points = self.parameters.iter().filter_map(|(name, value)| {
            let over = value.get("over")?.as_str()?;
            Some((format!("parameters.{name}.at"), self.over(over)))
        });
        temperature.into_iter().chain(states).chain(values).chain(points).collect()
    }

    fn over(&self, name: &str) -> Option<Unit> {
        match name {
            "p" => Some(Unit::STRESS),
            "v" => Some(Unit::VELOCITY),
            "T" => Some(Unit::TEMPERATURE),
            state => self.states.get(state).and_then(declared),
        }
    }
}

fn declared(value: &Value) -> Option<Unit> {
    value.get("unit")?.as_str()?.parse().ok()
}
