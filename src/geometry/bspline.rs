//! B-spline basis on an open knot vector (Piegl & Tiller, The NURBS Book, chapter 2).

use super::GeometryError;
use super::basis::{Basis, MAX_DEGREE, MAX_DERIVATIVE, Shape};

/// Values of all degrees up to the own one on a span: `table[q][r]` is `N_{k-q+r, q}(xi)`.
type Table = [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1];

/// B-spline basis: open knot vector, interior knots of any multiplicity up to `degree + 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct BSpline {
    degree: usize,
    knots: Vec<f64>,
    breaks: Vec<f64>,
    /// Knot index `k` of each span: `knots[k] = breaks[s] < breaks[s + 1] = knots[k + 1]`.
    starts: Vec<usize>,
}

impl BSpline {
    /// Basis of the given degree (0 up to [`MAX_DEGREE`]).
    ///
    /// # Errors
    /// If the degree is too high or the knots are not finite, not non-decreasing, not repeated `degree + 1` times at
    /// both ends, or repeated more than that inside.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, GeometryError> {
        check_knots(degree, &knots)?;
        let starts: Vec<usize> = (0..knots.len() - 1).filter(|&k| knots[k] < knots[k + 1]).collect();
        let mut breaks: Vec<f64> = starts.iter().map(|&k| knots[k]).collect();
        breaks.extend(knots.last());
        Ok(Self { degree, knots, breaks, starts })
    }

    /// Basis with the given breaks; `multiplicity(i)` is asked for the interior breaks `0 < i < breaks.len() - 1`.
    ///
    /// # Errors
    /// As [`BSpline::new`].
    pub fn from_breaks(
        degree: usize,
        breaks: &[f64],
        multiplicity: impl Fn(usize) -> usize,
    ) -> Result<Self, GeometryError> {
        let last = breaks.len().saturating_sub(1);
        let mut knots = Vec::with_capacity(breaks.len() + 2 * degree);
        for (i, &b) in breaks.iter().enumerate() {
            let repeats = if i == 0 || i == last { degree + 1 } else { multiplicity(i) };
            knots.extend(std::iter::repeat_n(b, repeats));
        }
        Self::new(degree, knots)
    }

    /// The knot vector.
    pub fn knot_vector(&self) -> &[f64] {
        &self.knots
    }

    /// How often `xi` occurs as a knot.
    pub fn multiplicity(&self, xi: f64) -> usize {
        self.knots.iter().filter(|&&k| k == xi).count()
    }

    /// Cox-de Boor recursion (algorithm A2.2), keeping every degree: the derivatives are built from the lower ones.
    fn table(&self, k: usize, xi: f64) -> Table {
        let mut table = Table::default();
        table[0][0] = 1.0;
        for q in 1..=self.degree {
            let lower = table[q - 1];
            for (r, value) in lower.iter().enumerate().take(q) {
                let (right, left) = (self.knots[k + r + 1], self.knots[k + r + 1 - q]);
                let share = value / (right - left);
                table[q][r] += (right - xi) * share;
                table[q][r + 1] = (xi - left) * share;
            }
        }
        table
    }

    /// `order`-th derivative: starts from the values of degree `p - order` and applies
    /// `N'_{j,q} = q (N_{j,q-1} / (t_{j+q} - t_j) - N_{j+1,q-1} / (t_{j+q+1} - t_{j+1}))` (eq. 2.7) `order` times.
    fn derivative(&self, k: usize, order: usize, table: &Table) -> [f64; MAX_DEGREE + 1] {
        let mut row = table[self.degree - order];
        for q in self.degree - order + 1..=self.degree {
            let mut next = [0.0; MAX_DEGREE + 1];
            for r in 0..q {
                let share = q as f64 * row[r] / (self.knots[k + r + 1] - self.knots[k + r + 1 - q]);
                next[r] -= share;
                next[r + 1] += share;
            }
            row = next;
        }
        row
    }
}

impl Basis for BSpline {
    fn degree(&self) -> usize {
        self.degree
    }

    fn len(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    fn evaluate(&self, span: usize, xi: f64) -> Shape {
        let k = self.starts[span];
        let table = self.table(k, xi);
        let mut d = [[0.0; MAX_DEGREE + 1]; MAX_DERIVATIVE + 1];
        for (order, row) in d.iter_mut().enumerate().take(self.degree + 1) {
            *row = self.derivative(k, order, &table);
        }
        Shape { first: k - self.degree, count: self.degree + 1, d }
    }

    /// Greville abscissae: means of `degree` consecutive knots, where the control polygon of `x(u) = u` sits.
    fn nodes(&self) -> Vec<f64> {
        if self.degree == 0 {
            return self.breaks.windows(2).map(|b| 0.5 * (b[0] + b[1])).collect();
        }
        self.knots[1..self.knots.len() - 1].windows(self.degree).map(mean).collect()
    }

    fn name(&self) -> &'static str {
        "nurbs"
    }

    fn knots(&self) -> Option<&[f64]> {
        Some(&self.knots)
    }
}

/// Mean that returns a repeated knot without rounding, so that end nodes are exactly the ends.
fn mean(knots: &[f64]) -> f64 {
    let first = knots[0];
    first + knots.iter().map(|k| k - first).sum::<f64>() / knots.len() as f64
}

fn check_knots(degree: usize, knots: &[f64]) -> Result<(), GeometryError> {
    let fail = |message: String| Err(GeometryError::shape("knots", message));
    if degree > MAX_DEGREE {
        return Err(GeometryError::shape("degrees", format!("at most {MAX_DEGREE}, is {degree}")));
    }
    let ends = degree + 1;
    if knots.len() < 2 * ends {
        return fail(format!("degree {degree} needs at least {} knots, there are {}", 2 * ends, knots.len()));
    }
    if let Some(i) = knots.iter().position(|k| !k.is_finite()) {
        return fail(format!("knot {i} is not a finite number"));
    }
    if let Some(i) = knots.windows(2).position(|k| k[0] > k[1]) {
        return fail(format!("knots must not decrease, but {} follows {}", knots[i + 1], knots[i]));
    }
    let repeated = |xi: f64| knots.iter().filter(|&&k| k == xi).count();
    let (lo, hi) = (knots[0], knots[knots.len() - 1]);
    if lo == hi || repeated(lo) != ends || repeated(hi) != ends {
        return fail(format!(
            "degree {degree} needs the first and the last knot exactly {ends} times, and the two different"
        ));
    }
    if let Some(xi) = knots.iter().find(|&&k| repeated(k) > ends) {
        return fail(format!("knot {xi} occurs more than {ends} times"));
    }
    Ok(())
}
