//! Where nothing rubs a march recalls states that were there before, or their mirror images: what comes out is the same as
//! when every step is solved, and it costs less.

mod support;

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;

use asperity::math::CondensedSolver;
use asperity::model::{Control as Motion, Mirror, Model, Record, State, Table};
use asperity::solve::{self, Control, Outcome, Recall, Tools, Ways, proceed};
use support::{Pass, pass, run};

/// A march over `[0, 1]` that recalls.
fn recalling(model: &Model, steps: usize) -> (Vec<Record>, Outcome) {
    let control = Control { end: 1.0, steps, max_cuts: 8, strategy: solve::Strategy::default() };
    let ways = Ways::new(model, &control);
    let mut witness = Recall::new(&ways, (), vec![]);
    let tools = Tools { solver: &mut CondensedSolver::default(), witness: &mut witness };
    let (mut records, quiet) = (vec![], AtomicBool::new(false));
    let outcome = proceed(model, Outcome::at(State::initial(model)), &control, tools, &quiet, |report| {
        records.push(report.record);
        Ok::<(), Infallible>(())
    });
    (records, outcome.unwrap_or_else(|e| match e {}))
}

/// Largest difference of forces and energies, each over its peak.
fn difference(a: &[Record], b: &[Record]) -> f64 {
    assert_eq!(a.len(), b.len());
    let values = |r: &Record| [r.force[0], r.force[1], r.strain_energy, r.external_work, r.snap_loss];
    let peak = |k: usize| a.iter().fold(1e-300, |m: f64, r| m.max(values(r)[k].abs()));
    let worst = |k: usize| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((values(a)[k] - values(b)[k]).abs()));
    (0..5).map(|k| worst(k) / peak(k)).fold(0.0, f64::max)
}

#[test]
fn the_way_down_from_an_asperity_is_the_way_up() {
    // an even and an odd number of steps: with and without one at the apex
    for steps in [76, 75] {
        let setup = Pass { friction: 0.0, steps, ..Pass::default() };
        let solved = run(pass(&setup), steps);
        let (records, outcome) = recalling(&solved.model, steps);
        let error = difference(&solved.records, &records);
        let (all, left) = (solved.outcome.iterations, outcome.iterations);
        println!("{steps} steps: {} recalled, {left} of {all} iterations, difference {error:.1e}", outcome.recalled);
        assert!(outcome.recalled >= steps / 2 - 2 && error < 1e-8);
        assert!(left as f64 <= 0.6 * all as f64, "{left} of {all} iterations");
    }
}

/// Behind a snap a soft asperity stands otherwise than before it at the mirrored place: the path has to be followed.
#[test]
fn a_path_that_snaps_is_followed() {
    let height = 1.6 * 60.0_f64.to_radians().tan() / std::f64::consts::PI;
    let setup = Pass { friction: 0.0, height, overlap: 0.5 * height, ..Pass::default() };
    let solved = run(pass(&setup), setup.steps);
    let (records, outcome) = recalling(&solved.model, setup.steps);
    assert!(solved.outcome.snaps > 0 && outcome.snaps == solved.outcome.snaps);
    let error = difference(&solved.records, &records);
    assert!(error < 1e-8, "{error:.1e}");
    let asymmetric = records[37].force[0].abs() / solved.peak(0);
    assert!(asymmetric > 0.1, "at the apex it leans: {asymmetric:.2}");
}

/// Pressed and let go at another speed of the table, off centre: nothing is symmetric, but it goes back the way it came.
#[test]
fn unloading_is_loading_backwards() {
    let mut model = pass(&Pass { friction: 0.0, from: -0.3, to: 0.1, overlap: 0.0, ..Pass::default() });
    let steps = 12;
    for motion in model.motions.iter_mut().filter(|m| m.drive) {
        let value = if motion.component == 0 { vec![0.0; 3] } else { vec![0.0, -0.2, 0.0] };
        motion.control = Motion::Displacement(Table { time: vec![0.0, 0.5, 1.0], value });
    }
    let solved = run(model, steps);
    let (records, outcome) = recalling(&solved.model, steps);
    assert!(difference(&solved.records, &records) < 1e-8);
    assert!(outcome.recalled >= 5, "{} recalled", outcome.recalled);
    assert!(records[6..11].iter().all(|r| r.newton_iterations == 0) && records[5].newton_iterations > 0);
}

/// Friction remembers, so nothing is recalled.
#[test]
fn with_friction_every_step_is_solved() {
    let model = pass(&Pass { steps: 19, ..Pass::default() });
    let control = Control { end: 1.0, steps: 19, max_cuts: 8, strategy: solve::Strategy::default() };
    assert!(!Ways::new(&model, &control).any());
    assert_eq!(recalling(&model, 19).1.recalled, 0);
}

#[test]
fn mirror_images_are_in_equilibrium_and_a_lopsided_model_has_none() {
    let model = pass(&Pass { friction: 0.0, steps: 38, ..Pass::default() });
    let mirror = Mirror::of(&model).expect("both bodies are symmetric");
    // the lower body is held: the axis is its own; the drives of 0.3 are mirrored at 0.7
    assert!(mirror.axis.abs() < 1e-12);
    assert!(mirror.agrees(&model, 0.3, 0.7) && !mirror.agrees(&model, 0.3, 0.6));
    let state = State::initial(&model);
    let twice = mirror.image(&model, &mirror.image(&model, &state));
    assert!(twice.u.iter().zip(&state.u).all(|(a, b)| (a - b).amax() < 1e-14));
    let mut lopsided = model;
    lopsided.bodies[0].points[3].x += 1e-6;
    assert!(Mirror::of(&lopsided).is_none());
}
