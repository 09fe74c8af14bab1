//! What must not change, or must balance (design section 7), on a part of the two-asperity pass.

mod support;

use asperity::bulk::NeoHookean;
use asperity::contact::{Projection, Sites, Tangent};
use asperity::geometry::{Edge, Patch, Point};
use asperity::laws::builtin::Frictionless;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Evaluation, Model, PairSpec, State, evaluate, record};
use asperity::solve::{Control, Status, march, predict};
use proptest::prelude::*;
use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use support::{Pass, Run, all_choices, climb, done, pass, run};

/// Largest difference of the forces of two runs, over the peak.
fn difference(a: &Run, b: &Run) -> f64 {
    let peak = a.peak(0).max(a.peak(1));
    let forces = a.records.iter().zip(&b.records);
    forces.flat_map(|(a, b)| [0, 1].map(|c| (a.force[c] - b.force[c]).abs() / peak)).fold(0.0, f64::max)
}

/// Largest difference of displacements and pressures, over the largest.
fn state_difference(a: &State, b: &State) -> f64 {
    let (mut worst, mut scale) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (a, b) in a.u.iter().zip(&b.u) {
        (worst[0], scale[0]) = (worst[0].max((a - b).amax()), scale[0].max(a.amax()));
    }
    for (a, b) in a.pairs.iter().zip(&b.pairs) {
        for (a, b) in a.pressure.iter().chain(&a.traction).zip(b.pressure.iter().chain(&b.traction)) {
            (worst[1], scale[1]) = (worst[1].max((a - b).abs()), scale[1].max(a.abs()));
        }
    }
    (worst[0] / scale[0]).max(worst[1] / scale[1])
}

/// A state in contact with arbitrary multipliers and a small ripple: not an equilibrium.
fn arbitrary(model: &Model, time: f64, seed: f64) -> (State, State) {
    let start = predict(model, &State::initial(model), time - 0.02);
    let mut trial = predict(model, &start, time);
    for (i, u) in trial.u.iter_mut().enumerate() {
        *u += Point::new((7.3 * i as f64 + seed).sin(), (3.1 * i as f64 + seed).cos())
            * (0.004 * model.element_size / 0.1);
    }
    for pair in &mut trial.pairs {
        pair.pressure.iter_mut().enumerate().for_each(|(i, p)| *p = 0.05 * (1.2 + (1.7 * i as f64 + seed).sin()));
        pair.traction.iter_mut().enumerate().for_each(|(i, q)| *q = 0.03 * (2.9 * i as f64 + seed).sin());
    }
    (start, trial)
}

/// With friction a step that had to be cut is another path, so only marches without a cut are compared.
#[test]
fn nodal_solution_does_not_depend_on_r() {
    for friction in [0.3, 0.0] {
        let setup = Pass { friction, sites: Some(Sites::Nodal), ..climb() };
        let reference = done(&setup);
        let mut compared = vec![];
        for factor in [1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3] {
            let outcome = run(pass(&Pass { r: factor, ..setup.clone() }), setup.steps).outcome;
            let change = state_difference(&reference.outcome.state, &outcome.state);
            println!(
                "nodal, mu = {friction}, r x {factor:.0e}: {:?}, {} iterations (r x 1: {}), {} cuts, change {change:.1e}",
                outcome.status, outcome.iterations, reference.outcome.iterations, outcome.cuts
            );
            if outcome.status == Status::Done && (outcome.cuts == 0 || friction == 0.0) {
                assert!(change < 1e-8, "r x {factor:.0e}: {change:.1e}");
                compared.push(factor);
            }
        }
        assert!(compared.len() >= 4, "{compared:?}");
    }
}

#[test]
fn quadrature_solution_depends_on_r_less_with_refinement() {
    let factors = [0.5, 2.0];
    let changes = [0.2, 0.1, 0.05].map(|element| {
        let setup = Pass { element, to: 0.1, steps: 7, ..climb() };
        let reference = done(&setup);
        factors.map(|r| difference(&reference, &done(&Pass { r, ..setup.clone() })))
    });
    for (k, factor) in factors.into_iter().enumerate() {
        let [a, b, c] = changes.map(|c| c[k]);
        let rate = (a / c).log2() / 2.0;
        println!("quadrature r x {factor}: change of the forces {a:.1e} {b:.1e} {c:.1e} of the peak, rate {rate:.2}");
        assert!(c < 6e-3 && rate > 1.0, "{changes:?}");
    }
}

