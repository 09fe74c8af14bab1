//! Friction that fades with heat: energy, closed forms, limits.

use asperity_laws::builtin::{Fading, Heated};
use asperity_laws::*;

const LAW: Heated = Heated {
    friction: 0.5,
    limit: 0.1,
    form: Fading::Linear,
    reference: None,
    range: 50.0,
    capacity: 2.0,
    transfer: 0.5,
    partition: 0.4,
    ambient: 300.0,
};
const FORMS: [Fading; 2] = [Fading::Linear, Fading::Exponential];

/// Bound and temperature after a step.
fn slide(law: &Heated, pressure: f64, slip: f64, dt: f64, old: f64) -> (f64, f64) {
    let mut new = [dual::constant(f64::NAN)];
    let answer = law.response(&InterfacePoint::new(pressure, slip, dt), &[old], &mut new);
    (answer.value().re, new[0].re)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
}

#[test]
fn heat_in_is_the_work_of_friction_at_every_step() {
    for form in FORMS {
        let (law, dt) = (Heated { form, ..LAW }, 0.1);
        let (mut t, mut taken_in, mut work) = (300.0, 0.0, 0.0);
        for k in 0..500 {
            let slip = 3.0 * f64::from(k).sin();
            let (bound, next) = slide(&law, 20.0, slip, dt, t);
            taken_in += 2.0 * (next - t) + 0.5 * (next - 300.0) * dt;
            work += bound * slip.abs();
            t = next;
        }
        assert!(t > 310.0);
        close(taken_in, 0.4 * work, 1e-12);
    }
}

#[test]
fn adiabatic_fading_converges_to_its_closed_form() {
    // w = p |s| beta / (C T_c); linear: 1 - x = e^(-mu0 w), exponential: e^x = 1 + mu0 w, for limit 0
    let w: f64 = 20.0 * 10.0 * 0.4 / 100.0;
    for (form, expected) in [(Fading::Linear, (-0.5 * w).exp()), (Fading::Exponential, 1.0 / (1.0 + 0.5 * w))] {
        let law = Heated { form, limit: 0.0, transfer: 0.0, ..LAW };
        let error = |n: u32| {
            let steps = (0..n).fold((0.0, 300.0), |(_, t), _| slide(&law, 20.0, 10.0 / f64::from(n), 0.1, t));
            steps.0 / 10.0 - expected
        };
        for n in [100, 200, 400] {
            close(error(n) / error(2 * n), 2.0, 0.02);
        }
    }
}

#[test]
fn cools_towards_the_ambient_of_the_scene() {
    let mut open = [f64::NAN];
    LAW.open(&InterfacePoint::new(0.0, 0.0, 2.0), &[400.0], &mut open);
    close(open[0], 300.0 + 100.0 / 1.5, 1e-14);
    let at = InterfacePoint { temperature: Some(350.0), ..InterfacePoint::new(0.0, 0.0, 2.0) };
    LAW.open(&at, &[400.0], &mut open);
    close(open[0], 350.0 + 50.0 / 1.5, 1e-14);
}

#[test]
fn lies_between_its_limits_and_falls_with_the_temperature() {
    for form in FORMS {
        let law = Heated { form, ..LAW };
        let mu = |t| slide(&law, 1.0, 0.0, 1e-12, t).0;
        close(mu(200.0), 0.5, 1e-12);
        close(mu(300.0), 0.5, 1e-12);
        close(mu(1e6), 0.1, 1e-12);
        close(mu(325.0), if form == Fading::Linear { 0.3 } else { 0.1 + 0.4 * (-0.5f64).exp() }, 1e-10);
    }
}

#[test]
fn is_coulomb_without_fading_and_frictionless_without_friction() {
    assert_eq!(slide(&Heated { limit: 0.5, ..LAW }, 2.0, 30.0, 0.1, 400.0).0, 1.0);
    assert!(Heated { friction: 0.0, limit: 0.0, ..LAW }.frictionless());
    assert_eq!(validate(&Heated { limit: 0.6, ..LAW }).unwrap_err().key(), "limit");
}
