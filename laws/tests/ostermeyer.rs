//! Ostermeyer's law against its closed forms.

use asperity_laws::builtin::Ostermeyer;
use asperity_laws::*;

const LAW: Ostermeyer = Ostermeyer {
    alpha: 1.0,
    beta: 1.0,
    gamma: 0.01,
    delta: 1.0,
    epsilon: 1.0,
    zeta: 20.0,
    ambient: 60.0,
    initial_friction: None,
};

/// States after a step of the power `P`.
fn advance(law: &Ostermeyer, power: f64, dt: f64, old: [f64; 2]) -> [f64; 2] {
    let mut new = [dual::constant(f64::NAN); 2];
    let bound = law.response(&InterfacePoint::new(0.5, 2.0 * power * dt, dt), &old, &mut new).value().re;
    assert_eq!(bound, 0.5 * new[0].re);
    new.map(|x| x.re)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
}

#[test]
fn stationary_values() {
    for (power, mu, temperature) in [(0.0, 0.6, 60.0), (1.0, 0.3333, 66.67), (2.0, 0.2308, 69.23), (5.0, 0.12, 72.0)] {
        let end = (0..200).fold([1.0, 10.0], |old, _| advance(&LAW, power, 1.0, old));
        close(end[0], mu, 2e-4);
        close(end[1], temperature, 1e-4);
        close(end[0], 0.6 / (1.0 + 0.8 * power), 1e-12);
    }
}

/// `exp(A t)` applied to the deviation from the stationary state, by the two real eigenvalues.
fn exact(power: f64, t: f64, start: [f64; 2]) -> [f64; 2] {
    let mu = 0.6 / (1.0 + 0.8 * power);
    let stationary = [mu, 60.0 + 20.0 * power * mu];
    let a = [[-(1.0 + power), 0.01], [20.0 * power, -1.0]];
    let (mean, half) = (0.5 * (a[0][0] + a[1][1]), 0.5 * (a[0][0] - a[1][1]));
    let root = (half * half + a[0][1] * a[1][0]).sqrt();
    let (cosh, sinh) = ((root * t).cosh() * (mean * t).exp(), (root * t).sinh() / root * (mean * t).exp());
    let x = [start[0] - stationary[0], start[1] - stationary[1]];
    std::array::from_fn(|i| stationary[i] + cosh * x[i] + sinh * (a[i][0] * x[0] + a[i][1] * x[1] - mean * x[i]))
}

#[test]
fn the_approach_at_constant_power_converges_with_first_order_to_the_matrix_exponential() {
    let (power, t, start) = (2.0, 1.5, [0.6, 60.0]);
    let expected = exact(power, t, start);
    let end = |n: u32| (0..n).fold(start, |old, _| advance(&LAW, power, t / f64::from(n), old));
    for n in [200, 400, 800] {
        let [coarse, fine] = [end(n), end(2 * n)];
        for ((coarse, fine), expected) in coarse.into_iter().zip(fine).zip(expected) {
            close((coarse - expected) / (fine - expected), 2.0, 0.02);
        }
    }
}

#[test]
fn without_birth_the_coefficient_decays_at_the_rate_of_destruction() {
    let law = Ostermeyer { gamma: 0.0, initial_friction: Some(0.5), ..LAW };
    let n = 100_000;
    let end = (0..n).fold([0.5, 60.0], |old, _| advance(&law, 2.0, 1.0 / f64::from(n), old));
    close(end[0], 0.5 * (-3.0f64).exp(), 1e-4);
    close(advance(&law, 2.0, 0.25, [0.5, 60.0])[0], 0.5 / 1.75, 1e-14);
}

#[test]
fn at_rest_and_open_both_states_relax() {
    let mut open = [f64::NAN; 2];
    LAW.open(&InterfacePoint::new(0.0, 0.0, 0.5), &[0.1, 100.0], &mut open);
    let expected = advance(&LAW, 0.0, 0.5, [0.1, 100.0]);
    assert_eq!(open, expected);
    close(expected[1], 60.0 + 40.0 / 1.5, 1e-14);
    close(expected[0], (0.1 + 0.5 * 0.01 * expected[1]) / 1.5, 1e-14);
    let rest = (0..200).fold([0.1, 100.0], |old, _| advance(&LAW, 0.0, 1.0, old));
    close(rest[0], 0.6, 1e-12);
    close(rest[1], 60.0, 1e-12);
}

#[test]
fn stays_positive_at_any_power_in_any_step() {
    for zeta in [0.0, 20.0, 99.0] {
        let law = Ostermeyer { zeta, ..LAW };
        for (i, j) in (-9..28).flat_map(|i| (-9..10).map(move |j| (i, j))) {
            let mut state = [0.6, 60.0];
            for _ in 0..3 {
                state = advance(&law, 10f64.powi(i), 10f64.powi(j), state);
                assert!(state[0] > 0.0 && state[1] >= 60.0 * (1.0 - 1e-12), "{state:?} at 1e{i}, 1e{j}");
            }
        }
    }
}

#[test]
fn is_coulomb_without_change_of_patches() {
    let law = Ostermeyer { alpha: 0.0, initial_friction: Some(0.3), ..LAW };
    assert_eq!(advance(&law, 5.0, 0.1, [0.3, 60.0])[0], 0.3);
}
