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
        for (e, coefficient, moved) in self.terms(strength, model, start, trial) {
            found.residual[e] += coefficient * moved;
            if let Some(system) = &mut found.system {
                system.interface.push((e, e, coefficient));
            }
        }
    }

    /// Its largest entry in the residual of a step.
    pub fn largest(&self, strength: f64, model: &Model, start: &State, end: &State) -> f64 {
        let mut forces = vec![0.0; model.equations.count];
        self.terms(strength, model, start, end).for_each(|(e, coefficient, moved)| forces[e] += coefficient * moved);
        forces.iter().fold(0.0, |m, f: &f64| m.max(f.abs()))
    }

    /// Equation, coefficient and displacement of every component that is free; those of one equation add up.
    fn terms<'a>(
        &'a self,
        strength: f64,
        model: &'a Model,
        start: &'a State,
        end: &'a State,
    ) -> impl Iterator<Item = (usize, f64, f64)> + 'a {
        self.shares.iter().enumerate().flat_map(move |(node, share)| {
            let moved = end.u[node] - start.u[node];
            let term = move |c| Some((model.equations.unknown(node, c)?, strength * model.modulus * share, moved[c]));
            (0..2).filter_map(term)
        })
    }
}
