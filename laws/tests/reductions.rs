//! Laws reduced to Coulomb's, to Tresca's and to none by their parameters: `reductions.toml`, also used with the engine.

use asperity_laws::{
    builtin::{Coulomb, Tresca},
    dual::derivatives,
    *,
};
use toml::{Table, Value};

fn reduced(to: &str) -> Vec<Box<dyn FrictionLaw>> {
    let all: Table = include_str!("reductions.toml").parse().expect("TOML");
    let Some(Value::Array(tables)) = all.get(to) else { panic!("no `{to}`") };
    let table = |value: &Value| value.as_table().expect("a table").clone();
    tables.iter().map(|value| parse(table(value)).unwrap_or_else(|error| panic!("{error}"))).collect()
}

/// Bound and derivatives of a law without states at many points.
fn answers(law: &dyn FrictionLaw) -> Vec<(f64, [f64; 2])> {
    let magnitudes = [0.0, 1e-9, 0.7, 1e9];
    let mut answers = vec![];
    for pressure in magnitudes {
        for slip in magnitudes.into_iter().chain([-0.7]) {
            for dt in [1e-9, 0.1, 1e9] {
                let at = InterfacePoint::new(pressure, slip, dt);
                answers.push(derivatives(&law.response(&at, &[], &mut []).value()));
            }
        }
    }
    answers
}

#[test]
fn coulomb_is_met_exactly() {
    let coulomb = answers(&Coulomb { friction: 0.3 });
    for law in reduced("coulomb") {
        assert_eq!(answers(law.as_ref()), coulomb, "{law:?}");
    }
}

#[test]
fn coulomb_is_met_to_round_off() {
    let coulomb = answers(&Coulomb { friction: 0.3 });
    let same = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * b.abs();
    for law in reduced("nearly_coulomb") {
        for (found, expected) in answers(law.as_ref()).into_iter().zip(&coulomb) {
            let close = same(found.0, expected.0) && (0..2).all(|i| same(found.1[i], expected.1[i]));
            assert!(close, "{found:?} instead of {expected:?}: {law:?}");
        }
    }
}

#[test]
fn tresca_is_met_exactly() {
    let tresca = answers(&Tresca { strength: 0.2 });
    for law in reduced("tresca") {
        assert_eq!(answers(law.as_ref()), tresca, "{law:?}");
    }
}

#[test]
fn zero_strength_is_no_friction() {
    for law in reduced("frictionless") {
        assert!(law.frictionless(), "{law:?}");
        assert!(answers(law.as_ref()).iter().all(|(bound, slopes)| *bound == 0.0 && *slopes == [0.0; 2]), "{law:?}");
    }
}
