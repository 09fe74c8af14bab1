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
use super::{Model, State};

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
