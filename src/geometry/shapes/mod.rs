//! The shapes a scene can name (`shape = { type = ... }`) and their meshes.
//!
//! Every shape but the block is an exact NURBS patch (`round`, `explicit`) that is then expressed in the basis of
//! the body (`mesh`): exactly for `nurbs`, through its nodes for `lagrange`. The block (`block`) is ruled between
//! a bottom and a top edge with a [`Profile`] each.

mod arcs;
mod block;
mod explicit;
mod grading;
mod heights;
mod mesh;
mod outline;
mod profile;
mod round;
mod table;

use std::path::Path;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use block::Block;
pub use explicit::Nurbs;
pub use grading::{Along, Grading};
pub use profile::{ArcProfile, Cosine, Csv, Flat, Polyline, Profile, Wedge};
pub use round::{AnnulusSector, Disk, HalfDisk, Round};

use super::{BSpline, Basis, Curve, Edge, GeometryError, Lagrange, MAX_DEGREE, Patch};

/// Shape of a body in its own coordinates; `position` of the body is added to all points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ShapeSpec {
    /// Rectangle whose bottom and top edge may carry a profile.
    Block(Block),
    /// Half disk with its round side down or up.
    HalfDisk(HalfDisk),
    /// Full disk.
    Disk(Disk),
    /// Part of a ring.
    AnnulusSector(AnnulusSector),
    /// Explicit NURBS patch.
    Nurbs(Nurbs),
}

/// Basis of the displacement and the geometry (`basis = { type = ..., degree = ... }`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum BasisSpec {
    /// Smooth splines, rational where the shape needs it.
    Nurbs {
        /// Polynomial degree, 1 to 8.
        degree: usize,
    },
    /// Continuous Lagrange polynomials.
    Lagrange {
        /// Polynomial degree, 1 or 2.
        degree: usize,
    },
}

impl BasisSpec {
    /// Polynomial degree.
    pub fn degree(&self) -> usize {
        match *self {
            Self::Nurbs { degree } | Self::Lagrange { degree } => degree,
        }
    }

    fn check(&self) -> Result<(), GeometryError> {
        let (highest, name) = match self {
            Self::Nurbs { .. } => (MAX_DEGREE, "nurbs"),
            Self::Lagrange { .. } => (2, "lagrange"),
        };
        if (1..=highest).contains(&self.degree()) {
            return Ok(());
        }
        let message = format!("a {name} basis has degree 1 to {highest}, not {}", self.degree());
        Err(GeometryError::outside("basis", "degree", message))
    }

    /// Basis on the given breaks with the given continuity (0: a kink is possible) at interior breaks.
    fn on(
        &self,
        breaks: Vec<f64>,
        continuity: impl Fn(usize) -> Option<usize>,
    ) -> Result<Arc<dyn Basis>, GeometryError> {
        Ok(match *self {
            Self::Lagrange { degree } => Arc::new(Lagrange::new(degree, breaks)?),
            Self::Nurbs { degree } => Arc::new(BSpline::from_breaks(degree, &breaks, |i| {
                continuity(i).map_or(1, |k| degree.saturating_sub(k).max(1))
            })?),
        })
    }
}

/// Builds the patch of a deformable body.
///
/// # Errors
/// If a value is not allowed, a profile file cannot be used, or the Jacobian is not positive inside every element.
pub fn build(
    spec: &ShapeSpec,
    basis: &BasisSpec,
    elements: [usize; 2],
    grading: Option<&Grading>,
    position: [f64; 2],
    base_dir: &Path,
) -> Result<Patch, GeometryError> {
    check_common(basis, elements, grading, position)?;
    let mut patch = patch_of(spec, basis, elements, grading, base_dir)?;
    mesh::check_jacobian(&patch)?;
    for point in &mut patch.points {
        *point += super::Point::from(position);
    }
    Ok(patch)
}

/// Builds one edge alone, for a rigid body. A block's edge does not depend on its opposite edge, and only the count of
/// `elements` along the edge matters.
///
/// # Errors
/// As [`build`].
pub fn build_edge(
    spec: &ShapeSpec,
    edge: Edge,
    basis: &BasisSpec,
    elements: [usize; 2],
    grading: Option<&Grading>,
    position: [f64; 2],
    base_dir: &Path,
) -> Result<Curve, GeometryError> {
    check_common(basis, elements, grading, position)?;
    let mut curve = match spec {
        ShapeSpec::Block(block) => block.edge(edge, basis, elements, grading, base_dir)?,
        other => patch_of(other, basis, elements, grading, base_dir)?.boundary(edge),
    };
    curve.nodes = (0..curve.points.len()).collect();
    for point in &mut curve.points {
        *point += super::Point::from(position);
    }
    Ok(curve)
}

/// The patch of a shape before it is moved to its position.
fn patch_of(
    spec: &ShapeSpec,
    basis: &BasisSpec,
    elements: [usize; 2],
    grading: Option<&Grading>,
    base_dir: &Path,
) -> Result<Patch, GeometryError> {
    let master = match spec {
        ShapeSpec::Block(block) => return block.patch(basis, elements, grading, base_dir),
        ShapeSpec::HalfDisk(shape) => shape.master(),
        ShapeSpec::Disk(shape) => shape.master(),
        ShapeSpec::AnnulusSector(shape) => shape.master(),
        ShapeSpec::Nurbs(shape) => shape.master(),
    };
    mesh::express(&master?, basis, elements, grading)
}

fn check_common(
    basis: &BasisSpec,
    elements: [usize; 2],
    grading: Option<&Grading>,
    position: [f64; 2],
) -> Result<(), GeometryError> {
    basis.check()?;
    if elements.contains(&0) {
        let message = format!("both counts must be at least 1, are {elements:?}");
        return Err(GeometryError::outside("elements", "", message));
    }
    if position.iter().any(|x| !x.is_finite()) {
        return Err(GeometryError::outside("position", "", "must be two finite numbers"));
    }
    grading.map_or(Ok(()), Grading::check)
}

/// Checks that a number is finite and positive.
fn positive(key: &str, value: f64) -> Result<(), GeometryError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(GeometryError::shape(key, format!("must be a finite number above 0, is {value}")))
}

/// Checks that all numbers are finite.
fn finite(key: &str, values: &[f64]) -> Result<(), GeometryError> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(v) => Err(GeometryError::shape(key, format!("must be finite numbers, one is {v}"))),
    }
}

/// Checks that a pair is finite and increasing.
fn increasing(key: &str, pair: [f64; 2]) -> Result<(), GeometryError> {
    finite(key, &pair)?;
    if pair[0] < pair[1] {
        return Ok(());
    }
    Err(GeometryError::shape(key, format!("must be [low, high] with low < high, is {pair:?}")))
}
