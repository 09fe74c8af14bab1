//! The conformance kit passes honest laws of outside crates and catches planted faults, each under its own name.

use asperity_laws::dual::{abs, chain, constant};
use asperity_laws::*;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU64, Ordering};

/// Record of a test law with one parameter `a`.
const fn info(name: &'static str, kind: Kind, unit: Unit) -> LawInfo {
    const A: [Parameter; 5] = [
        Parameter::new("a", Unit::ONE, Range::Number, "a number"),
        Parameter::new("a", Unit::STRESS, Range::Number, "a stress"),
        Parameter::new("a", Unit::LENGTH, Range::Above(0.0), "a length"),
        Parameter::new("a", Unit::VELOCITY, Range::Above(0.0), "a speed"),
        Parameter::new("a", Unit::TIME, Range::Above(0.0), "a time"),
    ];
    let index = if unit.stress == 1 {
        1
    } else if unit.length == 1 && unit.time == 0 {
        2
    } else if unit.time == -1 {
        3
    } else {
        4 * unit.time as usize
    };
    LawInfo { name, kind, equation: "test", parameters: A.split_at(index).1.split_at(1).0, reference: "test" }
}

/// Declares a test law with one parameter; the closure is its response.
macro_rules! law {
    ($type:ident, $name:literal, $kind:ident, $unit:expr, [$($state:expr),*], $response:expr) => {
        #[derive(Debug, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct $type { a: f64 }
        #[typetag::serde(name = $name)]
        impl FrictionLaw for $type {
            fn variables(&self) -> Vec<Variable> { vec![$($state),*] }
            fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
                let response: fn(f64, &InterfacePoint, &[f64], &mut [Dual]) -> Dual = $response;
                Response::$kind(response(self.a, at, old, new))
            }
        }
        inventory::submit! { info($name, law!(@ $kind), $unit) }
    };
    (@ Threshold) => { Kind::SetValued };
    (@ Traction) => { Kind::Direct };
}

fn state(unit: Unit) -> Variable {
    Variable::new("z", unit, 0.0)
}

fn caught(law: &dyn FrictionLaw, property: &str) {
    let violation = conforms(law).expect_err("a planted fault");
    assert_eq!(violation.property, property, "{violation}");
}

// Honest laws.

law!(Dahl, "test-dahl", Traction, Unit::LENGTH, [state(Unit::LENGTH)], |a, at, old, new| {
    let [z] = evolve(at.dt, old, new, |[z]| [at.velocity() - at.speed() * z / a]);
    at.pressure * z * (0.5 / a)
});
law!(Ageing, "test-ageing", Threshold, Unit::TIME, [state(Unit::TIME)], |a, at, old, new| {
    let [age] = evolve(at.dt, old, new, |[age]| [constant(1.0) - age / a]);
    at.pressure * (age / a).tanh()
});
law!(Smooth, "test-smooth", Traction, Unit::VELOCITY, [], |a, at, _, _| at.pressure * dual::tanh(at.velocity() / a));

#[test]
fn honest_laws_pass_at_any_scale() {
    for a in [1e-6, 1.0, 1e6] {
        for law in [&Dahl { a } as &dyn FrictionLaw, &Ageing { a }, &Smooth { a }] {
            conforms(law).unwrap();
        }
    }
}

// Faults.

