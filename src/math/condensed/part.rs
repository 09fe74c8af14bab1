//! A connected part of the bulk, usually a body: Cholesky of its interior and the stiffness condensed on its boundary.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::supernodal::{
    SupernodalLltRef, SupernodeRef, factorize_supernodal_numeric_llt, factorize_supernodal_numeric_llt_scratch,
};
use faer::{Accum, Mat, MatMut, MatRef, Par};

use super::analysis::{Analysis, view};
use crate::math::{DenseMatrix, Pattern, SolveError, checksum};

/// `K = [K_II K_IB; K_BI K_BB]` of one part, I its interior and B its boundary.
///
/// With `K_II = L_II L_II'` and `L_BI = K_BI L_II'^-1` the condensed stiffness is `S = K_BB - L_BI L_BI'`. A sparse
/// Cholesky of the whole part with the boundary last comes to it: its trailing block is a Cholesky factor of `S`. But `S`
/// need not be positive definite (a body that only contact holds, a surface about to buckle), so the diagonal of `K_BB` is
/// doubled before, `L_BB L_BB' = S + diag |K_BB|`, and the same amount taken off afterwards. That costs no accuracy: the
/// round-off of `S` is that of forming `K_BB - L_BI L_BI'` itself, row by row.
pub(super) struct Part {
    analysis: Analysis,
    /// Values of the lower triangle that `factor` and `condensed` belong to.
    values: Vec<f64>,
    /// Values on the way in, then with the diagonal of the boundary doubled.
    work: Vec<f64>,
    /// Values of the Cholesky factor.
    factor: Vec<f64>,
    /// Whether `factor` and `condensed` belong to `values`.
    factored: bool,
    /// `S`, lower triangle.
    condensed: Mat<f64>,
    /// `L_BB`.
    trailing: Mat<f64>,
    /// A vector in the order of the part.
    local: Vec<f64>,
    /// Its entries below a supernode.
    below: Vec<f64>,
    memory: MemBuffer,
}

impl Part {
    /// Analyses a part; `unknowns` from `interior` on are its boundary.
    pub fn new(bulk: &Pattern, unknowns: Vec<usize>, interior: usize) -> Result<Self, SolveError> {
        let analysis = Analysis::new(bulk, unknowns, interior)?;
        let n = analysis.unknowns.len();
        let scratch =
            factorize_supernodal_numeric_llt_scratch::<usize, f64>(&analysis.symbolic, Par::Seq, Default::default());
        Ok(Self {
            values: vec![0.0; analysis.source.len()],
            work: vec![0.0; analysis.source.len()],
            factor: vec![0.0; analysis.symbolic.len_val()],
            factored: false,
            condensed: Mat::new(),
            trailing: Mat::new(),
            local: vec![0.0; n],
            below: vec![0.0; n],
            memory: MemBuffer::new(scratch),
            analysis,
        })
    }

    /// Unknowns of the bulk: the interior in order of elimination, then the boundary.
    pub fn unknowns(&self) -> &[usize] {
        &self.analysis.unknowns
    }

    /// The last of [`Self::unknowns`].
    pub fn boundary(&self) -> &[usize] {
        &self.analysis.unknowns[self.analysis.interior..]
    }

    /// Operations of the Cholesky factorisation of the interior: the squares of its column lengths.
    pub fn operations(&self) -> f64 {
        let Analysis { interior, symbolic, .. } = &self.analysis;
        let nodes = symbolic.supernode_begin().iter().zip(symbolic.supernode_end()).enumerate();
        let columns = nodes.flat_map(|(s, (&start, &end))| {
            let below = symbolic.supernode(s).pattern().len();
            (start..end.min(*interior)).map(move |j| (end - j + below) as f64)
        });
        columns.map(|length| length * length).sum()
    }

    /// Takes the values of the bulk and springs `(place in the part, stiffness)`; factors unless nothing has changed since
    /// the last time. Whether it did.
    pub fn factor(&mut self, bulk: &[f64], springs: impl Iterator<Item = (usize, f64)>) -> Result<bool, SolveError> {
        let Analysis { source, lower, .. } = &self.analysis;
        self.work.iter_mut().zip(source).for_each(|(v, &k)| *v = bulk[k]);
        springs.for_each(|(place, v)| self.work[lower.columns[place]] += v);
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        if self.factored && self.values.iter().zip(&self.work).all(same) {
            return Ok(false);
        }
        std::mem::swap(&mut self.values, &mut self.work);
        self.factored = false;
        self.decompose()?;
        self.condense();
        self.factored = true;
        Ok(true)
    }

    /// Checksum of the values that are factored, if any.
    pub fn checksum(&self) -> Option<u64> {
        self.factored.then(|| checksum(self.values.iter().map(|v| v.to_bits())))
    }

    /// Cholesky factor with the diagonal of the boundary doubled.
    fn decompose(&mut self) -> Result<(), SolveError> {
        let Analysis { unknowns, interior, lower, symbolic, .. } = &self.analysis;
        self.work.copy_from_slice(&self.values);
        for &k in &lower.columns[*interior..unknowns.len()] {
            self.work[k] += shift(self.values[k]);
        }
        let matrix = SparseColMatRef::new(view(lower), &self.work);
        let (memory, default) = (MemStack::new(&mut self.memory), Default::default());
        factorize_supernodal_numeric_llt(
            &mut self.factor,
            matrix,
            default,
            symbolic,
            Par::Seq,
            memory,
            Default::default(),
        )
        .map_err(|_| SolveError::Indefinite)?;
        Ok(())
    }

