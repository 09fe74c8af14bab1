//! LuGre and elasto-plastic presliding against their closed forms: steady sliding, first loading, drift, passivity.

use asperity_laws::builtin::{Damping, ElastoPlastic, LuGre};
use asperity_laws::*;

const LUGRE: LuGre = LuGre {
    rest: 1.5,
    kinetic: 1.0,
    speed: 1e-3,
    stiffness: 1e5,
    damping: 316.22776601683796,
    damping_form: Damping::Passive,
    viscosity: 0.4,
};
const DUPONT: ElastoPlastic = ElastoPlastic {
    rest: 1.5,
    kinetic: 1.0,
    speed: 1e-3,
    elastic: 0.7,
    stiffness: 1e5,
    damping: 316.22776601683796,
    damping_form: Damping::Passive,
    viscosity: 0.4,
};
/// Without damping, viscosity and weakening.
const PLAIN: LuGre = LuGre { rest: 1.0, damping: 0.0, viscosity: 0.0, ..LUGRE };
const PLAIN_DUPONT: ElastoPlastic = ElastoPlastic { rest: 1.0, damping: 0.0, viscosity: 0.0, ..DUPONT };

/// Traction per pressure and deflection after a slip.
fn slide(law: &dyn FrictionLaw, slip: f64, dt: f64, old: f64) -> (f64, f64) {
    let mut new = [dual::constant(f64::NAN)];
    let answer = law.response(&InterfacePoint::new(2.0, slip, dt), &[old], &mut new);
    (0.5 * answer.value().re, new[0].re)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
}

#[test]
fn steady_sliding_follows_the_friction_curve() {
    for law in [&LUGRE as &dyn FrictionLaw, &DUPONT] {
        for v in [1e-5, 1e-3, 2e-3, -1e-2, 1.0] {
            let z = (0..400).fold(0.0, |z, _| slide(law, 1e-5 * f64::signum(v), 1e-5 / v.abs(), z).1);
            let g = 1.0 + 0.5 * (-(v / 1e-3) * (v / 1e-3)).exp();
            close(slide(law, 1e-7 * v.signum(), 1e-7 / v.abs(), z).0, g * v.signum() + 0.4 * v, 1e-6);
        }
    }
}

#[test]
fn presliding_is_a_spring() {
    for law in [&PLAIN as &dyn FrictionLaw, &PLAIN_DUPONT] {
        close(slide(law, 1e-13, 1.0, 0.0).0, 1e-8, 1e-7);
    }
    close(slide(&PLAIN_DUPONT, 6.9e-6, 1.0, 0.0).0, 0.69, 1e-14); // elastic up to 0.7
    close(slide(&PLAIN_DUPONT, -1.0e-6, 1.0, 0.9e-5).0, 0.8, 1e-14); // unloads elastically from beyond
}

#[test]
fn first_loading_converges_with_first_order_to_the_exponential() {
    let end = |steps: u32| (0..steps).fold(0.0, |z, _| slide(&PLAIN, 2e-5 / f64::from(steps), 0.1, z).1) * 1e5;
    let error = |steps| (end(steps) - (1.0 - (-2.0f64).exp())).abs();
    for steps in [64, 128, 256] {
        close(error(steps) / error(2 * steps), 2.0, 0.02);
    }
}

/// Slip over one cycle of the load `low -> high -> low` after a first loading, in `steps` steps each way.
fn drift(law: &dyn FrictionLaw, [low, high]: [f64; 2], steps: u32) -> f64 {
    let (mut z, mut total) = (0.0, 0.0);
    let mut towards = |from: f64, to: f64| {
        for k in 1..=steps {
            let load = from + (to - from) * f64::from(k) / f64::from(steps);
            let (mut left, mut right) = (-1e-4, 1e-4);
            for _ in 0..100 {
                let middle: f64 = 0.5 * (left + right);
                if slide(law, middle, 1.0, z).0 < load { left = middle } else { right = middle }
            }
            z = slide(law, left, 1.0, z).1;
            total += left;
        }
        total
    };
    let before = towards(0.0, low);
    towards(low, high);
    towards(high, low) - before
}

#[test]
fn lugre_drifts_under_a_load_below_break_away_as_its_equation_says() {
    let load: [f64; 2] = [0.1, 0.5];
    let exact = 1e-5 * ((1.0 - load[0] * load[0]) / (1.0 - load[1] * load[1])).ln();
    let error = |steps| drift(&PLAIN, load, steps) / exact - 1.0;
    assert!(error(1600).abs() < 2e-3, "{}", error(1600));
    close(error(400) / error(800), 2.0, 0.05);
}

#[test]
fn elasto_plastic_does_not_drift_under_the_same_load() {
    let cycle = drift(&PLAIN_DUPONT, [0.1, 0.5], 400);
    assert!(cycle.abs() < 1e-12 * 1e-5, "{cycle}");
    assert!(drift(&PLAIN_DUPONT, [0.1, 0.9], 400) > 1e-8); // beyond the elastic range it does
}

#[test]
fn constant_damping_can_create_energy_and_passive_damping_cannot() {
    let work = |law: &dyn FrictionLaw| {
        let (mut z, mut work) = (0.0, 0.0);
        for (slip, dt) in std::iter::repeat_n((1e-6, 1.0), 30).chain([(1e-6, 1e-7)]) {
            let (q, end) = slide(law, slip, dt, z);
            (z, work) = (end, work + q * slip);
        }
        work
    };
    let constant = LuGre { damping_form: Damping::Constant, viscosity: 0.0, ..LUGRE };
    assert!(work(&constant) < -1e-4, "{}", work(&constant));
    assert!(work(&LuGre { viscosity: 0.0, ..LUGRE }) > 0.0 && work(&ElastoPlastic { viscosity: 0.0, ..DUPONT }) > 0.0);
}

#[test]
fn tends_to_coulomb_with_the_stiffness() {
    for stiffness in [1e3, 1e4, 1e5] {
        for law in [&LuGre { stiffness, ..PLAIN } as &dyn FrictionLaw, &ElastoPlastic { stiffness, ..PLAIN_DUPONT }] {
            let missing = 1.0 - slide(law, 1.0, 1.0, 0.0).0;
            assert!((0.0..=1.0 / stiffness).contains(&missing), "{missing}");
        }
    }
}

#[test]
fn zero_friction_carries_nothing_and_an_open_contact_forgets() {
    let zero = LuGre { rest: 0.0, kinetic: 0.0, viscosity: 0.0, ..LUGRE };
    let zero_dupont = ElastoPlastic { rest: 0.0, kinetic: 0.0, viscosity: 0.0, ..DUPONT };
    for law in [&zero as &dyn FrictionLaw, &zero_dupont] {
        assert_eq!(slide(law, 1e3, 1e-3, 0.0), (0.0, 0.0));
        let mut new = [f64::NAN];
        law.open(&InterfacePoint::new(0.0, 0.0, 1.0), &[1.0], &mut new);
        assert_eq!(new, [0.0]);
    }
}
