//! A body: one tensor-product patch.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::basis::{Basis, Shape, find_span};
use super::refine::{self, Homogeneous};
use super::{BSpline, Curve, GeometryError, Point};

/// Tensor-product patch in the reference configuration; control point `(i, j)` has index `i + j * nu`.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Bases in `u` (along x) and `v` (upwards).
    pub basis: [Arc<dyn Basis>; 2],
    /// Weight of each control point, positive.
    pub weights: Vec<f64>,
    /// Control points.
    pub points: Vec<Point>,
}

/// Edge of a patch, named by its place in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Edge {
    /// `v` at its start.
    Bottom,
    /// `u` at its end.
    Right,
    /// `v` at its end.
    Top,
    /// `u` at its start.
    Left,
}

impl Edge {
    /// Direction in which the edge runs: 0 (along `u`) or 1 (along `v`).
    pub fn direction(self) -> usize {
        match self {
            Self::Bottom | Self::Top => 0,
            Self::Left | Self::Right => 1,
        }
    }
}

/// Shape functions of one element with their gradients with respect to the parameters `(u, v)`.
#[derive(Clone, Debug)]
pub struct PatchShape {
    /// Control points with a function alive on the element.
    pub nodes: Vec<usize>,
    /// Values.
    pub values: Vec<f64>,
    /// Derivatives by `u` and `v`.
    pub gradients: Vec<[f64; 2]>,
}

impl Patch {
    /// Number of spans in `u` and `v`.
    pub fn elements(&self) -> [usize; 2] {
        [0, 1].map(|d| self.basis[d].breaks().len() - 1)
    }

    /// Parameter range of an element: `[[u0, u1], [v0, v1]]`.
    pub fn span_box(&self, element: [usize; 2]) -> [[f64; 2]; 2] {
        [0, 1].map(|d| {
            let breaks = self.basis[d].breaks();
            [breaks[element[d]], breaks[element[d] + 1]]
        })
    }

