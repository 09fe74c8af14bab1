//! How accurate the forces of a run are, from the run alone.
//!
//! A discrete solution stores more energy than the exact one, or lets bodies overlap. Where the error has the energy `e` and the
//! bodies hold `W`, the force of the drive, the derivative of the energy by the way, is wrong by about the same share, `dF/F = e/W`.
//! At some of the steps in contact two parts of `e` are measured:
//!
//! ```text
//! space     eta^2 / 2 of the recovered stress, see bulk::Recovery
//! contact   1/2 sum w p max(0, -g) over the sites: work of the pressure through the overlap that the discretization leaves
//! ```
//!
//! and `error = rms(dF) / max |F|` over these steps, `F = (Fx, Fy)`: the norm of `asperity trade`. No constant is fitted; the
//! effectivity (estimate over true error) on scenes of all kinds is in `papers/trade/effectivity.md`. Between the nominal times
//! a curve is read as straight lines: what that leaves out is told by the second differences of the forces, `rms = |d2 F| / sqrt(120)`.
//!
//! What is not seen: the error of the time steps at the nominal times. Without memory and rate in the law it is below 1e-5 on the
//! shipped scenes; else it is unknown, and the estimate says so. Behind a snap nothing is estimated.

use asperity_laws::{FrictionLaw, InterfacePoint, Response};
use serde::{Deserialize, Serialize};

use crate::bulk::{Recovery, StressError};
use crate::contact::{ContactDiscretization, ContactStatus, SiteRecord};
use crate::model::{BodyKind, Control, Evaluation, Model, Motion, Pair, Record, State};

use super::accuracy::{Estimate, Quantity};

/// Steps in contact between two measurements in the beginning: they take below 5 % of the time of a run.
const APART: usize = 3;
/// Measurements after which they are taken half as often.
const ENOUGH: usize = 16;

/// Gathers the error of a run step by step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Estimator {
    quantity: Quantity,
    stride: usize,
    touching: usize,
    samples: usize,
    /// Steps for which they stand.
    measured: usize,
    /// Sums over these of the squares of `dF` from space, contact and both.
    squares: [f64; 3],
    peak: f64,
    /// The quantity at the last two steps, in contact or not.
    before: [Option<[f64; 2]>; 2],
    /// Sum of the squares of the second differences, and how many.
    bends: (f64, usize),
    snaps: usize,
    unseen: Vec<String>,
    strain: f64,
    /// Largest strain energy among the samples, and that of the other strain measure there.
    energies: [f64; 2],
}

impl Estimator {
    /// For a run of a model.
    pub fn new(model: &Model) -> Self {
        let driven = |m: &&Motion| m.body == model.driven;
        let displaced = model.motions.iter().filter(driven).any(|m| match &m.control {
            Control::Displacement(table) => !table.is_constant(),
            Control::Force(_) => false,
        });
        let forced = model.motions.iter().filter(driven).any(|m| matches!(m.control, Control::Force(_)));
        Self {
            quantity: if forced && !displaced { Quantity::Way } else { Quantity::Forces },
            stride: APART,
            touching: 0,
            samples: 0,
            measured: 0,
            squares: [0.0; 3],
            peak: 0.0,
            before: [None; 2],
            bends: (0.0, 0),
            snaps: 0,
            unseen: unseen(model),
            strain: 0.0,
            energies: [0.0; 2],
        }
    }

    /// Takes the next nominal step.
    pub fn take(&mut self, model: &Model, record: &Record, state: &State, evaluation: &Evaluation) {
        let value = match self.quantity {
            Quantity::Forces => record.force,
            Quantity::Way => record.drive,
        };
        let size = value[0].hypot(value[1]);
        self.peak = self.peak.max(size);
        self.snaps += record.snaps;
        if let [Some(first), Some(second)] = self.before {
            let bend = |c: usize| first[c] - 2.0 * second[c] + value[c];
            self.bends.0 += bend(0).powi(2) + bend(1).powi(2);
            self.bends.1 += 1;
        }
        self.before = [self.before[1], Some(value)];
        if record.contact_length == 0.0 {
            self.before[0] = None;
            return;
        }
        self.touching += 1;
        if self.touching.is_multiple_of(self.stride) {
            self.sample(model, state, evaluation, size);
        }
    }

