//! How many of the possible contact unknowns are kept out of the interior.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

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
    touched: Vec<bool>,
    choice: Choice,
}

/// What is kept, and what the next choice is made from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Whether all possible contact unknowns are kept for good.
    whole: bool,
    /// Those that are kept.
    kept: Vec<bool>,
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
        let choice = Choice { whole, kept: vec![true; n], margin: 1, lasted: 0.0, waste: f64::INFINITY };
        Self { pattern, possible, places, touched: vec![false; n], choice }
    }

    /// The same with a choice that was made before for the same system; `None` where it is of another one.
    pub fn recall(system: &System, choice: Choice) -> Option<Self> {
        let fits = choice.kept.len() == system.boundary.len();
        fits.then(|| Self { choice, ..Self::new(system, 0.0) })
    }

    /// What is kept, and why.
    pub fn choice(&self) -> &Choice {
        &self.choice
    }

    /// The unknowns that are kept.
    pub fn boundary(&self) -> Arc<[usize]> {
        self.possible.iter().zip(&self.choice.kept).filter(|(_, kept)| **kept).map(|(&e, _)| e).collect()
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
        if self.choice.whole {
            return None;
        }
        self.touch(system);
        let cost = |kept: &[bool]| dense_lu(kept.iter().filter(|k| **k).count() + multipliers);
        if self.touched.iter().zip(&self.choice.kept).all(|(touched, kept)| kept | !touched) {
            self.choice.waste += (cost(&self.choice.kept) - cost(&self.widened(self.choice.margin))).max(0.0);
            self.choice.lasted += 1.0;
            if self.choice.waste <= factorisation {
                return None;
            }
        } else {
            // the best margin costs as much as the analysis that it puts off
            let spent = |margin| self.choice.lasted * (cost(&self.widened(margin)) - cost(&self.touched));
            if spent(2 * self.choice.margin) <= factorisation {
                self.choice.margin = (2 * self.choice.margin).min(self.touched.len());
            } else if spent(self.choice.margin) > factorisation {
                self.choice.margin = self.choice.margin.div_ceil(2);
            }
        }
        let fresh = self.widened(self.choice.margin);
        (self.choice.lasted, self.choice.waste) = (1.0, 0.0);
        self.choice.kept = fresh;
        Some(self.boundary())
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
