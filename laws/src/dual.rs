//! Dual numbers: a value with its derivatives with respect to pressure and slip. The only file that names `num-dual`.
//!
//! `num-dual` compares and branches on the value alone, and at a tie its `abs` and `signum` follow the sign bit of zero (`+0.0` and
//! `-0.0` differ), its `tanh` overflows to NaN, and its `powf` is NaN at zero. A law therefore takes the functions of this file:
//! **at a tie (`|0|`, `min(a, a)`, `max(a, a)`) the derivative is the mean of the two branches**, so a law keeps its mirror
//! symmetry in the slip exactly, and the derivative stays an element of Clarke's generalised one (what a semismooth Newton needs).
//! NaN passes through all of them: a failed state update is never hidden by a cap.

use nalgebra::Vector2;
use num_dual::{Derivative, DualSVec64};

/// The methods of dual numbers (`exp`, `ln`, `asinh`, `recip`, ...); bring it into scope to write a law.
pub use num_dual::DualNum;

/// A number with its derivatives with respect to `[pressure, slip increment]`; units are those of the value per stress and per
/// length.
pub type Dual = DualSVec64<2>;

/// The independent variable pressure: derivative `[1, 0]`.
pub fn pressure_dual(value: f64) -> Dual {
    Dual::from_re(value).derivative(0)
}

/// The independent variable slip increment: derivative `[0, 1]`.
pub fn slip_dual(value: f64) -> Dual {
    Dual::from_re(value).derivative(1)
}

/// A number that depends on neither pressure nor slip.
pub fn constant(value: f64) -> Dual {
    Dual::from_re(value)
}

/// A value with given derivatives with respect to `[pressure, slip]`.
pub fn with_derivatives(value: f64, derivatives: [f64; 2]) -> Dual {
    Dual::new(value, Derivative::some(Vector2::from(derivatives)))
}

/// Value and derivatives with respect to `[pressure, slip]`.
pub fn derivatives(x: &Dual) -> (f64, [f64; 2]) {
    (x.re, x.eps.0.map_or([0.0; 2], |d| [d[0], d[1]]))
}

/// `|x|`; derivative `0` at `x = 0`.
pub fn abs(x: Dual) -> Dual {
    if x.re == 0.0 {
        constant(0.0)
    } else if x.re < 0.0 {
        -x
    } else {
        x
    }
}

/// Larger of the two; mean derivative at a tie.
pub fn max(a: Dual, b: Dual) -> Dual {
    if a.re == b.re {
        (a + b) * 0.5
    } else if a.re > b.re || a.re.is_nan() {
        a
    } else {
        b
    }
}

/// Smaller of the two; mean derivative at a tie.
pub fn min(a: Dual, b: Dual) -> Dual {
    -max(-a, -b)
}

/// `tanh x` without overflow: beyond |x| = 400 the derivative (4e-348) underflows and value is +-1.
pub fn tanh(x: Dual) -> Dual {
    if x.re.abs() > 400.0 { constant(x.re.signum()) } else { chain(x, x.re.tanh(), x.re.cosh().powi(-2)) }
}

/// `x^n` for `x >= 0`, `n > 0` or `x > 0` and any `n`. At `x = 0` the value is 0 and the derivative 0 for `n > 1`, 1 for `n = 1`,
/// infinite for `n < 1` (regularise such a law by [`offset_power`]).
pub fn power(x: Dual, n: f64) -> Dual {
    chain(x, x.re.powf(n), n * x.re.powf(n - 1.0))
}

/// `(x + offset)^n - offset^n` for `x, offset >= 0`, `n > 0`, without cancellation: a power that starts at 0 with a finite slope.
pub fn offset_power(x: Dual, offset: f64, n: f64) -> Dual {
    if offset == 0.0 {
        return power(x, n);
    }
    ((x / offset).ln_1p() * n).exp_m1() * offset.powf(n)
}

/// From `start` at `x = 0` to `end` at infinity, `end + (start - end) exp(-x)` for `x >= 0`: a sum of positive terms, so no digits
/// cancel. Constant beyond `x = 500`: what is left of the difference, 1e-217 of it, would soon be lost to underflow, and an
/// overflowing slope of `x` must not meet it.
pub fn decay(start: f64, end: f64, x: Dual) -> Dual {
    let x = min(x, constant(500.0));
    if start >= end { (-x).exp() * (start - end) + end } else { -(-x).exp_m1() * (end - start) + start }
}

/// `sqrt(x^2 + floor^2)`, `floor > 0`: `|x|` with a smooth least value, for a law that is singular at rest.
pub fn hypot(x: Dual, floor: f64) -> Dual {
    let value = x.re.hypot(floor);
    chain(x, value, x.re / value)
}

