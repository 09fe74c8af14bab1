//! Changes of basis that leave the geometry as it is, in homogeneous coordinates `(w x, w y, w)`.

use super::basis::{Basis, MAX_DEGREE, find_span};
use super::{BSpline, GeometryError, Point};

/// Control point times weight, and weight.
pub type Homogeneous = nalgebra::Vector3<f64>;

/// A refined basis with its control points.
pub type Refined = Result<(BSpline, Vec<Homogeneous>), GeometryError>;

/// Homogeneous coordinates of control points.
pub fn lift(points: &[Point], weights: &[f64]) -> Vec<Homogeneous> {
    let lift = |(p, w): (&Point, &f64)| Homogeneous::new(w * p.x, w * p.y, *w);
    points.iter().zip(weights).map(lift).collect()
}

/// Control points and weights. Weights that agree to round-off become exactly 1, so that a polynomial patch stays one.
pub fn project(net: &[Homogeneous]) -> (Vec<Point>, Vec<f64>) {
    let points = net.iter().map(|h| Point::new(h.x, h.y) / h.z).collect();
    let reference = net[0].z;
    let polynomial = net.iter().all(|h| (h.z - reference).abs() <= 1e-13 * reference);
    let weight = |h: &Homogeneous| if polynomial { 1.0 } else { h.z };
    (points, net.iter().map(weight).collect())
}

/// The B-spline behind a basis.
///
/// # Errors
/// If the basis has no knots.
pub fn spline_of(basis: &dyn Basis) -> Result<BSpline, GeometryError> {
    let knots = basis.knots().ok_or_else(|| {
        let message = format!("a {} basis has no knots to refine", basis.name());
        GeometryError::outside("basis", "type", message)
    })?;
    BSpline::new(basis.degree(), knots.to_vec())
}

/// Inserts one knot (Boehm's algorithm, Piegl & Tiller A5.1 with r = 1).
///
/// # Errors
/// If `xi` is not inside the range or already a knot of multiplicity `degree`.
pub fn insert_knot(spline: &BSpline, net: &[Homogeneous], xi: f64) -> Refined {
    let (p, knots) = (spline.degree(), spline.knot_vector());
    let (lo, hi) = (knots[0], knots[knots.len() - 1]);
    let s = spline.multiplicity(xi);
    if !(lo < xi && xi < hi) || s >= p {
        let message = format!("a new knot must lie inside ({lo}, {hi}) and occur at most {p} times, {xi} does not");
        return Err(GeometryError::shape("knots", message));
    }
    let k = knots.partition_point(|&t| t <= xi) - 1;
    let mut out = Vec::with_capacity(net.len() + 1);
    out.extend_from_slice(&net[..=k - p]);
    for i in k - p + 1..=k - s {
        let alpha = (xi - knots[i]) / (knots[i + p] - knots[i]);
        out.push(net[i] * alpha + net[i - 1] * (1.0 - alpha));
    }
    out.extend_from_slice(&net[k - s..]);
    let mut refined = knots.to_vec();
    refined.insert(k + 1, xi);
    Ok((BSpline::new(p, refined)?, out))
}

/// Raises the degree by one; every break keeps its continuity, so its multiplicity grows by one.
///
/// # Errors
/// If the degree is already [`MAX_DEGREE`].
pub fn elevate(spline: &BSpline, net: &[Homogeneous]) -> Refined {
    if spline.degree() == MAX_DEGREE {
        let message = format!("at most {MAX_DEGREE}");
        return Err(GeometryError::outside("basis", "degree", message));
    }
    let breaks = spline.breaks();
    let raised = BSpline::from_breaks(spline.degree() + 1, breaks, |i| spline.multiplicity(breaks[i]) + 1)?;
    let net = embed(spline, net, &raised);
    Ok((raised, net))
}

/// Control points in a basis whose span contains the given function: interpolation there is exact.
pub fn embed(from: &dyn Basis, net: &[Homogeneous], into: &dyn Basis) -> Vec<Homogeneous> {
    let values = into.nodes().into_iter().map(|xi| combine(from, net, xi));
    interpolate(into, values.collect())
}

/// Value of a combination of basis functions at `xi`.
pub fn combine(basis: &dyn Basis, net: &[Homogeneous], xi: f64) -> Homogeneous {
    let shape = basis.evaluate(find_span(basis.breaks(), xi), xi);
    let alive = &net[shape.first..shape.first + shape.count];
    shape.d[0].iter().zip(alive).map(|(n, h)| h * *n).sum()
}

/// Coefficients of the function of a continuous basis that takes the given values at the nodes of the basis.
///
/// Node `i` lies in the support of function `i`, so the matrix has bandwidth `p` to both sides.
/// The collocation matrix at Greville abscissae is banded and totally positive, so elimination without pivoting is
/// stable (de Boor and Pinkus, Numer. Math. 27, 1977, 485-490); at Lagrange nodes it is the unit matrix.
pub fn interpolate(basis: &dyn Basis, mut values: Vec<Homogeneous>) -> Vec<Homogeneous> {
    let (n, p) = (basis.len(), basis.degree());
    let width = 2 * p + 1;
    // row[j + p - i] holds the entry of column j in row i
    let mut rows = vec![vec![0.0; width]; n];
    for (i, xi) in basis.nodes().into_iter().enumerate() {
        let shape = basis.evaluate(find_span(basis.breaks(), xi), xi);
        for (a, value) in shape.d[0].iter().enumerate().take(shape.count) {
            rows[i][shape.first + a + p - i] = *value;
        }
    }
    for i in 0..n {
        for k in i + 1..n.min(i + p + 1) {
            let factor = rows[k][i + p - k] / rows[i][p];
            for j in i..n.min(i + p + 1) {
                rows[k][j + p - k] -= factor * rows[i][j + p - i];
            }
            values[k] = values[k] - values[i] * factor;
        }
    }
    for i in (0..n).rev() {
        for j in i + 1..n.min(i + p + 1) {
            values[i] = values[i] - values[j] * rows[i][j + p - i];
        }
        values[i] /= rows[i][p];
    }
    values
}
