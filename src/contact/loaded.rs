//! A pair under given site forces: what the kinematics alone say, before any contact condition is asked.

use crate::geometry::Point;
use crate::math::Triplets;

use super::ContactDiscretization;
use super::complementarity::{SiteAnswer, SiteInput};
use super::interface::{Configuration, ContactStatus, InterfaceStart, InterfaceTrial, Tangent};
use super::mortar::Mortar;
use super::sites::recall;

/// Forces that a site is told to carry (nominal stresses).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SiteLoad {
    /// Reference arc length: finds the site again where the sites move (segments).
    pub arc: f64,
    /// Pressure `p^`.
    pub pressure: f64,
    /// Traction `q^`.
    pub traction: f64,
}

/// A sparse row over local displacement unknowns: `2 * control point + component`, nonmortar control points first.
pub type SiteRow = Vec<(usize, f64)>;

/// A site without its conditions.
#[derive(Clone, Debug)]
pub struct SiteKinematics {
    /// Reference arc length along the nonmortar edge.
    pub arc: f64,
    /// Position, for laws that vary in space.
    pub position: [f64; 2],
    /// Reference length that belongs to the site.
    pub weight: f64,
    /// Gap; `NaN` without a partner.
    pub gap: f64,
    /// Slip increment of the step; `NaN` without a partner.
    pub slip: f64,
    /// Boundary stretch.
    pub stretch: f64,
    /// Augmentations `[r_N, r_T]` (stress/length).
    pub r: [f64; 2],
    /// `(multiplier, M_aA)`.
    pub reads: Vec<(usize, f64)>,
    /// Deflection at the start of the step, see [`super::complementarity()`].
    pub deflection: f64,
    /// Internal variables at the start of the step.
    pub old: Vec<f64>,
    /// What the site was told to carry: `[p^, q^]` (nominal).
    pub load: [f64; 2],
    /// Virtual gap of the site; empty without a partner.
    pub gap_row: SiteRow,
    /// Virtual slip of the site; empty without a partner or friction.
    pub slip_row: SiteRow,
}

impl SiteKinematics {
    /// True where the site faces the other body.
    pub fn has_partner(&self) -> bool {
        !self.gap.is_nan()
    }
}

/// A pair under given forces.
#[derive(Clone, Debug, Default)]
pub struct LoadedInterface {
    /// `sum_a w_a (-p^_a dg_a + q^_a ds_a)` at the control points, nonmortar first (internal-force sign).
    pub forces: Vec<Point>,
    /// Its derivative at fixed `p^`, `q^`.
    pub geometric: Triplets,
    /// The sites.
    pub sites: Vec<SiteKinematics>,
}

impl Mortar {
    /// The pair at the end of a step of length `dt` in the given configuration; a site without an entry in `loads` (by number
    /// while there are as many, else the nearest along the edge) carries nothing, nor does one without a partner.
    pub fn under(&self, start: &InterfaceStart, at: Configuration, loads: &[SiteLoad], dt: f64) -> LoadedInterface {
        let none = vec![0.0; self.multipliers()];
        let trial = InterfaceTrial { at, pressure: &none, traction: &none, dt };
        let told = |site: &SiteInput, arc: f64, number: (usize, usize)| {
            let load = recall(loads, |l| l.arc, number, arc).filter(|_| site.has_partner);
            SiteAnswer::told(load.map_or([0.0; 2], |l| [l.pressure, l.traction]), site.old)
        };
        self.assembled((start, &trial, Tangent::None), told, |found| found.loaded(&trial))
    }
}

impl SiteAnswer {
    /// Forces that no condition was asked for.
    fn told([p, q]: [f64; 2], old: &[f64]) -> Self {
        Self {
            p,
            q,
            dp_dp: 0.0,
            dp_dg: 0.0,
            dq_dp: 0.0,
            dq_dq: 0.0,
            dq_ds: 0.0,
            dq_dstretch: 0.0,
            weakening: 0.0,
            status: if p == 0.0 && q == 0.0 { ContactStatus::Open } else { ContactStatus::Slip },
            deflection: 0.0,
            variables: old.to_vec(),
        }
    }
}
