//! How far the stress of a solution is from a smoother one: the error of the discretization, without knowing the solution.

use nalgebra::{Cholesky, DMatrix, Dyn, Matrix2};

use super::elements::{Elements, deformation_gradient};
use super::{Material, Tau};
use crate::geometry::{BSpline, Basis, MAX_DEGREE, Patch, Point, Shape};
use crate::math::gauss;

/// Recovery of stresses on a patch.
///
/// The stress `s` of a solution jumps, or bends, from element to element. Fitted by smooth splines `s*` of the degree of the solution,
///
/// ```text
/// sum_k w_k (s* - s)(x_k) N(x_k) = 0   for all splines N of degree p with p - 1 continuous derivatives on the elements,
/// ```
///
/// at the p Gauss points of each element and direction, where the stress is more accurate than elsewhere (degree 1: at two), it
/// gains about one order where the solution is smooth (Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33, 1992). So the energy of
/// the difference estimates that of the error,
///
/// ```text
/// eta^2 = int (s* - s) : C^-1 : (s* - s) dx,     C^-1 of small strain, plane strain.
/// ```
///
/// (A projection in L2 would not do for even degrees: what their derivatives are wrong by is nearly continuous.) The fit is made over the
/// parameters: there the mass matrix is the product of two of one direction.
pub struct Recovery<'a> {
    elements: &'a Elements,
    patch: &'a Patch,
    material: &'a dyn Material,
    directions: [Direction; 2],
}

/// Smooth functions along one parameter.
struct Direction {
    /// At the Gauss points of every span, `degree + 1` of the solution.
    shapes: Vec<Vec<Shape>>,
    /// The moment of each function that a unit value at one of these points makes: `sum_k w_k N(x_k) L(x_k)` over the sampling points.
    moments: Vec<Vec<[f64; MAX_DEGREE + 1]>>,
    /// Parameters of the Gauss points.
    at: Vec<Vec<f64>>,
    mass: Cholesky<f64, Dyn>,
}

/// Cauchy stress `xx, yy, xy` and current area at every quadrature point.
struct Points {
    stress: Vec<[f64; 3]>,
    areas: Vec<f64>,
    /// Largest `|F - I|`.
    strain: f64,
}

/// Energies of a state of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StressError {
    /// `eta^2`.
    pub error: f64,
    /// The same of the stress itself: twice the strain energy at small strain.
    pub stress: f64,
    /// Largest displacement gradient `|F - I|`, rotations included.
    pub strain: f64,
}

impl Direction {
    fn new(basis: &dyn Basis) -> Option<Self> {
        let degree = basis.degree();
        let smooth = BSpline::from_breaks(degree, basis.breaks(), |_| 1).ok()?;
        let (rule, sampling) = (gauss(degree + 1), gauss(degree.max(2)));
        let mut mass = DMatrix::zeros(smooth.len(), smooth.len());
        let (mut shapes, mut moments, mut at) = (vec![], vec![], vec![]);
        for (span, ends) in basis.breaks().windows(2).enumerate() {
            let place = |x: &f64| ends[0] + x * (ends[1] - ends[0]);
            at.push(rule.points.iter().map(place).collect::<Vec<_>>());
            shapes.push(at[span].iter().map(|&xi| smooth.evaluate(span, xi)).collect::<Vec<_>>());
            let mut own = vec![[0.0; MAX_DEGREE + 1]; rule.points.len()];
            for (x, w) in sampling.points.iter().zip(&sampling.weights) {
                let (shape, w) = (smooth.evaluate(span, place(x)), w * (ends[1] - ends[0]));
                for (i, j) in (0..shape.count).flat_map(|i| (0..shape.count).map(move |j| (i, j))) {
                    mass[(shape.first + i, shape.first + j)] += w * shape.d[0][i] * shape.d[0][j];
                }
                for (g, moments) in own.iter_mut().enumerate() {
                    let value = w * cardinal(&rule.points, g, *x);
                    (0..shape.count).for_each(|i| moments[i] += value * shape.d[0][i]);
                }
            }
            moments.push(own);
        }
        Some(Self { shapes, moments, at, mass: mass.cholesky()? })
    }

    /// Number of functions.
    fn len(&self) -> usize {
        self.mass.l_dirty().nrows()
    }
}

