//! Bernstein form of whatever a [`Basis`] evaluates: Bezier extraction by interpolation, exact to round-off.
//!
//! On one span every function is a polynomial of degree `p`, hence determined by its values at `p + 1` points `t_j`:
//! `N(t_j) = sum_k c_k B_k(t_j)`, `B_k(t) = binom(p,k) t^k (1-t)^(p-k)`. The matrix `B_k(t_j)` depends on the degree
//! alone, so that splines of any knot vector and Lagrange bases take the same road.
//! Rational geometry goes through homogeneous coordinates: `W_k = sum_i c_ik w_i`, `P_k = sum_i c_ik w_i P_i / W_k`.

use nalgebra::DMatrix;

use crate::geometry::Basis;

/// The points of interpolation in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sites {
    /// Chebyshev-Lobatto points: ends included, so that neighbouring cells meet exactly.
    WithEnds,
    /// Chebyshev-Gauss points, strictly inside: for fields that jump between elements.
    Inside,
}

/// Conversion of point values to Bernstein coefficients for one degree.
#[derive(Clone, Debug)]
pub struct Bernstein {
    sites: Vec<f64>,
    inverse: DMatrix<f64>,
}

impl Bernstein {
    /// Conversion for polynomials of the given degree.
    pub fn new(degree: usize, sites: Sites) -> Self {
        let sites: Vec<f64> = (0..=degree).map(|j| site(degree, j, sites)).collect();
        let rows = sites.iter().flat_map(|&t| bernstein(degree, t)).collect::<Vec<_>>();
        let inverse = DMatrix::from_row_slice(degree + 1, degree + 1, &rows)
            .try_inverse()
            .expect("distinct points determine a polynomial");
        Self { sites, inverse }
    }

    /// The interpolation points in `[0, 1]`, ascending.
    pub fn sites(&self) -> &[f64] {
        &self.sites
    }

    /// Bernstein coefficients of the polynomial with the given values at [`Self::sites`].
    pub fn fit(&self, values: &[f64]) -> Vec<f64> {
        (0..self.sites.len())
            .map(|k| values.iter().enumerate().map(|(j, value)| self.inverse[(k, j)] * value).sum())
            .collect()
    }
}

fn site(degree: usize, j: usize, sites: Sites) -> f64 {
    let angle = match sites {
        Sites::WithEnds if degree == 0 => return 0.5,
        Sites::WithEnds => j as f64 / degree as f64,
        Sites::Inside => (j as f64 + 0.5) / (degree as f64 + 1.0),
    };
    // sin^2 instead of (1 - cos)/2: exact at both ends.
    (0.5 * std::f64::consts::PI * angle).sin().powi(2)
}

/// Values of the `degree + 1` Bernstein polynomials at `t`.
pub fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    for _ in 0..degree {
        // One step of de Casteljau's triangle raises the degree by one.
        let mut raised = vec![0.0; values.len() + 1];
        for (k, value) in values.iter().enumerate() {
            raised[k] += (1.0 - t) * value;
            raised[k + 1] += t * value;
        }
        values = raised;
    }
    values
}

/// Functions alive on a span, in Bernstein form.
#[derive(Clone, Debug)]
pub struct Extraction {
    /// Index of the first function alive.
    pub first: usize,
    /// `coefficients[i][k]`: Bernstein coefficient `k` of function `first + i`.
    pub coefficients: Vec<Vec<f64>>,
}

/// Bernstein form of all functions of `basis` alive on `span` (polynomial functions, before any division by weights).
pub fn extract(basis: &dyn Basis, span: usize, fit: &Bernstein) -> Extraction {
    let [start, end] = [basis.breaks()[span], basis.breaks()[span + 1]];
    let shapes: Vec<_> = fit.sites().iter().map(|t| basis.evaluate(span, (1.0 - t) * start + t * end)).collect();
    let function = |i: usize| shapes.iter().map(|shape| shape.d[0][i]).collect::<Vec<_>>();
    Extraction { first: shapes[0].first, coefficients: (0..shapes[0].count).map(|i| fit.fit(&function(i))).collect() }
}

/// Extraction of every span of a basis.
pub fn extract_all(basis: &dyn Basis) -> Vec<Extraction> {
    let fit = Bernstein::new(basis.degree(), Sites::WithEnds);
    (0..basis.breaks().len() - 1).map(|span| extract(basis, span, &fit)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_recovers_bernstein_coefficients() {
        for degree in 0..=8 {
            let exact: Vec<f64> = (0..=degree).map(|k| 1.0 / (1.0 + k as f64) - 0.3).collect();
            for sites in [Sites::WithEnds, Sites::Inside] {
                let fit = Bernstein::new(degree, sites);
                let value = |t: &f64| bernstein(degree, *t).iter().zip(&exact).map(|(b, c)| b * c).sum::<f64>();
                let found = fit.fit(&fit.sites().iter().map(value).collect::<Vec<_>>());
                for (found, exact) in found.iter().zip(&exact) {
                    assert!((found - exact).abs() < 1e-12, "degree {degree}: {found} {exact}");
                }
            }
        }
    }
}
