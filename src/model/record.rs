//! What is reported of a converged step: forces, friction coefficient, contact angle, energies, sites.

use crate::contact::{ContactStatus, InterfaceForces};
use crate::math::Vec2;

use super::{Control, Evaluation, Model, State};

/// One row of `history.csv`. Forces are per unit depth.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Nominal step.
    pub step: usize,
    /// Time.
    pub time: f64,
    /// Displacement of the driven edge.
    pub drive: [f64; 2],
    /// Resistance `Fx` and support `Fy` felt by the driven body: positive when it is pushed onto its counterpart and
    /// dragged in +x. Taken as the assembled reaction of its drives, less its rate of momentum.
    pub force: [f64; 2],
    /// `Fx / Fy`; `NaN` without contact.
    pub mu_global: f64,
    /// Pressure-weighted mean contact angle `atan(S/C)` (theory 1.2b), positive when climbing; `NaN` without contact.
    pub contact_angle: f64,
    /// Reference length of the nonmortar edge in contact.
    pub contact_length: f64,
    /// Largest true pressure.
    pub pressure_max: f64,
    /// Largest penetration at an integration point in contact.
    pub penetration_max: f64,
    /// Stored energy.
    pub strain_energy: f64,
    /// Cumulative work of friction.
    pub dissipated: f64,
    /// Cumulative work of all motions.
    pub external_work: f64,
    /// Linear solves spent on the step, failed attempts included.
    pub newton_iterations: usize,
    /// How often the step was cut.
    pub cuts: usize,
    /// True for an accepted step.
    pub converged: bool,
    /// Wall time of the step in seconds.
    pub wall_s: f64,
    /// Sum of the reactions on all other bodies, less their rate of momentum, signed like `force`: equal to it in equilibrium.
    pub reaction_base: [f64; 2],
    /// True where every closed site slips, all in the same direction.
    pub fully_slipping: bool,
    /// Resultant of all interface forces over the sum of their magnitudes: zero to round-off.
    pub force_imbalance: f64,
    /// The same for their moment.
    pub moment_imbalance: f64,
    /// Share of the bodies' tangential stiffness that friction takes away by falling with the slip rate, see
    /// `solve::weakening`; 0 where it does not matter.
    pub weakening: f64,
    /// Snaps that were crossed in the step.
    pub snaps: usize,
    /// Cumulative energy that they set free.
    pub snap_loss: f64,
    /// Energy of motion.
    pub kinetic_energy: f64,
    /// Cumulative energy taken away by the time integration of inertia.
    pub numerical_loss: f64,
    /// Cumulative work of viscous stresses.
    pub viscous_loss: f64,
}

impl Record {
    /// Where the external work went: stored, kinetic, dissipated, set free by snaps, taken by integrator and viscosity.
    pub fn accounted(&self) -> f64 {
        let moving = self.kinetic_energy + self.numerical_loss + self.viscous_loss;
        self.strain_energy + self.dissipated + self.snap_loss + moving
    }
}

/// One row of `interface.csv`.
#[derive(Clone, Debug)]
pub struct InterfaceRow {
    /// Nominal step.
    pub step: usize,
    /// Contact pair.
    pub pair: usize,
    /// Site within the pair.
    pub index: usize,
    /// Position.
    pub x: f64,
    /// Position.
    pub y: f64,
    /// Reference arc length along the nonmortar edge.
    pub arc: f64,
    /// Unit normal along which the pressure acts on the driven body (on the nonmortar body where neither is driven).
    pub normal: [f64; 2],
    /// Unit tangent of the mortar curve: slip and traction are positive along it.
    pub tangent: [f64; 2],
    /// True (Cauchy) pressure.
    pub pressure: f64,
    /// True tangential traction.
    pub traction: f64,
    /// Gap.
    pub gap: f64,
    /// Slip increment of the last accepted step.
    pub slip: f64,
    /// Open, stick or slip.
    pub status: ContactStatus,
    /// Reference length of the site.
    pub weight: f64,
    /// Internal variables of the law.
    pub variables: Vec<f64>,
}

