//! A boundary curve: edge of a patch or contour of a rigid body.

use std::sync::Arc;

use super::basis::{Basis, Shape, find_span, rational};
use super::refine::{self, Homogeneous};
use super::{GeometryError, Point};

/// Chords of the polygon that measures a span.
const CHORDS: usize = 16;

/// Boundary of a patch or of a rigid body in the reference configuration.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Basis along the curve.
    pub basis: Arc<dyn Basis>,
    /// Weight of each control point, positive.
    pub weights: Vec<f64>,
    /// Control points.
    pub points: Vec<Point>,
    /// Index in the patch of each control point of the curve; `0..n` for a rigid body.
    pub nodes: Vec<usize>,
    /// Outward normal = `side` * (tangent turned counter-clockwise by 90 degrees); +1 or -1.
    pub side: f64,
}

impl Curve {
    /// Number of spans.
    pub fn spans(&self) -> usize {
        self.basis.breaks().len() - 1
    }

    /// Span that contains `xi`, clamped to the first and the last.
    pub fn span_of(&self, xi: f64) -> usize {
        find_span(self.basis.breaks(), xi)
    }

    /// Shape functions of a span at `xi`, rational where the weights of the span differ.
    pub fn shape(&self, span: usize, xi: f64) -> Shape {
        let shape = self.basis.evaluate(span, xi);
        let alive = &self.weights[shape.first..shape.first + shape.count];
        if alive.iter().all(|w| *w == alive[0]) { shape } else { rational(&shape, &self.weights) }
    }

    /// `k`-th parameter derivative of the curve through the given control points (numbered as those of the curve).
    pub fn place(&self, shape: &Shape, k: usize, points: &[Point]) -> Point {
        let alive = &points[shape.first..shape.first + shape.count];
        let mut sum = Point::zeros();
        for (d, point) in shape.d[k].iter().zip(alive) {
            sum += point * *d;
        }
        sum
    }

    /// Point of the reference curve.
    pub fn point(&self, xi: f64) -> Point {
        self.place(&self.shape(self.span_of(xi), xi), 0, &self.points)
    }

    /// Length of each span of the reference curve, along a fine polygon.
    pub fn span_lengths(&self) -> Vec<f64> {
        let place = |ends: &[f64], k: usize| self.point(ends[0] + (ends[1] - ends[0]) * k as f64 / CHORDS as f64);
        let chords = |ends: &[f64]| (0..CHORDS).map(|k| (place(ends, k + 1) - place(ends, k)).norm()).sum();
        self.basis.breaks().windows(2).map(chords).collect()
    }

    /// Length of the shortest span of the reference curve.
    pub fn shortest_span(&self) -> f64 {
        self.span_lengths().into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Outward unit normal of the reference curve.
    pub fn normal(&self, xi: f64) -> Point {
        let a = self.place(&self.shape(self.span_of(xi), xi), 1, &self.points);
        Point::new(-a.y, a.x) * (self.side / a.norm())
    }

    /// The same curve with one more knot (Boehm). The control points are new ones, so `nodes` is renumbered to `0..n`.
    ///
    /// # Errors
    /// If the basis has no knots, or the knot is not inside the range or would be repeated more than `degree` times.
    pub fn insert_knot(&self, xi: f64) -> Result<Self, GeometryError> {
        self.refined(|spline, net| refine::insert_knot(spline, net, xi))
    }

    /// The same curve in a basis of one degree more. `nodes` is renumbered to `0..n`.
    ///
    /// # Errors
    /// If the basis has no knots or the degree is already the highest.
    pub fn elevate(&self) -> Result<Self, GeometryError> {
        self.refined(refine::elevate)
    }

    fn refined(
        &self,
        step: impl FnOnce(&super::BSpline, &[Homogeneous]) -> refine::Refined,
    ) -> Result<Self, GeometryError> {
        let spline = refine::spline_of(self.basis.as_ref())?;
        let (spline, net) = step(&spline, &refine::lift(&self.points, &self.weights))?;
        let (points, weights) = refine::project(&net);
        Ok(Self { basis: Arc::new(spline), nodes: (0..points.len()).collect(), points, weights, side: self.side })
    }
}
