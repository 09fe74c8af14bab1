//! The functions of the expression language on dual numbers. Ties (`abs`, `min`, `max`) are those of [`crate::dual`].

use crate::dual::{Dual, abs, chain, constant, max, min, power, tanh};
use std::f64::consts::LN_10;

/// A function of one argument.
pub(super) type Unary = fn(Dual) -> Dual;
/// A function of two arguments, or of more as `f(f(a, b), c)`.
pub(super) type Binary = fn(Dual, Dual) -> Dual;

/// Functions of one argument by name.
pub(super) const UNARY: [(&str, Unary); 13] = [
    ("exp", |x| chain(x, x.re.exp(), x.re.exp())),
    ("ln", |x| chain(x, x.re.ln(), x.re.recip())),
    ("log10", |x| chain(x, x.re.log10(), (x.re * LN_10).recip())),
    ("sqrt", |x| chain(x, x.re.sqrt(), 0.5 / x.re.sqrt())),
    ("abs", abs),
    ("sign", sign),
    ("tanh", tanh),
    ("sinh", |x| chain(x, x.re.sinh(), x.re.cosh())),
    ("cosh", |x| chain(x, x.re.cosh(), x.re.sinh())),
    ("asinh", |x| chain(x, x.re.asinh(), x.re.hypot(1.0).recip())),
    ("atan", |x| chain(x, x.re.atan(), (1.0 + x.re * x.re).recip())),
    ("sin", |x| chain(x, x.re.sin(), x.re.cos())),
    ("cos", |x| chain(x, x.re.cos(), -x.re.sin())),
];

/// Functions of two or more arguments by name.
pub(super) const VARIADIC: [(&str, Binary); 2] = [("min", min), ("max", max)];

/// Names of all functions.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    UNARY.iter().map(|f| f.0).chain(VARIADIC.iter().map(|f| f.0))
}

/// -1, 0 or 1; derivative 0.
fn sign(x: Dual) -> Dual {
    if x.re == 0.0 || x.re.is_nan() { constant(x.re) } else { constant(x.re.signum()) }
}

/// `x^n` with a fixed exponent; at `x = 0` as [`crate::dual::power`], and 1 for `n = 0`.
pub(super) fn power_by(x: Dual, n: f64) -> Dual {
    if n == 0.0 { constant(1.0) } else { power(x, n) }
}

/// `a^b` for `a >= 0`; the derivative by the exponent vanishes at `a = 0`.
pub(super) fn power_of(a: Dual, b: Dual) -> Dual {
    let value = a.re.powf(b.re);
    let by_exponent = if a.re == 0.0 { 0.0 } else { value * a.re.ln() };
    power_by(a, b.re) + chain(b, 0.0, by_exponent)
}
