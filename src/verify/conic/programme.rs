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

use clarabel::solver::{IPSolver, SolverStatus};
use nalgebra::DMatrix;

use super::form::Form;

/// Tangential directions: 1 in the plane, 2 in space.
pub const TANGENTS: usize = 1;

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
    pub(super) fn cone(&self) -> Option<Cone> {
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
