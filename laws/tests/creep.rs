//! Spring sliders under direct laws: stability of rate-and-state friction, and the Prandtl-Tomlinson chain of potential wells.

use asperity_laws::builtin::{Evolution, RateAndState};
use asperity_laws::drive::Slider;
use asperity_laws::*;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

const A: f64 = 0.01;
const B: f64 = 0.015;
const DISTANCE: f64 = 1e-5;
const PRESSURE: f64 = 1e6;
const SPEED: f64 = 1e-6;
/// `(b - a) sigma/Dc`.
const CRITICAL: f64 = 5.0e8;

/// Logarithms of the first and the following maxima of `mu - mu_ss` of a slider that starts slightly off steady sliding, and
/// the times of these maxima.
fn maxima(evolution: Evolution, stiffness: f64, duration: f64, steps: usize) -> Vec<[f64; 2]> {
    let law = RateAndState {
        friction: 0.6,
        direct_effect: A,
        evolution_effect: B,
        distance: DISTANCE,
        speed: SPEED,
        evolution,
        initial_age: None,
    };
    let steady = 0.6 * PRESSURE;
    let slider = Slider {
        mass: 0.0,
        stiffness,
        velocity: SPEED,
        pressure: PRESSURE,
        initial_force: steady * (1.0 + 1e-6),
        initial_velocity: SPEED,
        states: None,
    };
    let history = slider.run(&law, duration, steps);
    assert!(history.failure.is_none(), "{:?}", history.failure);
    let off: Vec<[f64; 2]> = history.records.iter().map(|record| [record.time, record.force / steady - 1.0]).collect();
    let peaks = off.windows(3).filter(|w| w[1][1] > w[0][1] && w[1][1] >= w[2][1] && w[1][1] > 0.0);
    peaks.map(|w| [w[1][0], w[1][1].ln()]).collect()
}

/// Growth rate and frequency of the linearised slider: `l^2 + (V/Dc) (kappa - (b - a))/a l + kappa V^2/(a Dc^2) = 0`,
/// `kappa = k Dc/sigma`.
fn linear(stiffness: f64) -> [f64; 2] {
    let (kappa, rate) = (stiffness * DISTANCE / PRESSURE, SPEED / DISTANCE);
    let growth = -0.5 * rate * (kappa - (B - A)) / A;
    [growth, (kappa / A * rate * rate - growth * growth).sqrt()]
}

/// Growth and frequency found, extrapolated from two step sizes (first order).
fn found(evolution: Evolution, stiffness: f64) -> [f64; 2] {
    let rates = |steps: usize| {
        let peaks = maxima(evolution, stiffness, 900.0, steps);
        let (first, last) = (peaks[1], peaks[peaks.len() - 1]);
        let time = last[0] - first[0];
        [(last[1] - first[1]) / time, TAU * (peaks.len() - 2) as f64 / time]
    };
    let [coarse, fine] = [20_000, 40_000].map(rates);
    [2.0 * fine[0] - coarse[0], 2.0 * fine[1] - coarse[1]]
}

#[test]
fn rate_and_state_slider_is_unstable_below_the_critical_stiffness() {
    assert!((linear(CRITICAL)[1] - 0.070_710_678).abs() < 1e-9);
    for evolution in [Evolution::Aging, Evolution::Slip] {
        for factor in [0.95, 1.0, 1.05] {
            let ([growth, frequency], [exact, omega]) =
                (found(evolution, factor * CRITICAL), linear(factor * CRITICAL));
            assert!((growth - exact).abs() < 1e-6, "{evolution:?} {factor}: growth {growth} is not {exact}");
            assert!((frequency / omega - 1.0).abs() < 1e-4, "{evolution:?} {factor}: {frequency} is not {omega}");
        }
    }
}

/// `q = peak sin(2 pi x/period)`: no friction at all, the slope of a potential; the state is the place.
#[derive(Debug, Serialize, Deserialize)]
struct Wells {
    peak: f64,
    period: f64,
}

#[typetag::serde(name = "test-wells")]
impl FrictionLaw for Wells {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("place", Unit::LENGTH, 0.0)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        new[0] = at.slip + old[0];
        Response::Traction((new[0] * (TAU / self.period)).sin() * self.peak)
    }
}

