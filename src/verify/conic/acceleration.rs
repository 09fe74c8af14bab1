//! Anderson's acceleration of a fixed-point iteration `x <- G(x)` (Anderson 1965; Walker and Ni, SIAM J. Numer. Anal. 49 (2011) 1715).
//!
//! With the residuals `f_i = G(x_i) - x_i` of the last iterates, the combination with the smallest residual is continued:
//! `x = G_k - sum_i gamma_i (G_{i+1} - G_i)`, `gamma = argmin |f_k - sum_i gamma_i (f_{i+1} - f_i)|`. Where one direction contracts slowly
//! (a body near a snap, friction that feeds back on the pressure) that direction is solved for.

use std::collections::VecDeque;

use nalgebra::{Cholesky, DMatrix, DVector};

/// Differences kept.
const MEMORY: usize = 5;
/// Regularisation of the normal equations: differences that are nearly parallel.
const FAINT: f64 = 1e-12;

/// The last iterates.
#[derive(Default)]
pub struct Acceleration {
    /// `(f, G)`.
    last: VecDeque<(Vec<f64>, Vec<f64>)>,
}

impl Acceleration {
    /// Forgets all iterates.
    pub fn clear(&mut self) {
        self.last.clear();
    }

    /// The next iterate, from `x` and `G(x)`; `G(x)` itself where nothing better is known.
    pub fn next(&mut self, x: &[f64], image: Vec<f64>) -> Vec<f64> {
        if self.last.back().is_some_and(|(f, _)| f.len() != x.len()) {
            self.clear();
        }
        let residual = image.iter().zip(x).map(|(g, x)| g - x).collect();
        self.last.push_back((residual, image.clone()));
        if self.last.len() > MEMORY + 1 {
            self.last.pop_front();
        }
        let mut next = image;
        for (k, gamma) in self.combination().into_iter().enumerate() {
            let (new, old) = (&self.last[k + 1].1, &self.last[k].1);
            next.iter_mut().zip(new.iter().zip(old)).for_each(|(x, (a, b))| *x -= gamma * (a - b));
        }
        next
    }

    /// `gamma`; empty where it cannot be found.
    fn combination(&self) -> Vec<f64> {
        let Some((f, _)) = self.last.back() else { return vec![] };
        let count = self.last.len() - 1;
        let differences = DMatrix::from_fn(f.len(), count, |i, k| self.last[k + 1].0[i] - self.last[k].0[i]);
        let mut normal = differences.tr_mul(&differences);
        (0..count).for_each(|k| normal[(k, k)] *= 1.0 + FAINT);
        let right = differences.tr_mul(&DVector::from_column_slice(f));
        Cholesky::new(normal).map_or(vec![], |factor| factor.solve(&right).as_slice().to_vec())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map of five unknowns with contraction 0.95 and one direction that even grows.
    #[test]
    fn a_linear_map_is_solved_in_as_many_steps_as_it_has_rates() {
        let rates = [0.95, 0.5, -0.3, 0.1, 1.4];
        let map = |x: &[f64]| -> Vec<f64> { x.iter().zip(rates).map(|(x, rate)| rate * x + 1.0).collect() };
        let (mut x, mut acceleration) = (vec![0.0; 5], Acceleration::default());
        for _ in 0..7 {
            let image = map(&x);
            x = acceleration.next(&x, image);
        }
        for (x, rate) in x.iter().zip(rates) {
            assert!((x - 1.0 / (1.0 - rate)).abs() < 1e-6 / (1.0 - rate).abs(), "{x} at rate {rate}");
        }
    }
}
