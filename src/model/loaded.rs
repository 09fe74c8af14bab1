//! Bodies under given contact forces: equilibrium and kinematics, no contact condition.

use crate::contact::{InterfaceStart, SiteKinematics, SiteLoad};
use crate::geometry::Point;
use crate::math::{SparseMatrix, Triplets};

use super::assembly::{at_contact, bulk, residual};
use super::{Model, Pair, RateForces, State};

/// A trial configuration under given contact forces.
pub struct Loaded {
    /// `R_bulk(u) - loads`, rate forces included, at the displacement equations (forces per unit depth): what contact has to balance.
    pub bulk: Vec<f64>,
    /// Contact forces at the displacement equations, in the sign of the residual: `bulk + contact = 0` in equilibrium.
    pub contact: Vec<f64>,
    /// Contact forces at every control point, in the same sign.
    pub contact_forces: Vec<Point>,
    /// Stiffness of the bodies.
    pub stiffness: SparseMatrix,
    /// Derivative of `contact` at fixed site forces.
    pub geometric: Triplets,
    /// The sites of each pair, their rows over displacement equations.
    pub sites: Vec<Vec<SiteKinematics>>,
    /// Largest nodal force, reactions included: what a residual is measured against.
    pub force_scale: f64,
}

/// Evaluates displacements `u` at the end `time` of a step from `start`, with `loads` at the sites of each pair. `None` where a
/// body is turned inside out.
pub fn load(model: &Model, start: &State, u: &[Point], time: f64, loads: &[Vec<SiteLoad>]) -> Option<Loaded> {
    let mut found = bulk(model, u, Some(time - start.time))?;
    let mut force_scale = found.forces.iter().fold(0.0_f64, |m, f| m.max(f.amax()));
    RateForces::of(model, start, u, time).add(&mut found.forces, &mut force_scale);
    let mut out = Loaded {
        bulk: residual(model, &found.forces, time),
        contact: vec![0.0; model.equations.count],
        contact_forces: vec![Point::zeros(); model.nodes()],
        stiffness: found.stiffness?,
        geometric: vec![],
        sites: vec![],
        force_scale,
    };
    out.bulk.truncate(model.equations.count);
    for (k, pair) in model.pairs.iter().enumerate() {
        let found = at_contact(model, pair, [&start.u, u], |old, new| {
            let from = InterfaceStart { at: old, sites: &start.pairs[k].sites };
            pair.contact.under(&from, new, &loads[k], time - start.time)
        });
        let unknowns = unknowns(model, pair);
        pair.nodes().zip(&found.forces).for_each(|(node, f)| out.contact_forces[node] += f);
        for (i, f) in found.forces.iter().flat_map(|f| [f.x, f.y]).enumerate() {
            out.force_scale = out.force_scale.max(f.abs());
            if let Some(e) = unknowns[i] {
                out.contact[e] += f;
            }
        }
        let entry = |(i, j, v): (usize, usize, f64)| Some((unknowns[i]?, unknowns[j]?, v));
        out.geometric.extend(found.geometric.into_iter().filter_map(entry));
        let row = |row: &[(usize, f64)]| row.iter().filter_map(|&(i, v)| Some((unknowns[i]?, v))).collect();
        let site = |site: SiteKinematics| SiteKinematics {
            gap_row: row(&site.gap_row),
            slip_row: row(&site.slip_row),
            ..site
        };
        out.sites.push(found.sites.into_iter().map(site).collect());
    }
    Some(out)
}

/// Displacement equation behind each local unknown of a pair.
fn unknowns(model: &Model, pair: &Pair) -> Vec<Option<usize>> {
    pair.nodes().flat_map(|node| [0, 1].map(|c| model.equations.unknown(node, c))).collect()
}