/// The polynomial through the points that is 1 at one of them and 0 at the others.
fn cardinal(points: &[f64], one: usize, x: f64) -> f64 {
    let others = points.iter().enumerate().filter(|(k, _)| *k != one);
    others.map(|(_, y)| (x - y) / (points[one] - y)).product()
}

impl<'a> Recovery<'a> {
    /// For a body; `None` where a basis is degenerate.
    pub fn new(elements: &'a Elements, patch: &'a Patch, material: &'a dyn Material) -> Option<Self> {
        let [u, v] = [0, 1].map(|d| Direction::new(patch.basis[d].as_ref()));
        Some(Self { elements, patch, material, directions: [u?, v?] })
    }

    /// Energies at the displacement `u` of the control points; `None` where the material has no state.
    pub fn error(&self, u: &[Point]) -> Option<StressError> {
        let Points { stress, areas, strain } = self.stresses(u)?;
        let smooth: [Vec<f64>; 3] = std::array::from_fn(|c| self.recover(|q| stress[q][c]));
        let (e, nu) = (self.material.youngs_modulus(), self.material.poissons_ratio());
        let energy =
            |[xx, yy, xy]: [f64; 3]| (1.0 + nu) / e * (xx * xx + yy * yy + 2.0 * xy * xy - nu * (xx + yy) * (xx + yy));
        let mut sum = StressError { strain, ..StressError::default() };
        for (q, (s, area)) in stress.iter().zip(&areas).enumerate() {
            sum.error += area * energy(std::array::from_fn(|c| smooth[c][q] - s[c]));
            sum.stress += area * energy(*s);
        }
        Some(sum)
    }

    fn stresses(&self, u: &[Point]) -> Option<Points> {
        let tau: Tau = self.elements.tau(self.material, u);
        let (mut stress, mut areas, mut strain) = (vec![], vec![], 0.0_f64);
        for (e, ([i, j], [a, b])) in self.places().enumerate() {
            let per_element = self.directions[0].at[i].len() * self.directions[1].at[j].len();
            let (nodes, points, gradients) = self.elements.element(e / per_element);
            let q = e % per_element;
            let f = deformation_gradient(nodes, &gradients[q * nodes.len()..(q + 1) * nodes.len()], u);
            let uv = [self.directions[0].at[i][a], self.directions[1].at[j][b]];
            let [xx, yy, _, xy] = self.material.cauchy(&f, &|theta| tau.at([i, j], uv, theta))?;
            stress.push([xx, yy, xy]);
            strain = strain.max((f - Matrix2::identity()).norm());
            let stretch = if self.material.small_strain() { 1.0 } else { f.determinant() };
            areas.push(self.elements.weights[points.start + q] * stretch);
        }
        Some(Points { stress, areas, strain })
    }

    /// Element `[i, j]` and point `[a, b]` of every quadrature point, in their order.
    fn places(&self) -> impl Iterator<Item = ([usize; 2], [usize; 2])> + '_ {
        let [nu, nv] = self.patch.elements();
        let [pu, pv] = [0, 1].map(|d| self.patch.basis[d].degree() + 1);
        (0..nv).flat_map(move |j| {
            (0..nu).flat_map(move |i| (0..pv).flat_map(move |b| (0..pu).map(move |a| ([i, j], [a, b]))))
        })
    }

    /// The projection of a field given at the quadrature points, at these points.
    fn recover(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let [u, v] = &self.directions;
        let mut sums = DMatrix::zeros(u.len(), v.len());
        for (q, ([i, j], [a, b])) in self.places().enumerate() {
            let (s, t, value) = (&u.shapes[i][a], &v.shapes[j][b], value(q));
            for (l, k) in (0..t.count).flat_map(|l| (0..s.count).map(move |k| (l, k))) {
                sums[(s.first + k, t.first + l)] += value * u.moments[i][a][k] * v.moments[j][b][l];
            }
        }
        let half = u.mass.solve(&sums);
        let net = v.mass.solve(&half.transpose());
        let at = |([i, j], [a, b]): ([usize; 2], [usize; 2])| {
            let (s, t) = (&u.shapes[i][a], &v.shapes[j][b]);
            let pairs = (0..t.count).flat_map(|l| (0..s.count).map(move |k| (l, k)));
            pairs.map(|(l, k)| net[(t.first + l, s.first + k)] * s.d[0][k] * t.d[0][l]).sum()
        };
        self.places().map(at).collect()
    }
}
