//! Axes of a study: what values they take, and which keys of the scene take them.

use toml::Value;

use super::spec::{AxisSpec, Paths, Values};
use crate::scene::{Issue, KeyPath};

/// Significant digits of the values of a range: enough to compute with, few enough to read.
const DIGITS: usize = 12;

/// A direction of the study.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// Column of the table, symbol in formulas.
    pub name: String,
    /// The values that stand in the table.
    pub values: Vec<Value>,
    /// What is put into the scene.
    pub effects: Vec<Effect>,
}

/// Values for one key of the scene.
#[derive(Clone, Debug)]
pub(super) struct Effect {
    /// Key of the scene.
    pub path: KeyPath,
    /// Where that key stands in the study.
    pub path_at: KeyPath,
    /// One value for each value of the axis.
    pub values: Vec<Value>,
    /// Where the values stand in the study.
    pub origin: KeyPath,
}

impl Axis {
    /// The axis of a declaration that stands at `key`.
    pub fn new(spec: &AxisSpec, key: &KeyPath) -> Result<Self, Vec<Issue>> {
        let values = expand(&spec.values);
        let mut effects = effects(spec.path.as_ref(), &values, &key.at("path"), key.at("values"))?;
        let mut issues = vec![];
        for (k, zip) in spec.zip.iter().enumerate() {
            let (here, zipped) = (key.at("zip").at(k), expand(&zip.values));
            if zipped.len() != values.len() {
                let message = format!("{} values, but the axis has {}", zipped.len(), values.len());
                issues.push(Issue::value(here.at("values"), message).allowed("as many values as the axis has"));
            }
            match self::effects(Some(&zip.path), &zipped, &here.at("path"), here.at("values")) {
                Ok(more) => effects.extend(more),
                Err(more) => issues.extend(more),
            }
        }
        let name = match (&spec.name, &spec.path) {
            (Some(name), _) => Some(name.clone()),
            (None, Some(Paths::One(path))) => Some(path.clone()),
            _ => None,
        };
        let Some(name) = name else {
            issues.push(Issue::value(key.clone(), "missing key `name`").allowed("the column of the table"));
            return Err(issues);
        };
        if issues.is_empty() { Ok(Self { name, values, effects }) } else { Err(issues) }
    }

    /// The values as numbers, where all of them are.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.values.iter().map(number).collect()
    }

    /// The value of one number as text.
    pub fn label(&self, k: usize) -> String {
        plain(&self.values[k])
    }
}

fn effects(paths: Option<&Paths>, values: &[Value], key: &KeyPath, origin: KeyPath) -> Result<Vec<Effect>, Vec<Issue>> {
    let paths: Vec<(&String, KeyPath)> = match paths {
        None => vec![],
        Some(Paths::One(path)) => vec![(path, key.clone())],
        Some(Paths::Several(paths)) => paths.iter().enumerate().map(|(k, path)| (path, key.at(k))).collect(),
    };
    let effect = |(text, key): (&String, KeyPath)| match KeyPath::parse(text) {
        Some(path) => Ok(Effect { path, path_at: key, values: values.to_vec(), origin: origin.clone() }),
        None => Err(not_a_key(text, key)),
    };
    paths.into_iter().map(effect).collect::<Result<_, Issue>>().map_err(|issue| vec![issue])
}

/// The message for a text that should be a dotted key.
pub(super) fn not_a_key(text: &str, key: KeyPath) -> Issue {
    Issue::value(key, format!("{text:?} is not a dotted key"))
        .allowed("a key of the scene, e.g. contact.0.law.friction")
}

fn expand(values: &Values) -> Vec<Value> {
    match values {
        Values::List(list) => list.clone(),
        Values::Linear(spec) => {
            let (range, last) = (&spec.linear, (spec.linear.count - 1) as f64);
            let at = |k: usize| (range.from * (last - k as f64) + range.to * k as f64) / last;
            (0..range.count).map(|k| whole(rounded(at(k)))).collect()
        }
        Values::Logarithmic(spec) => {
            let (range, last) = (&spec.logarithmic, (spec.logarithmic.count - 1) as f64);
            let at = |k: usize| (range.from.ln() * (last - k as f64) + range.to.ln() * k as f64) / last;
            (0..range.count).map(|k| whole(rounded(at(k).exp()))).collect()
        }
    }
}

/// The number without the digits that round-off made.
pub(super) fn rounded(number: f64) -> f64 {
    format!("{number:.*e}", DIGITS - 1).parse().unwrap_or(number)
}

/// A number as a value of TOML: an integer where it is whole, as a scene asks for it where it counts something.
pub(super) fn whole(number: f64) -> Value {
    let exact = number == number.trunc() && number.abs() < 1e15;
    if exact { Value::Integer(number as i64) } else { Value::Float(number) }
}

/// The number of a value.
pub(super) fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|number| number as f64))
}

/// A value as it stands in a table: text without quotes, numbers as everywhere.
pub(super) fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) => crate::output::tables::number(*number),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::spec::{LinearRange, LinearSpec, LogarithmicRange, LogarithmicSpec};

    fn texts(values: &Values) -> Vec<String> {
        expand(values).iter().map(plain).collect()
    }

    #[test]
    fn ranges_hit_their_ends_and_read_well() {
        let linear = |from, to, count| Values::Linear(LinearSpec { linear: LinearRange { from, to, count } });
        assert_eq!(texts(&linear(0.0, 0.3, 4)), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(texts(&linear(10.0, -10.0, 3)), ["10", "0", "-10"]);
        let logarithmic = LogarithmicRange { from: 1e-2, to: 1e2, count: 5 };
        let logarithmic = Values::Logarithmic(LogarithmicSpec { logarithmic });
        assert_eq!(texts(&logarithmic), ["0.01", "0.1", "1", "10", "100"]);
    }
}
