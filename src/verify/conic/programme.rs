//! One convex programme: linearised bodies, unilateral contact, friction in a second-order cone.
//!
//! # Primal
//!
//! Increments `x` of the displacements, stabilisation slips `e_a` (normal) and `t_a` (tangential), bounds `tau_a` on the slip:
//!
//! ```text
//! min  1/2 x'K x + f'x + sum_a w_a [ r_N/2 e_a^2 + r_T/2 |t_a|^2 + c_a tau_a + h_a/2 tau_a^2 ]
//!
//! dual         constraint
//! w_a p^_a     g_a + G_a x + e_a + m_a (sigma_a - tau_a) >= 0
//! w_a (b_a, -q^_a)    (tau_a, s_a + S_a x - t_a) in the second-order cone |s - t| <= tau
//! p_A          sum_a M_aA w_a e_a = 0
//! q_A          sum_a M_aA w_a t_a = 0
//! ```
//!
//! # What its conditions say
//!
//! `x`: `K x + f - sum w p^ G + sum w q^ S = 0`, equilibrium. `e`: `r_N e = p^ - sum M p_A`, and the equality makes `p_A` the
//! projection `P p^`, so the gap condition reads `0 <= p^  complementary to  g + (1 - P) p^/r_N >= 0`, that of quadrature sites;
//! `t`: `r_T t = q^ - sum M q_A` likewise. `tau`: `b = c + m p^ + h tau`. The cone: `|q^| <= b`, and `q^ = b s~/|s~|`
//! where `s~ = s + S x - t` is not zero. Sites that are not relaxed (nodal) have neither `e` nor `t`.
//!
//! # Coulomb's law
//!
//! is no convex programme: with slope `m` and no shift the cone would lift a sliding site by `m |s~|`. Two ways around, both
//! exact when an outer iteration has come to rest (theory 2.9): *Tresca*, `m = 0` and `c = b(p^)` of the last iterate; *De Saxce*,
//! `m = db/dp` and the shift `sigma = |s~|` of the last iterate, which takes the lift away again. `h >= 0` is the slope of a bound
//! that grows with the slip.
//!
//! # Scales
//!
//! Lengths in units of a length `L` of the order of the increments, stresses such that `E` is 1: all entries of the matrix are then
//! of order one, whatever the units.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::DMatrix;

/// Tangential directions: 1 in the plane, 2 in space.
pub const TANGENTS: usize = 1;

/// Accuracy asked of Clarabel, and the least that is taken from it.
const TOLERANCES: [f64; 2] = [1e-11, 1e-8];
/// Factors on the length scale, one attempt after the other.
const ATTEMPTS: [f64; 3] = [1.0, 30.0, 0.03];

/// A sparse row over the increments.
pub type Row = Vec<(usize, f64)>;

/// What a site that may be closed asks for.
#[derive(Clone, Debug, Default)]
pub struct Facing {
    /// `g`.
    pub gap: f64,
    /// `G`.
    pub gap_row: Row,
    /// `s`, deflection at the start of the step included.
    pub slip: [f64; TANGENTS],
    /// `S`.
    pub slip_rows: [Row; TANGENTS],
    /// What it carries along the slip.
    pub friction: Friction,
}

/// Friction of a site that may be closed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Friction {
    /// None.
    #[default]
    None,
    /// Set-valued law.
    Cone(Cone),
    /// Direct law: a given traction, and its slope `>= 0` in the slip. No cone.
    Given([f64; TANGENTS], f64),
}

impl Facing {
    fn cone(&self) -> Option<Cone> {
        match self.friction {
            Friction::Cone(cone) => Some(cone),
            _ => None,
        }
    }
}

/// Bound on the traction, `c + m p^ + h tau`, and the shift of the gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// `c >= 0`.
    pub constant: f64,
    /// `m >= 0`.
    pub slope: f64,
    /// `h >= 0`.
    pub hardening: f64,
    /// `sigma`.
    pub shift: f64,
}