law!(WrongSlope, "test-wrong-slope", Threshold, Unit::ONE, [], |a, at, _, _| chain(
    at.pressure,
    0.3 * at.pressure.re,
    0.303 * a
));
law!(WrongMemory, "test-wrong-memory", Traction, Unit::LENGTH, [state(Unit::LENGTH)], |a, at, old, new| {
    new[0] = (at.slip + old[0]) / (abs(at.slip) / a + 1.0).re; // derivative of the denominator forgotten
    at.pressure * new[0] / a
});
law!(Negative, "test-negative", Threshold, Unit::STRESS, [], |a, _, _, _| constant(a));
law!(Unwritten, "test-unwritten", Threshold, Unit::ONE, [state(Unit::ONE)], |a, at, _, _| at.pressure * a);
law!(Singular, "test-singular", Threshold, Unit::STRESS, [], |a, at, _, _| (at.pressure / a).sqrt() * a);
law!(Leaning, "test-leaning", Threshold, Unit::LENGTH, [], |a, at, _, _| at.pressure * (dual::tanh(at.slip / a) + 2.0));
law!(Jumping, "test-jumping", Traction, Unit::ONE, [], |a, at, _, _| at.pressure * a * at.slip.re.signum());
law!(Driving, "test-driving", Traction, Unit::VELOCITY, [], |a, at, _, _| -at.pressure * dual::tanh(at.velocity() / a));
law!(Counting, "test-counting", Threshold, Unit::ONE, [state(Unit::ONE)], |a, at, old, new| {
    new[0] = constant(old[0] + a); // per step instead of per time
    at.pressure * new[0]
});
law!(Dimensional, "test-dimensional", Threshold, Unit::ONE, [], |a, at, _, _| at.pressure * (-at.speed()).exp() * a);
law!(Hidden, "test-hidden", Threshold, Unit::ONE, [], |a, at, _, _| {
    static CALLS: AtomicU64 = AtomicU64::new(0);
    at.pressure * a * (CALLS.fetch_add(1, Ordering::Relaxed) as f64)
});
law!(Misdeclared, "test-misdeclared", Traction, Unit::LENGTH, [], |_, at, _, _| at.pressure * 0.0);

#[test]
fn a_wrong_tangent_is_caught() {
    caught(&WrongSlope { a: 1.0 }, "tangent");
    caught(&WrongMemory { a: 1e-3 }, "tangent");
}

#[test]
fn a_negative_strength_is_caught() {
    caught(&Negative { a: -1.0 }, "finite");
    caught(&builtin::Tresca { strength: -1.0 }, "documentation");
}

#[test]
fn a_state_that_is_not_written_is_caught() {
    caught(&Unwritten { a: 0.3 }, "finite");
}

#[test]
fn hidden_memory_is_caught() {
    caught(&Hidden { a: 0.3 }, "committed");
}

#[test]
fn singularities_and_jumps_are_caught() {
    caught(&Singular { a: 1.0 }, "finite");
    caught(&Jumping { a: 0.3 }, "limits");
}

#[test]
fn wrong_symmetry_and_energy_from_nothing_are_caught() {
    caught(&Leaning { a: 1.0 }, "mirror");
    caught(&Driving { a: 1.0 }, "dissipation");
}

#[test]
fn a_rate_per_step_is_caught() {
    caught(&Counting { a: 0.1 }, "refinement");
}

#[test]
fn a_hidden_unit_is_caught() {
    caught(&Dimensional { a: 0.3 }, "units");
    conforms(&Misdeclared { a: 1.0 }).unwrap();
}

#[test]
fn a_violation_reports_the_simplest_history() {
    let violation = conforms(&Leaning { a: 1.0 }).unwrap_err();
    assert!(violation.sample.unwrap().history.is_empty());
}

/// No record, and one whose parameters are not those of the law.
#[derive(Debug, Serialize, Deserialize)]
struct Undocumented {}
#[typetag::serde(name = "test-undocumented")]
impl FrictionLaw for Undocumented {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Threshold(at.pressure)
    }
}

#[derive(Debug, Serialize, Deserialize)]
struct Renamed {
    b: f64,
}
#[typetag::serde(name = "test-renamed")]
impl FrictionLaw for Renamed {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        Response::Threshold(at.pressure * self.b)
    }
}
inventory::submit! { info("test-renamed", Kind::SetValued, Unit::ONE) }

#[test]
fn missing_and_wrong_records_are_caught() {
    caught(&Undocumented {}, "documentation");
    caught(&Renamed { b: 1.0 }, "documentation");
    assert!(matches!(validate(&Undocumented {}), Err(LawError::UnknownLaw { .. })));
}
