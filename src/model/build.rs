//! Building a model from bodies, motions and contact pairs.

use std::collections::BTreeSet;
use std::sync::Arc;

use asperity_laws::FrictionLaw;

use crate::bulk::{Elements, Material, VolumeSpace, confinement};
use crate::contact::{Integration, Mortar, Projection, Sites};
use crate::geometry::{Basis, Curve, Edge, Patch, Point};
use crate::math::gauss;

use super::body::{Body, BodyKind};
use super::choices::{multiplier, resolve};
use super::equations::{Dof, Equations};
use super::motion::{Control, Motion};
use super::{Model, Pair, Side};

/// Why a model cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// No body of that name.
    #[error("there is no body '{0}'")]
    UnknownBody(String),
    /// A rigid body consists of the edges it was given.
    #[error("rigid body '{body}' has no {edge:?} edge")]
    NoEdge {
        /// Body.
        body: String,
        /// Edge asked for.
        edge: Edge,
    },
    /// The map from parameters to the body is not invertible.
    #[error("the geometry of body '{0}' folds over itself (its Jacobian is not positive)")]
    Folded(String),
    /// Contact between two rigid bodies.
    #[error("bodies '{0}' and '{1}' are both rigid: one side of a contact must deform")]
    BothRigid(String, String),
}

/// What a body is given as.
pub enum BodySpec {
    /// Patch and material.
    Deformable(Patch, Arc<dyn Material>),
    /// Contact edges.
    Rigid(Vec<(Edge, Curve)>),
}

/// A contact pair and its choices; `None` leaves a choice to the program.
pub struct PairSpec {
    /// Body and edge that carry multipliers.
    pub nonmortar: (String, Edge),
    /// Body and edge projected onto.
    pub mortar: (String, Edge),
    /// Friction law.
    pub law: Arc<dyn FrictionLaw>,
    /// Where the conditions hold; default `quadrature`.
    pub sites: Option<Sites>,
    /// Projection; default closest point, ray where the mortar curve has corners.
    pub projection: Option<Projection>,
    /// Integration; default element by element.
    pub integration: Option<Integration>,
    /// Gauss points per element or segment; default degree + 1, at least 3, twice as many where a mortar curve of degree 2 or
    /// more has corners inside, and at least one for each mortar element.
    pub points: Option<usize>,
    /// Augmentation of the pressure in units of `E/h`; default 1.
    pub r: Option<f64>,
    /// Augmentation of the traction in units of `E/h`; default as for the pressure.
    pub r_tangential: Option<f64>,
    /// Multiplier basis on the spans of the nonmortar edge; default the functions of the edge, linear ones for quadratic Lagrange
    /// elements that are integrated across corners of the mortar curve.
    pub multiplier: Option<Arc<dyn Basis>>,
}

impl PairSpec {
    /// A pair with all numerical choices left to the program.
    pub fn new(nonmortar: (&str, Edge), mortar: (&str, Edge), law: Arc<dyn FrictionLaw>) -> Self {
        Self {
            nonmortar: (nonmortar.0.into(), nonmortar.1),
            mortar: (mortar.0.into(), mortar.1),
            law,
            sites: None,
            projection: None,
            integration: None,
            points: None,
            r: None,
            r_tangential: None,
            multiplier: None,
        }
    }
}

/// Collects bodies, motions and pairs.
#[derive(Default)]
pub struct Builder {
    bodies: Vec<Body>,
    motions: Vec<Motion>,
    pairs: Vec<PairSpec>,
}

impl Builder {
    /// Adds a body.
    ///
    /// # Errors
    /// [`ModelError::Folded`] where the patch is not invertible.
    pub fn body(&mut self, name: &str, spec: BodySpec) -> Result<&mut Self, ModelError> {
        let volume = match &spec {
            BodySpec::Deformable(patch, material) => VolumeSpace::needed(patch, material.as_ref()),
            BodySpec::Rigid(_) => None,
        };
        self.body_in(name, spec, volume)
    }

    /// Adds a body whose dilatations are projected onto a space (`None`: not projected).
    ///
    /// # Errors
    /// As [`Self::body`].
    pub fn body_in(
        &mut self,
        name: &str,
        spec: BodySpec,
        volume: Option<VolumeSpace>,
    ) -> Result<&mut Self, ModelError> {
        let offset = self.bodies.last().map_or(0, |b| b.nodes().end);
        let (kind, points) = match spec {
            BodySpec::Deformable(patch, material) => {
                let elements = Elements::new(&patch, volume).ok_or_else(|| ModelError::Folded(name.into()))?.into();
                let points = patch.points.clone();
                (BodyKind::Deformable { patch, elements, material }, points)
            }
            BodySpec::Rigid(mut curves) => {
                let mut points = Vec::new();
                for (_, curve) in &mut curves {
                    curve.nodes = (points.len()..points.len() + curve.points.len()).collect();
                    points.extend_from_slice(&curve.points);
                }
                (BodyKind::Rigid { curves }, points)
            }
        };
        self.bodies.push(Body { name: name.into(), kind, offset, points });
        Ok(self)
    }

    /// Moves one component of an edge (of the whole body, where it is rigid).
    ///
    /// # Errors
    /// Unknown body.
    pub fn motion(
        &mut self,
        body: &str,
        edge: Edge,
        component: usize,
        control: Control,
        drive: bool,
    ) -> Result<&mut Self, ModelError> {
        let k = self.find(body)?;
        let body = &self.bodies[k];
        let nodes = match body.patch() {
            Some(patch) => patch.boundary(edge).nodes.iter().map(|i| body.offset + i).collect(),
            None => body.nodes().collect(),
        };
        self.motions.push(Motion { body: k, nodes, component, control, drive });
        Ok(self)
    }

