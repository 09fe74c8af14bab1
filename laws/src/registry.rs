//! Laws linked into the program: list, read from a scene, validate, schema.
//!
//! A law of a foreign crate is linked only if the program names the crate: `use my_laws as _;`.

use crate::{
    dual::constant,
    info::{Kind, LawInfo, Parameter, Range},
    law::{FrictionLaw, InterfacePoint, Variable},
};
use schemars::{Schema, SchemaGenerator, json_schema};
use toml::{Table, Value};

/// What is wrong with the `law = { .. }` table of a scene; [`Self::key`] says where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// No `type = ".."`.
    #[error("a law needs `type = \"..\"`, one of: {known}", known = known.join(", "))]
    NoType {
        /// Names of the linked laws.
        known: Vec<&'static str>,
    },
    /// Not linked into this program.
    #[error(
        "unknown law `{law}`{hint}; known: {known}. A law of another crate is linked by `use that_crate as _;` in the program",
        hint = suggestion(nearest), known = known.join(", ")
    )]
    UnknownLaw {
        /// The name that was asked for.
        law: String,
        /// Most similar known name.
        nearest: Option<&'static str>,
        /// Names of the linked laws.
        known: Vec<&'static str>,
    },
    /// The law has no such parameter.
    #[error("law `{law}` has no parameter `{key}`{hint}; its parameters: {known}", hint = suggestion(nearest), known = known.join(", "))]
    UnknownParameter {
        /// Name of the law.
        law: String,
        /// Offending key.
        key: String,
        /// Most similar parameter.
        nearest: Option<&'static str>,
        /// All parameters.
        known: Vec<&'static str>,
    },
    /// A parameter without default is not given.
    #[error("law `{law}` needs `{key}` ({meaning}): {range}")]
    Missing {
        /// Name of the law.
        law: String,
        /// Name of the parameter.
        key: &'static str,
        /// What it is.
        meaning: &'static str,
        /// What it may be.
        range: Range,
    },
    /// Wrong type or outside of the range.
    #[error("law `{law}`: `{key} = {value}` must be {range}")]
    OutOfRange {
        /// Name of the law.
        law: String,
        /// Offending key.
        key: String,
        /// The value found, as written in TOML.
        value: String,
        /// What it may be.
        range: Range,
    },
    /// Any other reason, among them conditions of several parameters.
    #[error("law `{law}`: {message}")]
    Invalid {
        /// Name of the law.
        law: String,
        /// Offending key, dotted if nested, `type` if it is not known.
        key: String,
        /// Reason.
        message: String,
    },
}

impl LawError {
    /// A condition among several parameters that does not hold, pinned to one of them.
    pub fn invalid(law: &str, key: &str, message: impl Into<String>) -> Self {
        Self::Invalid { law: law.into(), key: key.into(), message: message.into() }
    }

    /// The key in the table of the law to which the message belongs, dotted if it is a nested one (`states.z.rate`); `type` where it is
    /// the law as a whole.
    pub fn key(&self) -> &str {
        match self {
            Self::NoType { .. } | Self::UnknownLaw { .. } | Self::Missing { .. } => "type",
            Self::UnknownParameter { key, .. } | Self::OutOfRange { key, .. } | Self::Invalid { key, .. } => key,
        }
    }
}

fn suggestion(nearest: &Option<&'static str>) -> String {
    nearest.map_or(String::new(), |n| format!(" (did you mean `{n}`?)"))
}

/// Documentation of all laws linked into this program, sorted by name.
pub fn linked() -> Vec<&'static LawInfo> {
    let mut all: Vec<_> = inventory::iter::<LawInfo>().collect();
    all.sort_by_key(|info| info.name);
    all
}

/// Documentation of one law.
pub fn find(name: &str) -> Option<&'static LawInfo> {
    inventory::iter::<LawInfo>().find(|info| info.name == name)
}

/// Whether a law is set-valued or direct; `None` if it is not linked.
pub fn kind(law: &dyn FrictionLaw) -> Option<Kind> {
    let declared = find(law.typetag_name())?.kind;
    if declared != Kind::Either {
        return Some(declared);
    }
    let old: Vec<f64> = law.variables().iter().map(|variable| variable.initial).collect();
    let mut new = vec![constant(f64::NAN); old.len()];
    Some(law.response(&InterfacePoint::new(0.0, 0.0, 1.0), &old, &mut new).kind())
}

/// Reads a law from its table in a scene, `{ type = "coulomb", friction = 0.3 }`.
///
/// # Errors
/// Says what is wrong, what would be right, and which key to point at.
pub fn parse(table: Table) -> Result<Box<dyn FrictionLaw>, LawError> {
    let info = match table.get("type") {
        Some(Value::String(name)) => find(name).ok_or_else(|| unknown_law(name))?,
        _ => return Err(LawError::NoType { known: names() }),
    };
    check(info, &table)?;
    let law: Box<dyn FrictionLaw> = table.try_into().map_err(|error: toml::de::Error| LawError::Invalid {
        law: info.name.into(),
        key: "type".into(),
        message: error.message().into(),
    })?;
    law.validate()?;
    starts(&*law)?;
    Ok(law)
}

