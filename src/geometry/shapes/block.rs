//! Rectangle with profiles: the recommended body for asperities and, with an `arc`, for Hertz contact.

use std::path::Path;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::grading::Grading;
use super::mesh::{Breaks, Joint};
use super::outline::Outline;
use super::profile::Profile;
use super::{BasisSpec, increasing};
use crate::geometry::refine::{Homogeneous, combine, project};
use crate::geometry::{Basis, Curve, Edge, GeometryError, Patch};

/// Rectangle `x[0] <= x <= x[1]`, `y[0] <= y <= y[1]` whose top edge is raised and whose bottom edge is lowered by a
/// profile.
///
/// The parameter `u` is x itself: `x(u, v) = u`, except on edges with exact arcs, where the two agree at the joints
/// only. `v` runs from 0 to 1; lines of constant `u` are straight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Left and right end.
    pub x: [f64; 2],
    /// Bottom and top edge without profile.
    pub y: [f64; 2],
    /// Profile of the top edge, pointing up.
    #[serde(default)]
    pub top: Profile,
    /// Profile of the bottom edge, pointing down.
    #[serde(default)]
    pub bottom: Profile,
}

impl Block {
    /// The body: ruled between its bottom and its top edge, linear in `v` in homogeneous coordinates.
    pub(super) fn patch(
        &self,
        spec: &BasisSpec,
        elements: [usize; 2],
        grading: Option<&Grading>,
        base_dir: &Path,
    ) -> Result<Patch, GeometryError> {
        let bottom = self.outline(Edge::Bottom, base_dir)?;
        let top = self.outline(Edge::Top, base_dir)?;
        let u = self.basis_u(&[&bottom, &top], spec, elements[0], grading)?;
        let v = basis_v(spec, elements[1], grading)?;
        let lower = bottom.control(&u, spec, self.y[0], -1.0);
        let upper = top.control(&u, spec, self.y[1], 1.0);
        self.check_thickness(u.as_ref(), &lower, &upper)?;
        let rule = |t: f64| {
            let lines = lower.iter().zip(&upper);
            lines.map(move |(a, b)| a * (1.0 - t) + b * t)
        };
        let net: Vec<Homogeneous> = v.nodes().into_iter().flat_map(rule).collect();
        let (points, weights) = project(&net);
        Ok(Patch { basis: [u, v], weights, points })
    }

    /// One edge alone.
    pub(super) fn edge(
        &self,
        edge: Edge,
        spec: &BasisSpec,
        elements: [usize; 2],
        grading: Option<&Grading>,
        base_dir: &Path,
    ) -> Result<Curve, GeometryError> {
        let (y, sign) = match edge {
            Edge::Bottom => (self.y[0], -1.0),
            Edge::Top => (self.y[1], 1.0),
            Edge::Left | Edge::Right => {
                return Ok(self.patch(spec, elements, grading, base_dir)?.boundary(edge));
            }
        };
        let outline = self.outline(edge, base_dir)?;
        let basis = self.basis_u(&[&outline], spec, elements[0], grading)?;
        let (points, weights) = project(&outline.control(&basis, spec, y, sign));
        Ok(Curve { basis, weights, nodes: (0..points.len()).collect(), points, side: sign })
    }

    fn outline(&self, edge: Edge, base_dir: &Path) -> Result<Outline, GeometryError> {
        increasing("x", self.x)?;
        increasing("y", self.y)?;
        match edge {
            Edge::Top => self.top.outline(self.x, base_dir, "top"),
            _ => self.bottom.outline(self.x, base_dir, "bottom"),
        }
    }

    /// Basis along x with an element end on the joints of all given outlines.
    fn basis_u(
        &self,
        outlines: &[&Outline],
        spec: &BasisSpec,
        count: usize,
        grading: Option<&Grading>,
    ) -> Result<Arc<dyn Basis>, GeometryError> {
        let density = Grading::density(grading, 0, self.x)?;
        let joints = outlines.iter().flat_map(|o| o.joints.iter().copied());
        let joints = merge(joints.collect(), self.x, |a, b| density.share(a, b) * count as f64);
        Breaks::new(self.x, &joints, count, &density, 0)?.basis(spec)
    }

    /// The profiles must leave material between them; tested at several points per element.
    fn check_thickness(
        &self,
        basis: &dyn Basis,
        lower: &[Homogeneous],
        upper: &[Homogeneous],
    ) -> Result<(), GeometryError> {
        for b in basis.breaks().windows(2) {
            for i in 0..=8 {
                let u = b[0] + (b[1] - b[0]) * f64::from(i) / 8.0;
                let (l, t) = (combine(basis, lower, u), combine(basis, upper, u));
                let thickness = t.y / t.z - l.y / l.z;
                if thickness.is_nan() || thickness <= 0.0 {
                    let message = format!(
                        "the profiles must leave a positive thickness between bottom and top, it is {thickness} at x = {u}"
                    );
                    return Err(GeometryError::shape("y", message));
                }
            }
        }
        Ok(())
    }
}

fn basis_v(spec: &BasisSpec, count: usize, grading: Option<&Grading>) -> Result<Arc<dyn Basis>, GeometryError> {
    let range = [0.0, 1.0];
    let density = Grading::density(grading, 1, range)?;
    Breaks::new(range, &[], count, &density, 1)?.basis(spec)
}

/// Sorts joints and merges equal ones. A smooth joint (continuity 1 or more) that would cut off less than a quarter of
/// an element (`count(a, b)` elements fit between two places) is dropped: a sliver costs more than it gains.
fn merge(mut joints: Vec<Joint>, range: [f64; 2], count: impl Fn(f64, f64) -> f64) -> Vec<Joint> {
    let tolerance = 1e-9 * (range[1] - range[0]);
    joints.retain(|j| range[0] + tolerance < j.at && j.at < range[1] - tolerance);
    // kinks first, so that they win over smooth joints near by
    joints.sort_by(|a, b| (a.continuity, a.at).partial_cmp(&(b.continuity, b.at)).unwrap_or(std::cmp::Ordering::Equal));
    let mut kept: Vec<Joint> = Vec::with_capacity(joints.len());
    for joint in joints {
        let near = |at: f64| {
            let distance = (at - joint.at).abs();
            let sliver = count(at.min(joint.at), at.max(joint.at)) < 0.25;
            distance <= tolerance || (joint.continuity > 0 && sliver)
        };
        if !kept.iter().map(|k| k.at).chain(range).any(near) {
            kept.push(joint);
        }
    }
    kept.sort_by(|a, b| a.at.total_cmp(&b.at));
    kept
}
