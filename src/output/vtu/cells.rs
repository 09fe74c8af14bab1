//! The grid of a field output: Bezier cells of all bodies with their control values, in the point order of VTK.

use super::bezier::{Bernstein, Extraction, Sites, bernstein, extract_all};
use super::{BodyField, CauchySample, StressField};
use crate::geometry::{Curve, Patch, Point};

/// VTK cell type of a curve cell.
const BEZIER_CURVE: u8 = 75;
/// VTK cell type of a quadrilateral cell.
const BEZIER_QUADRILATERAL: u8 = 77;

/// Cells and control values of all bodies of one output; every cell owns its points, so that fields may jump.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Projected control points in the reference position.
    pub points: Vec<[f64; 3]>,
    /// Weights of the control points.
    pub weights: Vec<f64>,
    /// Bezier coefficients of the displacement.
    pub displacement: Vec<[f64; 3]>,
    /// Bezier coefficients of the Cauchy stress `xx, yy, zz, xy`; NaN on rigid bodies.
    pub stress: Vec<[f64; 4]>,
    /// Bezier coefficients of the von Mises stress; NaN on rigid bodies.
    pub von_mises: Vec<f64>,
    /// Bezier coefficients of det F; NaN on rigid bodies.
    pub det_f: Vec<f64>,
    /// Number of points up to and including each cell.
    pub offsets: Vec<usize>,
    /// VTK cell type.
    pub types: Vec<u8>,
    /// Degrees in both directions; the second is 0 for curves.
    pub degrees: Vec<[usize; 2]>,
    /// Index of the body in the scene.
    pub body: Vec<usize>,
}

impl Grid {
    /// Collects all elements of all bodies.
    pub fn build(bodies: &[BodyField]) -> Self {
        let mut grid = Self::default();
        for (id, body) in bodies.iter().enumerate() {
            match body {
                BodyField::Deformable { patch, displacement, stress, .. } => {
                    grid.patch(id, patch, displacement, stress);
                }
                BodyField::Rigid { curve, displacement, .. } => grid.curve(id, curve, displacement),
            }
        }
        grid
    }

    fn patch(&mut self, id: usize, patch: &Patch, displacement: &[Point], stress: &StressField) {
        let degrees = [patch.basis[0].degree(), patch.basis[1].degree()];
        let spans = [extract_all(patch.basis[0].as_ref()), extract_all(patch.basis[1].as_ref())];
        let sampler = StressFit::new(degrees);
        for (j, v) in spans[1].iter().enumerate() {
            for (i, u) in spans[0].iter().enumerate() {
                let net = Net::of_patch(patch, displacement, u, v);
                let samples = sampler.coefficients(patch.span_box([i, j]), &net.weights, |uv| stress([i, j], uv));
                for (a, b) in cell_order(degrees) {
                    let k = a + b * (degrees[0] + 1);
                    self.point(&net, k, samples[k]);
                }
                self.close(id, BEZIER_QUADRILATERAL, degrees);
            }
        }
    }

    fn curve(&mut self, id: usize, curve: &Curve, displacement: &[Point]) {
        let degree = curve.basis.degree();
        for span in extract_all(curve.basis.as_ref()) {
            let net = Net::of_curve(curve, displacement, &span);
            for k in std::iter::once(0).chain([degree]).chain(1..degree) {
                self.point(&net, k, [f64::NAN; 6]);
            }
            self.close(id, BEZIER_CURVE, [degree, 0]);
        }
    }

    fn point(&mut self, net: &Net, k: usize, [xx, yy, zz, xy, von_mises, det_f]: [f64; 6]) {
        let flat = |p: Point| [p.x, p.y, 0.0];
        self.points.push(flat(net.points[k]));
        self.weights.push(net.weights[k]);
        self.displacement.push(flat(net.displacement[k]));
        self.stress.push([xx, yy, zz, xy]);
        self.von_mises.push(von_mises);
        self.det_f.push(det_f);
    }

    fn close(&mut self, id: usize, kind: u8, degrees: [usize; 2]) {
        self.offsets.push(self.points.len());
        self.types.push(kind);
        self.degrees.push(degrees);
        self.body.push(id);
    }
}

/// Order of the control points `(a, b)` of a quadrilateral cell in VTK: corners counter-clockwise, the inside of the
/// edges `v = 0`, `u = 1` (both ascending), `v = 1`, `u = 0` (ascending too), then the interior with `u` fastest.
pub fn cell_order([p, q]: [usize; 2]) -> Vec<(usize, usize)> {
    let mut order = vec![(0, 0), (p, 0), (p, q), (0, q)];
    order.extend((1..p).map(|a| (a, 0)));
    order.extend((1..q).map(|b| (p, b)));
    order.extend((1..p).map(|a| (a, q)));
    order.extend((1..q).map(|b| (0, b)));
    order.extend((1..q).flat_map(|b| (1..p).map(move |a| (a, b))));
    order
}

