//! Gauss-Legendre quadrature on `[0, 1]`.

/// Points and weights on `[0, 1]`; the weights sum to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussRule {
    /// Abscissae in `(0, 1)`, increasing.
    pub points: Vec<f64>,
    /// Positive weights.
    pub weights: Vec<f64>,
}

/// The `n`-point Gauss-Legendre rule on `[0, 1]`, exact for polynomials of degree `2n - 1`.
///
/// The nodes are the roots of the Legendre polynomial `P_n`, found by Newton's method from
/// `cos(pi (i + 3/4) / (n + 1/2))` (Abramowitz and Stegun 25.4.29: weights `2 / ((1 - x^2) P_n'(x)^2)`).
pub fn gauss(n: usize) -> GaussRule {
    assert!(n > 0, "a quadrature rule needs at least one point");
    let mut rule = GaussRule { points: vec![0.0; n], weights: vec![0.0; n] };
    for i in 0..n {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..100 {
            let (value, derivative) = legendre(n, x);
            slope = derivative;
            let dx = value / derivative;
            x -= dx;
            if dx.abs() < 1e-16 {
                break;
            }
        }
        rule.points[n - 1 - i] = 0.5 * (1.0 + x);
        rule.weights[n - 1 - i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    rule
}

/// Value and slope of the Legendre polynomial by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::gauss;

    #[test]
    fn integrates_monomials_up_to_degree_2n_minus_1() {
        for n in 1..=20 {
            let rule = gauss(n);
            for k in 0..2 * n {
                let integral: f64 = rule.points.iter().zip(&rule.weights).map(|(x, w)| w * x.powi(k as i32)).sum();
                assert!((integral - 1.0 / (k as f64 + 1.0)).abs() < 1e-14, "n = {n}, k = {k}: {integral}");
            }
        }
    }
}