    /// Element that contains the parameters, clamped to the patch.
    pub fn element_of(&self, uv: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|d| find_span(self.basis[d].breaks(), uv[d]))
    }

    /// Shape functions of an element at the parameters `uv`; rational if the weights of the element differ.
    pub fn shape(&self, element: [usize; 2], uv: [f64; 2]) -> PatchShape {
        let [u, v] = [0, 1].map(|d| self.basis[d].evaluate(element[d], uv[d]));
        let mut shape = tensor(&u, &v, self.basis[0].len());
        let reference = self.weights[shape.nodes[0]];
        if shape.nodes.iter().any(|&n| self.weights[n] != reference) {
            self.make_rational(&mut shape);
        }
        shape
    }

    /// Quotient rule on `R W = w N`: `grad R = (w grad N - R grad W) / W`.
    fn make_rational(&self, shape: &mut PatchShape) {
        let mut total = [0.0; 3];
        for (a, &node) in shape.nodes.iter().enumerate() {
            let w = self.weights[node];
            let [du, dv] = shape.gradients[a].map(|g| g * w);
            shape.values[a] *= w;
            shape.gradients[a] = [du, dv];
            total = [total[0] + shape.values[a], total[1] + du, total[2] + dv];
        }
        for (value, gradient) in shape.values.iter_mut().zip(&mut shape.gradients) {
            *value /= total[0];
            gradient[0] = (gradient[0] - *value * total[1]) / total[0];
            gradient[1] = (gradient[1] - *value * total[2]) / total[0];
        }
    }

    /// Reference point and Jacobian columns `[dX/du, dX/dv]`.
    pub fn map(&self, element: [usize; 2], uv: [f64; 2]) -> (Point, [Point; 2]) {
        let shape = self.shape(element, uv);
        let (mut x, mut columns) = (Point::zeros(), [Point::zeros(); 2]);
        for (a, &node) in shape.nodes.iter().enumerate() {
            x += self.points[node] * shape.values[a];
            for (column, g) in columns.iter_mut().zip(shape.gradients[a]) {
                *column += self.points[node] * g;
            }
        }
        (x, columns)
    }

    /// Determinant of the Jacobian, positive for a patch that is oriented counter-clockwise.
    pub fn jacobian(&self, element: [usize; 2], uv: [f64; 2]) -> f64 {
        let (_, [du, dv]) = self.map(element, uv);
        du.perp(&dv)
    }

    /// Edge as a curve. Its normal points outward: with positive Jacobian the interior lies to the left of `bottom`
    /// and `right` and to the right of `top` and `left`; a patch of the other orientation has all sides turned.
    pub fn boundary(&self, edge: Edge) -> Curve {
        let [nu, nv] = [0, 1].map(|d| self.basis[d].len());
        let nodes: Vec<usize> = match edge {
            Edge::Bottom => (0..nu).collect(),
            Edge::Top => (nu * (nv - 1)..nu * nv).collect(),
            Edge::Left => (0..nv).map(|j| j * nu).collect(),
            Edge::Right => (1..=nv).map(|j| j * nu - 1).collect(),
        };
        let side = match edge {
            Edge::Bottom | Edge::Right => -1.0,
            Edge::Top | Edge::Left => 1.0,
        };
        Curve {
            basis: Arc::clone(&self.basis[edge.direction()]),
            weights: nodes.iter().map(|&n| self.weights[n]).collect(),
            points: nodes.iter().map(|&n| self.points[n]).collect(),
            nodes,
            side: side * self.orientation(),
        }
    }

    /// Sign of the Jacobian in the middle of the patch.
    fn orientation(&self) -> f64 {
        let middle = self.elements().map(|n| n / 2);
        let uv = self.span_box(middle).map(|[a, b]| 0.5 * (a + b));
        self.jacobian(middle, uv).signum()
    }

    /// The same patch with one more knot in direction 0 (`u`) or 1 (`v`).
    ///
    /// # Errors
    /// As [`Curve::insert_knot`].
    pub fn insert_knot(&self, direction: usize, xi: f64) -> Result<Self, GeometryError> {
        self.refined(direction, |spline, net| refine::insert_knot(spline, net, xi))
    }

    /// The same patch in a basis of one degree more in direction 0 (`u`) or 1 (`v`).
    ///
    /// # Errors
    /// As [`Curve::elevate`].
    pub fn elevate(&self, direction: usize) -> Result<Self, GeometryError> {
        self.refined(direction, refine::elevate)
    }

    fn refined(
        &self,
        direction: usize,
        step: impl Fn(&BSpline, &[Homogeneous]) -> refine::Refined,
    ) -> Result<Self, GeometryError> {
        let spline = refine::spline_of(self.basis[direction].as_ref())?;
        let net = refine::lift(&self.points, &self.weights);
        let mut refined = spline.clone();
        let net = map_lines(&net, self.basis[0].len(), direction, |line| {
            let (basis, line) = step(&spline, line)?;
            refined = basis;
            Ok(line)
        })?;
        let (points, weights) = refine::project(&net);
        let mut basis = self.basis.clone();
        basis[direction] = Arc::new(refined);
        Ok(Self { basis, weights, points })
    }
}

/// Applies `change` to every line of a control net (`nu` points per row) that runs in the given direction.
pub(super) fn map_lines(
    net: &[Homogeneous],
    nu: usize,
    direction: usize,
    mut change: impl FnMut(&[Homogeneous]) -> Result<Vec<Homogeneous>, GeometryError>,
) -> Result<Vec<Homogeneous>, GeometryError> {
    if direction == 0 {
        let rows: Result<Vec<_>, _> = net.chunks(nu).map(change).collect();
        return Ok(rows?.concat());
    }
    let column = |i: usize| -> Vec<Homogeneous> { net.iter().skip(i).step_by(nu).copied().collect() };
    let columns: Vec<Vec<Homogeneous>> = (0..nu).map(|i| change(&column(i))).collect::<Result<_, _>>()?;
    let rows = columns[0].len();
    Ok((0..rows).flat_map(|j| columns.iter().map(move |c| c[j])).collect())
}

fn tensor(u: &Shape, v: &Shape, nu: usize) -> PatchShape {
    let count = u.count * v.count;
    let mut shape = PatchShape {
        nodes: Vec::with_capacity(count),
        values: Vec::with_capacity(count),
        gradients: Vec::with_capacity(count),
    };
    for j in 0..v.count {
        for i in 0..u.count {
            shape.nodes.push(u.first + i + (v.first + j) * nu);
            shape.values.push(u.d[0][i] * v.d[0][j]);
            shape.gradients.push([u.d[1][i] * v.d[0][j], u.d[0][i] * v.d[1][j]]);
        }
    }
    shape
}