    /// `S = L_BB L_BB' - diag |K_BB|`.
    fn condense(&mut self) {
        let Analysis { interior, lower, symbolic, .. } = &self.analysis;
        let llt = SupernodalLltRef::new(symbolic, &self.factor);
        let n = self.analysis.boundary();
        self.condensed.resize_with(n, n, |_, _| 0.0);
        self.trailing.resize_with(n, n, |_, _| 0.0);
        self.trailing.fill(0.0);
        for s in (0..symbolic.n_supernodes()).rev() {
            let node = llt.supernode(s);
            let columns = node.start()..node.start() + node.val().ncols();
            if columns.end <= *interior {
                break;
            }
            for j in columns.start.max(*interior)..columns.end {
                let column = node.val().col(j - columns.start);
                for (i, v) in rows(&node, 0).zip(column.iter()).filter(|(i, _)| *i >= j) {
                    self.trailing[(i - interior, j - interior)] = *v;
                }
            }
        }
        use BlockStructure::{TriangularLower, TriangularUpper};
        let (l, s) = (self.trailing.as_ref(), self.condensed.as_mut());
        triangular::matmul(
            s,
            TriangularLower,
            Accum::Replace,
            l,
            TriangularLower,
            l.transpose(),
            TriangularUpper,
            1.0,
            Par::Seq,
        );
        for k in 0..self.trailing.ncols() {
            self.condensed[(k, k)] -= shift(self.values[lower.columns[interior + k]]);
        }
    }

    /// Adds `S` to a matrix in which the boundary unknowns stand in the given rows.
    pub fn add_condensed(&self, slots: &[usize], target: &mut DenseMatrix) {
        for (j, &column) in slots.iter().enumerate() {
            target.add(column, column, self.condensed[(j, j)]);
            for (i, &row) in slots.iter().enumerate().skip(j + 1) {
                target.add(row, column, self.condensed[(i, j)]);
                target.add(column, row, self.condensed[(i, j)]);
            }
        }
    }

    /// From `(f_I, f_B)` to `(y, f_B - L_BI y)` with `y = L_II^-1 f_I`.
    pub fn reduce(&mut self, f: &mut [f64]) {
        let Analysis { unknowns, interior, symbolic, .. } = &self.analysis;
        let llt = SupernodalLltRef::new(symbolic, &self.factor);
        self.local.iter_mut().zip(unknowns).for_each(|(v, &e)| *v = f[e]);
        for s in 0..symbolic.n_supernodes() {
            let node = llt.supernode(s);
            let Some((width, top, bottom)) = interior_columns(&node, *interior) else { break };
            let x = &mut self.local[node.start()..node.start() + width];
            solve_lower_triangular_in_place(top, column_mut(x), Par::Seq);
            let below = &mut self.below[..bottom.nrows()];
            matmul(column_mut(below), Accum::Replace, bottom, column(x), 1.0, Par::Seq);
            for (i, v) in rows(&node, width).zip(below) {
                self.local[i] -= *v;
            }
        }
        self.local.iter().zip(unknowns).for_each(|(v, &e)| f[e] = *v);
    }

    /// From `(y, x_B)` to `(x_I, x_B)` with `x_I = L_II'^-1 (y - L_BI' x_B)`.
    pub fn back_substitute(&mut self, x: &mut [f64]) {
        let Analysis { unknowns, interior, symbolic, .. } = &self.analysis;
        let llt = SupernodalLltRef::new(symbolic, &self.factor);
        self.local.iter_mut().zip(unknowns).for_each(|(v, &e)| *v = x[e]);
        for s in (0..symbolic.n_supernodes()).rev() {
            let node = llt.supernode(s);
            let Some((width, top, bottom)) = interior_columns(&node, *interior) else { continue };
            let below = &mut self.below[..bottom.nrows()];
            for (i, v) in rows(&node, width).zip(below.iter_mut()) {
                *v = self.local[i];
            }
            let y = &mut self.local[node.start()..node.start() + width];
            matmul(column_mut(y), Accum::Add, bottom.transpose(), column(below), -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), column_mut(y), Par::Seq);
        }
        self.local.iter().zip(unknowns).for_each(|(v, &e)| x[e] = *v);
    }
}

/// What is added to a diagonal entry of the boundary: as much again; anything does for an unknown that the bulk does not
/// hold at all, for it is coupled with no other.
fn shift(diagonal: f64) -> f64 {
    if diagonal == 0.0 { 1.0 } else { diagonal.abs() }
}

/// Rows of a supernode from the given one on.
fn rows<'a>(node: &SupernodeRef<'a, usize, f64>, from: usize) -> impl Iterator<Item = usize> + use<'a> {
    let (start, columns) = (node.start(), node.val().ncols());
    (start + from..start + columns).chain(node.pattern().iter().copied())
}

/// Number of the interior columns of a supernode, their triangle and the rows below it. `None` where it has none.
fn interior_columns<'a>(
    node: &SupernodeRef<'a, usize, f64>,
    interior: usize,
) -> Option<(usize, MatRef<'a, f64>, MatRef<'a, f64>)> {
    let width = interior.checked_sub(node.start()).filter(|&left| left > 0)?.min(node.val().ncols());
    let (top, bottom) = node.val().subcols(0, width).split_at_row(width);
    Some((width, top, bottom))
}

fn column(x: &[f64]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(x, x.len(), 1)
}

fn column_mut(x: &mut [f64]) -> MatMut<'_, f64> {
    let n = x.len();
    MatMut::from_column_major_slice_mut(x, n, 1)
}