/// Bezier control net of one element: index `a + b * (p + 1)`.
struct Net {
    weights: Vec<f64>,
    points: Vec<Point>,
    displacement: Vec<Point>,
}

impl Net {
    fn of_patch(patch: &Patch, displacement: &[Point], u: &Extraction, v: &Extraction) -> Self {
        let width = patch.basis[0].len();
        let mut net = Self::zeros(u.coefficients[0].len() * v.coefficients[0].len());
        for (j, cv) in v.coefficients.iter().enumerate() {
            for (i, cu) in u.coefficients.iter().enumerate() {
                let node = u.first + i + (v.first + j) * width;
                let products = cv.iter().flat_map(|b| cu.iter().map(move |a| a * b));
                net.add(products, patch.weights[node], patch.points[node], displacement[node]);
            }
        }
        net.projected()
    }

    fn of_curve(curve: &Curve, displacement: &[Point], span: &Extraction) -> Self {
        let mut net = Self::zeros(span.coefficients[0].len());
        for (i, c) in span.coefficients.iter().enumerate() {
            let node = span.first + i;
            net.add(c.iter().copied(), curve.weights[node], curve.points[node], displacement[node]);
        }
        net.projected()
    }

    fn zeros(count: usize) -> Self {
        let points = vec![Point::zeros(); count];
        Self { weights: vec![0.0; count], displacement: points.clone(), points }
    }

    /// Adds one control point in homogeneous coordinates.
    fn add(&mut self, coefficients: impl Iterator<Item = f64>, weight: f64, point: Point, displacement: Point) {
        for (k, c) in coefficients.enumerate() {
            self.weights[k] += c * weight;
            self.points[k] += c * weight * point;
            self.displacement[k] += c * weight * displacement;
        }
    }

    fn projected(mut self) -> Self {
        for (k, weight) in self.weights.iter().enumerate() {
            self.points[k] /= *weight;
            self.displacement[k] /= *weight;
        }
        self
    }
}

/// Fit of the stress inside an element in the rational space of its geometry.
struct StressFit {
    fits: [Bernstein; 2],
}

impl StressFit {
    fn new(degrees: [usize; 2]) -> Self {
        Self { fits: degrees.map(|degree| Bernstein::new(degree, Sites::Inside)) }
    }

    /// Coefficients of xx, yy, zz, xy, von Mises, det F, index `a + b * (p + 1)`: interpolation of the samples.
    fn coefficients(
        &self,
        [[u0, u1], [v0, v1]]: [[f64; 2]; 2],
        weights: &[f64],
        stress: impl Fn([f64; 2]) -> CauchySample,
    ) -> Vec<[f64; 6]> {
        let mut samples = Vec::with_capacity(weights.len());
        for t in self.fits[1].sites() {
            for s in self.fits[0].sites() {
                let sample = stress([u0 + s * (u1 - u0), v0 + t * (v1 - v0)]);
                let [xx, yy, zz, xy] = sample.stress;
                let weight = self.weight(weights, *s, *t);
                samples.push([xx, yy, zz, xy, sample.von_mises(), sample.det_f].map(|value| value * weight));
            }
        }
        let mut result = self.tensor_fit(&samples);
        for (values, weight) in result.iter_mut().zip(weights) {
            values.iter_mut().for_each(|value| *value /= weight);
        }
        result
    }

    fn weight(&self, weights: &[f64], s: f64, t: f64) -> f64 {
        let [bu, bv] = [(&self.fits[0], s), (&self.fits[1], t)].map(|(fit, t)| bernstein(fit.sites().len() - 1, t));
        weights.chunks(bu.len()).zip(&bv).map(|(row, b)| b * row.iter().zip(&bu).map(|(w, a)| w * a).sum::<f64>()).sum()
    }

    fn tensor_fit(&self, samples: &[[f64; 6]]) -> Vec<[f64; 6]> {
        let [nu, nv] = [self.fits[0].sites().len(), self.fits[1].sites().len()];
        let mut result = vec![[0.0; 6]; nu * nv];
        for field in 0..6 {
            let mut rows = Vec::with_capacity(nu * nv);
            for row in samples.chunks(nu) {
                rows.extend(self.fits[0].fit(&row.iter().map(|sample| sample[field]).collect::<Vec<_>>()));
            }
            for a in 0..nu {
                let column: Vec<f64> = (0..nv).map(|b| rows[a + b * nu]).collect();
                for (b, value) in self.fits[1].fit(&column).into_iter().enumerate() {
                    result[a + b * nu][field] = value;
                }
            }
        }
        result
    }
}