/// Work of the puller over the last of four periods. `eta = 2 pi peak/(k period)` with `k = period = 1`.
fn pulled(eta: f64, steps: usize) -> f64 {
    let law = Wells { peak: eta / TAU, period: 1.0 };
    let slider = Slider {
        mass: 0.0,
        stiffness: 1.0,
        velocity: 1.0,
        pressure: 1.0,
        initial_force: 0.0,
        initial_velocity: 0.0,
        states: None,
    };
    let history = slider.run(&law, 4.0, 4 * steps);
    assert!(history.failure.is_none(), "{:?}", history.failure);
    let last = &history.records[history.records.len() - steps - 1..];
    last.windows(2).map(|pair| 0.5 * (pair[0].force + pair[1].force) * (pair[1].time - pair[0].time)).sum()
}

/// The same by energy: the work of a period is what is set free in the jump from the fold `cos(2 pi x) = -1/eta` to the next
/// equilibrium under the same pull.
fn set_free(eta: f64) -> f64 {
    let peak = eta / TAU;
    let fold = (-1.0 / eta).acos() / TAU;
    let pull = fold + peak * (TAU * fold).sin();
    let unbalanced = |x: f64| pull - x - peak * (TAU * x).sin();
    let mut low = fold;
    while unbalanced(low + 1e-4) > 0.0 {
        low += 1e-4;
    }
    let mut high = low + 1e-4;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if unbalanced(middle) > 0.0 { low = middle } else { high = middle }
    }
    let energy = |x: f64| 0.5 * (pull - x) * (pull - x) - peak / TAU * (TAU * x).cos();
    energy(fold) - energy(low)
}

#[test]
fn prandtl_tomlinson_is_smooth_up_to_eta_one_and_then_pays_for_each_jump() {
    // smooth: the work of a period vanishes with the step
    assert!(pulled(0.95, 4000).abs() < 1e-9, "{:e}", pulled(0.95, 4000));
    for eta in [1.5, 3.0, 5.0] {
        let exact = set_free(eta);
        let [coarse, fine] = [1000, 16_000].map(|steps| (pulled(eta, steps) / exact - 1.0).abs());
        assert!(fine < 1e-3 && fine < coarse / 8.0, "eta {eta}: {coarse:e}, {fine:e} of {exact}");
    }
    // just above the threshold the jump is small, but there
    let (above, exact) = (pulled(1.1, 16_000), set_free(1.1));
    assert!(above > 0.0 && (above / exact - 1.0).abs() < 0.05, "{above:e} of {exact:e}");
}

/// `q = c v`: with mass and spring an overdamped oscillator.
#[derive(Debug, Serialize, Deserialize)]
struct Viscous {
    viscosity: f64,
}

#[typetag::serde(name = "test-viscous")]
impl FrictionLaw for Viscous {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Traction(at.velocity() * self.viscosity)
    }
}

#[test]
fn a_viscous_slider_relaxes_as_the_oscillator_does() {
    let slider = Slider {
        mass: 1.0,
        stiffness: 4.0,
        velocity: 0.0,
        pressure: 1.0,
        initial_force: 8.0,
        initial_velocity: 0.0,
        states: None,
    };
    // x = 2 - f/4 with x'' + 5 x' + 4 x = 8, roots -1 and -4
    let exact = 8.0 * (4.0 * (-1.0_f64).exp() - (-4.0_f64).exp()) / 3.0;
    let error = |steps: usize| slider.run(&Viscous { viscosity: 5.0 }, 1.0, steps).last().force - exact;
    let [coarse, fine] = [1000, 2000].map(error);
    assert!((coarse / fine - 2.0).abs() < 0.01, "first order: {coarse:e}, {fine:e}");
    assert!((2.0 * fine - coarse).abs() < 1e-6, "extrapolated: {:e}", 2.0 * fine - coarse);
    // so stiff that the inertia does nothing: creep without ringing
    let stiff = Slider { mass: 1e-9, ..slider }.run(&Viscous { viscosity: 5.0 }, 10.0, 1000);
    let smooth =
        stiff.records[2..].windows(2).all(|pair| pair[1].velocity < pair[0].velocity && pair[1].velocity > 0.0);
    assert!(smooth, "velocity falls steadily");
}