/// States must start at numbers: parameters that are each in range may be too far apart for their quotient.
fn starts(law: &dyn FrictionLaw) -> Result<(), LawError> {
    let wrong = law.variables().into_iter().find(|variable| !variable.initial.is_finite());
    wrong.map_or(Ok(()), |Variable { name, initial, .. }| {
        let message = format!("its parameters are too far apart: the state `{name}` would start at {initial}");
        Err(LawError::invalid(law.typetag_name(), "type", message))
    })
}

/// Checks a law that was not read by [`parse`]: the ranges of its record and its own conditions.
///
/// # Errors
/// As [`parse`].
pub fn validate(law: &dyn FrictionLaw) -> Result<(), LawError> {
    let name = law.typetag_name();
    let info = find(name).ok_or_else(|| unknown_law(name))?;
    let table = Table::try_from(law).map_err(|error| LawError::Invalid {
        law: name.into(),
        key: "type".into(),
        message: error.to_string(),
    })?;
    check(info, &table)?;
    law.validate()?;
    starts(law)
}

/// JSON schema of the `law` table, for `#[schemars(schema_with = "asperity_laws::schema")]`.
pub fn schema(_: &mut SchemaGenerator) -> Schema {
    let laws: Vec<_> = linked().into_iter().map(law_schema).collect();
    json_schema!({ "oneOf": laws })
}

fn law_schema(info: &LawInfo) -> serde_json::Value {
    let mut properties = serde_json::Map::new();
    properties.insert("type".into(), serde_json::json!({ "const": info.name }));
    for parameter in info.parameters {
        let mut schema = match parameter.range {
            Range::Number => serde_json::json!({ "type": "number" }),
            Range::AtLeast(low) => serde_json::json!({ "type": "number", "minimum": low }),
            Range::Above(low) => serde_json::json!({ "type": "number", "exclusiveMinimum": low }),
            Range::Between(low, high) => serde_json::json!({ "type": "number", "minimum": low, "maximum": high }),
            Range::Choice(words) => serde_json::json!({ "enum": words }),
            Range::Text(_) => serde_json::json!({ "type": "string" }),
            Range::Other(_) => serde_json::json!({}),
        };
        let words = match parameter.range {
            Range::Text(words) | Range::Other(words) => format!("; {words}"),
            _ => String::new(),
        };
        schema["description"] = format!("{} [{}]{words}", parameter.meaning, parameter.unit).into();
        properties.insert(parameter.name.into(), schema);
    }
    let needed = info.parameters.iter().filter(|p| p.default.is_none()).map(|p| p.name);
    let required: Vec<_> = std::iter::once("type").chain(needed).collect();
    serde_json::json!({
        "type": "object", "description": info.equation, "properties": properties,
        "required": required, "additionalProperties": false
    })
}

fn check(info: &LawInfo, table: &Table) -> Result<(), LawError> {
    for key in table.keys().filter(|key| *key != "type") {
        if !info.parameters.iter().any(|p| p.name == key) {
            let known: Vec<_> = info.parameters.iter().map(|p| p.name).collect();
            let nearest = nearest(key, &known);
            return Err(LawError::UnknownParameter { law: info.name.into(), key: key.clone(), nearest, known });
        }
    }
    info.parameters.iter().try_for_each(|parameter| match table.get(parameter.name) {
        Some(value) => check_value(info, parameter, value),
        None if parameter.default.is_some() => Ok(()),
        None => Err(LawError::Missing {
            law: info.name.into(),
            key: parameter.name,
            meaning: parameter.meaning,
            range: parameter.range,
        }),
    })
}

fn check_value(info: &LawInfo, parameter: &Parameter, value: &Value) -> Result<(), LawError> {
    let admissible = match (parameter.range, value) {
        (Range::Other(_), _) | (Range::Text(_), Value::String(_)) => true,
        (Range::Choice(words), Value::String(word)) => words.contains(&word.as_str()),
        (range, Value::Float(x)) => range.contains(*x),
        (range, Value::Integer(i)) => range.contains(*i as f64),
        _ => false,
    };
    if admissible {
        return Ok(());
    }
    Err(LawError::OutOfRange {
        law: info.name.into(),
        key: parameter.name.into(),
        value: value.to_string(),
        range: parameter.range,
    })
}

fn names() -> Vec<&'static str> {
    linked().iter().map(|info| info.name).collect()
}

fn unknown_law(name: &str) -> LawError {
    let known = names();
    LawError::UnknownLaw { law: name.into(), nearest: nearest(name, &known), known }
}

/// The most similar candidate, if it is similar enough to be meant.
pub(crate) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let distance = |candidate: &&&str| strsim::damerau_levenshtein(word, candidate);
    let best = candidates.iter().min_by_key(distance)?;
    (distance(&best) <= 1 + best.len() / 3).then_some(*best)
}
