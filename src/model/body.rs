//! Deformable and rigid bodies.

use std::sync::Arc;

use crate::bulk::{Elements, Material, VolumeSpace};
use crate::geometry::{Curve, Edge, Patch, Point};

/// What a body is made of.
#[derive(Clone, Debug)]
pub enum BodyKind {
    /// A patch with a material; its control points are unknowns.
    Deformable {
        /// Geometry and basis.
        patch: Patch,
        /// Reference gradients and weights.
        elements: Box<Elements>,
        /// Constitutive model.
        material: Arc<dyn Material>,
    },
    /// Contact edges only; no unknowns of its own, moves as one piece.
    Rigid {
        /// Edges that take part in contact.
        curves: Vec<(Edge, Curve)>,
    },
}

/// A body of the model.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in the scene.
    pub name: String,
    /// Deformable or rigid.
    pub kind: BodyKind,
    /// Number of its first control point over all bodies.
    pub offset: usize,
    /// Reference control points.
    pub points: Vec<Point>,
}

impl Body {
    /// The patch of a deformable body.
    pub fn patch(&self) -> Option<&Patch> {
        match &self.kind {
            BodyKind::Deformable { patch, .. } => Some(patch),
            BodyKind::Rigid { .. } => None,
        }
    }

    /// The material of a deformable body.
    pub fn material(&self) -> Option<&Arc<dyn Material>> {
        match &self.kind {
            BodyKind::Deformable { material, .. } => Some(material),
            BodyKind::Rigid { .. } => None,
        }
    }

    /// How the change of volume enters the energy of a deformable body, and why.
    pub fn volumetric(&self) -> Option<String> {
        let BodyKind::Deformable { elements, material, .. } = &self.kind else { return None };
        let nu = material.poissons_ratio();
        Some(match (elements.volume(), VolumeSpace::asked_by(material.as_ref())) {
            (Some(space), _) => format!("dilatations projected onto {space}, because nu = {nu} > 0.4"),
            (None, false) => format!("dilatations at each point, enough for nu = {nu} <= 0.4"),
            (None, true) => format!("dilatations at each point, as demanded: locks at nu = {nu} > 0.4"),
        })
    }

    /// An edge, with `nodes` counted inside the body.
    pub fn edge(&self, edge: Edge) -> Option<Curve> {
        match &self.kind {
            BodyKind::Deformable { patch, .. } => Some(patch.boundary(edge)),
            BodyKind::Rigid { curves } => curves.iter().find(|(e, _)| *e == edge).map(|(_, c)| c.clone()),
        }
    }

    /// The curves of a rigid body.
    pub fn curves(&self) -> impl Iterator<Item = &Curve> {
        let curves: &[(Edge, Curve)] = match &self.kind {
            BodyKind::Deformable { .. } => &[],
            BodyKind::Rigid { curves } => curves,
        };
        curves.iter().map(|(_, curve)| curve)
    }

    /// True for a body without unknowns.
    pub fn is_rigid(&self) -> bool {
        matches!(self.kind, BodyKind::Rigid { .. })
    }

    /// Numbers of all its control points.
    pub fn nodes(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.points.len()
    }

    /// Mean reference position of the control points.
    pub fn centre(&self) -> Point {
        self.points.iter().sum::<Point>() / self.points.len() as f64
    }
}
