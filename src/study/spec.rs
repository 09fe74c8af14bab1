//! The declaration of a study: the structs that are read from TOML and printed as a JSON schema.

use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use toml::Value;

use crate::output::tables::history_columns;
use crate::scene::OutputSpec;

/// A scene computed again and again with some of its values changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "asperity study")]
pub struct StudySpec {
    /// Version of this format.
    #[schemars(extend("const" = 1))]
    pub version: u32,
    /// A name for reports and figures.
    #[serde(default)]
    pub title: String,
    /// The scene that is varied: a file, relative to this one.
    pub scene: String,
    /// Changes common to all points, as the arguments of `--set`: `PATH=VALUE`.
    #[serde(default)]
    pub set: Vec<String>,
    /// What is varied; axes are crossed, the last one runs fastest.
    #[schemars(length(min = 1))]
    pub axis: Vec<AxisSpec>,
    /// Values of the scene that follow from the axes: `PATH=FORMULA` in the names of axes.
    #[serde(default)]
    pub formula: Vec<String>,
    /// Columns of the table: one number for each point.
    #[serde(default)]
    pub quantity: Vec<QuantitySpec>,
    /// Figures; left out: every quantity over the first axis, one line for each value of the second.
    #[serde(default)]
    pub figure: Vec<FigureSpec>,
    /// What each point writes, as in a scene; left out: `history.csv` and `run.json` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub output: Option<OutputSpec>,
}

/// One direction of the study: values, and the keys of the scene that take them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisSpec {
    /// Column of the table and symbol in formulas; left out: the path.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Dotted key of the scene, or several that all take the value. Not needed where formulas use the name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<Paths>,
    /// The values.
    pub values: Values,
    /// Further keys that change along with the axis, each with values of its own.
    #[serde(default)]
    pub zip: Vec<ZipSpec>,
}

/// Keys that change along with an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZipSpec {
    /// Dotted key of the scene, or several that all take the value.
    pub path: Paths,
    /// As many values as the axis has.
    pub values: Values,
}

/// One dotted key, or several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Paths {
    /// One key.
    One(String),
    /// Several keys that take the same value.
    Several(Vec<String>),
}

/// Values of an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Values {
    /// One by one; anything that can stand in a scene.
    List(#[schemars(schema_with = "anything")] Vec<Value>),
    /// Equal differences.
    Linear(LinearSpec),
    /// Equal ratios.
    Logarithmic(LogarithmicSpec),
}

fn anything(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "array", "minItems": 1 })
}

/// Numbers of equal differences.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearSpec {
    /// The range.
    pub linear: LinearRange,
}

/// Ends and number of values of a linear range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearRange {
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values, both ends included.
    #[schemars(range(min = 2, max = 1_000_000))]
    pub count: usize,
}

/// Numbers of equal ratios.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogarithmicSpec {
    /// The range.
    pub logarithmic: LogarithmicRange,
}

/// Ends and number of values of a logarithmic range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogarithmicRange {
    /// First value.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub from: f64,
    /// Last value.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub to: f64,
    /// Number of values, both ends included.
    #[schemars(range(min = 2, max = 1_000_000))]
    pub count: usize,
}

/// One number for each point, from its `history.csv`. Rows without a number in the column are left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuantitySpec {
    /// Column of the table.
    pub name: String,
    /// Column of `history.csv`.
    #[schemars(schema_with = "history_column")]
    pub column: String,
    /// What is taken of it.
    pub take: Take,
    /// Which steps count.
    #[serde(default)]
    pub over: Steps,
    /// Only steps whose value of a column lies between two numbers: `{ time = [1.0, 5.0] }`.
    #[serde(default)]
    #[schemars(schema_with = "windows")]
    pub within: BTreeMap<String, [f64; 2]>,
    /// Column over which `mean` and `integral` integrate.
    #[serde(default = "time")]
    #[schemars(schema_with = "history_column")]
    pub along: String,
    /// Column by which a `mean` is weighted; left out: all steps weigh the same per unit of `along`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "history_column")]
    pub weight: Option<String>,
}

fn time() -> String {
    "time".into()
}

fn history_column(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "string", "enum": history_columns(true).map(|column| column.0).collect::<Vec<_>>() })
}

fn windows(_: &mut SchemaGenerator) -> Schema {
    let window = json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
    let columns: serde_json::Map<String, serde_json::Value> =
        history_columns(true).map(|column| (column.0.to_owned(), window.clone().to_value())).collect();
    json_schema!({ "type": "object", "properties": columns, "additionalProperties": false })
}

/// What is taken of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Take {
    /// Value at the last step.
    Last,
    /// Mean: trapezoidal rule over `along`, between neighbouring steps that both count.
    Mean,
    /// Smallest value.
    Min,
    /// Largest value.
    Max,
    /// Integral over `along`, signed: trapezoidal rule between neighbouring steps that both count.
    Integral,
    /// Sum over the steps.
    Sum,
}

/// Which steps count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Steps {
    /// All of them.
    #[default]
    All,
    /// Those in contact.
    Contact,
    /// Those at which the whole contact slips.
    Slipping,
}

/// One quantity over an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureSpec {
    /// The quantity.
    pub quantity: String,
    /// The axis it is drawn over; left out: the first one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<String>,
    /// The axis of which each value gets a line; left out: the first of the others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lines: Option<String>,
}
