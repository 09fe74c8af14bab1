//! The interface moves, the bodies answer with the stiffness of one iterate.

use crate::contact::Tangent;
use crate::math::{System, norm};

use super::assembly::{add_interface, interface_entries, interfaces};
use super::{Evaluation, Model, State};

/// A trial state whose bodies are linearised at the iterate `x0` it started from, while contact is evaluated as it is:
///
/// ```text
/// R(x) = R_bulk(x0) + K (x - x0) + R_interface(x)
/// ```
///
/// An evaluation costs the contact kernel alone, and a solve the dense block of a condensed `K`, which stays the same.
pub struct Linearised<'a> {
    model: &'a Model,
    start: &'a State,
    /// `R_bulk(x0)`, loads included.
    base: Vec<f64>,
    /// `x - x0`.
    moved: Vec<f64>,
    /// `x`.
    trial: State,
    /// `R(x)`.
    pub residual: Vec<f64>,
    /// Its tangent, `K` of `x0` included.
    pub system: System,
}

impl<'a> Linearised<'a> {
    /// At an evaluated iterate of the step from `start`; `system` is that of the evaluation.
    pub fn at(model: &'a Model, start: &'a State, trial: State, found: &Evaluation, system: System) -> Self {
        let mut interface = vec![0.0; model.unknowns()];
        add_interface(model, &found.interfaces, &mut interface);
        let base = found.residual.iter().zip(&interface).map(|(all, part)| all - part).collect();
        let (moved, residual) = (vec![0.0; model.unknowns()], found.residual.clone());
        Self { model, start, base, moved, trial, residual, system }
    }

    /// Moves by an increment of the unknowns and evaluates.
    pub fn advance(&mut self, increment: &[f64]) {
        self.trial.advance(self.model, increment, 1.0);
        self.moved.iter_mut().zip(increment).for_each(|(x, d)| *x += d);
        let found = interfaces(self.model, self.start, &self.trial, Tangent::Exact);
        self.residual.copy_from_slice(&self.base);
        self.system.bulk.add_product(&self.moved[..self.system.bulk.pattern.n], &mut self.residual);
        add_interface(self.model, &found, &mut self.residual);
        self.system.interface = interface_entries(self.model, &found);
    }

    /// Euclidean norm of the residual.
    pub fn norm(&self) -> f64 {
        norm(&self.residual)
    }

    /// `x - x0`.
    pub fn moved(&self) -> &[f64] {
        &self.moved
    }
}
