//! Rate-and-state friction against its closed forms: velocity steps, holds, the spring slider.

use asperity_laws::builtin::{Evolution, RateAndState};
use asperity_laws::*;

const LAW: RateAndState = RateAndState {
    friction: 0.6,
    direct_effect: 0.01,
    evolution_effect: 0.015,
    distance: 1e-5,
    speed: 1e-6,
    evolution: Evolution::Aging,
    initial_age: None,
};
const ALL: [Evolution; 3] = [Evolution::Aging, Evolution::Slip, Evolution::Prz];

/// Coefficient and age after a step at constant velocity.
fn slide(law: &RateAndState, velocity: f64, dt: f64, age: f64) -> (f64, f64) {
    let mut new = [dual::constant(f64::NAN)];
    let answer = law.response(&InterfacePoint::new(1.0, velocity * dt, dt), &[age], &mut new);
    (answer.value().re, new[0].re)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} instead of {b}");
}

#[test]
fn starts_in_steady_sliding_at_the_reference_speed() {
    close(LAW.variables()[0].initial, 10.0, 1e-14);
    close(slide(&LAW, 1e-6, 1e3, 10.0).0, 0.6, 1e-12);
}

#[test]
fn a_velocity_step_gives_the_direct_effect_at_once_and_the_steady_state_in_the_end() {
    let (v1, v2) = (1e-6, 1e-4);
    for evolution in ALL {
        let law = RateAndState { evolution, ..LAW };
        let (before, age) = slide(&law, v1, 1e5, 10.0);
        let (at_once, _) = slide(&law, v2, 1e-17 / v2, age);
        let (end, _) = slide(&law, v2, 10.0, age);
        close(at_once - before, 0.01 * (v2 / v1).ln(), 1e-10);
        close(end - before, -0.005 * (v2 / v1).ln(), 1e-12);
        close(before, 0.6 + if evolution == Evolution::Prz { 0.015 * 2f64.ln() } else { 0.0 }, 1e-12);
    }
}

#[test]
fn the_slip_law_decays_over_exactly_its_distance_up_and_down() {
    let law = RateAndState { evolution: Evolution::Slip, ..LAW };
    for velocity in [1e-4, 1e-8] {
        let steady = 0.6 - 0.005 * (velocity / 1e-6f64).ln();
        for x in [1e-3, 0.5, 1.0, 3.0] {
            let (mu, _) = slide(&law, velocity, x * 1e-5 / velocity, 10.0);
            close((mu - steady) / (0.015 * (velocity / 1e-6f64).ln()), (-x).exp(), 1e-10);
        }
    }
}

#[test]
fn the_age_grows_with_time_at_rest_but_for_the_slip_law() {
    for (evolution, grown) in [(Evolution::Aging, 1e6 + 10.0), (Evolution::Slip, 10.0), (Evolution::Prz, 1e6 + 10.0)] {
        let law = RateAndState { evolution, ..LAW };
        assert_eq!(slide(&law, 0.0, 1e6, 10.0), (0.0, grown));
        let mut open = [f64::NAN];
        law.open(&InterfacePoint::new(0.0, 0.0, 1e6), &[10.0], &mut open);
        assert_eq!(open, [grown]);
    }
}

#[test]
fn the_peak_after_a_hold_grows_with_the_logarithm_of_its_length() {
    for hold in [1.0, 1e2, 1e5] {
        let (_, age) = slide(&LAW, 0.0, hold, 10.0);
        let (peak, _) = slide(&LAW, 1e-6, 1e-9, age);
        close(peak - 0.6, 0.015 * (1.0 + hold / 10.0f64).ln(), 1e-9);
    }
}

#[test]
fn one_step_is_as_good_as_a_thousand_at_constant_velocity() {
    for evolution in ALL {
        let law = RateAndState { evolution, ..LAW };
        for velocity in [1e-9, 1e-6, 1e-2] {
            let dt = 2e-5 / velocity;
            let (_, one) = slide(&law, velocity, dt, 3.0);
            let many = (0..1000).fold(3.0, |age, _| slide(&law, velocity, dt / 1000.0, age).1);
            close(one / many, 1.0, 1e-12);
        }
    }
}

/// Small steps of the stated rates (Heun, second order): a second way to the same age.
#[test]
fn the_exact_steps_solve_the_rates() {
    let (velocity, dt, count) = (2e-6, 6.0, 4000);
    for (evolution, rate) in [
        (Evolution::Aging, (|y: f64| 1.0 - y) as fn(f64) -> f64),
        (Evolution::Slip, |y| -y * y.ln()),
        (Evolution::Prz, |y| 1.0 - 0.25 * y * y),
    ] {
        let law = RateAndState { evolution, ..LAW };
        let (h, y_of) = (dt / f64::from(count), velocity / 1e-5);
        let heun = (0..count).fold(10.0, |age, _| {
            let first = rate(age * y_of);
            age + 0.5 * h * (first + rate((age + h * first) * y_of))
        });
        close(slide(&law, velocity, dt, 10.0).1 / heun, 1.0, 1e-7);
    }
}

#[test]
fn tends_to_coulomb_with_the_direct_effect_and_scales_with_its_coefficients() {
    for a in [1e-2, 5e-3, 2.5e-3] {
        let law = RateAndState { direct_effect: a, evolution_effect: 0.0, ..LAW };
        close((slide(&law, 1e-3, 1.0, 10.0).0 - 0.6) / a, 1e3f64.ln(), 1e-9);
    }
    let weak = RateAndState { friction: 0.6e-300, direct_effect: 1e-302, evolution_effect: 1.5e-302, ..LAW };
    close(slide(&weak, 1e-3, 1e-3, 10.0).0 * 1e300, slide(&LAW, 1e-3, 1e-3, 10.0).0, 1e-12);
}

/// Spring of stiffness `k` pulled at `V0` under unit pressure, quasi-static: largest deviation of the velocity in the last two of twenty
/// periods relative to that in the first two.
fn growth(stiffness: f64) -> f64 {
    let (mut age, mut slip, mut time) = (10.0, 0.0, 0.0);
    let (dt, period) = (0.05, 2.0 * std::f64::consts::PI / 0.1 / 0.5f64.sqrt());
    let start = 0.6 * (1.0 + 1e-5); // pulled a little too far
    let mut largest = [0.0f64; 2];
    while time < 20.0 * period {
        time += dt;
        let balance = |v: f64| start + stiffness * (1e-6 * time - slip - v * dt) - slide(&LAW, v, dt, age).0;
        let (mut low, mut high) = (0.5e-6, 2e-6);
        for _ in 0..60 {
            let middle: f64 = 0.5 * (low + high);
            if balance(middle) > 0.0 { low = middle } else { high = middle }
        }
        age = slide(&LAW, low, dt, age).1;
        slip += low * dt;
        let window = if time < 2.0 * period { 0 } else { 1 };
        if !(2.0 * period..18.0 * period).contains(&time) {
            largest[window] = largest[window].max((low / 1e-6 - 1.0).abs());
        }
    }
    largest[1] / largest[0]
}

#[test]
fn a_spring_slider_is_stable_above_the_critical_stiffness() {
    let critical = 0.005 / 1e-5; // (b - a) p / Dc, Ruina 1983
    let (stiff, soft) = (growth(1.05 * critical), growth(0.95 * critical));
    assert!(stiff < 0.8 && soft > 1.2, "{stiff}, {soft}");
}
