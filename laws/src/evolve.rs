//! Internal variables by their rates: backward Euler with a consistent tangent, so that a law writes no derivative.

use crate::dual::{self, Dual};

/// Seed of a state derivative. The rates carry derivatives with respect to pressure and slip in the same two slots; beside this seed
/// they vanish, so that taking them off again costs no digits. Thus one type serves any number of states, and the closure may
/// capture any dual.
const SEED: f64 = f64::from_bits((1023 + 100) << 52);
const NEWTON_STEPS: usize = 40;
const HALVINGS: i32 = 12;
/// Correction relative to the state at which the local Newton method stops.
const CONVERGED: f64 = 4.0 * f64::EPSILON;
/// Correction that is accepted if round-off keeps it from getting smaller.
const STAGNATED: f64 = 1e-9;
/// Residual relative to its terms above which a small correction is not believed.
const BALANCED: f64 = 1e-6;
/// Bounds of the continuation in `theta`: smallest stage relative to what is done, and number of stages.
const SMALLEST_STAGE: f64 = 1e-9;
const STAGES: usize = 300;

/// Integrates `d state/dt = rate(state)` over one step by backward Euler,
///
/// ```text
/// z1 = z0 + dt f(z1, p, s)          dz1/dx = (1 - dt df/dz)^-1 dt df/dx ,   x = p, s
/// ```
///
/// and writes and returns `z1` with its derivatives by the implicit function theorem. `N` states follow from the closure:
///
/// ```
/// # use asperity_laws::{Dual, InterfacePoint, evolve};
/// fn deflection(at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Dual {
///     let [z] = evolve(at.dt, old, new, |[z]| [at.velocity() - at.speed() * z / 1e-3]);
///     z
/// }
/// ```
///
/// First order in `dt`; stable for stiff decaying states. Rates must be finite around the path; where they are not (a logarithm of a
/// negative state) the iteration backs off. Newton with the affine-invariant monotonicity test (Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3); if it fails, the step is entered in stages `theta dt`. If that fails too, all states are NaN, which the
/// engine takes as a failed step. Scale-free: no tolerance has a unit.
///
/// # Panics
/// If `old` or `new` do not hold `N` states: the law contradicts its own `variables`.
pub fn evolve<const N: usize>(
    dt: f64,
    old: &[f64],
    new: &mut [Dual],
    rate: impl Fn([Dual; N]) -> [Dual; N],
) -> [Dual; N] {
    let start: [f64; N] = old.try_into().expect("one old value per rate");
    let step = Step { start, dt, rate };
    let end = step.end().and_then(|end| end.with_tangent(dt)).unwrap_or([dual::constant(f64::NAN); N]);
    new.copy_from_slice(&end);
    end
}

struct Step<const N: usize, F> {
    start: [f64; N],
    dt: f64,
    rate: F,
}

/// A solution, with rates and matrix at the iterate before the last correction: apart by round-off only.
struct Solved<const N: usize> {
    z: [f64; N],
    rates: [Dual; N],
    matrix: [[f64; N]; N],
}

impl<const N: usize> Solved<N> {
    fn with_tangent(&self, dt: f64) -> Option<[Dual; N]> {
        let column = |k: usize| solve(self.matrix, self.rates.map(|f| dt * dual::derivatives(&f).1[k]));
        let (by_pressure, by_slip) = (column(0)?, column(1)?);
        Some(std::array::from_fn(|i| dual::with_derivatives(self.z[i], [by_pressure[i], by_slip[i]])))
    }
}

impl<const N: usize, F: Fn([Dual; N]) -> [Dual; N]> Step<N, F> {
    /// State at the end: directly, or in stages that grow while they succeed.
    fn end(&self) -> Option<Solved<N>> {
        if let Some(end) = self.newton(self.start, self.dt) {
            return Some(end);
        }
        let (mut z, mut done, mut stage) = (self.start, 0.0, 0.25);
        for _ in 0..STAGES {
            let theta = f64::min(done + stage, 1.0);
            match self.newton(z, theta * self.dt) {
                Some(end) if theta == 1.0 => return Some(end),
                Some(next) => (z, done, stage) = (next.z, theta, 2.0 * stage),
                None if stage > SMALLEST_STAGE * f64::max(done, SMALLEST_STAGE) => stage *= 0.5,
                None => return None,
            }
        }
        None
    }

