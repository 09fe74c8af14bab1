//! What a contact discretization takes and gives: the seam between kinematics, laws and the model.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};

use crate::geometry::Point;
use crate::math::{Triplets, Vec2};

/// How a nonmortar point finds its partner on the mortar curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Closest point of the mortar curve.
    Closest,
    /// Intersection of the nonmortar normal with the mortar curve: smooth at mortar corners.
    Ray,
}

/// Where the contact conditions hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sites {
    /// Control points, with weighted averages of gap and slip.
    Nodal,
    /// Quadrature points, each with its own gap and slip.
    Quadrature,
}

/// How the nonmortar edge is cut for integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integration {
    /// Gauss points on the nonmortar elements.
    Element,
    /// Gauss points on segments bounded by the ends of nonmortar and (projected) mortar elements.
    Segment,
}

/// Numerical choices of a pair, all resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numerics {
    /// Where the conditions hold.
    pub sites: Sites,
    /// How partners are found.
    pub projection: Projection,
    /// How the edge is cut.
    pub integration: Integration,
    /// Gauss points per element or segment.
    pub points: usize,
    /// Augmentation of the pressure in units of `E/h`.
    pub r: f64,
    /// Augmentation of the traction in units of `E/h`.
    pub r_tangential: f64,
}

/// Derivative that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tangent {
    /// None: forces only.
    None,
    /// The consistent one.
    Exact,
    /// Consistent but for the slope of the law in the slip where friction falls as the slip grows, which is left out (the bound
    /// is then lagged from one iteration to the next). Converges linearly, but also where the exact one does not.
    Lagged,
}

/// State of a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactStatus {
    /// No contact.
    Open,
    /// Contact, the traction below its bound.
    Stick,
    /// Contact, the traction at its bound (always so without friction, and for direct laws).
    Slip,
}

impl std::fmt::Display for ContactStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Slip => "slip",
        })
    }
}

/// Positions of the control points of the two contact curves.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// Nonmortar control points.
    pub nonmortar: &'a [Point],
    /// Mortar control points.
    pub mortar: &'a [Point],
}

/// What a site remembers from one step to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SiteMemory {
    /// Reference arc length along the nonmortar edge: finds the site again where the sites move (segments).
    pub arc: f64,
    /// Slip that the site has made without friction work, `(q^ - q)/r_T`: zero at nodal sites; at quadrature sites the
    /// small deflection by which the stabilisation lets a sticking site move, see [`super::complementarity()`].
    pub deflection: f64,
    /// Projected traction `q^` (nominal).
    pub traction: f64,
    /// `p - r_N g`: the pressure of a closed site, negative where open; 0 without a partner.
    pub closure: f64,
    /// Internal variables of the law.
    pub variables: Vec<f64>,
}

/// The interface at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct InterfaceStart<'a> {
    /// Positions at the start of the step.
    pub at: Configuration<'a>,
    /// Memory of the sites; empty before the first step.
    pub sites: &'a [SiteMemory],
}

/// The interface tried as the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct InterfaceTrial<'a> {
    /// Positions tried.
    pub at: Configuration<'a>,
    /// Pressure multipliers (nominal stress, one per multiplier function).
    pub pressure: &'a [f64],
    /// Traction multipliers; empty when nothing rubs.
    pub traction: &'a [f64],
    /// Time step.
    pub dt: f64,
}

/// One site at the end of an evaluation, for records and audits.
#[derive(Clone, Debug)]
pub struct SiteRecord {
    /// Nonmortar position.
    pub x: Point,
    /// Reference arc length along the nonmortar edge.
    pub arc: f64,
    /// Unit vector along which the pressure acts on the nonmortar body.
    pub normal: Vec2,
    /// Unit tangent: slip and traction are positive along it.
    pub tangent: Vec2,
    /// Pressure per current length (Cauchy).
    pub pressure: f64,
    /// Tangential traction per current length (Cauchy).
    pub traction: f64,
    /// Gap; `NaN` without a projection.
    pub gap: f64,
    /// Slip increment of the step; `NaN` without a projection.
    pub slip: f64,
    /// Open, stick or slip.
    pub status: ContactStatus,
    /// Reference length that belongs to the site.
    pub weight: f64,
    /// Reference length of the nonmortar element it lies on (a harmonic mean where there are several).
    pub element: f64,
    /// Boundary stretch, current over reference length.
    pub stretch: f64,
    /// Internal variables of the law at the end of the step.
    pub variables: Vec<f64>,
    /// Fall of the traction with the slip of the step, `max(0, -d|q|/d|s|)` (nominal stress over length).
    pub weakening: f64,
    /// True where the site carried pressure at the start of the step and does at its end, but on another flank of the mortar curve.
    pub jumped: bool,
}

/// Forces, multiplier rows and tangent of one contact pair. Local unknowns are numbered: control points of the
/// nonmortar curve, then of the mortar curve (two each), then pressure multipliers, then traction multipliers.
#[derive(Clone, Debug, Default)]
pub struct InterfaceForces {
    /// Contribution to the residual at the control points, nonmortar first (internal-force sign).
    pub forces: Vec<Point>,
    /// Residual of the multiplier rows (length squared): `sum_a M_aA w_a (p^ - p)/r`, then those of the traction.
    pub multiplier_rows: Vec<f64>,
    /// Derivative of all of it; empty when no tangent was asked for.
    pub tangent: Triplets,
    /// The sites.
    pub sites: Vec<SiteRecord>,
    /// Memory of the sites at the end of the step.
    pub memory: Vec<SiteMemory>,
    /// Force on the nonmortar body from the pressure alone.
    pub normal_force: Vec2,
    /// Force on the nonmortar body from friction alone.
    pub friction_force: Vec2,
    /// Work of friction over the step, `sum w q^ (s - change of the deflection)` with the mean of `q^` over the step
    /// (trapezoidal rule; the final value where `q^` changes its sign), and only the share of the step in which the site was
    /// closed: never negative for a set-valued law.
    pub dissipated: f64,
    /// Largest penetration at an integration point in contact.
    pub penetration: f64,
    /// Smallest gap at any integration point that has a partner (infinite where none has).
    pub smallest_gap: f64,
    /// Moment of all interface forces about the origin (zero to round-off), and the scale to judge it by.
    pub moment: [f64; 2],
}

/// A way to discretise the contact of two curves. `evaluate` is a pure function of its arguments.
pub trait ContactDiscretization: Debug + Send + Sync {
    /// Number of pressure multipliers (and of traction multipliers where the pair rubs).
    fn multipliers(&self) -> usize;
    /// False when the law transmits no tangential traction: no tangential unknowns then.
    fn rubs(&self) -> bool;
    /// Augmentation `r = E/h` (stress/length) that scales the multiplier unknowns.
    fn augmentation(&self) -> f64;
    /// Names of the internal variables of one site.
    fn variable_names(&self) -> Vec<String>;
    /// Longest time step that the law accepts at the closed sites found, infinite without opinion; `memory` is that of the
    /// start of the step of length `dt`.
    fn suggested_step(&self, memory: &[SiteMemory], found: &InterfaceForces, dt: f64) -> f64;
    /// Why the law gave no number, with place and values, at the first site where that is so; arguments as in
    /// [`Self::suggested_step`].
    fn explain(&self, memory: &[SiteMemory], found: &InterfaceForces, dt: f64) -> Option<String>;
    /// Forces and, where asked for, the tangent.
    fn evaluate(&self, start: &InterfaceStart, trial: &InterfaceTrial, tangent: Tangent) -> InterfaceForces;
}
