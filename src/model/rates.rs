//! Forces that depend on rates, where a model has any: inertia and viscosity. Without them everything here is empty.

use serde::{Deserialize, Serialize};

use crate::geometry::Point;
use crate::math::{LinearSolver, SparseLu, SparseMatrix, System};

use super::assembly::{bulk, residual};
use super::{Body, Control, Dof, Inertia, Matter, Model, State, Viscosity};

/// Forces of inertia and viscosity at every control point, in the sign of internal forces; empty where not modelled.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RateForces {
    /// Rate of momentum.
    pub inertia: Vec<Point>,
    /// Viscous part of the stress.
    pub viscous: Vec<Point>,
}

/// Velocity and acceleration of every control point, and the forces that go with them; empty where not modelled.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rates {
    /// Velocity.
    pub velocity: Vec<Point>,
    /// Acceleration (of the integrator, see `model::inertia`).
    pub acceleration: Vec<Point>,
    /// Forces at the state.
    pub forces: RateForces,
}

impl RateForces {
    /// At displacements `u` at the end of a step from `start` to `time`; at the start itself those found there.
    pub(super) fn of(model: &Model, start: &State, u: &[Point], time: f64) -> Self {
        let dt = time - start.time;
        if dt == 0.0 {
            return start.rates.forces.clone();
        }
        let inertia = |i: &Inertia| i.forces(start, &i.accelerations(model, start, u, dt));
        Self {
            inertia: model.inertia.as_ref().map_or(vec![], inertia),
            viscous: model.viscosity.as_ref().map_or(vec![], |v| v.forces(model, start, u, dt)),
        }
    }

    /// Adds them to other forces, and their size to a scale of forces.
    pub(super) fn add(&self, forces: &mut [Point], scale: &mut f64) {
        for part in [&self.inertia, &self.viscous] {
            for (sum, f) in forces.iter_mut().zip(part) {
                *sum += f;
                *scale = scale.max(f.amax());
            }
        }
    }

    /// Work over a step by the trapezoidal rule: of inertia, and of viscosity.
    fn work(&self, end: &Self, moved: impl Fn(usize) -> Point) -> [f64; 2] {
        let work = |from: &[Point], to: &[Point]| -> f64 {
            to.iter()
                .enumerate()
                .map(|(i, f)| 0.5 * (f + from.get(i).copied().unwrap_or_default()).dot(&moved(i)))
                .sum()
        };
        [work(&self.inertia, &end.inertia), work(&self.viscous, &end.viscous)]
    }
}

impl Rates {
    /// True where nothing is modelled.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// At time 0, and the force of every motion there.
    pub(super) fn initial(model: &Model, state: &State) -> Option<(Self, Vec<f64>)> {
        let inertia = model.inertia.as_ref()?;
        let mut velocity = inertia.velocity.clone();
        for (v, dofs) in velocity.iter_mut().zip(&model.equations.dofs) {
            for c in 0..2 {
                match dofs[c] {
                    Dof::Prescribed(k) => v[c] = model.motions[k].control.table().slope(0.0),
                    Dof::Fixed => v[c] = 0.0,
                    Dof::Unknown(_) => {}
                }
            }
        }
        let mut forces = bulk(model, &state.u, None)?.forces;
        let acceleration = initial_acceleration(model, inertia, &residual(model, &forces, 0.0));
        let rate_forces = RateForces { inertia: inertia.times(&acceleration), viscous: vec![] };
        rate_forces.add(&mut forces, &mut 0.0);
        let of_motion = |m: &super::Motion| match &m.control {
            Control::Force(table) => table.at(0.0),
            Control::Displacement(_) => m.nodes.iter().map(|&i| forces[i][m.component]).sum(),
        };
        let motions = model.motions.iter().map(of_motion).collect();
        Some((Self { velocity, acceleration, forces: rate_forces }, motions))
    }

    /// At the end of a step, with the forces found there.
    pub(super) fn after(model: &Model, start: &State, end: &State, forces: &RateForces) -> Self {
        let Some(inertia) = &model.inertia else { return Self { forces: forces.clone(), ..Self::default() } };
        let acceleration = inertia.accelerations(model, start, &end.u, end.time - start.time);
        let velocity = inertia.velocities(model, start, end, &acceleration);
        Self { velocity, acceleration, forces: forces.clone() }
    }
}

