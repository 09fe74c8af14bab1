//! `evaluate(model, start, trial)`: residual and tangent, a pure function of its arguments.

use crate::contact::{
    Configuration, ContactDiscretization, ContactStatus, InterfaceForces, InterfaceStart, InterfaceTrial, Tangent,
};
use crate::geometry::Point;
use crate::math::{SparseMatrix, System, Triplets, norm};

use super::body::BodyKind;
use super::motion::Control;
use super::{Model, Pair, RateForces, Side, State};

/// Residual, tangent and what was found on the way.
pub struct Evaluation {
    /// Internal, interface and rate forces at every control point, before supports and loads: at a supported one the reaction.
    pub forces: Vec<Point>,
    /// Residual of the equations; all entries are forces per unit depth.
    pub residual: Vec<f64>,
    /// Newton matrix, where asked for.
    pub system: Option<System>,
    /// The pairs.
    pub interfaces: Vec<InterfaceForces>,
    /// Strain energy of all bodies.
    pub strain_energy: f64,
    /// Largest nodal force among the parts of the residual: what a small residual is measured against.
    pub force_scale: f64,
    /// Inertia and viscous forces, part of `forces`; empty where not modelled.
    pub rates: RateForces,
    /// Length of the step.
    pub dt: f64,
}

impl Evaluation {
    /// Euclidean norm of the residual.
    pub fn norm(&self) -> f64 {
        norm(&self.residual)
    }

    /// The pairs in which a body takes part.
    pub fn interfaces_of(&self, model: &Model, body: usize) -> impl Iterator<Item = &InterfaceForces> {
        let takes_part = move |pair: &Pair| pair.nonmortar.body == body || pair.mortar.body == body;
        model.pairs.iter().zip(&self.interfaces).filter(move |(pair, _)| takes_part(pair)).map(|(_, found)| found)
    }

    /// Status of every site at which a body may touch another.
    pub fn statuses_of(&self, model: &Model, body: usize) -> impl Iterator<Item = ContactStatus> {
        self.interfaces_of(model, body).flat_map(|found| found.sites.iter().map(|site| site.status))
    }
}

/// Evaluates a trial state for a step that starts at `start`. `None` where a body is turned inside out (`det F <= 0`).
pub fn evaluate(model: &Model, start: &State, trial: &State, tangent: Tangent) -> Option<Evaluation> {
    let wanted = tangent != Tangent::None;
    let dt = trial.time - start.time;
    let Bulk { mut forces, stiffness, strain_energy } = bulk(model, &trial.u, wanted.then_some(dt))?;
    let mut force_scale = forces.iter().fold(0.0_f64, |m, f| m.max(f.amax()));
    let rates = RateForces::of(model, start, &trial.u, trial.time);
    rates.add(&mut forces, &mut force_scale);
    let interfaces = interfaces(model, start, trial, tangent);
    let mut residual = residual(model, &forces, trial.time);
    add_interface(model, &interfaces, &mut residual);
    for (pair, found) in model.pairs.iter().zip(&interfaces) {
        for (node, f) in pair.nodes().zip(&found.forces) {
            forces[node] += f;
            force_scale = force_scale.max(f.amax());
        }
    }
    let interface = || interface_entries(model, &interfaces);
    let system = stiffness.map(|bulk| System {
        n: model.unknowns(),
        bulk,
        interface: interface(),
        boundary: model.boundary.clone(),
    });
    Some(Evaluation { forces, residual, system, interfaces, strain_energy, force_scale, rates, dt })
}

/// The bodies by themselves.
pub(super) struct Bulk {
    /// Internal force at every control point.
    pub forces: Vec<Point>,
    /// Stiffness, that of the rate forces included, where asked for.
    pub stiffness: Option<SparseMatrix>,
    pub strain_energy: f64,
}

/// Evaluates all bodies at the displacements `u`, with the stiffness for a step of a given length where one is given; `None` where
/// a body is turned inside out.
pub(super) fn bulk(model: &Model, u: &[Point], step: Option<f64>) -> Option<Bulk> {
    let wanted = step.is_some();
    let mut forces = vec![Point::zeros(); model.nodes()];
    let mut values = if wanted { model.equations.constant.clone() } else { vec![] };
    values.resize(if wanted { model.equations.pattern.rows.len() } else { 0 }, 0.0);
    let mut strain_energy = 0.0;
    for (k, body) in model.bodies.iter().enumerate() {
        if let BodyKind::Deformable { elements, material, .. } = &body.kind {
            let scatter = &model.equations.scatter[k];
            let stiffness = wanted && !material.linear();
            let displaced = &u[body.nodes()];
            if !stiffness && displaced.iter().all(|u| *u == displaced[0]) {
                continue; // a body at rest, or moved as a whole, exerts no force
            }
            strain_energy += elements.integrate(material.as_ref(), displaced, stiffness, |e, element| {
                for (&a, f) in element.nodes.iter().zip(element.forces) {
                    forces[body.offset + a] += f;
                }
                if stiffness {
                    scatter.add(e, element.stiffness, &mut values);
                }
            })?;
        }
    }
    let stiffness = step.map(|dt| {
        model.add_rate_stiffness(dt, &mut values);
        let mut stiffness = SparseMatrix { pattern: model.equations.pattern.clone(), values };
        stiffness.mirror();
        stiffness
    });
    Some(Bulk { forces, stiffness, strain_energy })
}

