//! A linearised step condensed on the unknowns that contact can act on.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix};

use crate::contact::{ContactDiscretization, SiteKinematics};
use crate::math::{Condensed, DenseMatrix, SolveError};
use crate::model::{Loaded, Model, Pair};

use super::LEAST;
use super::answer::{PairAnswer, multipliers};
use super::bound::{Carries, carries};
use super::conditions::{relaxed, sliding};
use super::programme::{Cone, Facing, Friction, Programme, Site};

/// How a programme comes to a law whose bound depends on the pressure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Bound of the last iterate.
    Tresca,
    /// Bound that follows the pressure, the gap shifted by the slip of the last iterate.
    DeSaxce,
}

/// Shifts tried to make a matrix positive definite, of its mean diagonal: hardly any for a body that only contact holds, whose
/// matrix is singular; then much, so that no direction is left soft by chance.
const SHIFTS: [f64; 7] = [0.0, 1e-10, 1e-8, 1e-3, 1e-2, 0.1, 1.0];

/// Condenses one linearisation after the other; the analysis of the bodies and what is left of their factorisation is kept.
#[derive(Default)]
pub struct Stage {
    touched: BTreeSet<usize>,
    condensed: Option<Condensed>,
}

/// A programme and the way back to all unknowns.
pub struct Staged {
    /// The programme on the touched unknowns.
    pub programme: Programme,
    /// What is needed to complete an increment.
    reduced: Vec<f64>,
}

impl Stage {
    /// Linearises at `loaded` with the bounds of the forces in it.
    ///
    /// # Errors
    /// An interior that is not positive definite.
    pub fn set(
        &mut self,
        model: &Model,
        loaded: &Loaded,
        answers: &[PairAnswer],
        (way, dt): (Way, f64),
    ) -> Result<Staged, SolveError> {
        let facing = |(pair, sites): (&Pair, &Vec<SiteKinematics>)| candidates(model, pair, sites);
        let facing: Vec<Vec<bool>> = model.pairs.iter().zip(&loaded.sites).map(facing).collect();
        self.keep(model, loaded, &facing)?;
        let condensed = self.condensed.as_mut().expect("kept just now");
        condensed.factor(&loaded.stiffness, &[])?;
        let mut reduced: Vec<f64> = loaded.bulk.iter().map(|f| -f).collect();
        condensed.reduce(&mut reduced);
        let force: Vec<f64> = condensed.boundary().iter().map(|&e| -reduced[e]).collect();
        let stiffness = definite(stiffness(condensed, loaded));
        let slot = |e: usize| condensed.slot(e);
        let mut sites = vec![];
        let mut first = 0;
        for (((pair, of), answer), facing) in model.pairs.iter().zip(&loaded.sites).zip(answers).zip(&facing) {
            let at = PairSites { pair, answer, way, dt, first, slot: &slot };
            sites.extend(of.iter().zip(facing).map(|(site, facing)| at.site(site, *facing)));
            first += pair.contact.multipliers();
        }
        let length = scale(model, &force, &sites);
        let programme =
            Programme { stiffness, force, sites, multipliers: multipliers(model), modulus: model.modulus, length };
        Ok(Staged { programme, reduced })
    }

    /// Analyses the bodies again where contact reaches an unknown for the first time, or has left most of those kept.
    fn keep(&mut self, model: &Model, loaded: &Loaded, facing: &[Vec<bool>]) -> Result<(), SolveError> {
        let sites = loaded.sites.iter().flatten().zip(facing.iter().flatten()).filter(|(_, facing)| **facing);
        let rows = sites.flat_map(|(site, _)| site.gap_row.iter().chain(&site.slip_row));
        let mut wanted: BTreeSet<usize> = rows.map(|(e, _)| *e).collect();
        wanted.extend(loaded.geometric.iter().flat_map(|(i, j, _)| [*i, *j]));
        let most = 2 * wanted.len();
        if self.condensed.is_none() || !wanted.is_subset(&self.touched) || self.touched.len() > most {
            let both: BTreeSet<usize> = wanted.union(&self.touched).copied().collect();
            self.touched = if both.len() > most { wanted } else { both };
            let boundary: Arc<[usize]> = self.touched.iter().copied().collect();
            self.condensed = Some(Condensed::new(model.equations.pattern.clone(), boundary)?);
        }
        Ok(())
    }

    /// The increment of all displacement unknowns that belongs to a solution of the programme.
    pub fn complete(&mut self, staged: Staged, increment: &[f64]) -> Vec<f64> {
        let condensed = self.condensed.as_mut().expect("staged before");
        let mut x = staged.reduced;
        condensed.boundary().iter().zip(increment).for_each(|(&e, v)| x[e] = *v);
        condensed.back_substitute(&mut x);
        x
    }
}

