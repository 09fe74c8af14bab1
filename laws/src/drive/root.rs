//! Zero of a scalar residual: bracket, then Newton's method kept inside of it by bisection.

/// A bracket grows by this factor; small, so that the nearest of several zeros is found.
const GROWTH: f64 = 1.5;
/// Enough to grow over, and to bisect down, the whole range of numbers.
const ITERATIONS: usize = 2200;

/// Value, slope and the size of the terms that make up the value.
pub(super) struct Residual {
    pub value: f64,
    pub slope: f64,
    pub scale: f64,
}

impl Residual {
    fn vanishes(&self) -> bool {
        self.value.abs() <= 4.0 * f64::EPSILON * self.scale
    }
}

/// Walks from `start` to where the residual changes its sign: upwards while it is positive, as a residual that falls in the large asks.
pub(super) fn bracket<E>(
    residual: impl Fn(f64) -> Result<Residual, E>,
    start: f64,
    probe: f64,
) -> Result<Option<[f64; 2]>, E> {
    let first = residual(start)?.value;
    let (mut near, mut step) = (start, probe.abs().copysign(first));
    for _ in 0..ITERATIONS {
        let far = near + step;
        if residual(far)?.value * first.signum() <= 0.0 {
            return Ok(Some([near, far]));
        }
        (near, step) = (far, step * GROWTH);
    }
    Ok(None)
}

/// The zero between two places, to round-off; the residual is `>= 0` at the lower and `<= 0` at the upper one.
pub(super) fn solve<E>(
    residual: impl Fn(f64) -> Result<Residual, E>,
    [mut low, mut high]: [f64; 2],
    guess: f64,
) -> Result<f64, E> {
    let sign = (high - low).signum();
    let inside = |x: f64, low: f64, high: f64| low.min(high) < x && x < low.max(high);
    let mut x = if inside(guess, low, high) { guess } else { high };
    let mut last = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let r = residual(x)?;
        if r.vanishes() {
            break;
        }
        if r.value * sign > 0.0 {
            low = x
        } else {
            high = x
        }
        let (newton, middle) = (x - r.value / r.slope, 0.5 * (low + high));
        if (newton - x).abs() <= f64::EPSILON * x.abs() || middle == low || middle == high {
            break;
        }
        x = if inside(newton, low, high) && r.value.abs() <= 0.5 * last { newton } else { middle };
        last = r.value.abs();
    }
    Ok(x)
}

/// The end of `(0, whole]` where `holds` stops to be true, just beyond it; it holds at 0 and not at `whole`.
pub(super) fn event<E>(whole: f64, holds: impl Fn(f64) -> Result<bool, E>) -> Result<f64, E> {
    let (mut before, mut after) = (0.0, whole);
    loop {
        let middle = 0.5 * (before + after);
        if middle <= before || middle >= after || after - before <= f64::EPSILON * whole {
            return Ok(after);
        }
        if holds(middle)? { before = middle } else { after = middle }
    }
}