/// The sites of a converged state.
pub fn interface_rows(model: &Model, evaluation: &Evaluation, step: usize) -> Vec<InterfaceRow> {
    let mut rows = Vec::new();
    for (k, (pair, found)) in model.pairs.iter().zip(&evaluation.interfaces).enumerate() {
        let sign = if pair.mortar.body == model.driven { -1.0 } else { 1.0 };
        rows.extend(found.sites.iter().enumerate().map(|(index, site)| InterfaceRow {
            step,
            pair: k,
            index,
            x: site.x.x,
            y: site.x.y,
            arc: site.arc,
            normal: (site.normal * sign).into(),
            tangent: site.tangent.into(),
            pressure: site.pressure,
            traction: site.traction,
            gap: site.gap,
            slip: site.slip,
            status: site.status,
            weight: site.weight,
            variables: site.variables.clone(),
        }));
    }
    rows
}

/// Mechanical part of the record of a converged state; `step`, iterations, cuts and time are left to the caller.
pub fn record(model: &Model, state: &State, evaluation: &Evaluation) -> Record {
    let up = upward(model);
    let reaction = |driven: bool| -> Vec2 {
        let supported = |(body, _): &(usize, Vec2)| (*body == model.driven) == driven;
        reactions(model, evaluation).filter(supported).map(|(_, f)| f).sum::<Vec2>()
            - momentum(model, evaluation, driven)
    };
    let [on_driven, on_base] = [reaction(true), reaction(false)];
    let contact = contact_length(evaluation);
    let normal = normal_force(model, &evaluation.interfaces);
    let force = [on_driven.x, -up * on_driven.y];
    let none = if contact > 0.0 { 0.0 } else { f64::NAN };
    let sites = || evaluation.interfaces.iter().flat_map(|i| &i.sites);
    let [force_imbalance, moment_imbalance] = imbalance(evaluation);
    Record {
        time: state.time,
        drive: drive_displacement(model, state),
        force,
        mu_global: force[0] / force[1] + none,
        contact_angle: (-normal.x / (up * normal.y)).atan() + none,
        contact_length: contact,
        pressure_max: sites().fold(0.0, |m, s| m.max(s.pressure)),
        penetration_max: evaluation.interfaces.iter().fold(0.0, |m, i| m.max(i.penetration)),
        strain_energy: evaluation.strain_energy,
        dissipated: state.ledger.dissipated,
        snap_loss: state.ledger.snap_loss,
        kinetic_energy: model.kinetic_energy(state),
        numerical_loss: state.ledger.numerical_loss,
        viscous_loss: state.ledger.viscous_loss,
        external_work: state.ledger.external_work,
        converged: true,
        reaction_base: [-on_base.x, up * on_base.y],
        fully_slipping: fully_slipping(evaluation),
        force_imbalance,
        moment_imbalance,
        ..Record::default()
    }
}

/// Resistance and support of the driven body, signed as in [`Record::force`], from forces at all control points (internal-force
/// sign): in equilibrium those of contact alone come to the reaction of its drives.
pub fn resistance(model: &Model, forces: &[Vec2]) -> [f64; 2] {
    let sum: Vec2 = model.bodies[model.driven].nodes().map(|i| forces[i]).sum();
    [sum.x, -upward(model) * sum.y]
}

/// Forces of every motion at a state: reaction of a displacement, or the applied force.
pub(super) fn motion_forces(model: &Model, evaluation: &Evaluation) -> Vec<f64> {
    model.motions.iter().map(|m| m.nodes.iter().map(|&i| evaluation.forces[i][m.component]).sum()).collect()
}

