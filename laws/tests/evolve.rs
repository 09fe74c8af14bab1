//! `evolve` against closed forms: values, tangents, order, stiffness, failure.

use asperity_laws::{Dual, DualNum, InterfacePoint, dual::derivatives, evolve};

/// Bristle `dz/dt = v - sigma |v| z`, in units where the saturated deflection is `1/sigma`.
fn dahl(at: &InterfacePoint, sigma: f64, old: f64) -> Dual {
    let mut new = [Dual::from_re(f64::NAN)];
    let [z] = evolve(at.dt, &[old], &mut new, |[z]| [at.velocity() - at.speed() * z * sigma]);
    assert_eq!(derivatives(&z), derivatives(&new[0]));
    z
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
}

#[test]
fn dahl_backward_euler_and_its_tangent_in_closed_form() {
    for (sigma, old, slip, dt) in
        [(2.0, 0.1, 0.3, 0.5), (2.0, 0.1, -0.3, 1e-6), (1e6, -5e-7, 3.0, 1e3), (1e-6, 0.0, -1e-9, 1.0)]
    {
        let (z, slope) = derivatives(&dahl(&InterfacePoint::new(1.0, slip, dt), sigma, old));
        let denominator = 1.0 + sigma * slip.abs();
        let expected = (old + slip) / denominator;
        close(z, expected, 1e-14);
        close(slope[1], (1.0 - slip.signum() * expected * sigma) / denominator, 1e-9);
        assert_eq!(slope[0], 0.0);
    }
}

#[test]
fn dahl_converges_with_first_order_to_the_exponential() {
    let exact = 1.0 - (-2.0f64).exp();
    let error = |steps: u32| {
        let at = InterfacePoint::new(1.0, 2.0 / f64::from(steps), 0.1);
        let end = (0..steps).fold(0.0, |z, _| dahl(&at, 1.0, z).re);
        (end - exact).abs()
    };
    for steps in [64, 128, 256] {
        let order = (error(steps) / error(2 * steps)).log2();
        assert!((order - 1.0).abs() < 0.02, "order {order}");
    }
}

#[test]
fn nonlinear_rate_against_the_root_of_its_quadratic() {
    // z' = p - z^2: z1 = [-1 + sqrt(1 + 4 h (z0 + h p))] / 2h, dz1/dp = h / (1 + 2 h z1)
    for (pressure, dt, old) in [(1.0, 0.1, 0.0), (1e8, 1e8, 0.0), (1e-8, 1e-8, 3.0), (4.0, 1e6, 1e-3)] {
        let at = InterfacePoint::new(pressure, 0.0, dt);
        let mut new = [Dual::from_re(f64::NAN)];
        let [z] = evolve(dt, &[old], &mut new, |[z]| [at.pressure - z * z]);
        let c = old + dt * pressure;
        let expected = 2.0 * c / (1.0 + (1.0 + 4.0 * dt * c).sqrt());
        let (value, slope) = derivatives(&z);
        close(value, expected, 1e-13);
        close(slope[0], dt / (1.0 + 2.0 * dt * expected), 1e-12);
    }
}

#[test]
fn three_coupled_states_of_very_different_units() {
    // z' = A z + p e0 with a cascade: z0' = p - a z0, z1' = 1e9 z0 - b z1, z2' = 1e-9 z1 - c z2 + s-dependent drain
    let (a, b, c, dt, p, s) = (2.0, 3.0, 5.0, 0.7, 1.5, 0.2);
    let at = InterfacePoint::new(p, s, dt);
    let old = [0.3, 2e9, -1.0];
    let mut new = [Dual::from_re(f64::NAN); 3];
    evolve(dt, &old, &mut new, |[x, y, z]| [at.pressure - x * a, x * 1e9 - y * b, y * 1e-9 - z * (at.slip + c)]);
    let x = (old[0] + dt * p) / (1.0 + dt * a);
    let y = (old[1] + dt * 1e9 * x) / (1.0 + dt * b);
    let z = (old[2] + dt * 1e-9 * y) / (1.0 + dt * (c + s));
    let dx = dt / (1.0 + dt * a);
    let dy = dt * 1e9 * dx / (1.0 + dt * b);
    let expected =
        [(x, [dx, 0.0]), (y, [dy, 0.0]), (z, [dt * 1e-9 * dy / (1.0 + dt * (c + s)), -dt * z / (1.0 + dt * (c + s))])];
    for (found, (value, slopes)) in new.iter().map(derivatives).zip(expected) {
        close(found.0, value, 1e-14);
        close(found.1[0], slopes[0], 1e-13);
        close(found.1[1], slopes[1], 1e-13);
    }
}

#[test]
fn steep_and_bounded_rates_in_one_huge_step() {
    // logarithm of a state that a full Newton step would make negative; stationary state 1
    let mut new = [Dual::from_re(f64::NAN)];
    for (old, dt) in [(1e6, 1e6), (1e-6, 1e9), (1e-30, 1.0)] {
        let [z] = evolve(dt, &[old], &mut new, |[z]| [-z * z.ln()]);
        let residual = (old - dt * z.re * z.re.ln() - z.re) / (old + z.re + dt * z.re);
        assert!(z.re > 0.0 && residual.abs() < 1e-14, "state {} from {old} in {dt}: residual {residual}", z.re);
    }
}

#[test]
fn without_a_solution_the_answer_is_nan() {
    // z = z0 + dt (1 + z^2) has no real root for dt = 1
    let mut new = [Dual::from_re(0.0)];
    let [z] = evolve(1.0, &[0.0], &mut new, |[z]| [z * z + 1.0]);
    assert!(z.re.is_nan() && new[0].re.is_nan());
}
