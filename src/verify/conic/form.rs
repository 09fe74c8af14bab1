//! A programme in Clarabel's vectors, and back.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, SupportedConeT};

use super::programme::{Facing, Friction, Programme, Row, Site, Solution, TANGENTS};

/// Accuracy asked of Clarabel, and the least that is taken from it. Where a site just touches, or is about to slip, pressure and
/// gap are known to the square root of it only. (Asked for more it loses digits on the way.)
const TOLERANCES: [f64; 2] = [1e-11, 1e-8];
/// Iterations granted to it; it takes about 15.
const MOST: u32 = 100;

/// Entries of a sparse matrix: rows, columns, values.
type Entries = (Vec<usize>, Vec<usize>, Vec<f64>);

/// Places of the parts of the programme in Clarabel's vectors `min 1/2 x'Px + q'x, A x + s = b, s in K`.
pub(super) struct Form {
    length: f64,
    /// Mean weight.
    weight: f64,
    /// First place of `e, t` of a site and of its `tau`; of its gap row and its cone.
    columns: Vec<(Option<usize>, Option<usize>)>,
    rows: Vec<(Option<usize>, Option<usize>)>,
    p: Entries,
    a: Entries,
    q: Vec<f64>,
    b: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Form {
    pub fn new(of: &Programme, length: f64) -> Self {
        let n = of.stiffness.nrows();
        let mut form = Self {
            length,
            weight: of.sites.iter().map(|site| site.weight).sum::<f64>() / of.sites.len().max(1) as f64,
            columns: vec![],
            rows: vec![],
            p: Default::default(),
            a: Default::default(),
            q: of.force.iter().map(|f| f / (of.modulus * length)).collect(),
            b: vec![],
            cones: vec![],
        };
        for j in 0..n {
            (0..=j).for_each(|i| push(&mut form.p, i, j, of.stiffness[(i, j)] / of.modulus));
        }
        form.place_columns(of);
        form.given(of);
        form.equalities(of);
        form.gaps(of);
        form.friction(of);
        form
    }

    /// Variables of the sites and their part of the objective; lengths in units of `L`, `w c` in units of `E L`.
    fn place_columns(&mut self, of: &Programme) {
        for site in &of.sites {
            let w = site.weight / of.modulus;
            let mut place = (None, None);
            if site.relaxed {
                place.0 = Some(self.q.len());
                for r in [site.r[0]].into_iter().chain(site.rubs.then_some([site.r[1]; TANGENTS]).into_iter().flatten())
                {
                    push(&mut self.p, self.q.len(), self.q.len(), w * r);
                    self.q.push(0.0);
                }
            }
            if let Some(cone) = site.facing.as_ref().and_then(Facing::cone) {
                place.1 = Some(self.q.len());
                push(&mut self.p, self.q.len(), self.q.len(), w * cone.hardening);
                self.q.push(w * cone.constant / self.length);
            }
            self.columns.push(place);
        }
    }

    /// Tractions of direct laws: `w q.(S x - t) + w k/2 |S x|^2`.
    fn given(&mut self, of: &Programme) {
        for (site, (relaxation, _)) in of.sites.iter().zip(&self.columns) {
            let Some((facing, (traction, slope))) = site.facing.as_ref().and_then(|f| match f.friction {
                Friction::Given(traction, slope) => Some((f, (traction, slope))),
                _ => None,
            }) else {
                continue;
            };
            let w = site.weight / of.modulus;
            for (c, (row, q)) in facing.slip_rows.iter().zip(traction).enumerate() {
                row.iter().for_each(|&(j, v)| self.q[j] += w * q * v / self.length);
                relaxation.iter().for_each(|e| self.q[e + 1 + c] -= w * q / self.length);
                for &(i, a) in row.iter().filter(|_| slope > 0.0) {
                    row.iter().filter(|(j, _)| i <= *j).for_each(|&(j, b)| push(&mut self.p, i, j, w * slope * a * b));
                }
            }
        }
    }

    /// `sum_a M_aA w_a e_a = 0` and the same for every component of `t`, weights in units of their mean: duals are then of the
    /// size of those of the sites.
    fn equalities(&mut self, of: &Programme) {
        let count = (1 + TANGENTS) * of.multipliers;
        for (site, (relaxation, _)) in of.sites.iter().zip(&self.columns) {
            let Some(first) = relaxation else { continue };
            for &(multiplier, m) in &site.reads {
                for k in 0..if site.rubs { 1 + TANGENTS } else { 1 } {
                    push(&mut self.a, k * of.multipliers + multiplier, first + k, m * site.weight / self.weight);
                }
            }
        }
        self.b.resize(count, 0.0);
        self.cones.push(SupportedConeT::ZeroConeT(count));
    }

    /// Factor on the row of a gap: one that is wide open must not set the scale of the others.
    fn share(&self, facing: &Facing) -> f64 {
        (self.length / facing.gap.abs()).min(1.0)
    }

    fn gaps(&mut self, of: &Programme) {
        let first = self.b.len();
        for (site, (relaxation, bound)) in of.sites.iter().zip(&self.columns) {
            let Some(facing) = &site.facing else {
                self.rows.push((None, None));
                continue;
            };
            let row = self.b.len();
            self.rows.push((Some(row), None));
            let share = self.share(facing);
            facing.gap_row.iter().for_each(|&(j, v)| push(&mut self.a, row, j, -share * v));
            relaxation.iter().for_each(|&e| push(&mut self.a, row, e, -share));
            let mut lift = 0.0;
            if let (Some(cone), Some(tau)) = (facing.cone(), bound) {
                push(&mut self.a, row, *tau, share * cone.slope);
                lift = cone.slope * cone.shift;
            }
            self.b.push(share * (facing.gap + lift) / self.length);
        }
        self.cones.push(SupportedConeT::NonnegativeConeT(self.b.len() - first));
    }

    fn friction(&mut self, of: &Programme) {
        for (k, site) in of.sites.iter().enumerate() {
            let (Some(facing), (relaxation, Some(tau))) = (&site.facing, self.columns[k]) else { continue };
            let row = self.b.len();
            self.rows[k].1 = Some(row);
            push(&mut self.a, row, tau, -1.0);
            self.b.push(0.0);
            for c in 0..TANGENTS {
                facing.slip_rows[c].iter().for_each(|&(j, v)| push(&mut self.a, row + 1 + c, j, -v));
                relaxation.iter().for_each(|&e| push(&mut self.a, row + 1 + c, e + 1 + c, 1.0));
                self.b.push(facing.slip[c] / self.length);
            }
            self.cones.push(SupportedConeT::SecondOrderConeT(1 + TANGENTS));
        }
    }

    /// Clarabel set up.
    pub fn solver(&self) -> Result<DefaultSolver<f64>, String> {
        let (n, m) = (self.q.len(), self.b.len());
        let matrix =
            |rows: usize, (i, j, v): &Entries| CscMatrix::new_from_triplets(rows, n, i.clone(), j.clone(), v.clone());
        let settings = DefaultSettings {
            verbose: false,
            max_iter: MOST,
            max_threads: 1,
            direct_solve_method: "qdldl".into(),
            tol_gap_abs: TOLERANCES[0],
            tol_gap_rel: TOLERANCES[0],
            tol_feas: TOLERANCES[0],
            reduced_tol_gap_abs: TOLERANCES[1],
            reduced_tol_gap_rel: TOLERANCES[1],
            reduced_tol_feas: TOLERANCES[1],
            ..DefaultSettings::default()
        };
        DefaultSolver::new(&matrix(n, &self.p), &self.q, &matrix(m, &self.a), &self.b, &self.cones, settings)
            .map_err(|error| format!("Clarabel refuses the programme: {error}"))
    }

    /// Back to units; duals of rows with lengths are forces in units of `E L`.
    pub fn read(&self, of: &Programme, x: &[f64], z: &[f64]) -> Solution {
        let force = of.modulus * self.length;
        let n = of.stiffness.nrows();
        let pressure = |(site, (row, _)): (&Site, &(Option<usize>, Option<usize>))| {
            let share = site.facing.as_ref().map_or(1.0, |facing| self.share(facing));
            row.map_or(0.0, |row| share * z[row] * force / site.weight)
        };
        let slipped = |row: &Row| row.iter().map(|&(j, v)| v * x[j] * self.length).sum::<f64>();
        let traction = |(site, (_, row)): (&Site, &(Option<usize>, Option<usize>))| match (row, &site.facing) {
            (Some(row), _) => std::array::from_fn(|c| -z[row + 1 + c] * force / site.weight),
            (None, Some(Facing { friction: Friction::Given(q, slope), slip_rows, .. })) => {
                std::array::from_fn(|c| q[c] + slope * slipped(&slip_rows[c]))
            }
            _ => [0.0; TANGENTS],
        };
        let stress = |kind: usize, multiplier: usize| z[kind * of.multipliers + multiplier] * force / self.weight;
        let mut found = Solution {
            increment: x[..n].iter().map(|v| v * self.length).collect(),
            pressure: of.sites.iter().zip(&self.rows).map(pressure).collect(),
            traction: of.sites.iter().zip(&self.rows).map(traction).collect(),
            pressures: (0..of.multipliers).map(|k| stress(0, k)).collect(),
            tractions: (0..of.multipliers).map(|k| std::array::from_fn(|c| stress(1 + c, k))).collect(),
            duality_gap: 0.0,
            iterations: 0,
            attempts: 0,
        };
        // sites that are not relaxed are their multipliers
        for (site, (p, q)) in of.sites.iter().zip(found.pressure.iter().zip(&found.traction)) {
            for &(multiplier, _) in site.reads.iter().filter(|_| !site.relaxed) {
                (found.pressures[multiplier], found.tractions[multiplier]) = (*p, *q);
            }
        }
        found
    }
}

fn push(entries: &mut Entries, i: usize, j: usize, v: f64) {
    entries.0.push(i);
    entries.1.push(j);
    entries.2.push(v);
}
