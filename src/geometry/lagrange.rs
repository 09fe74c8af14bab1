//! Classical finite-element basis: continuous Lagrange polynomials of degree 1 or 2.

use super::GeometryError;
use super::basis::{Basis, MAX_DEGREE, MAX_DERIVATIVE, Shape};

/// Lagrange basis with nodes at the breaks and, for degree 2, at the middles of the spans. Nodes are numbered along the
/// line, so the functions of span `s` are `degree * s ..= degree * (s + 1)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Lagrange {
    degree: usize,
    breaks: Vec<f64>,
}

impl Lagrange {
    /// Basis of degree 1 or 2.
    ///
    /// # Errors
    /// If the degree is another one or the breaks are not at least two finite, strictly increasing numbers.
    pub fn new(degree: usize, breaks: Vec<f64>) -> Result<Self, GeometryError> {
        if !(1..=2).contains(&degree) {
            return Err(GeometryError::outside(
                "basis",
                "degree",
                format!("a lagrange basis has degree 1 or 2, not {degree}"),
            ));
        }
        let increasing = breaks.windows(2).all(|b| b[0] < b[1]);
        if breaks.len() < 2 || !increasing || breaks.iter().any(|b| !b.is_finite()) {
            return Err(GeometryError::outside(
                "elements",
                "",
                "element ends must be at least two finite, strictly increasing numbers",
            ));
        }
        Ok(Self { degree, breaks })
    }
}

impl Basis for Lagrange {
    fn degree(&self) -> usize {
        self.degree
    }

    fn len(&self) -> usize {
        self.degree * (self.breaks.len() - 1) + 1
    }

    fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    fn evaluate(&self, span: usize, xi: f64) -> Shape {
        let h = self.breaks[span + 1] - self.breaks[span];
        let t = (xi - self.breaks[span]) / h;
        let mut d = [[0.0; MAX_DEGREE + 1]; MAX_DERIVATIVE + 1];
        if self.degree == 1 {
            d[0][..2].copy_from_slice(&[1.0 - t, t]);
            d[1][..2].copy_from_slice(&[-1.0 / h, 1.0 / h]);
        } else {
            let s = 1.0 - t;
            let slopes = [4.0 * t - 3.0, 4.0 - 8.0 * t, 4.0 * t - 1.0];
            d[0][..3].copy_from_slice(&[s * (1.0 - 2.0 * t), 4.0 * t * s, t * (2.0 * t - 1.0)]);
            d[1][..3].copy_from_slice(&slopes.map(|slope| slope / h));
            d[2][..3].copy_from_slice(&[4.0, -8.0, 4.0].map(|c| c / (h * h)));
        }
        Shape { first: self.degree * span, count: self.degree + 1, d }
    }

    fn nodes(&self) -> Vec<f64> {
        let mut nodes = Vec::with_capacity(self.len());
        for b in self.breaks.windows(2) {
            nodes.push(b[0]);
            if self.degree == 2 {
                nodes.push(0.5 * (b[0] + b[1]));
            }
        }
        nodes.extend(self.breaks.last());
        nodes
    }

    fn name(&self) -> &'static str {
        "lagrange"
    }
}
