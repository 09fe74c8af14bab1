//! After-the-fact audit of a run, from its records alone.
//!
//! What must hold of every solution, whatever the law and the numerical choices. Differences of forces are measured by the
//! peak force and differences of energies by the largest energy of the whole run: round-off and the tolerance of the solver
//! are relative to these, and a nearly lifted contact must not be judged by its own tiny force.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::model::Record;

use super::criteria::*;
use super::expectations::Expectations;
use super::finding::{Finding, Worst};

/// Audit of a run, fed with one record after the other.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Audit {
    expected: Expectations,
    before: Before,
    peak_force: f64,
    peak_energy: f64,
    /// Bound on the error of work and dissipation made so far by finite steps.
    step_error: f64,
    /// Energy that was there without work at the first step: bodies may start overlapping, tables may start displaced.
    initial_energy: Option<f64>,
    /// Energy set free by snaps.
    lost: f64,
    interface_force: Worst,
    interface_moment: Worst,
    reaction: Worst,
    identity: Worst,
    dissipation: Worst,
    energy_balance: Worst,
    energy_created: Worst,
    penetration: Worst,
    contact_lost: Worst,
    rate_weakening: Worst,
    snap: Worst,
    numerical_loss: Worst,
    viscosity: Worst,
}

/// The record before; at rest and without load in the beginning.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Before {
    force: [f64; 2],
    drive: [f64; 2],
    dissipated: f64,
    external_work: f64,
    snap_loss: f64,
    touching: bool,
}

impl Audit {
    /// An audit that has seen nothing yet.
    pub fn new(expected: Expectations) -> Self {
        let none = Worst::default();
        Self {
            expected,
            before: Before::default(),
            peak_force: expected.negligible_force,
            peak_energy: expected.negligible_force * expected.element_size,
            step_error: 0.0,
            initial_energy: None,
            lost: 0.0,
            interface_force: none,
            interface_moment: none,
            reaction: none,
            identity: none,
            dissipation: none,
            energy_balance: none,
            energy_created: none,
            penetration: none,
            contact_lost: none,
            rate_weakening: none,
            snap: none,
            numerical_loss: none,
            viscosity: none,
        }
    }

    /// Takes the record of the next nominal step.
    pub fn take(&mut self, record: &Record) {
        self.forces(record);
        self.energies(record);
        self.contact(record);
        self.before = Before {
            force: record.force,
            drive: record.drive,
            dissipated: record.dissipated,
            external_work: record.external_work,
            snap_loss: record.snap_loss,
            touching: record.contact_length > 0.0,
        };
    }

    fn forces(&mut self, record: &Record) {
        let (step, force) = (record.step, norm(record.force));
        self.peak_force = self.peak_force.max(force);
        self.interface_force.take(step, record.force_imbalance);
        self.interface_moment.take(step, record.moment_imbalance);
        self.reaction.take(step, norm(difference(record.force, record.reaction_base)));
        if let Some(friction) = self.expected.friction.filter(|_| record.fully_slipping && force != 0.0) {
            let shift = turn(record.mu_global.atan() - record.contact_angle);
            // slip in -x turns the force the other way
            self.identity.take(step, turn(shift.abs() - friction.atan()).abs() * force);
        }
    }

    fn energies(&mut self, record: &Record) {
        // A snap can only set energy free.
        let lost = positive(record.snap_loss - self.before.snap_loss);
        self.snap.take(record.step, lost);
        self.lost += lost;
        let taken = record.kinetic_energy + record.numerical_loss + record.viscous_loss;
        let (step, held) = (record.step, record.strain_energy + record.dissipated + self.lost + taken);
        let largest = record.strain_energy.abs().max(record.dissipated.abs()).max(record.external_work.abs());
        let largest = largest.max(record.kinetic_energy);
        self.shares(record);
        self.peak_energy = self.peak_energy.max(largest);
        if self.expected.dissipative {
            self.dissipation.take(step, positive(self.before.dissipated - record.dissipated));
        }
        let created = held - record.external_work;
        let created = created - *self.initial_energy.get_or_insert(positive(created));
        self.energy_balance.take(step, created.abs());
        // The work of a force that changes monotonically in a step lies within (change of force) * (way) of any rule.
        let way = norm(difference(record.drive, self.before.drive));
        self.step_error += norm(difference(record.force, self.before.force)) * way;
        if self.expected.single_drive {
            self.energy_created.take(step, positive(created - self.step_error));
        }
    }

    /// What integrator and viscosity took, where they are there.
    fn shares(&mut self, record: &Record) {
        if self.expected.inertia {
            self.numerical_loss.take(record.step, record.numerical_loss.abs());
        }
        if self.expected.viscosity {
            self.viscosity.take(record.step, record.viscous_loss.abs());
        }
    }

    fn contact(&mut self, record: &Record) {
        let (step, touching) = (record.step, record.contact_length > 0.0);
        if touching {
            self.penetration.take(step, record.penetration_max);
            self.rate_weakening.take(step, record.weakening);
        }
        if self.before.touching {
            let against = record.external_work > self.before.external_work;
            // moving bodies may bounce
            let passed = !touching && against && record.snaps == 0 && !self.expected.inertia;
            self.contact_lost.take(step, if passed { norm(self.before.force) } else { 0.0 });
        }
    }

    /// What was found in the records so far, one finding per audit.
    pub fn findings(&self) -> Vec<Finding> {
        let (force, energy) = (self.peak_force, self.peak_energy);
        let mut findings = vec![
            self.interface_force.judge(&INTERFACE_FORCE, 1.0),
            self.interface_moment.judge(&INTERFACE_MOMENT, 1.0),
            self.reaction.judge(&DRIVEN_REACTION, force),
            self.identity.judge(&FRICTION_IDENTITY, force),
            self.dissipation.judge(&DISSIPATION, energy),
            self.energy_balance.judge(&ENERGY_BALANCE, energy),
            self.energy_created.judge(&ENERGY_CREATED, energy),
            self.penetration.judge(&PENETRATION, self.expected.element_size),
            self.contact_lost.judge(&CONTACT_LOST, force),
            self.rate_weakening.judge(&RATE_WEAKENING, 1.0),
            self.snap.judge(&SNAP, energy),
        ];
        let Expectations { inertia, viscosity, .. } = self.expected;
        findings.extend(inertia.then(|| self.numerical_loss.judge(&NUMERICAL_LOSS, energy)));
        findings.extend(viscosity.then(|| self.viscosity.judge(&VISCOSITY, energy)));
        findings
    }
}

fn norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// `max(0, value)` that lets `NaN` through.
fn positive(value: f64) -> f64 {
    if value < 0.0 { 0.0 } else { value }
}

/// The angle between two lines, in `(-pi/2, pi/2]`: `mu_global` does not tell a force from its opposite.
fn turn(angle: f64) -> f64 {
    angle - PI * (angle / PI).round()
}
