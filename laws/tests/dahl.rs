//! Dahl's model against its closed forms, and its energy under a changing pressure.

use asperity_laws::builtin::Dahl;
use asperity_laws::*;

const LAW: Dahl = Dahl { friction: 0.5, stiffness: 200.0, exponent: 1.0 };

/// Traction and deflection after a slip.
fn slide(law: &Dahl, pressure: f64, slip: f64, old: f64) -> (f64, f64) {
    let mut new = [dual::constant(f64::NAN)];
    let answer = law.response(&InterfacePoint::new(pressure, slip, 0.1), &[old], &mut new);
    (answer.value().re, new[0].re)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
}

/// Deflection and trapezoidal work along `slip` in `count` steps.
fn path(law: &Dahl, slip: f64, count: u32, start: f64) -> (f64, f64) {
    (0..count).fold((start, 0.0), |(old, work), _| {
        let (q, z) = slide(law, 2.0, slip / f64::from(count), old);
        (z, work + 0.5 * (q + law.stiffness * old) * slip / f64::from(count))
    })
}

#[test]
fn first_loading_is_the_exponential_in_one_step_or_many() {
    for x in [1e-9, 1e-3, 5e-3, 0.1] {
        let expected = -(-200.0 * x).exp_m1();
        close(slide(&LAW, 2.0, x, 0.0).0, expected, 1e-14);
        close(200.0 * path(&LAW, x, 100, 0.0).0, expected, 1e-13);
    }
}

#[test]
fn first_loading_for_other_exponents() {
    let traction = |exponent, x| slide(&Dahl { exponent, ..LAW }, 2.0, x, 0.0).0;
    close(traction(0.0, 0.003), 0.6, 1e-14); // elastic
    close(traction(0.0, 0.5), 1.0, 1e-14); // plastic
    close(traction(2.0, 0.02), 4.0 / 5.0, 1e-14); // 1 - 1/(1 + x)
    close(traction(0.5, 0.005), 0.75, 1e-14); // 1 - (1 - x/2)^2
}

#[test]
fn the_loop_encloses_four_times_friction_times_amplitude() {
    for amplitude in [0.5, 2.0] {
        let (z, _) = path(&LAW, amplitude, 20_000, 0.0);
        let (z, back) = path(&LAW, -2.0 * amplitude, 40_000, z);
        let (_, forth) = path(&LAW, 2.0 * amplitude, 40_000, z);
        // less what the reversals miss: each loses 2 Fc^2/k of area
        let expected = 4.0 * amplitude - 4.0 / 200.0;
        close(back + forth, expected, 1e-4);
    }
}

#[test]
fn tends_to_coulomb_with_the_stiffness() {
    for stiffness in [1e2, 1e3] {
        let law = Dahl { stiffness, ..LAW };
        close((1.0 - slide(&law, 2.0, 0.02, 0.0).0).ln(), -0.02 * stiffness, 1e-7);
    }
    assert_eq!(slide(&Dahl { exponent: 0.0, ..LAW }, 2.0, -0.02, 0.0).0, -1.0);
}

#[test]
fn stays_below_the_bound_and_creates_no_energy_while_the_pressure_changes() {
    for exponent in [0.0, 0.5, 1.0, 2.0] {
        let law = Dahl { exponent, ..LAW };
        let (mut z, mut work, mut random) = (0.0, 0.0, 1u64);
        for _ in 0..100_000 {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let [pressure, slip] = [random >> 40, (random >> 20) & 0xff_ffff].map(|x| x as f64 / f64::from(1 << 24));
            let slip = (slip - 0.5) * 0.01;
            let (q, end) = slide(&law, pressure, slip, z);
            assert!(q.abs() <= 0.5 * pressure * (1.0 + 1e-15));
            work += q * slip - 0.5 * law.stiffness * (end * end - z * z);
            assert!(work >= 0.0, "work {work} beyond the stored energy");
            z = end;
        }
    }
}

#[test]
fn a_falling_pressure_lets_the_deflection_slip_back() {
    let (_, z) = slide(&LAW, 2.0, 1.0, 0.0);
    let (q, z) = slide(&LAW, 0.5, 0.0, z);
    close(q, 0.25, 1e-15);
    close(slide(&LAW, 2.0, 0.0, z).0, 0.25, 1e-15);
}