    /// Adds a contact pair.
    pub fn contact(&mut self, pair: PairSpec) -> &mut Self {
        self.pairs.push(pair);
        self
    }

    /// Numbers the unknowns.
    ///
    /// # Errors
    /// Unknown bodies or edges, contact between rigid bodies.
    pub fn build(self) -> Result<Model, ModelError> {
        let equations = Equations::new(&self.bodies, &self.motions);
        let mut offset = equations.count;
        let mut pairs = Vec::new();
        let mut element_size = f64::INFINITY;
        for spec in &self.pairs {
            let (pair, size) = self.pair(spec, offset)?;
            offset += pair.unknowns();
            element_size = element_size.min(size);
            pairs.push(pair);
        }
        let materials = || self.bodies.iter().filter_map(Body::material);
        let modulus = materials().map(|m| m.youngs_modulus()).fold(f64::INFINITY, f64::min);
        let confinement = materials().map(|m| confinement(m.as_ref())).fold(1.0, f64::max);
        let mut stiffness = vec![modulus * confinement; offset];
        self.bodies.iter().for_each(|body| stiffen(body, &equations, &mut stiffness));
        let driven = self.motions.iter().find(|m| m.drive).map(|m| m.body);
        Ok(Model {
            stride: pairs.iter().flat_map(|p| [&p.nonmortar, &p.mortar]).fold(f64::INFINITY, |m, side| {
                let points = || side.nodes.iter().map(|&i| point(&self.bodies, i));
                m.min(0.25 * points().zip(points().skip(1)).map(|(a, b)| (b - a).norm()).sum::<f64>())
            }),
            driven: driven.or(pairs.first().map(|p| p.nonmortar.body)).unwrap_or(0),
            modulus,
            confinement,
            stiffness,
            element_size: if element_size.is_finite() { element_size } else { mean_element(&self.bodies) },
            bodies: self.bodies,
            motions: self.motions,
            boundary: boundary(&pairs, &equations),
            pairs,
            equations,
            inertia: None,
            viscosity: None,
        })
    }

    fn find(&self, name: &str) -> Result<usize, ModelError> {
        self.bodies.iter().position(|b| b.name == name).ok_or_else(|| ModelError::UnknownBody(name.into()))
    }

    fn side(&self, (name, edge): &(String, Edge)) -> Result<(Side, Curve), ModelError> {
        let k = self.find(name)?;
        let body = &self.bodies[k];
        let curve = body.edge(*edge).ok_or_else(|| ModelError::NoEdge { body: name.clone(), edge: *edge })?;
        Ok((Side { body: k, nodes: curve.nodes.iter().map(|i| body.offset + i).collect() }, curve))
    }

    fn pair(&self, spec: &PairSpec, offset: usize) -> Result<(Pair, f64), ModelError> {
        let (nonmortar, edge) = self.side(&spec.nonmortar)?;
        let (mortar, target) = self.side(&spec.mortar)?;
        let moduli = [nonmortar.body, mortar.body].map(|k| self.bodies[k].material().map(|m| m.youngs_modulus()));
        let modulus = moduli.into_iter().flatten().reduce(f64::min);
        let modulus = modulus.ok_or_else(|| ModelError::BothRigid(spec.nonmortar.0.clone(), spec.mortar.0.clone()))?;
        let numerics = resolve(spec, &edge, &target);
        let multiplier = spec.multiplier.clone().or_else(|| multiplier(&edge, &target, numerics.integration));
        let contact = Mortar::new(edge, target, spec.law.clone(), multiplier, numerics, modulus);
        let size = modulus / crate::contact::ContactDiscretization::augmentation(&contact);
        Ok((Pair { nonmortar, mortar, contact: Arc::new(contact), offset }, size))
    }
}

/// Raises the stress scale of the equations of a body to its own.
fn stiffen(body: &Body, equations: &Equations, stiffness: &mut [f64]) {
    let Some(material) = body.material() else { return };
    let own = material.youngs_modulus() * confinement(material.as_ref());
    for dof in equations.dofs[body.nodes()].as_flattened() {
        if let Dof::Unknown(e) = *dof {
            stiffness[e] = stiffness[e].max(own);
        }
    }
}

/// Displacement unknowns of the contact edges, each once.
fn boundary(pairs: &[Pair], equations: &Equations) -> Arc<[usize]> {
    let nodes = pairs.iter().flat_map(|pair| pair.nonmortar.nodes.iter().chain(&pair.mortar.nodes));
    let unknowns: BTreeSet<usize> = nodes.flat_map(|&i| (0..2).filter_map(move |c| equations.unknown(i, c))).collect();
    unknowns.into_iter().collect()
}

/// Reference position of a control point, counted over all bodies.
fn point(bodies: &[Body], node: usize) -> Point {
    let body = &bodies[bodies.partition_point(|b| b.nodes().end <= node)];
    body.points[node - body.offset]
}

/// Mean element length of a model without contact: square root of the mean element area.
fn mean_element(bodies: &[Body]) -> f64 {
    let mut total = (0.0, 0);
    for body in bodies {
        if let BodyKind::Deformable { elements, .. } = &body.kind {
            total = (total.0 + elements.area(), total.1 + elements.count());
        }
    }
    if total.1 == 0 { gauss(1).weights[0] } else { (total.0 / total.1 as f64).sqrt() }
}
