//! From evaluated sites to forces, multiplier rows and tangent of a pair.

use crate::geometry::Point;
use crate::math::{Triplets, Vec2};

use super::integration::QuadraturePoint;
use super::interface::{ContactStatus, InterfaceForces, InterfaceTrial, Tangent};
use super::kinematics::{SLOTS, Slots};
use super::loaded::{LoadedInterface, SiteKinematics};
use super::point::{Curves, PointState, congruence};
use super::sites::SiteState;

/// Everything known about a pair at a trial state.
pub(super) struct Assembly<'a> {
    pub curves: Curves<'a>,
    pub points: &'a [QuadraturePoint],
    pub states: &'a [Option<PointState>],
    pub sites: &'a [SiteState],
    pub multipliers: usize,
    pub rubs: bool,
}

/// A sparse row that is built by adding: dense values and the places touched.
struct Row {
    values: Vec<f64>,
    touched: Vec<usize>,
}

impl Row {
    fn new(n: usize) -> Self {
        Self { values: vec![0.0; n], touched: Vec::new() }
    }

    fn add(&mut self, node: usize, value: Vec2) {
        for c in 0..2 {
            let i = 2 * node + c;
            if self.values[i] == 0.0 {
                self.touched.push(i);
            }
            self.values[i] += value[c];
        }
    }

    /// The entries so far; empties the row.
    fn take(&mut self) -> Vec<(usize, f64)> {
        let mut out = Vec::with_capacity(self.touched.len());
        for &i in &self.touched {
            if self.values[i] != 0.0 {
                out.push((i, self.values[i]));
                self.values[i] = 0.0;
            }
        }
        self.touched.clear();
        out
    }
}

/// Rows of a site, each multiplied by its weight.
struct SiteRows {
    gap: Vec<(usize, f64)>,
    virtual_gap: Vec<(usize, f64)>,
    virtual_slip: Vec<(usize, f64)>,
    slip: Vec<(usize, f64)>,
    stretch: Vec<(usize, f64)>,
}