/// Sites that may close: partners nearer than an element, or than the nearest site by an element; and all that carry.
fn candidates(model: &Model, pair: &Pair, sites: &[SiteKinematics]) -> Vec<bool> {
    let nearest = sites.iter().map(|site| site.gap).fold(f64::INFINITY, f64::min);
    // r is inverse to the length of the element
    let shortest = model.element_size * pair.contact.augmentation() * pair.contact.numerics().r;
    let element = |site: &SiteKinematics| shortest / site.r[0];
    sites.iter().map(|site| site.load != [0.0; 2] || site.gap <= element(site) + nearest.max(0.0)).collect()
}

/// `S` plus the symmetric part of the geometric stiffness of contact.
fn stiffness(condensed: &Condensed, loaded: &Loaded) -> DMatrix<f64> {
    let mut dense = DenseMatrix::default();
    dense.reset(condensed.boundary().len());
    condensed.add_condensed(&mut dense);
    let n = dense.order();
    let mut matrix = DMatrix::from_fn(n, n, |i, j| dense.entry(i, j));
    for &(i, j, v) in &loaded.geometric {
        if let (Some(i), Some(j)) = (condensed.slot(i), condensed.slot(j)) {
            matrix[(i, j)] += 0.5 * v;
            matrix[(j, i)] += 0.5 * v;
        }
    }
    matrix
}

/// The matrix, shifted until it is positive definite. Any such matrix leads the outer iteration to the same end: its increments
/// vanish there.
fn definite(matrix: DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    let mean = matrix.trace().abs() / n.max(1) as f64;
    for shift in SHIFTS {
        let tried = &matrix + DMatrix::identity(n, n) * (shift * mean);
        if Cholesky::new(tried.clone()).is_some() {
            return tried;
        }
    }
    let bound = matrix.row_iter().map(|row| row.abs().sum()).fold(0.0, f64::max);
    matrix + DMatrix::identity(n, n) * bound
}

/// Length of the increments to be expected: forces over `E`, or the deepest overlap.
fn scale(model: &Model, force: &[f64], sites: &[Site]) -> f64 {
    let force = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let overlap = sites.iter().filter_map(|site| site.facing.as_ref()).fold(0.0_f64, |m, f| m.max(-f.gap));
    (force / model.modulus).max(overlap).max(LEAST * model.element_size)
}

/// Makes the sites of a pair.
struct PairSites<'a> {
    pair: &'a Pair,
    answer: &'a PairAnswer,
    way: Way,
    dt: f64,
    /// Its first multiplier.
    first: usize,
    slot: &'a dyn Fn(usize) -> Option<usize>,
}

impl PairSites<'_> {
    fn site(&self, site: &SiteKinematics, facing: bool) -> Site {
        Site {
            weight: site.weight,
            r: site.r,
            reads: site.reads.iter().map(|&(k, m)| (self.first + k, m)).collect(),
            relaxed: relaxed(self.pair),
            rubs: self.pair.contact.rubs(),
            facing: (facing && site.has_partner()).then(|| self.facing(site)),
        }
    }

    fn facing(&self, site: &SiteKinematics) -> Facing {
        let row = |row: &[(usize, f64)]| row.iter().filter_map(|&(e, v)| Some(((self.slot)(e)?, v))).collect();
        Facing {
            gap: site.gap,
            gap_row: row(&site.gap_row),
            slip: [site.slip + site.deflection],
            slip_rows: [row(&site.slip_row)],
            friction: self.friction(site),
        }
    }

    fn friction(&self, site: &SiteKinematics) -> Friction {
        let Some(law) = self.pair.contact.law() else { return Friction::None };
        let p = site.load[0];
        if p <= 0.0 && self.way == Way::Tresca {
            return Friction::None;
        }
        let bound = match carries(&**law, site, p.max(0.0), self.dt) {
            Carries::Traction([q, _, slope]) => return Friction::Given([q], slope.max(0.0)),
            Carries::Bound(bound) => bound,
        };
        let slip = sliding(site, self.relaxation(site)).abs();
        // no cone is narrower than nothing, whatever a law far from its range says; `max` also drops what is no number
        let [value, by_pressure, hardening] = bound.map(|b| b.max(0.0));
        let [slope, shift] = match self.way {
            Way::Tresca => [0.0, 0.0],
            Way::DeSaxce => [if p > 0.0 { by_pressure.min(value / p) } else { by_pressure }, slip],
        };
        let hardening = if slip > 0.0 { hardening.min((value - slope * p) / slip) } else { hardening };
        let constant = (value - slope * p - hardening * slip).max(0.0);
        Friction::Cone(Cone { constant, slope, hardening, shift })
    }

    /// `(1 - P) q^/r_T`.
    fn relaxation(&self, site: &SiteKinematics) -> f64 {
        if !relaxed(self.pair) {
            return 0.0;
        }
        let multiplier: f64 = site.reads.iter().map(|&(k, m)| m * self.answer.traction[k]).sum();
        (site.load[1] - multiplier) / site.r[1]
    }
}