    /// Measures one step at which the quantity has this size.
    fn sample(&mut self, model: &Model, state: &State, evaluation: &Evaluation, size: f64) {
        let Some(found) = bodies(model, state) else { return };
        let (space, contact) = (found.error / found.stress, overlap(evaluation) / found.stress);
        if !(space + contact).is_finite() {
            return;
        }
        for (sum, share) in self.squares.iter_mut().zip([space, contact, space + contact]) {
            *sum += self.stride as f64 * (share * size).powi(2);
        }
        self.samples += 1;
        self.measured += self.stride;
        self.stride *= if self.samples.is_multiple_of(ENOUGH) { 2 } else { 1 };
        self.strain = self.strain.max(found.strain);
        if evaluation.strain_energy > self.energies[0] {
            self.energies = [evaluation.strain_energy, other_energy(model, state).unwrap_or(f64::NAN)];
        }
    }

    /// What is known so far.
    pub fn estimate(&self) -> Estimate {
        let known = self.samples > 0 && self.snaps == 0 && self.peak > 0.0;
        let mut not_estimated = self.unseen.clone();
        if self.snaps > 0 {
            not_estimated.push("anything: behind a snap the equilibrium depends on more than the mesh".into());
        } else if self.samples == 0 {
            not_estimated.push("anything: too few steps in contact".into());
        }
        let rms = |k: usize| known.then(|| (self.squares[k] / self.measured as f64).sqrt() / self.peak);
        let bends =
            (known && self.bends.1 > 0).then(|| (self.bends.0 / self.bends.1 as f64 / 120.0).sqrt() / self.peak);
        let [own, other] = self.energies;
        let change = || (other / own - 1.0).abs().max(self.strain * self.strain);
        let measure = (own > 0.0 && !other.is_nan()).then(change);
        Estimate {
            quantity: self.quantity,
            error: rms(2),
            space: rms(0),
            contact: rms(1),
            between_steps: bends,
            samples: self.samples,
            not_estimated,
            strain: self.strain,
            strain_measure: measure,
        }
    }
}

/// What the estimate leaves out, by contact.
fn unseen(model: &Model) -> Vec<String> {
    let reason = |(k, pair): (usize, &Pair)| {
        let law = pair.contact.law()?;
        let why = match pair.contact.variable_names().is_empty() {
            false => "its law has memory",
            true if depends_on_rate(&**law, model) => "its law depends on the slip rate",
            true => return None,
        };
        Some(format!("error of the time steps in contact {k}: {why}"))
    };
    model.pairs.iter().enumerate().filter_map(reason).collect()
}

/// Whether a law without variables answers otherwise where the same slip takes longer.
fn depends_on_rate(law: &dyn FrictionLaw, model: &Model) -> bool {
    let (pressure, slip) = (0.01 * model.modulus, 0.01 * model.element_size);
    let answer = |dt: f64| match law.response(&InterfacePoint::new(pressure, slip, dt), &[], &mut []) {
        Response::Threshold(value) | Response::Traction(value) => value.re,
    };
    let [fast, slow] = [1.0, 4.0].map(answer);
    (fast - slow).abs() > 1e-12 * fast.abs()
}

/// Energies of all bodies.
fn bodies(model: &Model, state: &State) -> Option<StressError> {
    let mut sum = StressError::default();
    for body in &model.bodies {
        if let BodyKind::Deformable { patch, elements, material } = &body.kind {
            let found = Recovery::new(elements, patch, material.as_ref())?.error(&state.u[body.nodes()])?;
            sum = StressError {
                error: sum.error + found.error,
                stress: sum.stress + found.stress,
                strain: sum.strain.max(found.strain),
            };
        }
    }
    Some(sum)
}

/// Strain energy of all bodies under the other strain measure; infinite where that has no state.
fn other_energy(model: &Model, state: &State) -> Option<f64> {
    let mut sum = 0.0;
    for body in &model.bodies {
        if let BodyKind::Deformable { elements, material, .. } = &body.kind {
            let other = material.other_strain_measure()?;
            let energy = elements.integrate(other.as_ref(), &state.u[body.nodes()], false, |_, _| ());
            sum += energy.unwrap_or(f64::INFINITY);
        }
    }
    Some(sum)
}

/// `sum w p max(0, -g)` over the closed sites, Cauchy pressure and current length.
fn overlap(evaluation: &Evaluation) -> f64 {
    let closed = |s: &&SiteRecord| s.status != ContactStatus::Open;
    let sites = evaluation.interfaces.iter().flat_map(|i| &i.sites).filter(closed);
    sites.map(|s| s.weight * s.stretch * s.pressure * f64::max(0.0, -s.gap)).sum()
}