/// Longest step that the laws of all pairs and viscosity accept at the end of the step found, and who asks; infinite without opinion.
/// Viscosity asks for accuracy only, so for no step below `shortest`.
pub fn suggested_step(
    model: &Model,
    [start, end]: [&State; 2],
    found: &Evaluation,
    shortest: f64,
) -> (f64, &'static str) {
    let dt = end.time - start.time;
    let pairs = model.pairs.iter().zip(&start.pairs).zip(&found.interfaces);
    let laws = pairs.map(|((pair, old), found)| pair.contact.suggested_step(&old.sites, found, dt));
    let law = laws.fold(f64::INFINITY, f64::min);
    let viscous = model.viscosity.as_ref().map_or(f64::INFINITY, |v| v.suggested_step(start, end, found).max(shortest));
    if viscous < law { (viscous, "viscosity") } else { (law, "the friction law") }
}

/// Why a law gave no number in a trial evaluation of a step of length `dt`, with place and values; `None` where all did.
pub fn explain(model: &Model, start: &State, found: &Evaluation, dt: f64) -> Option<String> {
    let mut pairs = model.pairs.iter().zip(&start.pairs).zip(&found.interfaces);
    pairs.find_map(|((pair, old), found)| pair.contact.explain(&old.sites, found, dt))
}

/// Contact of all pairs.
pub(super) fn interfaces(model: &Model, start: &State, trial: &State, tangent: Tangent) -> Vec<InterfaceForces> {
    model.pairs.iter().enumerate().map(|(k, pair)| interface(model, pair, k, start, trial, tangent)).collect()
}

fn interface(model: &Model, pair: &Pair, k: usize, start: &State, trial: &State, tangent: Tangent) -> InterfaceForces {
    at_contact(model, pair, [&start.u, &trial.u], |old, new| {
        let from = InterfaceStart { at: old, sites: &start.pairs[k].sites };
        let to = InterfaceTrial {
            at: new,
            pressure: &trial.pairs[k].pressure,
            traction: &trial.pairs[k].traction,
            dt: trial.time - start.time,
        };
        pair.contact.evaluate(&from, &to, tangent)
    })
}

/// Places the curves of a pair by displacements at the start and at the end of a step.
pub(super) fn at_contact<R>(
    model: &Model,
    pair: &Pair,
    u: [&[Point]; 2],
    take: impl FnOnce(Configuration, Configuration) -> R,
) -> R {
    let place = |side: &Side, u: &[Point]| -> Vec<Point> {
        let body = &model.bodies[side.body];
        side.nodes.iter().map(|&i| body.points[i - body.offset] + u[i]).collect()
    };
    let [(a, b), (c, d)] = u.map(|u| (place(&pair.nonmortar, u), place(&pair.mortar, u)));
    take(Configuration { nonmortar: &a, mortar: &b }, Configuration { nonmortar: &c, mortar: &d })
}

/// Nodal forces less the loads, at the equations.
pub(super) fn residual(model: &Model, forces: &[Point], time: f64) -> Vec<f64> {
    let mut residual = vec![0.0; model.unknowns()];
    for (node, f) in forces.iter().enumerate() {
        for c in 0..2 {
            if let Some(e) = model.equations.unknown(node, c) {
                residual[e] += f[c];
            }
        }
    }
    for (motion, unknown) in model.motions.iter().zip(&model.equations.of_motion) {
        if let (Control::Force(table), Some(e)) = (&motion.control, unknown) {
            residual[*e] -= table.at(time);
        }
    }
    residual
}

/// Adds interface forces and multiplier rows.
pub(super) fn add_interface(model: &Model, interfaces: &[InterfaceForces], residual: &mut [f64]) {
    for (pair, found) in model.pairs.iter().zip(interfaces) {
        for (node, f) in pair.nodes().zip(&found.forces) {
            for c in 0..2 {
                if let Some(e) = model.equations.unknown(node, c) {
                    residual[e] += f[c];
                }
            }
        }
        let scale = pair.contact.augmentation();
        let rows = &mut residual[pair.offset..pair.offset + pair.unknowns()];
        rows.iter_mut().zip(&found.multiplier_rows).for_each(|(row, v)| *row += scale * v);
    }
}

/// Local entries of the pairs at the unknowns of the model. Multiplier unknowns are `p/r` and their rows are multiplied
/// by `r`, so that all blocks have the size of `E`.
pub(super) fn interface_entries(model: &Model, interfaces: &[InterfaceForces]) -> Triplets {
    let mut entries = Triplets::new();
    for (pair, found) in model.pairs.iter().zip(interfaces) {
        let scale = pair.contact.augmentation();
        let nodes: Vec<usize> = pair.nodes().collect();
        let unknown = |i: usize| match nodes.get(i / 2) {
            Some(&node) => model.equations.unknown(node, i % 2).map(|e| (e, 1.0)),
            None => Some((pair.offset + i - 2 * nodes.len(), scale)),
        };
        entries.extend(found.tangent.iter().filter_map(|&(i, j, v)| {
            let ((row, a), (column, b)) = (unknown(i)?, unknown(j)?);
            Some((row, column, a * b * v))
        }));
    }
    entries
}