/// Error function.
pub fn erf(x: Dual) -> Dual {
    chain(x, libm::erf(x.re), std::f64::consts::FRAC_2_SQRT_PI * (-x.re * x.re).exp())
}

/// A function of `x` of which value and derivative are known.
pub fn chain(x: Dual, value: f64, slope: f64) -> Dual {
    Dual::new(value, x.eps * slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_take_the_mean_branch_whatever_the_sign_of_zero() {
        for zero in [0.0, -0.0] {
            assert_eq!(derivatives(&abs(slip_dual(zero))), (0.0, [0.0, 0.0]));
        }
        let (p, s) = (pressure_dual(2.0), slip_dual(2.0));
        assert_eq!(derivatives(&max(p, s)), (2.0, [0.5, 0.5]));
        assert_eq!(derivatives(&min(p, s)), (2.0, [0.5, 0.5]));
        assert_eq!(derivatives(&min(p * 2.0, s)), (2.0, [0.0, 1.0]));
    }

    #[test]
    fn nan_is_not_hidden_by_min_and_max() {
        let nan = constant(f64::NAN);
        for x in [
            max(nan, constant(1.0)),
            max(constant(1.0), nan),
            min(nan, constant(1.0)),
            min(constant(1.0), nan),
            abs(nan),
        ] {
            assert!(x.re.is_nan());
        }
    }

    #[test]
    fn tanh_and_power_survive_the_extremes() {
        assert_eq!(derivatives(&tanh(slip_dual(-1e300))), (-1.0, [0.0, 0.0]));
        let (value, slope) = derivatives(&tanh(slip_dual(0.5)));
        assert!((value - 0.5f64.tanh()).abs() < 1e-15 && (slope[1] - (1.0 - value * value)).abs() < 1e-15);
        assert_eq!(derivatives(&power(pressure_dual(0.0), 1.5)), (0.0, [0.0, 0.0]));
        assert_eq!(derivatives(&power(pressure_dual(4.0), 1.5)), (8.0, [3.0, 0.0]));
    }

    #[test]
    fn offset_power_agrees_with_its_definition_and_starts_with_finite_slope() {
        let (value, slope) = derivatives(&offset_power(pressure_dual(3.0), 1.0, 0.5));
        assert!((value - 1.0).abs() < 1e-15 && (slope[0] - 0.25).abs() < 1e-15);
        let (value, slope) = derivatives(&offset_power(pressure_dual(1e-20), 4.0, 0.5));
        assert!((value - 0.25e-20).abs() < 1e-35 && (slope[0] - 0.25).abs() < 1e-15);
        assert_eq!(derivatives(&offset_power(pressure_dual(4.0), 0.0, 1.5)), (8.0, [3.0, 0.0]));
    }

    #[test]
    fn decay_meets_both_ends_and_survives_overflow() {
        for (start, end) in [(0.5, 0.2), (0.2, 0.5), (0.3, 0.3), (1.0, 0.0), (0.0, 1.0)] {
            assert_eq!(derivatives(&decay(start, end, slip_dual(0.0))), (start, [0.0, end - start]));
            let (value, slope) = derivatives(&decay(start, end, with_derivatives(f64::INFINITY, [f64::INFINITY, 0.0])));
            assert!((value - end).abs() < 1e-200 && slope == [0.0, 0.0]);
            let (value, slope) = derivatives(&decay(start, end, slip_dual(1.0)));
            let e = std::f64::consts::E;
            assert!((value - end - (start - end) / e).abs() < 1e-15 && (slope[1] - (end - start) / e).abs() < 1e-15);
        }
    }

    #[test]
    fn hypot_is_even_and_never_below_its_floor() {
        assert_eq!(derivatives(&hypot(slip_dual(0.0), 1e-3)), (1e-3, [0.0, 0.0]));
        assert_eq!(derivatives(&hypot(slip_dual(-3.0), 4.0)), (5.0, [0.0, -0.6]));
        assert_eq!(derivatives(&hypot(slip_dual(1e200), 1.0)), (1e200, [0.0, 1.0]));
    }

    #[test]
    fn erf_agrees_with_its_power_series() {
        for x in [-1.5f64, -1e-3, 0.0, 0.3, 1.0, 2.0] {
            let (mut term, mut sum) = (x, x);
            for n in 1..60 {
                term *= -x * x / f64::from(n);
                sum += term / f64::from(2 * n + 1);
            }
            let (value, slope) = derivatives(&erf(pressure_dual(x)));
            assert!((value - sum * std::f64::consts::FRAC_2_SQRT_PI).abs() < 1e-14, "erf {x} = {value}");
            let h = 1e-5;
            let difference = (libm::erf(x + h) - libm::erf(x - h)) / (2.0 * h);
            assert!((slope[0] - difference).abs() < 1e-9, "slope {} of erf at {x}", slope[0]);
        }
    }
}
