//! Compressed sparse columns with a fixed pattern, triplets, and their sum: the linear system of a Newton iteration.

use std::sync::Arc;

/// Where a square matrix may have entries: column pointers and sorted row indices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Number of rows and columns.
    pub n: usize,
    /// `n + 1` offsets into `rows`.
    pub columns: Vec<usize>,
    /// Row indices, increasing within a column.
    pub rows: Vec<usize>,
}

impl Pattern {
    /// Pattern of the union of dense blocks: each item lists the unknowns that couple with one another.
    pub fn from_cliques(n: usize, cliques: impl Iterator<Item = Vec<usize>>) -> Self {
        let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); n];
        for clique in cliques {
            for &j in &clique {
                neighbours[j].extend_from_slice(&clique);
            }
        }
        let (mut columns, mut rows) = (vec![0], Vec::new());
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
            rows.append(list);
            columns.push(rows.len());
        }
        Self { n, columns, rows }
    }

    /// Position of entry `(i, j)` in the value array.
    pub fn position(&self, i: usize, j: usize) -> Option<usize> {
        let start = self.columns[j];
        self.rows[start..self.columns[j + 1]].binary_search(&i).ok().map(|k| start + k)
    }
}

/// A sparse matrix on a shared pattern.
#[derive(Clone, Debug)]
pub struct SparseMatrix {
    /// Where the values are.
    pub pattern: Arc<Pattern>,
    /// One value for each row index of the pattern.
    pub values: Vec<f64>,
}

impl SparseMatrix {
    /// `y = A x`.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.pattern.n];
        self.add_product(x, &mut y);
        y
    }

    /// `y += A x`.
    pub fn add_product(&self, x: &[f64], y: &mut [f64]) {
        for (range, xj) in self.pattern.columns.windows(2).zip(x) {
            for k in range[0]..range[1] {
                y[self.pattern.rows[k]] += self.values[k] * xj;
            }
        }
    }

    /// Copies the lower half to the upper one, on a pattern that is symmetric and holds its diagonal.
    pub fn mirror(&mut self) {
        let Pattern { n, columns, rows } = &*self.pattern;
        // Row by row the upper half is the lower one column by column; each column of it is full when its diagonal comes.
        let mut next = columns.clone();
        for j in 0..*n {
            let below = next[j] + 1..columns[j + 1];
            for (k, &i) in below.clone().zip(&rows[below]) {
                self.values[next[i]] = self.values[k];
                next[i] += 1;
            }
        }
    }

    /// Entry `(i, j)`, zero where the pattern has none.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        self.pattern.position(i, j).map_or(0.0, |k| self.values[k])
    }
}

/// Entries `(row, column, value)`; repeated places add up.
pub type Triplets = Vec<(usize, usize, f64)>;

/// The Newton system: bulk stiffness on the displacement equations (leading block, fixed pattern) plus the entries of
/// the interface, whose places change with contact.
#[derive(Clone, Debug)]
pub struct System {
    /// Number of all unknowns.
    pub n: usize,
    /// Stiffness of the bodies, on the first `bulk.pattern.n <= n` unknowns.
    pub bulk: SparseMatrix,
    /// Interface blocks and multiplier rows.
    pub interface: Triplets,
    /// Displacement unknowns that the interface may act on, the same throughout an analysis: a solver may treat the others in
    /// advance. (Springs on the diagonal may stand anywhere.)
    pub boundary: Arc<[usize]>,
}

impl System {
    /// Every entry `(row, column, value)`; those of one place add up.
    pub fn for_each(&self, mut visit: impl FnMut(usize, usize, f64)) {
        let bulk = &self.bulk.pattern;
        for (j, range) in bulk.columns.windows(2).enumerate() {
            for k in range[0]..range[1] {
                visit(bulk.rows[k], j, self.bulk.values[k]);
            }
        }
        self.interface.iter().for_each(|&(i, j, v)| visit(i, j, v));
    }

    /// The sum as one sparse matrix.
    pub fn assemble(&self) -> SparseMatrix {
        let mut extra: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.n];
        for &(i, j, v) in &self.interface {
            extra[j].push((i, v));
        }
        let bulk = &self.bulk.pattern;
        let (mut columns, mut rows, mut values) = (vec![0], Vec::with_capacity(bulk.rows.len()), Vec::new());
        for (j, list) in extra.iter_mut().enumerate() {
            if j < bulk.n {
                let range = bulk.columns[j]..bulk.columns[j + 1];
                list.extend(bulk.rows[range.clone()].iter().copied().zip(self.bulk.values[range].iter().copied()));
            }
            list.sort_by_key(|&(i, _)| i);
            for &(i, v) in list.iter() {
                if rows.len() > columns[j] && rows.last() == Some(&i) {
                    *values.last_mut().expect("as long as rows") += v;
                } else {
                    rows.push(i);
                    values.push(v);
                }
            }
            columns.push(rows.len());
        }
        SparseMatrix { pattern: Arc::new(Pattern { n: self.n, columns, rows }), values }
    }
}