#[test]
fn units_change_nothing() {
    let reference = done(&climb());
    let iterations = |r: &Run| r.records.iter().map(|r| r.newton_iterations).collect::<Vec<_>>();
    for (length, stress) in [(1e-9, 1.0), (1e9, 1.0), (1.0, 1e-9), (1.0, 1e9), (1e-9, 1e9), (1e9, 1e-9), (3e-6, 2e6)] {
        let mut found = done(&Pass { length, stress, ..climb() });
        for record in &mut found.records {
            record.force = record.force.map(|f| f / (length * stress));
        }
        let change = difference(&reference, &found);
        println!(
            "length x {length:.0e}, stress x {stress:.0e}: change {change:.1e}, iterations {:?}",
            iterations(&found)
        );
        assert_eq!(iterations(&reference), iterations(&found), "length x {length:e}, stress x {stress:e}");
        assert!(change < 1e-9, "{change:.1e}");
    }
}

#[test]
fn mirrored_problem_gives_mirrored_forces() {
    for friction in [0.0, 0.3] {
        let setup = Pass { friction, to: 0.1, steps: 14, ..climb() };
        let (forward, mut backward) = (done(&setup), done(&Pass { from: -setup.from, to: -setup.to, ..setup }));
        backward.records.iter_mut().for_each(|r| r.force[0] *= -1.0);
        let change = difference(&forward, &backward);
        println!("mirrored, mu = {friction}: {change:.1e}");
        assert!(change < 1e-8, "{change:.1e}");
    }
}
#[test]
fn repetition_and_restart_are_bitwise_equal() {
    let (first, second) = (done(&climb()), done(&climb()));
    assert_eq!(first.states, second.states, "the same march twice");
    let half = serde_json::to_string(&first.states[3]).expect("serialises");
    let state: State = serde_json::from_str(&half).expect("deserialises");
    assert_eq!(state, first.states[3], "round trip");
    let control = Control { end: 1.0, steps: climb().steps, max_cuts: 8, strategy: Default::default() };
    let mut states = vec![];
    let outcome =
        march(&first.model, state, &control, &mut CondensedSolver::default(), &AtomicBool::new(false), |report| {
            states.push(report.state.clone());
            Ok::<(), Infallible>(())
        });
    assert_eq!(outcome.expect("no error").status, Status::Done);
    assert_eq!(states, first.states[4..], "restart in the middle");
}

#[test]
fn coulomb_at_zero_strength_is_frictionless() {
    let frictionless = done(&Pass { law: Some(Arc::new(Frictionless {})), ..climb() });
    let zero = done(&Pass { friction: 0.0, ..climb() });
    let tiny = done(&Pass { friction: 1e-12, ..climb() });
    let changes = [difference(&frictionless, &zero), difference(&frictionless, &tiny)];
    println!("Coulomb against frictionless: mu = 0 {:.1e}, mu = 1e-12 {:.1e}", changes[0], changes[1]);
    assert!(changes[0] == 0.0 && changes[1] < 1e-8, "{changes:?}");
}

/// Rotates a configuration about the origin.
fn rotated(model: &Model, state: &State, angle: f64) -> State {
    let mut out = state.clone();
    for (u, x) in out.u.iter_mut().zip(model.reference()) {
        *u = turn(x + *u, angle) - x;
    }
    out
}

