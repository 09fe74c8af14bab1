//! Sparse elimination of the multipliers that carry nothing.

use std::ops::Range;

use crate::math::{DenseMatrix, System};

/// Multipliers without any coupling to displacements (all their sites are open) couple with their neighbours along the
/// edge only. They are eliminated one after the other, in their order, wherever the diagonal is the largest entry of its
/// column (so growth is bounded as with partial pivoting; for the mass-like blocks of open sites it is). The others are
/// left to the dense block, with what the elimination puts on them.
#[derive(Default)]
pub(super) struct Idle {
    /// Number of the first multiplier.
    first: usize,
    /// For each multiplier its row among the multipliers; empty once it is eliminated.
    rows: Vec<Vec<(usize, f64)>>,
    /// Rows in which each multiplier occurs, eliminated ones among them.
    columns: Vec<Vec<usize>>,
    /// Multipliers that are coupled to displacements.
    bound: Vec<bool>,
    pivots: Vec<Pivot>,
    /// Factors and rows of the pivots.
    entries: Vec<(usize, f64)>,
    /// Multipliers left, in order.
    left: Vec<usize>,
    /// Place of each multiplier among those left.
    place: Vec<Option<usize>>,
}

/// One eliminated multiplier: `x = (b - upper x) / value`; `lower` times `b` is taken from the right-hand sides below.
struct Pivot {
    multiplier: usize,
    value: f64,
    lower: Range<usize>,
    upper: Range<usize>,
}

impl Idle {
    /// Takes the multiplier block of a system and eliminates what it can.
    pub fn eliminate(&mut self, system: &System) {
        self.gather(system);
        self.pivots.clear();
        self.entries.clear();
        let count = self.rows.len();
        (0..count).filter(|&k| !self.bound[k]).collect::<Vec<_>>().into_iter().for_each(|k| self.pivot(k));
        let gone = self.pivots.iter().map(|p| p.multiplier).collect::<Vec<_>>();
        self.place.clear();
        self.place.resize(count, None);
        self.left.clear();
        let mut gone = gone.into_iter().peekable();
        for k in 0..count {
            if gone.next_if_eq(&k).is_none() {
                self.place[k] = Some(self.left.len());
                self.left.push(k);
            }
        }
    }

    /// Multipliers left to the dense block, counted from the first.
    pub fn left(&self) -> &[usize] {
        &self.left
    }

    /// Place of an unknown of the system among those left.
    pub fn place(&self, unknown: usize) -> Option<usize> {
        self.place[unknown - self.first]
    }

    fn gather(&mut self, system: &System) {
        self.first = system.bulk.pattern.n;
        let count = system.n - self.first;
        self.rows.resize(count, Vec::new());
        self.columns.resize(count, Vec::new());
        self.rows.iter_mut().for_each(Vec::clear);
        self.columns.iter_mut().for_each(Vec::clear);
        self.bound.clear();
        self.bound.resize(count, false);
        for &(i, j, v) in system.interface.iter().filter(|entry| entry.2 != 0.0) {
            match (i.checked_sub(self.first), j.checked_sub(self.first)) {
                (Some(i), Some(j)) => self.add(i, j, v),
                (Some(k), None) | (None, Some(k)) => self.bound[k] = true,
                (None, None) => {}
            }
        }
    }

    fn add(&mut self, i: usize, j: usize, v: f64) {
        match self.rows[i].iter_mut().find(|(column, _)| *column == j) {
            Some((_, value)) => *value += v,
            None => {
                self.rows[i].push((j, v));
                self.columns[j].push(i);
            }
        }
    }

    /// Eliminates a multiplier if its diagonal is the largest entry of its column.
    fn pivot(&mut self, k: usize) {
        let value = self.entry(k, k);
        let below = std::mem::take(&mut self.columns[k]);
        let column = |i: &usize| self.entry(*i, k);
        if value == 0.0 || !below.iter().all(|i| column(i).abs() <= value.abs()) {
            self.columns[k] = below;
            return;
        }
        let row = std::mem::take(&mut self.rows[k]);
        let start = self.entries.len();
        for i in below.into_iter().filter(|&i| i != k) {
            let Some(at) = self.rows[i].iter().position(|(column, _)| *column == k) else { continue };
            let factor = self.rows[i].swap_remove(at).1 / value;
            self.entries.push((i, factor));
            row.iter().filter(|(j, _)| *j != k).for_each(|&(j, u)| self.add(i, j, -factor * u));
        }
        let middle = self.entries.len();
        self.entries.extend(row.into_iter().filter(|(j, _)| *j != k));
        self.pivots.push(Pivot { multiplier: k, value, lower: start..middle, upper: middle..self.entries.len() });
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self.rows[i].iter().find(|(column, _)| *column == j).map_or(0.0, |(_, v)| *v)
    }

    /// Adds what is left of the multiplier block to a matrix, from row `offset` on.
    pub fn add_left(&self, offset: usize, target: &mut DenseMatrix) {
        for (row, &i) in self.left.iter().enumerate() {
            for &(j, v) in &self.rows[i] {
                if let Some(column) = self.place[j] {
                    target.add(offset + row, offset + column, v);
                }
            }
        }
    }

    /// Takes the eliminated equations from a right-hand side of the multipliers.
    pub fn reduce(&self, f: &mut [f64]) {
        for pivot in &self.pivots {
            let v = f[pivot.multiplier];
            self.entries[pivot.lower.clone()].iter().for_each(|(i, factor)| f[*i] -= factor * v);
        }
    }

    /// Completes a solution that is known for the multipliers left.
    pub fn back_substitute(&self, x: &mut [f64]) {
        for pivot in self.pivots.iter().rev() {
            let known: f64 = self.entries[pivot.upper.clone()].iter().map(|(j, u)| u * x[*j]).sum();
            x[pivot.multiplier] = (x[pivot.multiplier] - known) / pivot.value;
        }
    }
}
