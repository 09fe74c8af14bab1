//! The ladder: what is tried where Newton's method fails, what is written down of it, and the words where nothing helps.

mod support;

use std::sync::atomic::AtomicBool;

use asperity::contact::Sites;
use asperity::math::CondensedSolver;
use asperity::model::State;
use asperity::solve::{self, Outcome, Rung, Status, Strategy, solve_step};
use support::{Pass, done, pass};

fn flanks(degrees: f64) -> Pass {
    let height = 1.6 * degrees.to_radians().tan() / std::f64::consts::PI;
    Pass { height, overlap: 0.5 * height, ..Pass::default() }
}

fn reached(outcome: &Outcome, rung: Rung) -> usize {
    outcome.log.events.iter().filter(|event| event.reached == Some(rung)).count()
}

/// Without cuts the pass ends where the path does.
#[test]
fn the_end_is_told_in_words() {
    let setup = Pass { friction: 0.1, ..flanks(60.0) };
    let control = solve::Control { end: 1.0, steps: 76, max_cuts: 0, strategy: Strategy::default() };
    let (model, quiet) = (pass(&setup), AtomicBool::new(false));
    let mut rows = 0;
    let outcome =
        solve::march(&model, State::initial(&model), &control, &mut CondensedSolver::default(), &quiet, |_| {
            rows += 1;
            Ok::<(), std::convert::Infallible>(())
        });
    let Outcome { status: Status::NotConverged { time, reason }, log, state, .. } = outcome.unwrap() else {
        panic!("the path has an end")
    };
    println!("{reason}");
    assert!(time == state.time && rows > 10);
    let parts = [
        "Newton's method did not converge in ",
        "contact sites, from (",
        "law: coulomb)",
        "tried since the last step: Newton's method (1), other first guesses (",
        "inner loop on the interface (",
        "to change: ",
        "time.max_cuts",
    ];
    parts.iter().for_each(|part| assert!(reason.contains(part), "`{part}` is missing: {reason}"));
    let last = log.events.last().expect("an event");
    assert_eq!((last.time, last.reached), (time, None));
    let rungs: Vec<Rung> = last.tried.iter().map(|tried| tried.rung).collect();
    assert_eq!(rungs, [Rung::Newton, Rung::Guess, Rung::Interface]);
    assert!(last.tried.iter().all(|tried| tried.attempts > 0 && !tried.reason.is_empty()));
}

/// Each rung reaches steps that those before it do not.
#[test]
fn every_rung_is_needed() {
    let nodal = Pass { sites: Some(Sites::Nodal), ..Pass::default() };
    let cases = [
        ("soft", Pass { r: 1e-3, ..nodal.clone() }),
        ("hard", Pass { r: 1e3, ..nodal.clone() }),
        ("mu = 1", Pass { friction: 1.0, ..nodal }),
        ("50 degrees, mu = 1", Pass { friction: 1.0, ..flanks(50.0) }),
    ];
    let mut counts = [0; Rung::ALL.len()];
    let mut cycles = 0;
    for (name, setup) in cases {
        let outcome = done(&setup).outcome;
        let here = Rung::ALL.map(|rung| reached(&outcome, rung));
        println!("{name}: {here:?}, {} iterations", outcome.iterations);
        counts.iter_mut().zip(here).for_each(|(sum, n)| *sum += n);
        let reasons = outcome.log.events.iter().flat_map(|event| &event.tried).map(|tried| &tried.reason);
        cycles += reasons.filter(|reason| reason.contains("contact states repeat every")).count();
        if name == "hard" {
            assert_eq!((outcome.cuts, outcome.snaps), (0, 0), "the augmentation E/h solves every step");
        }
    }
    for rung in [Rung::Guess, Rung::Interface, Rung::Augmentation, Rung::Cut, Rung::Crossing] {
        let place = Rung::ALL.iter().position(|r| *r == rung).expect("a rung");
        assert!(counts[place] > 0, "{rung:?}: {counts:?}");
    }
    assert!(cycles > 0, "contact states that repeat are seen");
}

/// At nodal sites the solution of a step does not depend on the augmentation at all.
#[test]
fn nodal_solutions_are_the_same_for_every_augmentation() {
    let setup = |r: f64| Pass { sites: Some(Sites::Nodal), from: -0.55, r, ..Pass::default() };
    let solve = |r: f64| {
        let (model, quiet, mut count) = (pass(&setup(r)), AtomicBool::new(false), 0);
        let start = State::initial(&model);
        let mut solver = CondensedSolver::default();
        let found = solve_step(&model, &start, 0.02, Strategy::default(), &mut solver, &quiet, &mut count);
        let found = found.unwrap_or_else(|failure| panic!("r = {r:e}: {failure}"));
        println!("r = {r:e}: {:?}, {count} iterations", found.rung);
        assert!(found.evaluation.interfaces[0].sites.iter().any(|site| site.pressure > 0.0));
        found.state
    };
    let expected = solve(1.0);
    let size = expected.u.iter().fold(0.0_f64, |m, u| m.max(u.amax()));
    for r in [1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3] {
        let found = solve(r);
        let error = found.u.iter().zip(&expected.u).fold(0.0_f64, |m, (a, b)| m.max((a - b).amax()));
        assert!(error < 1e-8 * size, "r = {r:e}: {error:e} of {size:e}");
    }
}

/// Work of friction is a trapezoidal rule over the step: with slips of many elements it would miss a quarter of it.
#[test]
fn coarse_steps_are_cut_to_the_slip_that_friction_work_needs() {
    let [coarse, fine] = [19, 152].map(|steps| done(&Pass { steps, ..Pass::default() }));
    let [few, many] = [&coarse, &fine].map(|run| run.records.last().expect("a step").dissipated);
    println!("dissipated: {few:.4e} in {} steps, {many:.4e} in {}", coarse.outcome.steps, fine.outcome.steps);
    assert!((few / many - 1.0).abs() < 0.08, "{few:e} and {many:e}");
    assert!(coarse.outcome.steps < 40 && fine.outcome.steps == 152);
}
