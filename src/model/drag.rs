//! Drag: a body force against the displacement of a step, which carries a body over to another equilibrium.

use crate::bulk::lumped_areas;

use super::{Evaluation, Model, State};

/// Coefficients `A_a/h^2` of the control points (`A_a` the lumped area, `h` the element size of the model), zero on rigid bodies:
/// times `E` they have the size of the stiffness of one element.
#[derive(Clone, Debug)]
pub struct Drag {
    shares: Vec<f64>,
}

impl Drag {
    /// For the control points of a model.
    pub fn new(model: &Model) -> Self {
        let shares = model.bodies.iter().flat_map(|body| match body.patch() {
            Some(patch) => lumped_areas(patch),
            None => vec![0.0; body.points.len()],
        });
        Self { shares: shares.map(|area| area / model.element_size.powi(2)).collect() }
    }

    /// Adds `strength E A_a/h^2 (u_a - u_a of the start)` to the residual, and its derivative to the system.
    pub fn add(&self, strength: f64, model: &Model, start: &State, trial: &State, found: &mut Evaluation) {
        for (node, share) in self.shares.iter().enumerate() {
            let coefficient = strength * model.modulus * share;
            let moved = trial.u[node] - start.u[node];
            for c in 0..2 {
                if let Some(e) = model.equations.unknown(node, c) {
                    found.residual[e] += coefficient * moved[c];
                    if let Some(system) = &mut found.system {
                        system.interface.push((e, e, coefficient));
                    }
                }
            }
        }
    }

    /// Its largest entry in the residual of a step.
    pub fn largest(&self, strength: f64, model: &Model, start: &State, end: &State) -> f64 {
        let mut forces = vec![0.0; model.equations.count];
        for (node, share) in self.shares.iter().enumerate() {
            let moved = end.u[node] - start.u[node];
            for c in 0..2 {
                if let Some(e) = model.equations.unknown(node, c) {
                    forces[e] += strength * model.modulus * share * moved[c];
                }
            }
        }
        forces.iter().fold(0.0, |m, f: &f64| m.max(f.abs()))
    }
}