/// A site of the programme.
#[derive(Clone, Debug, Default)]
pub struct Site {
    /// `w`.
    pub weight: f64,
    /// `[r_N, r_T]`.
    pub r: [f64; 2],
    /// `(A, M_aA)`.
    pub reads: Row,
    /// True with stabilisation (quadrature sites).
    pub relaxed: bool,
    /// Whether it rubs: then it has a multiplier of the traction.
    pub rubs: bool,
    /// `None` where it is known to stay open.
    pub facing: Option<Facing>,
}

/// The programme.
#[derive(Clone, Debug)]
pub struct Programme {
    /// `K`, symmetric positive semidefinite.
    pub stiffness: DMatrix<f64>,
    /// `f`.
    pub force: Vec<f64>,
    /// Sites.
    pub sites: Vec<Site>,
    /// Number of multipliers of each kind.
    pub multipliers: usize,
    /// Stress scale `E`.
    pub modulus: f64,
    /// Length scale `L`.
    pub length: f64,
}

/// Its solution.
#[derive(Clone, Debug)]
pub struct Solution {
    /// `x`.
    pub increment: Vec<f64>,
    /// `p^` of each site.
    pub pressure: Vec<f64>,
    /// `q^` of each site.
    pub traction: Vec<[f64; TANGENTS]>,
    /// `p_A`.
    pub pressures: Vec<f64>,
    /// `q_A`.
    pub tractions: Vec<[f64; TANGENTS]>,
    /// Primal less dual objective over their size.
    pub duality_gap: f64,
    /// Iterations of the interior-point method, all attempts.
    pub iterations: usize,
    /// Attempts it took.
    pub attempts: usize,
}

impl Programme {
    /// Solves; where Clarabel makes no progress, again with other scales.
    ///
    /// # Errors
    /// Clarabel's word for it.
    pub fn solve(&self) -> Result<Solution, String> {
        let mut iterations = 0;
        let mut last = String::new();
        for (k, factor) in ATTEMPTS.into_iter().enumerate() {
            let form = Form::new(self, factor * self.length);
            let mut solver = form.solver()?;
            solver.solve();
            iterations += solver.solution.iterations as usize;
            let status = solver.solution.status;
            if matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
                let found = &solver.solution;
                let gap = (found.obj_val - found.obj_val_dual).abs() / found.obj_val.abs().max(1.0);
                return Ok(Solution {
                    duality_gap: gap,
                    iterations,
                    attempts: k + 1,
                    ..form.read(self, &found.x, &found.z)
                });
            }
            last = format!("{status:?}");
        }
        Err(format!("Clarabel answers {last} at {} scales", ATTEMPTS.len()))
    }
}

/// Places of the parts of the programme in Clarabel's vectors `min 1/2 x'Px + q'x, A x + s = b, s in K`.
struct Form {
    length: f64,
    /// Mean weight.
    weight: f64,
    /// First place of `e, t` of a site and of its `tau`; of its gap row and its cone.
    columns: Vec<(Option<usize>, Option<usize>)>,
    rows: Vec<(Option<usize>, Option<usize>)>,
    p: (Vec<usize>, Vec<usize>, Vec<f64>),
    a: (Vec<usize>, Vec<usize>, Vec<f64>),
    q: Vec<f64>,
    b: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Form {
    fn new(of: &Programme, length: f64) -> Self {
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
            for c in 0..TANGENTS {
                let row = &facing.slip_rows[c];
                row.iter().for_each(|&(j, v)| self.q[j] += w * traction[c] * v / self.length);
                relaxation.iter().for_each(|e| self.q[e + 1 + c] -= w * traction[c] / self.length);
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

    fn solver(&self) -> Result<DefaultSolver<f64>, String> {
        let (n, m) = (self.q.len(), self.b.len());
        let matrix = |rows: usize, (i, j, v): &(Vec<usize>, Vec<usize>, Vec<f64>)| {
            CscMatrix::new_from_triplets(rows, n, i.clone(), j.clone(), v.clone())
        };
        let settings = DefaultSettings {
            verbose: false,
            max_iter: 100,
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
    fn read(&self, of: &Programme, x: &[f64], z: &[f64]) -> Solution {
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

fn push(entries: &mut (Vec<usize>, Vec<usize>, Vec<f64>), i: usize, j: usize, v: f64) {
    entries.0.push(i);
    entries.1.push(j);
    entries.2.push(v);
}
