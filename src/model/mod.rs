//! All that is fixed during an analysis, the state that moves, and their evaluation.

mod assembly;
mod body;
mod build;
mod choices;
mod continued;
mod drag;
mod equations;
mod inertia;
mod linearised;
mod loaded;
mod motion;
mod rates;
mod record;
mod state;
mod viscosity;

pub use crate::contact::{ContactStatus, Tangent};
pub use assembly::{Evaluation, evaluate, explain, suggested_step};
pub use body::{Body, BodyKind};
pub use build::{BodySpec, Builder, ModelError, PairSpec};
pub use drag::Drag;
pub use equations::{Dof, Equations};
pub use inertia::{Inertia, Matter};
pub use linearised::Linearised;
pub use loaded::{Loaded, load};
pub use motion::{Control, Motion, Table};
pub use rates::{RateForces, Rates};
pub use record::{InterfaceRow, Record, interface_rows, record, resistance};
pub use state::{Ledger, PairState, State, Trend};
pub use viscosity::Viscosity;

use std::sync::Arc;

use crate::contact::{ContactDiscretization, Mortar};

/// One side of a contact pair: control points of an edge of a body.
#[derive(Clone, Debug)]
pub struct Side {
    /// Body.
    pub body: usize,
    /// Numbers of the control points of the edge, over all bodies.
    pub nodes: Vec<usize>,
}

/// Two edges that may touch.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Carries multipliers.
    pub nonmortar: Side,
    /// Is projected onto.
    pub mortar: Side,
    /// The discretization.
    pub contact: Arc<Mortar>,
    /// First multiplier unknown.
    pub offset: usize,
}

impl Pair {
    /// Number of multiplier unknowns.
    pub fn unknowns(&self) -> usize {
        self.contact.multipliers() * if self.contact.rubs() { 2 } else { 1 }
    }

    /// Control points of the two contact curves, nonmortar first.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        self.nonmortar.nodes.iter().chain(&self.mortar.nodes).copied()
    }
}

/// Bodies, motions, contact pairs and the numbering of their unknowns.
#[derive(Clone, Debug)]
pub struct Model {
    /// Bodies in scene order.
    pub bodies: Vec<Body>,
    /// Prescribed displacements and forces, one per component.
    pub motions: Vec<Motion>,
    /// Contact pairs.
    pub pairs: Vec<Pair>,
    /// Numbering of the displacement unknowns and pattern of the bulk stiffness.
    pub equations: Equations,
    /// Displacement unknowns of the contact edges, in increasing order.
    pub boundary: Arc<[usize]>,
    /// The body whose resistance and support are reported, see [`Record`].
    pub driven: usize,
    /// Stress scale: the smallest Young's modulus.
    pub modulus: f64,
    /// How much stiffer against changes of volume the bodies are than at a Poisson's ratio of 0.4, at least 1: see
    /// [`confinement`](crate::bulk::confinement).
    pub confinement: f64,
    /// Stress scale of the body behind each equation, confinement included: what round-off there is measured by.
    pub stiffness: Vec<f64>,
    /// A quarter of the shortest contact edge: what a driven body may travel in one step without passing through another
    /// unseen.
    pub stride: f64,
    /// Length scale: shortest element of the contact edges (mean element of the bodies where there is no contact).
    pub element_size: f64,
    /// Mass and integrator, where inertia is modelled.
    pub inertia: Option<Inertia>,
    /// Viscous stresses, where there are any.
    pub viscosity: Option<Viscosity>,
}

impl Model {
    /// The same model with the augmentations of all pairs taken to a power: `1` leaves them, `0` makes them `E/h`.
    pub fn eased(&self, power: f64) -> Self {
        let ease = |pair: &Pair| Pair { contact: Arc::new(pair.contact.eased(power)), ..pair.clone() };
        Self { pairs: self.pairs.iter().map(ease).collect(), ..self.clone() }
    }

    /// Number of control points of all bodies.
    pub fn nodes(&self) -> usize {
        self.bodies.last().map_or(0, |b| b.offset + b.points.len())
    }

    /// Number of all unknowns.
    pub fn unknowns(&self) -> usize {
        self.equations.count + self.pairs.iter().map(Pair::unknowns).sum::<usize>()
    }

    /// Reference positions of all control points.
    pub fn reference(&self) -> impl Iterator<Item = crate::geometry::Point> + '_ {
        self.bodies.iter().flat_map(|b| b.points.iter().copied())
    }

    /// Largest coordinate extent of the bodies.
    pub fn size(&self) -> f64 {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for x in self.reference() {
            for c in 0..2 {
                low[c] = low[c].min(x[c]);
                high[c] = high[c].max(x[c]);
            }
        }
        (high[0] - low[0]).max(high[1] - low[1])
    }
}
