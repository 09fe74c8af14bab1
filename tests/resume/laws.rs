//! Every law goes on bit for bit from a checkpoint in the middle of a step of contact.

#[path = "../support/mod.rs"]
mod support;

use asperity::laws::{FrictionLaw, LawInfo, Range, linked, parse};
use asperity::math::{CondensedSolver, LinearSolver, SolverMemory, SparseLu};
use asperity::model::{Matter, Model, State};
use asperity::output::checkpoint::{decode, encode};
use asperity::scene::{Scene, build};
use asperity::solve::{Control, Outcome, Status, Tools, proceed};
use std::convert::Infallible;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use support::{Pass, climb, pass};

/// A law with a value inside of every range.
fn law(info: &LawInfo) -> Arc<dyn FrictionLaw> {
    let mut table = toml::Table::from_iter([("type".to_string(), info.name.into())]);
    for parameter in info.parameters.iter().filter(|parameter| parameter.default.is_none()) {
        let value: toml::Value = match parameter.range {
            Range::Number => 0.3.into(),
            Range::AtLeast(low) | Range::Above(low) => (low + 0.3).into(),
            Range::Between(low, high) => (low + 0.3 * (high - low)).into(),
            Range::Choice(words) => words[0].into(),
            Range::Text(_) | Range::Other(_) => unreachable!("{} has a default", parameter.name),
        };
        table.insert(parameter.name.into(), value);
    }
    // conditions of several parameters
    for (law, key, value) in [
        ("huemer", "n", 1.3),
        ("persson", "floor_speed", 0.01),
        ("pressure-power", "exponent", 1.3),
        ("savkoor", "floor_speed", 0.01),
    ] {
        if law == info.name {
            table.insert(key.into(), value.into());
        }
    }
    if info.name == "expression" {
        table.insert("threshold".into(), "(0.2 + 0.2*exp(-z))*p".into());
        table.insert("states".into(), toml::toml! { z = { rate = "abs(v)/0.5" } }.into());
    }
    Arc::from(parse(table.clone()).unwrap_or_else(|error| panic!("{table}: {error}")))
}

type Stop = (Outcome, SolverMemory);

/// Marches from a checkpoint; what stands at the end of every step.
fn march(model: &Model, solver: &mut dyn LinearSolver, from: Stop) -> Vec<Stop> {
    let (mut stops, quiet) = (vec![], AtomicBool::new(false));
    let control = Control { end: 1.0, steps: 12, max_cuts: 12, strategy: Default::default() };
    solver.recall(from.1);
    let outcome = proceed(model, from.0, &control, Tools { solver, witness: &mut () }, &quiet, |report| {
        stops.push((report.outcome.clone(), report.solver.memory()));
        Ok::<(), Infallible>(())
    });
    let Ok(outcome) = outcome;
    assert_eq!(outcome.status, Status::Done);
    stops
}

/// All stops after a checkpoint are those of the march in one go.
fn goes_on(name: &str, model: &Model, solver: fn() -> Box<dyn LinearSolver>) {
    let start = (Outcome::at(State::initial(model)), SolverMemory::default());
    let whole = march(model, solver().as_mut(), start);
    let touching = |stop: &Stop| stop.0.state.pairs[0].sites.iter().any(|site| site.closure > 0.0);
    assert!(whole.iter().filter(|stop| touching(stop)).count() > 3, "{name} touches");
    for k in [0, 3, whole.len() - 2] {
        let stop: Stop = decode(&encode(&whole[k])).expect("a checkpoint");
        assert!(stop == whole[k], "{name}: round trip of stop {k}");
        assert!(march(model, solver().as_mut(), stop) == whole[k + 1..], "{name}: from stop {k}");
    }
}

#[test]
fn every_law_goes_on_bit_for_bit() {
    let laws = linked();
    assert!(laws.len() >= 22, "{}", laws.len());
    for info in laws {
        let setup = Pass { law: Some(law(info)), ..climb() };
        goes_on(info.name, &pass(&setup), || Box::new(CondensedSolver::default()));
    }
}

#[test]
fn the_other_solver_goes_on_too() {
    goes_on("sparse LU", &pass(&climb()), || Box::new(SparseLu::default()));
}

/// Velocities, accelerations and the forces of inertia and viscosity are part of a checkpoint.
#[test]
fn moving_bodies_go_on_too() {
    let matter = |_: &asperity::model::Body| Matter { density: 0.01, velocity: [0.1, 0.0] };
    let model = pass(&climb()).with_inertia(0.8, matter).with_viscosity(0.05);
    goes_on("inertia and viscosity", &model, || Box::new(CondensedSolver::default()));
}

/// On thin bodies the solver keeps only what touches out of the interior, and chooses anew as the contact moves: the choice shows in
/// the round-off, so it must be recalled.
#[test]
fn the_choice_of_the_solver_is_part_of_a_checkpoint() {
    let thin = super::SCENE.replace("[24, 4]", "[72, 1]").replace("[13, 4]", "[39, 1]");
    let (scene, _) = Scene::parse(Path::new("thin.toml"), thin, &[]).expect("a scene");
    let model = build(&scene, Path::new(".")).expect("a model");
    let start = (Outcome::at(State::initial(&model)), SolverMemory::default());
    let whole = march(&model, &mut CondensedSolver::default(), start);
    let analyses = |stop: &Stop| stop.1.counters.analyses;
    println!("analyses {:?}", whole.iter().map(analyses).collect::<Vec<_>>());
    let k = (1..whole.len() - 2).find(|k| analyses(&whole[*k]) > 2 && analyses(&whole[*k]) == analyses(&whole[k + 1]));
    let k = k.expect("a choice that lasts over a step");
    assert!(march(&model, &mut CondensedSolver::default(), whole[k].clone()) == whole[k + 1..]);
    let forgetful = (whole[k].0.clone(), SolverMemory::default());
    let other = march(&model, &mut CondensedSolver::default(), forgetful);
    println!("without it the states differ: {}", other[0].0.state != whole[k + 1].0.state);
}
