//! What the conic method finds: displacements and contact forces.

use crate::contact::{ContactDiscretization, SiteLoad};
use crate::geometry::Point;
use crate::model::{Model, Pair, PairState, State};

use super::programme::{Solution, TANGENTS};

/// Displacements of all control points and the contact forces of all pairs.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Displacements.
    pub u: Vec<Point>,
    /// The pairs.
    pub pairs: Vec<PairAnswer>,
}

/// Contact forces of one pair (nominal stresses).
#[derive(Clone, Debug)]
pub struct PairAnswer {
    /// Forces of the sites.
    pub loads: Vec<SiteLoad>,
    /// Pressure multipliers.
    pub pressure: Vec<f64>,
    /// Traction multipliers; empty when nothing rubs.
    pub traction: Vec<f64>,
}

impl Answer {
    /// Displacements with the site forces at the start of the step.
    pub fn guess(model: &Model, start: &State, u: Vec<Point>) -> Self {
        let load = |memory: &crate::contact::SiteMemory| SiteLoad {
            arc: memory.arc,
            pressure: memory.closure.max(0.0),
            traction: memory.traction,
        };
        let of = |(_, state): (&Pair, &PairState)| PairAnswer {
            loads: state.sites.iter().map(load).collect(),
            pressure: state.pressure.clone(),
            traction: state.traction.clone(),
        };
        Self { u, pairs: model.pairs.iter().zip(&start.pairs).map(of).collect() }
    }

    /// Forces of the sites of each pair.
    pub fn loads(&self) -> Vec<Vec<SiteLoad>> {
        self.pairs.iter().map(|pair| pair.loads.clone()).collect()
    }

    /// Takes the forces of a solution; sites and multipliers of the programme are those of the pairs, one after the other, at
    /// the places `arcs`.
    pub fn take(&mut self, model: &Model, arcs: &[Vec<f64>], found: &Solution) {
        let (mut site, mut multiplier) = (0, 0);
        for ((pair, answer), arcs) in model.pairs.iter().zip(&mut self.pairs).zip(arcs) {
            let count = pair.contact.multipliers();
            let load = |(k, &arc): (usize, &f64)| SiteLoad {
                arc,
                pressure: found.pressure[site + k],
                traction: found.traction[site + k][0],
            };
            answer.loads = arcs.iter().enumerate().map(load).collect();
            answer.pressure.copy_from_slice(&found.pressures[multiplier..multiplier + count]);
            let tractions = found.tractions[multiplier..multiplier + count].iter().map(|q| q[0]);
            answer.traction.iter_mut().zip(tractions).for_each(|(q, found)| *q = found);
            site += arcs.len();
            multiplier += count;
        }
    }

    /// Displacement unknowns in elements and site forces in units of `E`, one after the other.
    pub fn flat(&self, model: &Model) -> Vec<f64> {
        let mut out = vec![0.0; model.equations.count];
        for (node, u) in self.u.iter().enumerate() {
            (0..2).for_each(|c| {
                if let Some(e) = model.equations.unknown(node, c) {
                    out[e] = u[c] / model.element_size;
                }
            });
        }
        let loads = self.pairs.iter().flat_map(|pair| &pair.loads);
        out.extend(loads.flat_map(|load| [load.pressure / model.modulus, load.traction / model.modulus]));
        out
    }

    /// The inverse of [`Self::flat`].
    pub fn set_flat(&mut self, model: &Model, values: &[f64]) {
        let (u, forces) = values.split_at(model.equations.count);
        for (node, x) in self.u.iter_mut().enumerate() {
            (0..2).for_each(|c| {
                if let Some(e) = model.equations.unknown(node, c) {
                    x[c] = u[e] * model.element_size;
                }
            });
        }
        let loads = self.pairs.iter_mut().flat_map(|pair| &mut pair.loads);
        for (load, force) in loads.zip(forces.chunks(2)) {
            (load.pressure, load.traction) = (force[0] * model.modulus, force[1] * model.modulus);
        }
    }

    /// As a trial state at the end of a step from `start`.
    pub fn state(&self, model: &Model, start: &State, time: f64) -> State {
        let mut state = start.clone();
        state.u.clone_from(&self.u);
        state.prescribe(model, time);
        for (pair, answer) in state.pairs.iter_mut().zip(&self.pairs) {
            pair.pressure.clone_from(&answer.pressure);
            pair.traction.clone_from(&answer.traction);
        }
        state
    }
}

const _: () = assert!(TANGENTS == 1, "kinematics are plane");

/// Number of multipliers of all pairs.
pub fn multipliers(model: &Model) -> usize {
    model.pairs.iter().map(|pair| pair.contact.multipliers()).sum()
}

/// Adds an increment of the displacement unknowns.
pub fn advance(model: &Model, u: &mut [Point], increment: &[f64], factor: f64) {
    for (node, u) in u.iter_mut().enumerate() {
        for c in 0..2 {
            if let Some(e) = model.equations.unknown(node, c) {
                u[c] += factor * increment[e];
            }
        }
    }
}