    fn newton(&self, guess: [f64; N], h: f64) -> Option<Solved<N>> {
        let (mut z, mut last) = (guess, f64::INFINITY);
        let mut f = self.rates(&z);
        for _ in 0..NEWTON_STEPS {
            let matrix = self.matrix(&z, &f, h);
            let residual = self.residual(&z, &f, h);
            let correction = solve(matrix, residual)?;
            let weights = std::array::from_fn(|i| z[i].abs() + self.start[i].abs() + correction[i].abs());
            let size = size(&correction, &weights);
            if size <= CONVERGED || (size <= STAGNATED && size >= 0.5 * last) {
                let end = Solved { z: advance(&z, 1.0, &correction), rates: f, matrix };
                return self.balanced(&z, &matrix, &residual).then_some(end);
            }
            last = size;
            (z, f) = (0..HALVINGS).find_map(|k| {
                let (t, goal) = (0.5f64.powi(k), (1.0 - 0.25 * 0.5f64.powi(k)) * size);
                let trial = advance(&z, t, &correction);
                let rates = self.rates(&trial);
                let next = solve(matrix, self.residual(&trial, &rates, h))?;
                (self::size(&next, &weights) <= goal || size <= STAGNATED).then_some((trial, rates))
            })?;
        }
        None
    }

    fn rates(&self, z: &[f64; N]) -> [Dual; N] {
        (self.rate)(z.map(dual::constant))
    }

    /// `z0 + h f - z`.
    fn residual(&self, z: &[f64; N], f: &[Dual; N], h: f64) -> [f64; N] {
        std::array::from_fn(|i| self.start[i] + h * f[i].re - z[i])
    }

    /// `1 - h df/dz`, two columns for each evaluation of the rates.
    fn matrix(&self, z: &[f64; N], f: &[Dual; N], h: f64) -> [[f64; N]; N] {
        let mut matrix = [[0.0; N]; N];
        for j in (0..N).step_by(2) {
            let columns = j..usize::min(j + 2, N);
            let mut seeded = z.map(dual::constant);
            for k in columns.clone() {
                let unit = if k == j { [SEED, 0.0] } else { [0.0, SEED] };
                seeded[k] = dual::with_derivatives(z[k], unit);
            }
            for (i, seeded_rate) in (self.rate)(seeded).iter().enumerate() {
                let (slopes, captured) = (dual::derivatives(seeded_rate).1, dual::derivatives(&f[i]).1);
                for k in columns.clone() {
                    let identity = f64::from(u8::from(i == k));
                    matrix[i][k] = identity - h * ((slopes[k - j] - captured[k - j]) / SEED);
                }
            }
        }
        matrix
    }

    /// Whether the residual is small beside its own terms: a correction is also small where the rates are merely steep.
    fn balanced(&self, z: &[f64; N], matrix: &[[f64; N]; N], residual: &[f64; N]) -> bool {
        (0..N).all(|i| {
            let terms: f64 = (0..N).map(|j| (matrix[i][j] * z[j]).abs()).sum();
            residual[i].abs() <= BALANCED * (self.start[i].abs() + z[i].abs() + terms)
        })
    }
}

/// Largest entry relative to the states at hand, so that the units of each state do not matter.
fn size<const N: usize>(correction: &[f64; N], weights: &[f64; N]) -> f64 {
    let relative = correction.iter().zip(weights).map(|(c, w)| if *c == 0.0 { 0.0 } else { c.abs() / w });
    relative.fold(0.0, f64::max)
}

fn advance<const N: usize>(z: &[f64; N], t: f64, correction: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| z[i] + t * correction[i])
}

/// Gauss elimination with row pivoting; `None` if the matrix is singular or anything is not finite.
fn solve<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    if !a.iter().flatten().all(|x| x.is_finite()) {
        return None;
    }
    for k in 0..N {
        let pivot = (k..N).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (row, right) = (a[k], b[k]);
        for i in k + 1..N {
            let factor = a[i][k] / row[k];
            (k..N).for_each(|j| a[i][j] -= factor * row[j]);
            b[i] -= factor * right;
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b.iter().all(|x| x.is_finite()).then_some(b)
}