fn turn(v: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    Point::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// Largest deviation from objectivity of nodal forces and sites.
fn objectivity(still: &Evaluation, turned: &Evaluation, angle: f64) -> f64 {
    let forces = still.forces.iter().zip(&turned.forces).map(|(a, b)| (turn(*a, angle) - b).amax() / still.force_scale);
    let sites = still.interfaces[0].sites.iter().zip(&turned.interfaces[0].sites).map(|(a, b)| {
        assert_eq!(a.status, b.status);
        let pairs = [(a.pressure, b.pressure), (a.traction, b.traction), (a.gap, b.gap), (a.slip, b.slip)];
        pairs.into_iter().filter(|(a, _)| !a.is_nan()).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    });
    forces.chain(sites).fold(0.0, f64::max)
}

/// Sum of the weights of all sites before contact: the length of the nonmortar edge.
fn edge_length(lower: &Patch, upper: &Patch) -> f64 {
    let material = Arc::new(NeoHookean { youngs_modulus: 1.0, poissons_ratio: 0.3 });
    let body = |patch: &Patch| BodySpec::Deformable(patch.clone(), material.clone());
    let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), Arc::new(Frictionless {}));
    (pair.sites, pair.points) = (Some(Sites::Nodal), Some(12));
    let mut builder = Builder::default();
    builder.body("lower", body(lower)).and_then(|b| b.body("upper", body(upper))).expect("bodies").contact(pair);
    let model = builder.build().expect("a valid model");
    let state = State::initial(&model);
    let evaluation = evaluate(&model, &state, &state, Tangent::None).expect("admissible");
    evaluation.interfaces[0].sites.iter().map(|s| s.weight).sum()
}

fn choices() -> impl Strategy<Value = (Sites, Projection)> {
    prop::sample::select(all_choices())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn superposed_rotation_rotates_forces_and_nothing_else(
        angle in prop_oneof![Just(90.0), Just(37.0), Just(180.0), -180.0..180.0f64],
        before in prop_oneof![Just(0.0), Just(1.0), -1.0..1.0f64],
        (sites, projection) in choices(),
        seed in 0.0..6.0f64,
    ) {
        let model = pass(&Pass { sites: Some(sites), projection: Some(projection), ..climb() });
        let (start, trial) = arbitrary(&model, 0.9, seed);
        let angle = f64::to_radians(angle);
        let still = evaluate(&model, &start, &trial, Tangent::None).expect("admissible");
        let (start, trial) = (rotated(&model, &start, before * angle), rotated(&model, &trial, angle));
        let turned = evaluate(&model, &start, &trial, Tangent::None).expect("admissible");
        let worst = objectivity(&still, &turned, angle);
        prop_assert!(worst < 1e-12, "{worst:e} at {angle} rad, start at {} rad", before * angle);
    }

    #[test]
    fn interface_momentum_balances_at_any_state(
        time in 0.3..1.0f64, seed in 0.0..6.0f64, (sites, projection) in choices(), r in -3.0..3.0f64,
    ) {
        let setup = Pass { sites: Some(sites), projection: Some(projection), r: 10f64.powf(r), to: 0.2, ..climb() };
        let model = pass(&setup);
        let (start, trial) = arbitrary(&model, time, seed);
        let evaluation = evaluate(&model, &start, &trial, Tangent::None).expect("admissible");
        let found = record(&model, &trial, &evaluation);
        prop_assert!(found.contact_length > 0.0);
        prop_assert!(found.force_imbalance <= 1e-13 && found.moment_imbalance <= 1e-13, "{found:?}");
    }

    #[test]
    fn knot_insertion_changes_neither_geometry_nor_weights(
        cut in 0.01..0.99f64, direction in 0usize..2, degree in 1usize..4, at in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let model = pass(&Pass { degree, ..climb() });
        let [lower, upper] = [0, 1].map(|k| model.bodies[k].patch().expect("deformable"));
        let parameter = |d: usize, share: f64| {
            let breaks = upper.basis[d].breaks();
            breaks[0] + share * (breaks[breaks.len() - 1] - breaks[0])
        };
        let refined = upper.insert_knot(direction, parameter(direction, cut)).expect("a new knot");
        prop_assert_eq!(refined.points.len() - upper.points.len(), upper.basis[1 - direction].len());
        let uv = [parameter(0, at.0), parameter(1, at.1)];
        let place = |patch: &Patch| patch.map(patch.element_of(uv), uv);
        let ((x, [du, dv]), (y, [eu, ev])) = (place(upper), place(&refined));
        prop_assert!((x - y).amax() < 1e-13 && (du - eu).amax() < 1e-11 && (dv - ev).amax() < 1e-11, "{x} {y}");
        let (before, after) = (edge_length(lower, upper), edge_length(lower, &refined));
        prop_assert!((before - after).abs() < 1e-11, "{before} {after}");
    }
}
