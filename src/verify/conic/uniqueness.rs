//! Whether friction may have more than one solution.
//!
//! With the bounds `b` given (Tresca) a linearised step has one solution. Coulomb's law asks for a fixed point of the map from the
//! bounds to `b(p^)`. At a state whose sites are open, sticking or slipping its derivative is
//!
//! ```text
//! T = diag(db/dp) (dp^/dq^) diag(sign q^)
//! ```
//!
//! with `dp^/dq^` the pressures that tractions at the slipping sites call forth at all sites that rub, the closed sites held closed
//! and the sticking ones held in place. Where `|T| < 1` the map contracts, whatever the directions of slip, and the rate problem has one solution.
//! For a single site with the condensed stiffness `[[k_t, k_nt], [k_nt, k_n]]` this is `mu |k_nt| < k_t` (theory 6.1; Klarbring 1990,
//! Alart 1993): `dp^ = k_nt du_t`, `du_t = dq^/k_t`. With several sites `|T|` is the spectral norm in the square roots of the
//! weights, so that the number does not depend on how fine the sites are. It is sufficient, not necessary: beyond 1 uniqueness is
//! no longer sure, not lost.

use nalgebra::{DMatrix, LU};

use super::programme::{Programme, Site, TANGENTS};

/// State of a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// Open.
    Open,
    /// Closed without bound: no friction, or a direct law.
    Frictionless,
    /// Sticking, with `db/dp`.
    Stick(f64),
    /// Slipping, with `db/dp`.
    Slip(f64),
}

/// `|T|` of a programme (its bounds do not matter) at a pattern of its sites; 0 where nothing slips, infinite where the state is
/// not determined at given bounds.
pub fn coupling(programme: &Programme, pattern: &[Pattern]) -> f64 {
    let frame = Frame::new(programme, pattern);
    let slips: Vec<usize> = (0..pattern.len()).filter(|&k| matches!(pattern[k], Pattern::Slip(_))).collect();
    let rubs: Vec<(usize, f64)> = pattern.iter().enumerate().filter_map(|(k, p)| Some((k, p.slope()?))).collect();
    if slips.is_empty() {
        return 0.0;
    }
    let mut loads = DMatrix::zeros(frame.size, slips.len());
    slips.iter().enumerate().for_each(|(column, &k)| frame.pull(k, column, &mut loads));
    let Some(found) = LU::new(frame.matrix()).solve(&loads) else { return f64::INFINITY };
    let weight = |k: usize| programme.sites[k].weight;
    let map = DMatrix::from_fn(rubs.len(), slips.len(), |i, j| {
        let ((k, slope), from) = (rubs[i], slips[j]);
        let row = frame.pressure[k].expect("sites that rub are closed");
        // the unknown is w p^
        slope * found[(row, j)] / weight(k) * (weight(k) / weight(from)).sqrt()
    });
    if map.iter().all(|v| v.is_finite()) { map.singular_values().max() } else { f64::INFINITY }
}

impl Pattern {
    /// `db/dp` of a site that rubs.
    fn slope(self) -> Option<f64> {
        match self {
            Self::Stick(slope) | Self::Slip(slope) => Some(slope),
            Self::Open | Self::Frictionless => None,
        }
    }
}

/// Places of the unknowns: increments, `w p^` of closed sites, `w q^` of sticking ones, multipliers.
struct Frame<'a> {
    programme: &'a Programme,
    size: usize,
    pressure: Vec<Option<usize>>,
    traction: Vec<Option<usize>>,
    multipliers: usize,
}

impl<'a> Frame<'a> {
    fn new(programme: &'a Programme, pattern: &[Pattern]) -> Self {
        let mut next = programme.stiffness.nrows();
        let mut place = |wanted: bool, size: usize| {
            wanted.then(|| {
                next += size;
                next - size
            })
        };
        let pressure = pattern.iter().map(|p| place(*p != Pattern::Open, 1)).collect();
        let traction = pattern.iter().map(|p| place(matches!(p, Pattern::Stick(_)), TANGENTS)).collect();
        let multipliers = next;
        let size = multipliers + (1 + TANGENTS) * programme.multipliers;
        Self { programme, size, pressure, traction, multipliers }
    }

    /// `-S' w q^` of a unit of `q^`, by the site's length scale of forces: what a traction puts on the bodies and on `t`.
    fn pull(&self, k: usize, column: usize, loads: &mut DMatrix<f64>) {
        let site = &self.programme.sites[k];
        let Some(facing) = &site.facing else { return };
        facing.slip_rows[0].iter().for_each(|&(j, v)| loads[(j, column)] -= site.weight * v);
        for &(a, m) in site.reads.iter().filter(|_| site.relaxed) {
            loads[(self.multipliers + self.programme.multipliers + a, column)] -= m * site.weight / site.r[1];
        }
    }

    /// Conditions of the programme with its active rows as equations.
    fn matrix(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.size, self.size);
        let n = self.programme.stiffness.nrows();
        matrix.view_mut((0, 0), (n, n)).copy_from(&self.programme.stiffness);
        for (k, site) in self.programme.sites.iter().enumerate() {
            let facing = site.facing.as_ref();
            if let (Some(row), Some(facing)) = (self.pressure[k], facing) {
                facing.gap_row.iter().for_each(|&(j, v)| couple(&mut matrix, row, j, [v, -v]));
            }
            if let (Some(row), Some(facing)) = (self.traction[k], facing) {
                for (c, slip) in facing.slip_rows.iter().enumerate() {
                    slip.iter().for_each(|&(j, v)| couple(&mut matrix, row + c, j, [v, v]));
                }
            }
            self.relax(site, self.pressure[k], self.multipliers, (site.r[0], 1.0), &mut matrix);
            for c in 0..if site.rubs { TANGENTS } else { 0 } {
                let first = self.multipliers + (1 + c) * self.programme.multipliers;
                self.relax(site, self.traction[k].map(|row| row + c), first, (site.r[1], -1.0), &mut matrix);
            }
        }
        // a multiplier that nothing reads, or of a site without stabilisation, is nothing
        for row in self.multipliers..self.size {
            if matrix[(row, row)] == 0.0 {
                matrix[(row, row)] = 1.0;
            }
        }
        matrix
    }

    /// `g + (p^ - M p_A)/r = 0` (sign +) or `s - (q^ - M q_A)/r = 0` (sign -), and `sum M w (p^ - M p_A)/r = 0`.
    fn relax(&self, site: &Site, row: Option<usize>, first: usize, (r, sign): (f64, f64), matrix: &mut DMatrix<f64>) {
        if !site.relaxed {
            return;
        }
        if let Some(row) = row {
            matrix[(row, row)] += sign / (r * site.weight);
        }
        for &(a, m) in &site.reads {
            if let Some(row) = row {
                matrix[(row, first + a)] -= sign * m / r;
                matrix[(first + a, row)] += m / r;
            }
            site.reads.iter().for_each(|&(b, v)| matrix[(first + a, first + b)] -= m * v * site.weight / r);
        }
    }
}

/// Entries `[row of the condition, column of the force]`.
fn couple(matrix: &mut DMatrix<f64>, row: usize, j: usize, [condition, force]: [f64; 2]) {
    matrix[(row, j)] += condition;
    matrix[(j, row)] += force;
}
