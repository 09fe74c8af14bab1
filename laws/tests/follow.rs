//! Laws driven along prescribed paths.

use asperity_laws::builtin::{Coulomb, Evolution, RateAndState};
use asperity_laws::drive::{History, Step, follow};
use asperity_laws::*;
use serde::{Deserialize, Serialize};

fn slide(velocity: f64, duration: f64, steps: usize) -> Vec<Step> {
    let dt = duration / steps as f64;
    vec![Step { dt, pressure: 2.0, slip: velocity * dt }; steps]
}

#[test]
fn coulomb_keeps_its_traction_at_rest_as_far_as_the_bound_allows() {
    let rest = |pressure: f64| Step { dt: 1.0, pressure, slip: 0.0 };
    let path = [Step { dt: 1.0, pressure: 2.0, slip: 0.5 }, rest(3.0), rest(1.0), rest(4.0), rest(0.0)];
    let history = follow(&Coulomb { friction: 0.5 }, None, &path);
    let tractions: Vec<f64> = history.records.iter().map(|record| record.traction).collect();
    assert_eq!(tractions, [0.0, 1.0, 1.0, 0.5, 0.5, 0.0]);
    assert_eq!(history.records.iter().filter(|record| record.slipping).count(), 1);
    assert_eq!(history.last().work, 0.5);
}

#[test]
fn a_velocity_step_of_rate_and_state_is_that_of_its_equations() {
    let law = RateAndState {
        friction: 0.6,
        direct_effect: 0.01,
        evolution_effect: 0.015,
        distance: 1e-5,
        speed: 1e-6,
        evolution: Evolution::Slip,
        initial_age: None,
    };
    let faster = slide(1e-5, 20.0, 20_000);
    let history = follow(&law, None, &[slide(1e-6, 100.0, 100), faster].concat());
    let coefficient = |k: usize| history.records[k].traction / history.records[k].pressure;
    let ratio = 10.0_f64.ln();
    assert!((coefficient(100) - 0.6).abs() < 1e-12);
    // from mu + a ln 10 at once to mu + (a - b) ln 10 with the decay length Dc, exactly
    for k in [101, 500, 1000, 20_100] {
        let travelled = (history.records[k].slip - history.records[100].slip) / 1e-5;
        let exact = 0.6 + (0.01 - 0.015 * (1.0 - (-travelled).exp())) * ratio;
        assert!((coefficient(k) - exact).abs() < 1e-11, "record {k}: {} is not {exact}", coefficient(k));
    }
}

/// Answers only steps shorter than `step`, and asks for even shorter ones after the first half of a unit of time.
#[derive(Debug, Serialize, Deserialize)]
struct Demanding {
    step: f64,
}

#[typetag::serde(name = "test-demanding")]
impl FrictionLaw for Demanding {
    fn variables(&self) -> Vec<Variable> {
        vec![Variable::new("clock", Unit::TIME, 0.0)]
    }

    fn response(&self, at: &InterfacePoint, old: &[f64], new: &mut [Dual]) -> Response {
        new[0] = dual::constant(if at.dt > self.step { f64::NAN } else { old[0] + at.dt });
        Response::Threshold(at.pressure)
    }

    fn suggested_step(&self, _: &InterfacePoint, old: &[f64]) -> Option<f64> {
        (old[0] > 0.5).then_some(0.25 * self.step)
    }
}

#[test]
fn steps_are_cut_where_the_law_asks_or_has_no_answer() {
    let history: History = follow(&Demanding { step: 0.1 }, None, &slide(3.0, 1.0, 1));
    assert!(history.failure.is_none());
    for pair in history.records.windows(2) {
        let (dt, slip) = (pair[1].time - pair[0].time, pair[1].slip - pair[0].slip);
        let largest = if pair[0].states[0] > 0.5 { 0.025 } else { 0.1 };
        assert!(dt <= largest * (1.0 + 1e-8) && (slip - 3.0 * dt).abs() < 1e-12, "{pair:?}");
    }
    let end = history.last();
    assert!(end.time == 1.0 && (end.states[0] - 1.0).abs() < 1e-12 && (end.slip - 3.0).abs() < 1e-12, "{end:?}");
}

#[test]
fn a_law_without_answer_ends_the_history_and_says_where() {
    let history = follow(&Demanding { step: 0.0 }, None, &slide(3.0, 1.0, 1));
    let failure = history.failure.expect("no answer");
    assert!(history.records.len() == 1 && failure.time == 0.0);
    assert!(failure.to_string().contains("the law has no answer at pressure 2e0"), "{failure}");
}
