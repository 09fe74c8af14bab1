//! A curve through measured points that overshoots nowhere.

use crate::dual::{Dual, chain, constant};

/// Piecewise cubic Hermite interpolant with the slopes of PCHIP: at an inner point the weighted harmonic mean of the two neighbouring
/// secants, or zero where they differ in sign, at the ends the three-point formula limited to keep the shape. Once continuously
/// differentiable, monotone where the points are, exact for points on a line. Outside of the points it stays at the end values; at
/// the first and the last point the derivative is that of the curve inside.
///
/// References: F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238; slopes of F. N. Fritsch and J. Butland, SIAM J. Sci.
/// Stat. Comput. 5 (1984) 300, as in SLATEC's PCHIM. The printed equations were not checked against the sources.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    at: Vec<f64>,
    value: Vec<f64>,
    slope: Vec<f64>,
}

impl Curve {
    /// A curve through the points.
    ///
    /// # Errors
    /// The name of the offending list, `at` or `value`, and what is wrong with it.
    pub fn new(at: Vec<f64>, value: Vec<f64>) -> Result<Self, (&'static str, String)> {
        if at.len() < 2 {
            return Err(("at", "a table needs two points or more".into()));
        }
        if at.len() != value.len() {
            return Err(("value", format!("{} values for {} points", value.len(), at.len())));
        }
        if let Some(pair) = at.windows(2).find(|pair| pair[0].is_nan() || pair[1].is_nan() || pair[0] >= pair[1]) {
            return Err(("at", format!("the points must increase: {} is followed by {}", pair[0], pair[1])));
        }
        for (name, list) in [("at", &at), ("value", &value)] {
            if let Some(x) = list.iter().find(|x| !x.is_finite()) {
                return Err((name, format!("{x} is not a finite number")));
            }
        }
        let slope = slopes(&at, &value);
        Ok(Self { at, value, slope })
    }

    /// Value and derivatives.
    pub fn value(&self, x: Dual) -> Dual {
        let last = self.at.len() - 1;
        if x.re < self.at[0] {
            return constant(self.value[0]);
        }
        if x.re > self.at[last] {
            return constant(self.value[last]);
        }
        if x.re.is_nan() {
            return x;
        }
        let k = (self.at.partition_point(|at| *at <= x.re) - 1).min(last - 1);
        let (h, t) = (self.at[k + 1] - self.at[k], x.re - self.at[k]);
        let secant = (self.value[k + 1] - self.value[k]) / h;
        let (a, b) = (self.slope[k], self.slope[k + 1]);
        let (second, third) = ((3.0 * secant - 2.0 * a - b) / h, (a + b - 2.0 * secant) / (h * h));
        let value = self.value[k] + t * (a + t * (second + t * third));
        chain(x, value, a + t * (2.0 * second + t * 3.0 * third))
    }
}

fn slopes(at: &[f64], value: &[f64]) -> Vec<f64> {
    let step: Vec<f64> = at.windows(2).map(|x| x[1] - x[0]).collect();
    let secant: Vec<f64> = value.windows(2).zip(&step).map(|(y, h)| (y[1] - y[0]) / h).collect();
    if secant.len() == 1 {
        return vec![secant[0]; 2];
    }
    let inner = |k: usize| {
        let (before, after) = (secant[k - 1], secant[k]);
        if before == 0.0 || after == 0.0 || before.signum() != after.signum() {
            return 0.0;
        }
        let (w1, w2) = (2.0 * step[k] + step[k - 1], step[k] + 2.0 * step[k - 1]);
        (w1 + w2) / (w1 / before + w2 / after)
    };
    let end = |h0: f64, h1: f64, near: f64, next: f64| {
        let slope = ((2.0 * h0 + h1) * near - h0 * next) / (h0 + h1);
        if near == 0.0 || slope.signum() != near.signum() {
            0.0
        } else if near.signum() != next.signum() && slope.abs() > 3.0 * near.abs() {
            3.0 * near
        } else {
            slope
        }
    };
    let n = secant.len();
    let first = end(step[0], step[1], secant[0], secant[1]);
    let last = end(step[n - 1], step[n - 2], secant[n - 1], secant[n - 2]);
    std::iter::once(first).chain((1..n).map(inner)).chain([last]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::{derivatives, slip_dual};

    fn at(curve: &Curve, x: f64) -> (f64, f64) {
        let (value, slopes) = derivatives(&curve.value(slip_dual(x)));
        (value, slopes[1])
    }

    #[test]
    fn lines_are_met_exactly_and_ends_continue() {
        let line = Curve::new(vec![-1.0, 0.5, 2.0, 7.0], vec![-2.0, 1.0, 4.0, 14.0]).unwrap();
        for x in [-1.0, -0.3, 0.5, 1.9, 6.9, 7.0] {
            let (value, slope) = at(&line, x);
            assert!((value - 2.0 * x).abs() < 1e-14 && (slope - 2.0).abs() < 1e-14, "{x}: {value} {slope}");
        }
        assert_eq!((at(&line, -1.1), at(&line, 8.0)), ((-2.0, 0.0), (14.0, 0.0)));
        assert!(line.value(constant(f64::NAN)).re.is_nan());
    }

    #[test]
    fn steps_do_not_overshoot_and_derivatives_are_continuous() {
        let (x, y) = (vec![0.0, 1.0, 1.1, 3.0, 4.0], vec![0.0, 0.1, 5.0, 5.0, 2.0]);
        let curve = Curve::new(x.clone(), y).unwrap();
        let samples: Vec<f64> = (0..=3000).map(|k| at(&curve, f64::from(k) * 1e-3).0).collect();
        assert!(samples.is_sorted() && samples.iter().all(|y| (0.0..=5.0).contains(y)));
        for &x in &x[1..4] {
            let (below, above) = (at(&curve, x - 1e-9).1, at(&curve, x + 1e-9).1);
            assert!((below - above).abs() < 1e-5, "at {x}: {below} {above}");
        }
    }

    #[test]
    fn error_falls_with_third_order_or_better_on_a_smooth_monotone_function() {
        let error = |n: u32| {
            let x: Vec<f64> = (0..=n).map(|k| f64::from(k) / f64::from(n)).collect();
            let curve = Curve::new(x.clone(), x.iter().map(|x| x.exp()).collect()).unwrap();
            (0..1000).map(|k| f64::from(k) / 999.0).map(|x| (at(&curve, x).0 - x.exp()).abs()).fold(0.0, f64::max)
        };
        let order = (error(16) / error(32)).log2();
        assert!(order > 2.8, "{order}");
    }

    #[test]
    fn bad_points_are_named() {
        let fails = |at: &[f64], value: &[f64]| Curve::new(at.to_vec(), value.to_vec()).unwrap_err();
        assert_eq!(fails(&[1.0], &[1.0]).0, "at");
        assert_eq!(fails(&[1.0, 2.0], &[1.0]), ("value", "1 values for 2 points".into()));
        assert_eq!(fails(&[1.0, 1.0], &[1.0, 2.0]), ("at", "the points must increase: 1 is followed by 1".into()));
        assert_eq!(fails(&[1.0, f64::NAN], &[1.0, 2.0]).0, "at");
        assert_eq!(fails(&[1.0, 2.0], &[1.0, f64::INFINITY]).0, "value");
    }
}