impl Assembly<'_> {
    /// Evaluates the sums.
    pub fn forces(&self, trial: &InterfaceTrial, tangent: Tangent) -> InterfaceForces {
        let nodes = trial.at.nonmortar.len() + trial.at.mortar.len();
        let mut out = InterfaceForces {
            forces: vec![Point::zeros(); nodes],
            multiplier_rows: vec![0.0; self.multipliers * if self.rubs { 2 } else { 1 }],
            smallest_gap: f64::INFINITY,
            ..Default::default()
        };
        let loads = self.point_loads();
        self.add_forces(&loads, trial, &mut out);
        self.add_multiplier_rows(&mut out);
        if tangent != Tangent::None {
            self.add_geometric_tangent(&loads, &mut out.tangent);
            self.add_site_tangents(nodes, &mut out.tangent);
        }
        self.record(&mut out);
        out
    }

    /// Forces, their derivative at fixed site forces, and the sites, whatever these carry.
    pub fn loaded(&self, trial: &InterfaceTrial) -> LoadedInterface {
        let nodes = trial.at.nonmortar.len() + trial.at.mortar.len();
        let mut out = InterfaceForces { forces: vec![Point::zeros(); nodes], ..Default::default() };
        let loads = self.point_loads();
        self.add_forces(&loads, trial, &mut out);
        self.add_geometric_tangent(&loads, &mut out.tangent);
        let mut row = Row::new(2 * nodes);
        let sites = self.sites.iter().map(|state| self.kinematics(state, &mut row)).collect();
        LoadedInterface { forces: out.forces, geometric: out.tangent, sites }
    }

    fn kinematics(&self, state: &SiteState, row: &mut Row) -> SiteKinematics {
        let rows = self.rows(state, row);
        let mean = |row: Vec<(usize, f64)>| row.into_iter().map(|(i, v)| (i, v / state.weight)).collect();
        SiteKinematics {
            arc: state.arc,
            position: state.position,
            weight: state.weight,
            gap: state.gap,
            slip: state.slip,
            stretch: state.stretch,
            r: state.r,
            reads: state.site.reads.clone(),
            deflection: state.old[0],
            old: state.answer.variables.clone(),
            load: [state.answer.p, state.answer.q],
            gap_row: mean(rows.virtual_gap),
            slip_row: mean(rows.virtual_slip),
        }
    }

    /// Pressure and traction (times weight) that the sites put on each quadrature point.
    fn point_loads(&self) -> Vec<[f64; 2]> {
        let mut loads = vec![[0.0; 2]; self.points.len()];
        for state in self.sites {
            for &(i, c) in &state.site.group {
                loads[i][0] += c * state.answer.p;
                loads[i][1] += c * state.answer.q;
            }
        }
        loads
    }

    fn add_forces(&self, loads: &[[f64; 2]], trial: &InterfaceTrial, out: &mut InterfaceForces) {
        let nonmortar = trial.at.nonmortar.len();
        for ((point, state), &[p, q]) in self.points.iter().zip(self.states).zip(loads) {
            let Some(state) = state else { continue };
            out.smallest_gap = out.smallest_gap.min(state.frame.gap);
            if p == 0.0 && q == 0.0 {
                continue;
            }
            out.penetration = out.penetration.max(-state.frame.gap);
            let part = |coefficients: &Slots, factor: f64| coefficients.map(|v| v * factor);
            let (normal, friction) = (part(&state.frame.normal, -p), part(&state.frame.tangential, q));
            out.normal_force -= Vec2::new(normal[0], normal[1]);
            out.friction_force -= Vec2::new(friction[0], friction[1]);
            let row: Slots = std::array::from_fn(|k| normal[k] + friction[k]);
            self.curves.spread(point, &state.partner, &row, |node, f| {
                out.forces[node] += f;
                let x = if node < nonmortar { trial.at.nonmortar[node] } else { trial.at.mortar[node - nonmortar] };
                out.moment[0] += x.x * f.y - x.y * f.x;
                out.moment[1] += x.norm() * f.norm();
            });
        }
    }

    fn add_multiplier_rows(&self, out: &mut InterfaceForces) {
        for state in self.sites {
            for &(a, m) in &state.site.reads {
                out.multiplier_rows[a] += m * state.weight * (state.answer.p - state.p) / state.r[0];
                if self.rubs {
                    out.multiplier_rows[self.multipliers + a] +=
                        m * state.weight * (state.answer.q - state.q) / state.r[1];
                }
            }
        }
    }

    /// `-p^ d(virtual gap) + q^ d(virtual slip)` at every loaded point.
    fn add_geometric_tangent(&self, loads: &[[f64; 2]], out: &mut Triplets) {
        for ((point, state), &[p, q]) in self.points.iter().zip(self.states).zip(loads) {
            let Some(state) = state else { continue };
            if p != 0.0 || q != 0.0 {
                let form = self.curves.orientation.linearise(&state.z, state.third, -p, q);
                let columns: Vec<_> = self.curves.columns(point, &state.partner).collect();
                congruence(&columns, &form, |i, j, v| out.push((i, j, v)));
            }
        }
    }

    fn rows(&self, state: &SiteState, row: &mut Row) -> SiteRows {
        let mut gather = |coefficients: &dyn Fn(&PointState, &QuadraturePoint) -> Slots, with_path: bool| {
            for &(i, c) in &state.site.group {
                let (Some(at), point) = (&self.states[i], &self.points[i]) else { continue };
                let slots = coefficients(at, point).map(|v| v * c);
                self.curves.spread(point, &at.partner, &slots, |node, v| row.add(node, v));
                if with_path {
                    let first = self.curves.nonmortar.points.len() + at.path.first;
                    at.path.gradient.iter().enumerate().for_each(|(k, g)| row.add(first + k, g * c));
                }
            }
            row.take()
        };
        let gap = gather(&|at, _| at.frame.gap_row, false);
        let virtual_gap = gather(&|at, _| at.frame.normal, false);
        if !self.rubs {
            return SiteRows { gap, virtual_gap, virtual_slip: vec![], slip: vec![], stretch: vec![] };
        }
        let speed = |at: &PointState| at.z[2].hypot(at.z[3]);
        let stretch = |at: &PointState, point: &QuadraturePoint| {
            let length = at.z[6].hypot(at.z[7]) * point.reference_stretch;
            let mut slots = [0.0; SLOTS];
            slots[6] = at.z[6] / length;
            slots[7] = at.z[7] / length;
            slots
        };
        SiteRows {
            gap,
            virtual_gap,
            virtual_slip: gather(&|at, _| at.frame.tangential, false),
            slip: gather(&|at, _| at.frame.parameter.map(|v| v * speed(at)), true),
            stretch: if state.answer.dq_dstretch == 0.0 { vec![] } else { gather(&stretch, false) },
        }
    }

    fn add_site_tangents(&self, nodes: usize, out: &mut Triplets) {
        let mut row = Row::new(2 * nodes);
        for state in self.sites {
            let open = state.answer.status == ContactStatus::Open;
            self.add_multiplier_block(state, 2 * nodes, out);
            if !open {
                let rows = self.rows(state, &mut row);
                self.add_coupling(state, &rows, 2 * nodes, out);
            }
        }
    }

    /// Rows and columns of the multipliers among themselves.
    fn add_multiplier_block(&self, state: &SiteState, offset: usize, out: &mut Triplets) {
        let a = &state.answer;
        for &(i, mi) in &state.site.reads {
            for &(j, mj) in &state.site.reads {
                let w = mi * mj * state.weight;
                out.push((offset + i, offset + j, w * (a.dp_dp - 1.0) / state.r[0]));
                if self.rubs {
                    let t = offset + self.multipliers;
                    out.push((t + i, t + j, w * (a.dq_dq - 1.0) / state.r[1]));
                    out.push((t + i, offset + j, w * a.dq_dp * a.dp_dp / state.r[1]));
                }
            }
        }
    }

    /// Displacements with displacements and with multipliers.
    fn add_coupling(&self, state: &SiteState, rows: &SiteRows, offset: usize, out: &mut Triplets) {
        let (a, w, t) = (&state.answer, state.weight, offset + self.multipliers);
        // q^ as a row over displacements, times the weight
        let mut friction: Vec<(usize, f64)> = Vec::new();
        let mut add = |row: &[(usize, f64)], factor: f64| {
            if factor != 0.0 {
                friction.extend(row.iter().map(|&(i, v)| (i, factor * v)));
            }
        };
        add(&rows.gap, a.dq_dp * a.dp_dg);
        add(&rows.slip, a.dq_ds);
        add(&rows.stretch, a.dq_dstretch);
        for &(i, g) in &rows.virtual_gap {
            rows.gap.iter().for_each(|&(j, v)| out.push((i, j, -g * a.dp_dg / w * v)));
        }
        for &(i, s) in &rows.virtual_slip {
            friction.iter().for_each(|&(j, v)| out.push((i, j, s / w * v)));
        }
        for &(k, m) in &state.site.reads {
            rows.virtual_gap.iter().for_each(|&(i, g)| out.push((i, offset + k, -g * a.dp_dp * m)));
            rows.gap.iter().for_each(|&(j, g)| out.push((offset + k, j, m * a.dp_dg / state.r[0] * g)));
            for &(i, s) in &rows.virtual_slip {
                out.push((i, offset + k, s * a.dq_dp * a.dp_dp * m));
                out.push((i, t + k, s * a.dq_dq * m));
            }
            friction.iter().for_each(|&(j, v)| out.push((t + k, j, m / state.r[1] * v)));
        }
    }

    fn record(&self, out: &mut InterfaceForces) {
        for state in self.sites {
            out.memory.push(state.memory());
            out.dissipated += state.dissipated();
            out.sites.push(state.record(self.states));
        }
    }
}
