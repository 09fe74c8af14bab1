//! Numerical choices, of one contact and of the solution: measured by the trade study, defaulted for everybody else.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::Basis;
use crate::math::{CondensedSolver, LinearSolver, SparseLu};
use crate::solve::Strategy;

/// How a contact is discretized.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Numerics {
    /// Where the contact conditions hold.
    pub sites: Sites,
    /// How a nonmortar point finds its partner.
    pub projection: Projection,
    /// How the nonmortar edge is cut for integration.
    pub integration: Integration,
    /// Gauss points on each element or segment; if left out degree + 1, at least 3. Twice as many on elements that meet quadratic
    /// Lagrange elements, and at least one for each mortar element that a nonmortar element meets.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 32))]
    pub points: Option<usize>,
    /// Factor on the normal augmentation `E/h` (dimensionless).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub r: f64,
    /// Factor on the tangential augmentation `E/h` (dimensionless); as `r` if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub r_tangential: Option<f64>,
    /// Degree of the multipliers: that of the nonmortar edge, or lower by an even number; on quadratic Lagrange elements also 1.
    /// If left out that of the edge, but 1 where quadratic Lagrange elements meet others without segments.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 8))]
    pub multiplier_degree: Option<usize>,
}

impl Default for Numerics {
    fn default() -> Self {
        Self {
            sites: Sites::Quadrature,
            projection: Projection::Auto,
            integration: Integration::Auto,
            points: None,
            r: 1.0,
            r_tangential: None,
            multiplier_degree: None,
        }
    }
}

/// How the change of volume enters the energy of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Volumetric {
    /// Near incompressibility (Poisson's ratio above 0.4) dilatations are projected onto a coarser space, so that nothing locks
    /// and the pressure does not oscillate; see `asperity check`.
    #[default]
    Auto,
    /// At each quadrature point as it is: locks near incompressibility.
    Standard,
}

/// Where the contact conditions hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sites {
    /// Quadrature points, each with its own gap and slip: resolves a contact edge inside an element.
    Quadrature,
    /// Control points, with weighted averages: the solution does not depend on `r` at all.
    Nodal,
}

/// How a nonmortar point finds its partner on the mortar curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// The closest point.
    Closest,
    /// Along the nonmortar normal: smooth at the corners of a polygon.
    Ray,
    /// `closest` on smooth mortar curves, `ray` on those with corners.
    Auto,
}

/// How the nonmortar edge is cut for integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Integration {
    /// Gauss points on the nonmortar elements.
    Element,
    /// Gauss points on segments between the ends of nonmortar and projected mortar elements: passes the patch test exactly.
    Segment,
    /// `element`.
    Auto,
}

/// How the equations of a step are solved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solution {
    /// Solver of the linear systems.
    pub solver: Solver,
    /// How a Newton iteration treats contact. The solution does not depend on it.
    pub strategy: Strategy,
    /// Viscous regularisation: relaxation time of the bodies in units of `time.end`; 0: none. A path of equilibria that ends is then
    /// followed on in time instead of being crossed, and what viscosity takes is reported.
    #[schemars(extend("minimum" = 0))]
    pub viscosity: f64,
    /// Solve every accepted step a second time by the conic method and compare (`run --certify` and `asperity certify` set it).
    pub certify: bool,
}

/// Solver of the linear systems. The solution does not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// The inside of the bodies by sparse Cholesky, contact unknowns and multipliers by dense LU: several times faster.
    #[default]
    Condensed,
    /// Sparse LU of the whole matrix: the reference.
    SparseLu,
}

impl Solver {
    /// A solver of this kind.
    pub fn create(self) -> Box<dyn LinearSolver> {
        match self {
            Self::Condensed => Box::new(CondensedSolver::default()),
            Self::SparseLu => Box::new(SparseLu::default()),
        }
    }
}

/// Degrees of multipliers on the elements of `edge` that do not let the pressure oscillate, highest first.
///
/// Splines of degree `p` carry multipliers of degree `p`, `p - 2`, ...; with `p - 1` the pair is unstable (Brivadis, Buffa,
/// Wohlmuth, Wunderlich, CMAME 284 (2015) 292; measured on Hertz: ten times the error of degree `p`). Quadratic Lagrange
/// elements have twice as many functions as linear multipliers, so those are stable (Puso, Laursen, Solberg 2008).
pub(super) fn stable_degrees(edge: &dyn Basis) -> Vec<usize> {
    let highest = edge.degree();
    let quadratic_elements = edge.name() == "lagrange" && highest == 2;
    (0..=highest).rev().filter(|degree| (highest - degree).is_multiple_of(2) || quadratic_elements).collect()
}