/// `M a = -R` at the unknowns; those without mass stay at rest.
fn initial_acceleration(model: &Model, inertia: &Inertia, residual: &[f64]) -> Vec<Point> {
    let n = model.equations.count;
    let mut rhs: Vec<f64> =
        residual[..n].iter().zip(&inertia.diagonal).map(|(r, m)| if *m > 0.0 { -r } else { 0.0 }).collect();
    if rhs.iter().any(|r| *r != 0.0) {
        let mut bulk = SparseMatrix { pattern: model.equations.pattern.clone(), values: inertia.entries.clone() };
        bulk.mirror();
        let massless = (0..n).filter(|&e| inertia.diagonal[e] <= 0.0).map(|e| (e, e, 1.0)).collect();
        let system = System { n, bulk, interface: massless, boundary: model.boundary.clone() };
        rhs = SparseLu::default().solve(&system, &rhs).expect("a mass matrix is positive definite");
    }
    let of = |dof: Dof| if let Dof::Unknown(e) = dof { rhs[e] } else { 0.0 };
    model.equations.dofs.iter().map(|dofs| Point::from(dofs.map(of))).collect()
}

impl Model {
    /// The model with inertia: `spectral_radius` in `[0, 1]` is the damping of vibrations too fast for the steps (see
    /// `model::inertia`), `matter` the density (> 0) and first velocity of each deformable body.
    pub fn with_inertia(mut self, spectral_radius: f64, matter: impl Fn(&Body) -> Matter) -> Self {
        self.inertia = Some(Inertia::new(&self, spectral_radius, matter));
        self
    }

    /// The model with viscous stresses of the given relaxation time (> 0), see `model::viscosity`.
    pub fn with_viscosity(mut self, time: f64) -> Self {
        self.viscosity = Some(Viscosity::new(&self, time));
        self
    }

    /// True where a body cannot jump: it has mass, or deforms in its own time.
    pub fn has_rates(&self) -> bool {
        self.inertia.is_some() || self.viscosity.is_some()
    }

    /// True where inertia holds a body that nothing else holds.
    pub fn has_mass(&self, body: usize) -> bool {
        self.inertia.is_some() && !self.bodies[body].is_rigid()
    }

    /// Adds the derivative of the rate forces over a step `dt` to the lower half of the bulk stiffness.
    pub(super) fn add_rate_stiffness(&self, dt: f64, values: &mut [f64]) {
        let inertia = self.inertia.as_ref().map(|i| (i.factor(dt), &i.entries));
        let viscous = self.viscosity.as_ref().map(|v| (v.time / dt, &v.entries));
        for (factor, entries) in [inertia, viscous].into_iter().flatten().filter(|_| dt > 0.0) {
            values.iter_mut().zip(entries).for_each(|(value, entry)| *value += factor * entry);
        }
    }

    /// Stress scale of the body behind an equation in a step `dt`, that of the rate forces included: what round-off there is
    /// measured by.
    pub fn stiffness_at(&self, equation: usize, dt: f64) -> f64 {
        let mut stiffness = self.stiffness[equation];
        if let Some(viscosity) = &self.viscosity {
            stiffness *= 1.0 + viscosity.time / dt;
        }
        if let Some(inertia) = &self.inertia {
            stiffness += inertia.factor(dt) * inertia.diagonal.get(equation).unwrap_or(&0.0);
        }
        stiffness
    }

    /// Guess for the displacements at the end of a step in which the bodies fly on; `None` without inertia.
    pub fn ballistic(&self, start: &State, time: f64) -> Option<Vec<Point>> {
        self.inertia.as_ref().map(|inertia| inertia.ballistic(start, time - start.time))
    }

    /// Kinetic energy of a state.
    pub fn kinetic_energy(&self, state: &State) -> f64 {
        self.inertia.as_ref().map_or(0.0, |inertia| inertia.kinetic_energy(&state.rates.velocity))
    }

    /// What integrator and viscosity took over a step.
    pub(super) fn rate_losses(&self, start: &State, end: &State) -> [f64; 2] {
        let [inertia, viscous] = start.rates.forces.work(&end.rates.forces, |i| end.u[i] - start.u[i]);
        [inertia - (self.kinetic_energy(end) - self.kinetic_energy(start)), viscous]
    }
}
