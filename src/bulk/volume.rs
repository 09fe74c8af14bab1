//! Near incompressibility: the dilatation of the volumetric energy is projected onto a coarser space.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::Material;
use crate::geometry::Patch;

/// Poisson's ratio up to which a material does without: the errors of the pressure are then those of `nu = 0.3`
/// (papers/incompressible).
const PLAIN: f64 = 0.4;

/// `lambda/mu` at [`PLAIN`]: the share of `lambda` that acts on the dilatation of each point.
pub(super) const POINTWISE: f64 = 2.0 * PLAIN / (1.0 - 2.0 * PLAIN);

/// A space of dilatations without continuity: on each block of elements the polynomials of a total degree, in the
/// parameters of the patch.
///
/// With `theta(F)` of [`Material`], the projection `P` onto this space in `L2` of the reference body, and
/// `lambda = lambda_0 + lambda_P`, `lambda_0 = min(lambda, 4 mu)`, the strain energy is
///
/// ```text
/// W = int psi_rest(F) + lambda_0/2 theta^2 + lambda_P/2 (P theta)^2 dX,       tau = lambda_0 theta + lambda_P P theta
/// ```
///
/// the mixed form of displacement and pressure with the pressure eliminated block by block. The first term is the
/// material at `nu = 0.4`, which does not lock; it lets `tau` vary inside a block and makes the step at 0.4 continuous.
/// `P` is self-adjoint: the internal forces `dW = int (d psi_rest/dF + tau d theta/dF) : dF dX` are the exact gradient, and
/// with an orthonormal basis `phi_k` the second derivative is symmetric:
///
/// ```text
/// d2W = int dF : [d2 psi_rest + tau d2 theta + lambda_0 d theta x d theta] : DF dX
///       + lambda_P sum_k (int phi_k d theta dX)(int phi_k D theta dX)
/// ```
///
/// A uniform deformation has `theta = P theta` and keeps its energy and stress. Near incompressibility a space is free of
/// oscillating pressures if it is small enough for the inf-sup condition: of splines of degree `p` it holds, independent
/// of `h`, on blocks of 4 x 4 elements with quadratics for `p = 2, 3, 4` and of 2 x 2 with constants for `p = 1`, not for
/// instance of one element with constants (any `p`: a checkerboard), of 2 x 2 with linears (`p = 2, 4`), of 4 x 4 with
/// cubics (`p = 4`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VolumeSpace {
    /// Elements of a block along each direction (one less or some more where their number is no multiple).
    pub block: usize,
    /// Total degree.
    pub degree: usize,
}

/// `lambda/(4 mu)`, at least 1: how much stiffer against changes of volume a material is than at `nu = 0.4`.
pub fn confinement(material: &dyn Material) -> f64 {
    let (lambda, mu) = material.lame();
    (lambda / (POINTWISE * mu)).max(1.0)
}

impl fmt::Display for VolumeSpace {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let functions = ["constants", "linears", "quadratics"].get(self.degree).copied();
        match functions {
            Some(name) => write!(f, "{name}")?,
            None => write!(f, "polynomials of degree {}", self.degree)?,
        }
        write!(f, " on {0} x {0} elements", self.block)
    }
}

impl VolumeSpace {
    /// The space for a patch of a material, if Poisson's ratio is above 0.4. Quadratic Lagrange elements have enough
    /// functions of their own for linear dilatations.
    pub fn needed(patch: &Patch, material: &dyn Material) -> Option<Self> {
        let basis = &patch.basis;
        let lowest = basis[0].degree().min(basis[1].degree());
        let (block, degree) = match (lowest, basis[0].name()) {
            (1, _) => (2, 0),
            (_, "lagrange") => (1, 1),
            _ => (4, 2),
        };
        Self::asked_by(material).then_some(Self { block, degree })
    }

    /// Whether a material asks for a space.
    pub fn asked_by(material: &dyn Material) -> bool {
        material.poissons_ratio() > PLAIN
    }

    /// Functions on a block.
    pub fn functions(&self) -> usize {
        (self.degree + 1) * (self.degree + 2) / 2
    }

    /// Products of Legendre polynomials of the parameters, scaled to `[-1, 1]` on a block.
    fn products(&self, [[u0, u1], [v0, v1]]: [[f64; 2]; 2], [u, v]: [f64; 2], out: &mut Vec<f64>) {
        let [s, t] = [(u, u0, u1), (v, v0, v1)].map(|(x, a, b)| (2.0 * x - a - b) / (b - a));
        out.clear();
        for total in 0..=self.degree {
            out.extend((0..=total).map(|k| legendre(total - k, s) * legendre(k, t)));
        }
    }
}

fn legendre(degree: usize, x: f64) -> f64 {
    let (mut last, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        (last, value) = (value, ((2.0 * k + 1.0) * x * value - k * last) / (k + 1.0));
    }
    value
}

/// One block of elements.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub elements: Vec<usize>,
    pub nodes: Vec<usize>,
    /// For each element, the place of its nodes among those of the block.
    pub places: Vec<usize>,
    /// Parameters.
    range: [[f64; 2]; 2],
    /// `phi_k = sum_l coefficients[k, l] product_l`.
    coefficients: DMatrix<f64>,
}