/// Reaction at every control point that a motion or a rigid body holds.
fn reactions<'a>(model: &'a Model, evaluation: &'a Evaluation) -> impl Iterator<Item = (usize, Vec2)> + 'a {
    let held = |body: usize, node: usize, c: usize| {
        model.bodies[body].is_rigid()
            || model.motions.iter().any(|m| m.body == body && m.component == c && m.nodes.contains(&node))
    };
    model.bodies.iter().enumerate().flat_map(move |(k, body)| {
        body.nodes().map(move |i| {
            let f = evaluation.forces[i];
            (k, Vec2::new(if held(k, i, 0) { f.x } else { 0.0 }, if held(k, i, 1) { f.y } else { 0.0 }))
        })
    })
}

/// Rate of momentum of the driven body, or of all others.
fn momentum(model: &Model, evaluation: &Evaluation, driven: bool) -> Vec2 {
    let bodies = model.bodies.iter().enumerate().filter(|(k, _)| (*k == model.driven) == driven);
    bodies.flat_map(|(_, body)| evaluation.rates.inertia.get(body.nodes()).into_iter().flatten()).sum()
}

/// +1 where the driven body lies above the bodies it touches, -1 below.
fn upward(model: &Model) -> f64 {
    let partners = model.pairs.iter().filter_map(|pair| match model.driven {
        d if d == pair.nonmortar.body => Some(pair.mortar.body),
        d if d == pair.mortar.body => Some(pair.nonmortar.body),
        _ => None,
    });
    let height = |k: usize| model.bodies[k].centre().y;
    let above: f64 = partners.map(|k| height(model.driven) - height(k)).sum();
    if above < 0.0 { -1.0 } else { 1.0 }
}

/// Pressure resultant on the driven body.
fn normal_force(model: &Model, interfaces: &[InterfaceForces]) -> Vec2 {
    let on_driven = |(pair, found): (&super::Pair, &InterfaceForces)| match model.driven {
        d if d == pair.nonmortar.body => found.normal_force,
        d if d == pair.mortar.body => -found.normal_force,
        _ => Vec2::zeros(),
    };
    model.pairs.iter().zip(interfaces).map(on_driven).sum()
}

fn contact_length(evaluation: &Evaluation) -> f64 {
    let closed = |i: &InterfaceForces| -> f64 {
        i.sites.iter().filter(|s| s.status != ContactStatus::Open).map(|s| s.weight).sum()
    };
    // an empty sum is -0
    evaluation.interfaces.iter().map(closed).sum::<f64>() + 0.0
}

fn fully_slipping(evaluation: &Evaluation) -> bool {
    let mut closed =
        evaluation.interfaces.iter().flat_map(|i| &i.sites).filter(|s| s.status != ContactStatus::Open).peekable();
    let Some(first) = closed.peek().map(|s| s.traction.signum()) else { return false };
    closed.all(|s| s.status == ContactStatus::Slip && (s.traction == 0.0 || s.traction.signum() == first))
}

fn imbalance(evaluation: &Evaluation) -> [f64; 2] {
    let (mut force, mut magnitude, mut moment) = (Vec2::zeros(), 0.0, [0.0; 2]);
    for interface in &evaluation.interfaces {
        force += interface.forces.iter().sum::<Vec2>();
        magnitude += interface.forces.iter().map(|f| f.norm()).sum::<f64>();
        moment[0] += interface.moment[0];
        moment[1] += interface.moment[1];
    }
    let share = |value: f64, scale: f64| if scale > 0.0 { value.abs() / scale } else { 0.0 };
    [share(force.norm(), magnitude), share(moment[0], moment[1])]
}

/// Displacement of the first drive (of the first motion of the driven body, where there is no drive).
fn drive_displacement(model: &Model, state: &State) -> [f64; 2] {
    let of = |component: usize| {
        let motions = || model.motions.iter().filter(|m| m.body == model.driven && m.component == component);
        let motion = motions().find(|m| m.drive).or_else(|| motions().next());
        motion.map_or(0.0, |m| match &m.control {
            Control::Displacement(table) => table.at(state.time),
            Control::Force(_) => m.nodes.first().map_or(0.0, |&i| state.u[i][component]),
        })
    };
    [of(0), of(1)]
}
