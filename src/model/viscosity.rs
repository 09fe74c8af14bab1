//! Viscous regularisation: Kelvin-Voigt stresses beside the elastic ones.
//!
//! To the first Piola-Kirchhoff stress of every body comes
//!
//! ```text
//! tau C : sym(dF/dt) ,        C the moduli at rest, dF/dt the mean rate over the step,
//! ```
//!
//! with one relaxation time `tau`: forces `tau/dt K_0 (u - u_start)` with the stiffness `K_0` at rest. It resists the rate of deformation,
//! not motion as a whole (a rotation by `w` in a step only in second order of `w`), and depends neither on the number of steps nor on
//! the mesh. Where an equilibrium path ends the bodies move on within about `tau` instead of snapping, and the work of these forces,
//!
//! ```text
//! 1/2 (V + V').(u' - u)       per step
//! ```
//!
//! by the rule of the external work, is what the snap would have set free.

use std::sync::Arc;

use crate::bulk::LinearElastic;
use crate::geometry::Point;

use super::body::BodyKind;
use super::equations::at_rest;
use super::{Evaluation, Model, State};

/// Energy that a step may leave open because viscous forces change in it, of what is stored and taken.
const OPEN: f64 = 0.01;
/// Steps of this share of the relaxation time follow any motion.
const FINE: f64 = 0.125;

/// Relaxation time and stiffness at rest.
#[derive(Clone, Debug)]
pub struct Viscosity {
    /// Relaxation time.
    pub time: f64,
    /// Stiffness of the bodies at rest: lower half, on the pattern of the bulk stiffness.
    pub(super) entries: Vec<f64>,
}

impl Viscosity {
    pub(super) fn new(model: &Model, time: f64) -> Self {
        let equations = &model.equations;
        let linear = |body: &super::Body| -> Option<Arc<dyn crate::bulk::Material>> { Some(Arc::new(solid(body)?)) };
        Self { time, entries: at_rest(&model.bodies, &equations.pattern, &equations.scatter, linear) }
    }

    /// Longest step that books the work of a fast motion: half the change of the viscous forces times the way stays small against the
    /// energies. A step that leaves open up to four times as much is let through, and the next is shorter.
    pub(super) fn suggested_step(&self, start: &State, end: &State, found: &Evaluation) -> f64 {
        let (dt, old) = (end.time - start.time, &start.rates.forces.viscous);
        let (mut change, mut taken) = (0.0, 0.0);
        for (i, force) in found.rates.viscous.iter().enumerate() {
            let moved = end.u[i] - start.u[i];
            change += 0.5 * (force - old.get(i).copied().unwrap_or_default()).dot(&moved);
            taken += force.dot(&moved);
        }
        let share = (OPEN * (found.strain_energy + taken.abs()) / change.abs()).sqrt();
        let step = if share < 0.5 { share * dt } else { share.max(1.0) * dt };
        if step.is_nan() { f64::INFINITY } else { step.max(FINE * self.time) }
    }

    /// Viscous forces at all control points for displacements `u` at the end of a step `dt`.
    pub(super) fn forces(&self, model: &Model, start: &State, u: &[Point], dt: f64) -> Vec<Point> {
        let moved: Vec<Point> = u.iter().zip(&start.u).map(|(a, b)| a - b).collect();
        let mut forces = vec![Point::zeros(); u.len()];
        for body in &model.bodies {
            if let (BodyKind::Deformable { elements, .. }, Some(solid)) = (&body.kind, solid(body)) {
                // what is not finite here is not finite in the elastic forces either, which are asked first
                let _ = elements.integrate(&solid, &moved[body.nodes()], false, |_, element| {
                    for (&a, f) in element.nodes.iter().zip(element.forces) {
                        forces[body.offset + a] += f * (self.time / dt);
                    }
                });
            }
        }
        forces
    }
}

/// The linear solid that a body is at rest.
fn solid(body: &super::Body) -> Option<LinearElastic> {
    let material = body.material()?;
    Some(LinearElastic { youngs_modulus: material.youngs_modulus(), poissons_ratio: material.poissons_ratio() })
}