/// The space on the elements of a patch.
#[derive(Clone, Debug)]
pub(super) struct Volume {
    pub space: VolumeSpace,
    pub blocks: Vec<Block>,
    /// `phi_k`, ordered element, quadrature point, function.
    pub values: Vec<f64>,
    /// Block of each element.
    home: Vec<usize>,
    /// Elements in a row.
    row: usize,
}

/// What the elements of a patch are to their blocks.
pub(super) struct Points<'a> {
    pub nodes: &'a [usize],
    pub nodes_per_element: usize,
    /// Parameters of the quadrature points, element by element.
    pub parameters: &'a [[f64; 2]],
    pub weights: &'a [f64],
    pub per_element: usize,
}

impl Volume {
    pub fn new(patch: &Patch, space: VolumeSpace, points: &Points) -> Self {
        let [nu, nv] = patch.elements();
        let parts = [nu, nv].map(|n| parts(n, space.block));
        let mut home = vec![0; nu * nv];
        let mut blocks = vec![];
        let mut values = vec![0.0; points.weights.len() * space.functions()];
        for (v, u) in parts[1].iter().flat_map(|v| parts[0].iter().map(move |u| (v, u))) {
            let elements: Vec<usize> = v.clone().flat_map(|j| u.clone().map(move |i| i + j * nu)).collect();
            elements.iter().for_each(|&e| home[e] = blocks.len());
            let ends = [patch.span_box([u.start, v.start]), patch.span_box([u.end - 1, v.end - 1])];
            let range = [0, 1].map(|d| [ends[0][d][0], ends[1][d][1]]);
            blocks.push(Block::new(elements, range, space, points, &mut values));
        }
        Self { space, blocks, values, home, row: nu }
    }

    /// Block of an element and its functions at the parameters `uv`.
    pub fn at(&self, [i, j]: [usize; 2], uv: [f64; 2]) -> (usize, Vec<f64>) {
        let home = self.home[i + j * self.row];
        let (block, mut products) = (&self.blocks[home], vec![]);
        self.space.products(block.range, uv, &mut products);
        (home, (&block.coefficients * DVector::from_vec(products)).as_slice().to_vec())
    }
}

/// `n` elements in blocks of about `size`, the same from both ends, so that what is symmetric stays so: an odd number of
/// elements in an odd number of blocks. Those that are larger by one lie inside, away from the edges that are in contact.
fn parts(n: usize, size: usize) -> Vec<std::ops::Range<usize>> {
    let full = (n / size).max(1);
    let count = full + usize::from(full.is_multiple_of(2) && n % 2 == 1);
    let (length, larger, half) = (n / count, n % count, count / 2);
    let is_larger = |k: usize| match k.min(count - 1 - k) {
        pair if pair == half => larger % 2 == 1,
        pair => pair + larger / 2 >= half,
    };
    let mut start = 0;
    let part = |k: usize| {
        let first = start;
        start += length + usize::from(is_larger(k));
        first..start
    };
    (0..count).map(part).collect()
}

impl Block {
    fn new(
        elements: Vec<usize>,
        range: [[f64; 2]; 2],
        space: VolumeSpace,
        points: &Points,
        values: &mut [f64],
    ) -> Self {
        let n = points.nodes_per_element;
        let of = |e: usize| &points.nodes[e * n..(e + 1) * n];
        let mut nodes: Vec<usize> = elements.iter().flat_map(|&e| of(e)).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let place = |a: &usize| nodes.partition_point(|b| b < a);
        let places = elements.iter().flat_map(|&e| of(e)).map(place).collect();
        let at = || elements.iter().flat_map(|&e| e * points.per_element..(e + 1) * points.per_element);
        let (mut products, mut table) = (vec![], vec![]);
        for q in at() {
            space.products(range, points.parameters[q], &mut products);
            table.push((products.clone(), points.weights[q]));
        }
        let coefficients = orthonormal(space.functions(), &table);
        for (q, (products, _)) in at().zip(&table) {
            let phi = &coefficients * DVector::from_column_slice(products);
            values[q * phi.len()..(q + 1) * phi.len()].copy_from_slice(phi.as_slice());
        }
        Self { elements, nodes, places, range, coefficients }
    }
}

/// Inverse of the Cholesky factor of the mass matrix: rows are orthonormal functions.
fn orthonormal(count: usize, table: &[(Vec<f64>, f64)]) -> DMatrix<f64> {
    let mut mass = DMatrix::zeros(count, count);
    for (products, w) in table {
        let column = DVector::from_column_slice(products);
        mass.ger(*w, &column, &column, 1.0);
    }
    let factor = mass.cholesky().expect("as many quadrature points as functions, on a body of positive area").l();
    factor.solve_lower_triangular(&DMatrix::identity(count, count)).expect("a regular factor")
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn blocks_are_symmetric_and_of_about_the_size() {
        for (n, size) in (1..200).flat_map(|n| [1, 2, 4].map(|size| (n, size))) {
            let parts = parts(n, size);
            assert_eq!((parts[0].start, parts[parts.len() - 1].end), (0, n));
            for (part, mirror) in parts.iter().zip(parts.iter().rev()) {
                assert_eq!(part.len(), mirror.len(), "{n} in {size}: {parts:?}");
                assert!(n < size || (part.len() + 1 >= size && part.len() < 2 * size && !part.is_empty()), "{parts:?}");
            }
            assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start));
        }
    }
}
