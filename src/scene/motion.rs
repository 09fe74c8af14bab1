//! How bodies are held and moved: supports, drives, and courses over time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Edge;

/// A component over time: constant, or piecewise linear and constant outside of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Course {
    /// The same at all times.
    Constant(f64),
    /// Straight lines between the entries of a table.
    Table(TimeTable),
}

/// Values at increasing times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeTable {
    /// Times, strictly increasing (time).
    #[schemars(length(min = 1))]
    pub time: Vec<f64>,
    /// One value for each time.
    #[schemars(length(min = 1))]
    pub value: Vec<f64>,
}

/// An edge whose points are displaced as given, each by the same amount.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportSpec {
    /// Name of the body.
    pub body: String,
    /// Edge of the body.
    pub edge: Edge,
    /// Displacement; a component left out is free.
    pub displacement: Components,
}

/// Horizontal and vertical component; either may be left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Components {
    /// Horizontal component (length).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Course>,
    /// Vertical component (length).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Course>,
}

/// An edge that is moved as one rigid piece, each component by displacement or by force; one left out is free.
///
/// A rigid body is moved as a whole, whichever edge is named; a component left out is held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveSpec {
    /// Name of the body.
    pub body: String,
    /// Edge of the body.
    pub edge: Edge,
    /// Horizontal component.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Motion>,
    /// Vertical component.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Motion>,
}

/// How one component of a drive is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// By its displacement (length).
    Displacement(Course),
    /// By the total force on the edge (force per depth).
    Force(Course),
}
