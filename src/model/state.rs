//! What moves during an analysis.

use serde::{Deserialize, Serialize};

use crate::contact::{ContactDiscretization, SiteMemory};
use crate::geometry::Point;

use super::record::motion_forces;
use super::{Control, Dof, Evaluation, Model, Rates};

/// Unknowns and memory of one contact pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairState {
    /// Pressure multipliers (nominal stress).
    pub pressure: Vec<f64>,
    /// Traction multipliers; empty when nothing rubs.
    pub traction: Vec<f64>,
    /// Memory of the sites; empty before the first step.
    pub sites: Vec<SiteMemory>,
}

/// Work done so far, and the forces that continue it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Work of all motions (trapezoidal rule over the steps).
    pub external_work: f64,
    /// Work of friction.
    pub dissipated: f64,
    /// Energy set free where an equilibrium path ended and the bodies snapped to another one.
    pub snap_loss: f64,
    /// Energy stored in the bodies; none before the first step.
    pub strain_energy: f64,
    /// Force of each motion at this state.
    pub forces: Vec<f64>,
    /// Energy taken away by the time integration of inertia.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub numerical_loss: f64,
    /// Work of viscous stresses.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub viscous_loss: f64,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl Ledger {
    /// Adds the work of all motions over a step by the trapezoidal rule and remembers their forces.
    fn settle(&mut self, model: &Model, start: &State, u: &[Point], time: f64, evaluation: &Evaluation) {
        let forces = motion_forces(model, evaluation);
        for (k, motion) in model.motions.iter().enumerate() {
            let travel = motion.travel([start.time, time], [&start.u, u]);
            self.external_work += 0.5 * (start.ledger.forces[k] + forces[k]) * travel;
        }
        self.forces = forces;
        self.strain_energy = evaluation.strain_energy;
    }

    /// Energy set free since an earlier state: work less what is stored and dissipated.
    pub fn released_since(&self, earlier: &Self) -> f64 {
        let since = |of: fn(&Self) -> f64| of(self) - of(earlier);
        since(|l| l.external_work) - since(|l| l.dissipated) - since(|l| l.strain_energy)
    }
}

/// How the unknowns moved lately, apart from the rigid motion of driven bodies: what the next step is extrapolated from.
/// Unknowns in the order of [`State::flat`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trend {
    /// Length of the last step.
    pub dt: f64,
    /// Rates over the last step.
    pub rate: Vec<f64>,
    /// Change of the rates per time, from the step before; empty after the first step.
    pub change: Vec<f64>,
}

/// Configuration, multipliers and memory at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time.
    pub time: f64,
    /// Displacement of every control point of every body.
    pub u: Vec<Point>,
    /// One entry per contact pair.
    pub pairs: Vec<PairState>,
    /// Work done so far.
    pub ledger: Ledger,
    /// Rates of the last step; `None` before the first.
    pub trend: Option<Trend>,
    /// Velocity, acceleration and the forces that go with them; empty where not modelled.
    #[serde(default, skip_serializing_if = "Rates::is_empty")]
    pub rates: Rates,
}

impl State {
    /// The undeformed state at time zero, displacements as prescribed at that time.
    pub fn initial(model: &Model) -> Self {
        let pairs = model.pairs.iter().map(|pair| {
            let n = pair.contact.multipliers();
            PairState {
                pressure: vec![0.0; n],
                traction: vec![0.0; if pair.contact.rubs() { n } else { 0 }],
                sites: vec![],
            }
        });
        let mut state = Self {
            time: 0.0,
            u: vec![Point::zeros(); model.nodes()],
            pairs: pairs.collect(),
            ledger: Ledger { forces: vec![0.0; model.motions.len()], ..Default::default() },
            trend: None,
            rates: Rates::default(),
        };
        state.prescribe(model, 0.0);
        if let Some((rates, forces)) = Rates::initial(model, &state) {
            (state.rates, state.ledger.forces) = (rates, forces);
        }
        state
    }

    /// Displacements, then pressures and tractions of every pair, one after the other.
    pub fn flat(&self) -> impl Iterator<Item = f64> + '_ {
        let multipliers = self.pairs.iter().flat_map(|p| p.pressure.iter().chain(&p.traction));
        self.u.iter().flat_map(|u| [u.x, u.y]).chain(multipliers.copied())
    }

    /// The same, to be changed.
    pub fn flat_mut(&mut self) -> impl Iterator<Item = &mut f64> + '_ {
        let multipliers = self.pairs.iter_mut().flat_map(|p| p.pressure.iter_mut().chain(&mut p.traction));
        self.u.iter_mut().flat_map(|u| u.iter_mut()).chain(multipliers)
    }

    /// Sets the time and every prescribed displacement component.
    pub fn prescribe(&mut self, model: &Model, time: f64) {
        self.time = time;
        for (dofs, u) in model.equations.dofs.iter().zip(&mut self.u) {
            for c in 0..2 {
                if let Dof::Prescribed(k) = dofs[c]
                    && let Control::Displacement(table) = &model.motions[k].control
                {
                    u[c] = table.at(time);
                }
            }
        }
    }

    /// Completes a converged step: memory of the sites, rates, work.
    pub fn commit(&mut self, model: &Model, start: &State, evaluation: &Evaluation) {
        for (pair, found) in self.pairs.iter_mut().zip(&evaluation.interfaces) {
            pair.sites.clone_from(&found.memory);
            self.ledger.dissipated += found.dissipated;
        }
        if model.has_rates() {
            self.rates = Rates::after(model, start, self, &evaluation.rates);
            let [numerical, viscous] = model.rate_losses(start, self);
            self.ledger.numerical_loss += numerical;
            self.ledger.viscous_loss += viscous;
        }
        self.ledger.settle(model, start, &self.u, self.time, evaluation);
    }

    /// Adds `factor` times a Newton increment (unknowns in the order of the equations; multipliers scaled by `r`).
    pub fn advance(&mut self, model: &Model, increment: &[f64], factor: f64) {
        for (dofs, u) in model.equations.dofs.iter().zip(&mut self.u) {
            for c in 0..2 {
                if let Dof::Unknown(e) = dofs[c] {
                    u[c] += factor * increment[e];
                }
            }
        }
        for (pair, state) in model.pairs.iter().zip(&mut self.pairs) {
            let scale = factor * pair.contact.augmentation();
            let values = state.pressure.iter_mut().chain(&mut state.traction);
            values.zip(&increment[pair.offset..]).for_each(|(value, d)| *value += scale * d);
        }
    }
}
