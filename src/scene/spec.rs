//! The declaration of a scene: the structs that are read from TOML, written to `run.json` and printed as a JSON schema.
//!
//! Ranges of single values are declared here, beside the value (`exclusiveMinimum`, ...); rules that join several values are
//! in `rules`. Values are in one consistent unit system. Plane strain: forces are per unit of depth.

use std::collections::BTreeMap;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use super::dynamics::DynamicsSpec;
use super::motion::{DriveSpec, SupportSpec};
use super::numerics::{Numerics, Solution, Volumetric};
use crate::geometry::{BasisSpec, Edge, Grading, ShapeSpec};

/// A whole analysis: bodies, how they are held and moved, their contacts, and how time passes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "asperity scene")]
pub struct Scene {
    /// Version of this format.
    #[schemars(extend("const" = 1))]
    pub version: u32,
    /// A name for reports and figures.
    #[serde(default)]
    pub title: String,
    /// Labels of the unit system; they label axes and columns and convert nothing.
    #[serde(default)]
    pub units: Units,
    /// Materials by name.
    #[serde(default)]
    pub material: BTreeMap<String, MaterialSpec>,
    /// Bodies by name.
    pub body: BTreeMap<String, BodySpec>,
    /// Edges that are held, point by point.
    #[serde(default)]
    pub support: Vec<SupportSpec>,
    /// Edges that are moved as one rigid piece. The first drive defines `Fx`, `Fy` and `mu_global` of the history.
    #[serde(default)]
    pub drive: Vec<DriveSpec>,
    /// Pairs of edges that may touch.
    #[serde(default)]
    pub contact: Vec<ContactSpec>,
    /// Duration and nominal steps.
    pub time: TimeSpec,
    /// Inertia; quasi-static if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamics: Option<DynamicsSpec>,
    /// How the equations of a step are solved.
    #[serde(default)]
    pub solution: Solution,
    /// What is written, and how often.
    #[serde(default)]
    pub output: OutputSpec,
}

/// Labels of the base units. Forces are per unit of depth: stress times length.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Units {
    /// Unit of length, e.g. `mm`.
    pub length: String,
    /// Unit of stress, e.g. `MPa`.
    pub stress: String,
    /// Unit of time, e.g. `s`.
    pub time: String,
}

/// A bulk material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum MaterialSpec {
    /// Finite strain: `psi = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2`.
    NeoHookean {
        /// Young's modulus (stress).
        #[schemars(extend("exclusiveMinimum" = 0))]
        youngs_modulus: f64,
        /// Poisson's ratio; at 0.5 the material would be incompressible and `lambda` infinite.
        #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
        poissons_ratio: f64,
        /// Mass per volume (stress time^2/length^2); matters with `[dynamics]` only.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        density: Option<f64>,
    },
    /// Hooke's law between Green's strain and the second Piola-Kirchhoff stress: large rotations, small strains; softens under
    /// compression. For comparison with codes that use it.
    SaintVenantKirchhoff {
        /// Young's modulus (stress).
        #[schemars(extend("exclusiveMinimum" = 0))]
        youngs_modulus: f64,
        /// Poisson's ratio.
        #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
        poissons_ratio: f64,
        /// Mass per volume (stress time^2/length^2); matters with `[dynamics]` only.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        density: Option<f64>,
    },
    /// Small strain: `sigma = lambda tr(eps) I + 2 mu eps`; for comparison with classical solutions.
    LinearElastic {
        /// Young's modulus (stress).
        #[schemars(extend("exclusiveMinimum" = 0))]
        youngs_modulus: f64,
        /// Poisson's ratio.
        #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
        poissons_ratio: f64,
        /// Mass per volume (stress time^2/length^2); matters with `[dynamics]` only.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(extend("exclusiveMinimum" = 0))]
        density: Option<f64>,
    },
}

/// A body: deformable (with a material), or rigid (a curve without unknowns).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodySpec {
    /// Shape in the reference configuration, before it is placed.
    pub shape: ShapeSpec,
    /// Name of the material; left out for a rigid body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// A body without unknowns that moves as one piece, as its drive says.
    #[serde(default)]
    pub rigid: bool,
    /// Shape functions.
    #[serde(default = "quadratic")]
    pub basis: BasisSpec,
    /// How the change of volume enters the energy; matters above a Poisson's ratio of 0.4.
    #[serde(default)]
    pub volumetric: Volumetric,
    /// Number of elements along x and y; of a rigid body only that along its contact edge matters.
    #[schemars(schema_with = "element_counts")]
    pub elements: [usize; 2],
    /// Where elements are finer; uniform if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grading: Option<Grading>,
    /// Displacement `[dx, dy]` that places the shape (length).
    #[serde(default)]
    pub position: [f64; 2],
    /// Rotation about `position` after placing, in degrees, counter-clockwise.
    #[serde(default)]
    pub rotation: f64,
    /// Velocity `[vx, vy]` of the whole body at time 0 (length/time), with `[dynamics]` only; at rest if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[f64; 2]>,
}

fn quadratic() -> BasisSpec {
    BasisSpec::Nurbs { degree: 2 }
}

fn element_counts(_: &mut SchemaGenerator) -> Schema {
    let count = json_schema!({ "type": "integer", "minimum": 1, "maximum": 100_000 });
    json_schema!({ "type": "array", "items": count, "minItems": 2, "maxItems": 2 })
}

/// An edge of a body.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// Name of the body.
    pub body: String,
    /// Edge of the body.
    pub edge: Edge,
}

/// Two edges that may touch, and the law of friction between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactSpec {
    /// The side that carries multipliers and integration points; must be deformable.
    pub nonmortar: Side,
    /// The side that is projected onto.
    pub mortar: Side,
    /// Friction law; `asperity laws` lists them with their parameters.
    #[schemars(schema_with = "asperity_laws::schema")]
    pub law: toml::Table,
    /// How the contact is discretized; the defaults need no user.
    #[serde(default)]
    pub numerics: Numerics,
}

/// Duration and nominal steps. Time starts at 0; the program may cut and regrow a step, outputs land on nominal times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeSpec {
    /// Time at the end (time).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: f64,
    /// Number of nominal steps.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub steps: usize,
    /// How often a step may be halved before the analysis stops.
    #[serde(default = "max_cuts")]
    #[schemars(range(min = 0, max = 40))]
    pub max_cuts: u32,
}

fn max_cuts() -> u32 {
    12
}

/// What is written besides `history.csv` and `run.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputSpec {
    /// Every n-th nominal step as `.vtu`; 0: never.
    pub fields: usize,
    /// Every n-th nominal step into `interface.csv`; 0: never.
    pub interface: usize,
    /// Figures as SVG and PNG.
    pub figures: bool,
}

impl Default for OutputSpec {
    fn default() -> Self {
        Self { fields: 10, interface: 1, figures: true }
    }
}
