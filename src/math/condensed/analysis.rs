//! Symbolic side of a part: order of elimination, places of the stiffness entries, structure of the factor.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::simplicial::{
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::cholesky::supernodal::{
    SymbolicSupernodalCholesky, factorize_supernodal_symbolic_cholesky, factorize_supernodal_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::{amd, qr};

use crate::math::{Pattern, SolveError};

/// What is known of a part before its values are.
#[derive(Debug)]
pub(super) struct Analysis {
    /// Unknown of the bulk behind each place: the interior in order of elimination, then the boundary.
    pub unknowns: Vec<usize>,
    /// Number of interior unknowns.
    pub interior: usize,
    /// Lower triangle of the part in this order, the diagonal first in each column.
    pub lower: Pattern,
    /// Where in the values of the bulk each entry of `lower` stands. Only the lower half of the bulk is read.
    pub source: Vec<usize>,
    /// Structure of the Cholesky factor.
    pub symbolic: SymbolicSupernodalCholesky<usize>,
}

impl Analysis {
    /// Analyses the part of `bulk` on the given unknowns; the last ones, from `interior` on, are its boundary.
    pub fn new(bulk: &Pattern, mut unknowns: Vec<usize>, interior: usize) -> Result<Self, SolveError> {
        let (graph, _) = lower_triangle(bulk, &unknowns);
        let mut order = minimum_degree(&with_clique(graph, interior))?;
        order.retain(|k| *k < interior);
        reorder(&mut unknowns, &order);
        let (graph, _) = lower_triangle(bulk, &unknowns[..interior]);
        reorder(&mut unknowns, &postorder(&transposed(&graph)));
        let (lower, source) = lower_triangle(bulk, &unknowns);
        let symbolic = structure(&transposed(&lower))?;
        Ok(Self { unknowns, interior, lower, source, symbolic })
    }

    /// Number of boundary unknowns.
    pub fn boundary(&self) -> usize {
        self.unknowns.len() - self.interior
    }
}

/// Lower triangle of the rows and columns `unknowns`, in that order, and the place of each entry in the bulk.
fn lower_triangle(bulk: &Pattern, unknowns: &[usize]) -> (Pattern, Vec<usize>) {
    let mut place = vec![usize::MAX; bulk.n];
    unknowns.iter().enumerate().for_each(|(k, &unknown)| place[unknown] = k);
    let mut entries: Vec<Vec<(usize, usize)>> = vec![Vec::new(); unknowns.len()];
    for &column in unknowns {
        for k in bulk.columns[column]..bulk.columns[column + 1] {
            let row = bulk.rows[k];
            if row >= column && place[row] != usize::MAX {
                let (i, j) = (place[row], place[column]);
                entries[i.min(j)].push((i.max(j), k));
            }
        }
    }
    let (mut columns, mut rows, mut source) = (vec![0], Vec::new(), Vec::new());
    for list in &mut entries {
        list.sort_unstable();
        rows.extend(list.iter().map(|&(row, _)| row));
        source.extend(list.iter().map(|&(_, k)| k));
        columns.push(rows.len());
    }
    (Pattern { n: unknowns.len(), columns, rows }, source)
}

fn transposed(pattern: &Pattern) -> Pattern {
    let mut lists: Vec<Vec<usize>> = vec![Vec::new(); pattern.n];
    for (j, range) in pattern.columns.windows(2).enumerate() {
        pattern.rows[range[0]..range[1]].iter().for_each(|&i| lists[i].push(j));
    }
    let mut columns = vec![0];
    columns.extend(lists.iter().scan(0, |end, list| {
        *end += list.len();
        Some(*end)
    }));
    Pattern { n: pattern.n, columns, rows: lists.concat() }
}

pub(in crate::math) fn view(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    SymbolicSparseColMatRef::new_checked(pattern.n, pattern.n, &pattern.columns, None, &pattern.rows)
}

/// Replaces the first unknowns by those at the given places.
fn reorder(unknowns: &mut [usize], order: &[usize]) {
    let ordered: Vec<usize> = order.iter().map(|&k| unknowns[k]).collect();
    unknowns[..order.len()].copy_from_slice(&ordered);
}

/// Couples all unknowns from `interior` on with one another, as the elimination of the others will do.
fn with_clique(mut lower: Pattern, interior: usize) -> Pattern {
    lower.rows.truncate(lower.columns[interior]);
    lower.columns.truncate(interior + 1);
    for j in interior..lower.n {
        lower.rows.extend(j..lower.n);
        lower.columns.push(lower.rows.len());
    }
    lower
}

/// Order of elimination with little fill-in (approximate minimum degree; Amestoy, Davis, Duff, SIAM J. Matrix Anal. Appl. 17
/// (1996) 886): the k-th to be eliminated is `order[k]`. With the boundary as a clique its unknowns have the largest
/// degrees and come last, and the degrees of the interior count those that an unknown is coupled with: contacts far from one
/// another are brought together late.
fn minimum_degree(graph: &Pattern) -> Result<Vec<usize>, SolveError> {
    let (mut order, mut inverse) = (vec![0; graph.n], vec![0; graph.n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(graph.n, graph.rows.len()));
    let control = amd::Control { dense: -1.0, ..Default::default() }; // no unknown is set aside for its degree
    amd::order(&mut order, &mut inverse, view(graph), control, MemStack::new(&mut memory))
        .map_err(|error| SolveError::TooLarge(error.to_string()))?;
    Ok(order)
}

/// An order with the same fill-in in which every subtree of the elimination tree is contiguous.
fn postorder(upper: &Pattern) -> Vec<usize> {
    let n = upper.n;
    let scratch =
        prefactorize_symbolic_cholesky_scratch::<usize>(n, upper.rows.len()).or(qr::postorder_scratch::<usize>(n));
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let (mut tree, mut counts, mut order) = (vec![0; n], vec![0; n], vec![0; n]);
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, view(upper), stack);
    qr::postorder(&mut order, tree, stack);
    order
}

/// Structure of the factor of a matrix whose upper triangle is given.
fn structure(upper: &Pattern) -> Result<SymbolicSupernodalCholesky<usize>, SolveError> {
    let (n, matrix) = (upper.n, view(upper));
    let scratch = prefactorize_symbolic_cholesky_scratch::<usize>(n, upper.rows.len())
        .or(factorize_supernodal_symbolic_cholesky_scratch::<usize>(n));
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let (mut tree, mut counts) = (vec![0; n], vec![0; n]);
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, matrix, stack);
    factorize_supernodal_symbolic_cholesky(matrix, tree, &counts, stack, Default::default())
        .map_err(|error| SolveError::TooLarge(error.to_string()))
}
