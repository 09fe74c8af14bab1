//! How many of the possible contact unknowns are kept out of the interior.

use std::sync::Arc;

use crate::math::{Pattern, System};

/// Chooses the boundary of the condensation. All unknowns that may come into contact are the boundary where the dense LU
/// is then no dearer than the Cholesky factorisation of the interior; else those that are in contact now and a margin of
/// their neighbours along the curves, so that the choice lasts. Costs are counted in operations, an analysis as one
/// factorisation.
pub(super) struct Extent {
    pattern: Arc<Pattern>,
    /// Unknowns that may come into contact, along the curves.
    possible: Arc<[usize]>,
    /// Place of each unknown in `possible`.
    places: Vec<Option<usize>>,
    /// Whether all of them are kept for good.
    whole: bool,
    kept: Vec<bool>,
    touched: Vec<bool>,
    /// Neighbours kept on either side of an unknown in contact.
    margin: usize,
    /// Solutions since the last choice.
    lasted: f64,
    /// Operations that a fresh choice with the same margin would have saved since then; infinite before the first choice.
    waste: f64,
}

impl Extent {
    /// For the pattern and the possible contact unknowns of a system, analysed with all of them kept. `interior` counts the
    /// operations of the factorisation then.
    pub fn new(system: &System, interior: f64) -> Self {
        let (pattern, possible) = (system.bulk.pattern.clone(), system.boundary.clone());
        let mut places = vec![None; pattern.n];
        possible.iter().enumerate().for_each(|(k, &e)| places[e] = Some(k));
        let n = possible.len();
        let whole = dense_lu(n + system.n - pattern.n) <= interior;
        let (kept, touched) = (vec![true; n], vec![false; n]);
        Self { pattern, possible, places, whole, kept, touched, margin: 1, lasted: 0.0, waste: f64::INFINITY }
    }

    /// Whether it was made for the pattern and the possible contact unknowns of a system.
    pub fn fits(&self, system: &System) -> bool {
        let (pattern, boundary) = (&system.bulk.pattern, &system.boundary);
        (Arc::ptr_eq(&self.pattern, pattern) || self.pattern == *pattern)
            && (Arc::ptr_eq(&self.possible, boundary) || self.possible == *boundary)
    }

    /// A new boundary, where the present one does not cover the contact of the system or has become too large. `multipliers`
    /// counts those in the dense block, `factorisation` the operations of the interior.
    pub fn revise(&mut self, system: &System, multipliers: usize, factorisation: f64) -> Option<Arc<[usize]>> {
        if self.whole {
            return None;
        }
        self.touch(system);
        let cost = |kept: &[bool]| dense_lu(kept.iter().filter(|k| **k).count() + multipliers);
        if self.touched.iter().zip(&self.kept).all(|(touched, kept)| kept | !touched) {
            self.waste += (cost(&self.kept) - cost(&self.widened(self.margin))).max(0.0);
            self.lasted += 1.0;
            if self.waste <= factorisation {
                return None;
            }
        } else {
            // the best margin costs as much as the analysis that it puts off
            let spent = |margin| self.lasted * (cost(&self.widened(margin)) - cost(&self.touched));
            if spent(2 * self.margin) <= factorisation {
                self.margin = (2 * self.margin).min(self.touched.len());
            } else if spent(self.margin) > factorisation {
                self.margin = self.margin.div_ceil(2);
            }
        }
        let fresh = self.widened(self.margin);
        (self.lasted, self.waste) = (1.0, 0.0);
        self.kept = fresh;
        Some(self.possible.iter().zip(&self.kept).filter(|(_, kept)| **kept).map(|(&e, _)| e).collect())
    }

    /// Marks the unknowns that the interface couples with others, and those on which it puts a negative spring, which could make
    /// an interior indefinite.
    fn touch(&mut self, system: &System) {
        self.touched.fill(false);
        for &(i, j, _) in system.interface.iter().filter(|(i, j, v)| if i == j { *v < 0.0 } else { *v != 0.0 }) {
            for e in [i, j] {
                if let Some(place) = self.places.get(e).copied().flatten() {
                    self.touched[place] = true;
                }
            }
        }
    }

    /// The unknowns in contact with a margin.
    fn widened(&self, margin: usize) -> Vec<bool> {
        let (n, mut wide) = (self.touched.len(), self.touched.clone());
        for k in (0..n).filter(|&k| self.touched[k]) {
            wide[k.saturating_sub(margin)..n.min(k + margin + 1)].fill(true);
        }
        wide
    }
}

/// Operations of a dense LU.
fn dense_lu(n: usize) -> f64 {
    2.0 / 3.0 * (n as f64).powi(3)
}
