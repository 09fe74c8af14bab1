//! A mass on a spring over a rough surface against its closed forms: stick-slip on a belt, and free vibration until rest.

use asperity_laws::builtin::Stribeck;
use asperity_laws::drive::{History, Record, Slider};
use asperity_laws::*;
use serde::{Deserialize, Serialize};

/// Friction that falls from static to kinetic as soon as anything moves. No law of a mesh: its bound jumps.
#[derive(Debug, Serialize, Deserialize)]
struct Jump {
    rest: f64,
    kinetic: f64,
}

#[typetag::serde(name = "test-jump")]
impl FrictionLaw for Jump {
    fn response(&self, at: &InterfacePoint, _: &[f64], _: &mut [Dual]) -> Response {
        let coefficient = if at.slip.re == 0.0 { self.rest } else { self.kinetic };
        Response::Threshold(at.pressure * coefficient)
    }
}

/// The same with a decay speed.
fn falling(speed: f64) -> Stribeck {
    Stribeck { static_friction: 0.6, kinetic_friction: 0.4, speed, exponent: 1.0, viscous: 0.0 }
}

const JUMP: Jump = Jump { rest: 0.6, kinetic: 0.4 };
/// Durations and extremes of the elongation with `mu_s = 0.6`, `mu_k = 0.4`, belt 0.1, `m = k = N = 1`:
/// slip `pi + 2 atan(v0/Delta)`, stick `2 Delta/v0`, elongation `mu_k -+ sqrt(Delta^2 + v0^2)`, `Delta = 0.2`.
const SLIP: f64 = 4.068_887_871_591_405;
const STICK: f64 = 4.0;
const EXTREMES: [f64; 2] = [0.176_393_202_250_021_02, 0.623_606_797_749_979];

fn belt() -> Slider {
    Slider {
        mass: 1.0,
        stiffness: 1.0,
        velocity: 0.1,
        pressure: 1.0,
        initial_force: 0.0,
        initial_velocity: 0.0,
        states: None,
    }
}

/// Lengths of the phases of stick and slip that are complete: (slipping, duration).
fn phases(history: &History) -> Vec<(bool, f64)> {
    let records = &history.records[1..];
    let ends: Vec<&[Record]> = records.windows(2).filter(|pair| pair[0].slipping != pair[1].slipping).collect();
    ends.windows(2).map(|pair| (pair[1][0].slipping, pair[1][0].time - pair[0][0].time)).collect()
}

/// Errors of slip time, stick time and extremes of the elongation, the first cycle left out.
fn errors(law: &dyn FrictionLaw, steps: usize) -> [f64; 3] {
    let history = belt().run(law, 40.0, steps);
    assert!(history.failure.is_none(), "{:?}", history.failure);
    let phases = phases(&history);
    assert!(phases.len() >= 6, "{phases:?}");
    let worst = |slipping: bool, exact: f64| {
        let of = phases[2..].iter().filter(|phase| phase.0 == slipping);
        of.map(|phase| (phase.1 - exact).abs()).fold(0.0, f64::max)
    };
    let forces = || history.records.iter().filter(|record| record.time > 10.0).map(|record| record.force);
    let (low, high) = (forces().fold(f64::INFINITY, f64::min), forces().fold(f64::NEG_INFINITY, f64::max));
    [worst(true, SLIP), worst(false, STICK), (low - EXTREMES[0]).abs().max((high - EXTREMES[1]).abs())]
}

#[test]
fn the_belt_with_a_jump_is_met_with_second_order() {
    let [coarse, fine] = [400, 1600].map(|steps| errors(&JUMP, steps));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < coarse / 12.0 || fine < 1e-12, "{coarse:e} at 400 steps, {fine:e} at 1600");
    }
    let finest = errors(&JUMP, 200_000);
    assert!(finest.iter().all(|error| *error < 1e-7), "{finest:?}");
}

/// A fast decay is a jump in the limit; the slip begins late by a time of the order `speed ln(1/speed)`.
#[test]
fn the_belt_with_a_decay_speed_tends_to_the_jump() {
    let [slow, fast] = [1e-3, 1e-5].map(|speed| errors(&falling(speed), 400_000));
    for (slow, fast) in slow.into_iter().zip(fast) {
        assert!(fast < slow / 30.0, "{slow:e} at a decay speed of 1e-3, {fast:e} at 1e-5");
    }
}

#[test]
fn a_free_mass_loses_the_same_amplitude_in_each_half_cycle_and_stops() {
    let coulomb = builtin::Coulomb { friction: 0.3 };
    let free = Slider { mass: 2.0, stiffness: 50.0, velocity: 0.0, pressure: 4.0, initial_force: 13.0, ..belt() };
    let history = free.run(&coulomb, 10.0, 1000);
    // Turning points: the record at which the velocity is zero.
    let turns: Vec<&Record> = history.records[1..].iter().filter(|record| record.velocity == 0.0).collect();
    // 13.0 - 2.4 each time, until 1.0 <= 1.2 = mu N.
    for (turn, force) in turns.iter().zip([-10.6, 8.2, -5.8, 3.4, -1.0]) {
        assert!((turn.force - force).abs() < 1e-11, "{} instead of {force}", turn.force);
    }
    let end = history.last();
    assert!(turns[5..].iter().all(|record| !record.slipping && record.force == end.force));
    assert!((turns[5].time - turns[4].time) < 0.02, "at rest for good");
    let energy = |force: f64| 0.5 * force * force / 50.0;
    assert!((energy(13.0) - energy(end.force) - end.work).abs() < 1e-12, "energy lost is work of friction");
}

#[test]
fn steady_pull_without_mass_sticks_then_slips_at_the_bound() {
    let massless = Slider { mass: 0.0, ..belt() };
    let history = massless.run(&builtin::Coulomb { friction: 0.3 }, 10.0, 100);
    for record in &history.records {
        assert!((record.force - f64::min(0.1 * record.time, 0.3)).abs() < 1e-13, "{record:?}");
        assert_eq!(record.slipping, record.time > 3.0 + 1e-9, "{record:?}");
    }
    assert!((history.last().work - 0.3 * 0.7).abs() < 1e-13);
}

/// Step and units are not the driver's business: everything scales.
#[test]
fn scaled_units_scale_the_answer() {
    let (length, stress) = (1e-9, 1e6);
    let small = Slider {
        mass: stress / length,
        stiffness: stress / length,
        velocity: 0.1 * length,
        pressure: stress,
        ..belt()
    };
    let (a, b) = (belt().run(&JUMP, 20.0, 200), small.run(&JUMP, 20.0, 200));
    assert_eq!(a.records.len(), b.records.len());
    for (a, b) in a.records.iter().zip(&b.records) {
        assert!((a.force - b.force / stress).abs() < 1e-9 && (a.slip - b.slip / length).abs() < 1e-9, "{a:?} {b:?}");
    }
}
