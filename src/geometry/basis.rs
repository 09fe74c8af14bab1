//! The seam between geometry and everything that evaluates it: a univariate, piecewise polynomial basis.

/// Highest polynomial degree a basis may have; fixes the size of [`Shape`].
pub const MAX_DEGREE: usize = 8;

/// Highest derivative a [`Shape`] carries.
pub const MAX_DERIVATIVE: usize = 3;

/// Functions alive on one span: `d[k][i]` is the `k`-th parameter derivative (`k = 0..=3`) of function `first + i`,
/// for `i < count = degree + 1`. Entries beyond `count` are zero.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Index of the first function that is not zero on the span.
    pub first: usize,
    /// Number of functions alive on the span.
    pub count: usize,
    /// Values and derivatives.
    pub d: [[f64; MAX_DEGREE + 1]; MAX_DERIVATIVE + 1],
}

/// A univariate, piecewise polynomial basis that forms a partition of unity.
pub trait Basis: std::fmt::Debug + Send + Sync {
    /// Polynomial degree.
    fn degree(&self) -> usize;
    /// Number of functions.
    fn len(&self) -> usize;
    /// Whether the basis has no function; no basis of this crate is empty.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Ends of the spans, strictly increasing; there are `breaks().len() - 1` spans.
    fn breaks(&self) -> &[f64];
    /// Values and derivatives of the polynomial of `span` at `xi`, which may lie outside the span.
    fn evaluate(&self, span: usize, xi: f64) -> Shape;
    /// Interpolation sites, one per function: Greville abscissae or Lagrange nodes.
    fn nodes(&self) -> Vec<f64>;
    /// `"nurbs"` or `"lagrange"`.
    fn name(&self) -> &'static str;
    /// The knot vector of a B-spline basis; what cannot be refined by knots has none.
    fn knots(&self) -> Option<&[f64]> {
        None
    }
}

/// Index of the span that contains `xi`; a point outside belongs to the first or last span, a break to the span on its
/// right.
pub fn find_span(breaks: &[f64], xi: f64) -> usize {
    let last = breaks.len() - 2;
    breaks[1..=last].partition_point(|&b| b <= xi)
}

/// Turns polynomial shapes into rational ones; `weights` are those of the whole basis.
///
/// With `W = sum w_i N_i` and `R_i = w_i N_i / W`, Leibniz' rule on `R_i W = w_i N_i` gives
/// `R^(k) = (w N^(k) - sum_{j=1..k} C(k,j) W^(j) R^(k-j)) / W` (Piegl & Tiller, The NURBS Book, eq. 4.8).
pub fn rational(shape: &Shape, weights: &[f64]) -> Shape {
    const BINOMIAL: [[f64; 4]; 4] =
        [[1.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [1.0, 2.0, 1.0, 0.0], [1.0, 3.0, 3.0, 1.0]];
    let weights = &weights[shape.first..shape.first + shape.count];
    let mut total = [0.0; MAX_DERIVATIVE + 1];
    for (sum, row) in total.iter_mut().zip(&shape.d) {
        *sum = row.iter().zip(weights).map(|(n, w)| n * w).sum();
    }
    let mut out = *shape;
    for (i, w) in weights.iter().enumerate() {
        for (k, binomial) in BINOMIAL.iter().enumerate() {
            let lower: f64 = (1..=k).map(|j| binomial[j] * total[j] * out.d[k - j][i]).sum();
            out.d[k][i] = (w * shape.d[k][i] - lower) / total[0];
        }
    }
    out
}
