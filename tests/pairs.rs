//! Several contact pairs in one scene, bodies that start inside one another, and steps too long for the bodies.

use std::convert::Infallible;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use asperity::math::CondensedSolver;
use asperity::model::{Record, State, interface_rows};
use asperity::scene::{Scene, build};
use asperity::solve::{Control, Status, march};

/// Three blocks on one another, two contact pairs, non-matching, Poisson's ratio 0: a uniform uniaxial state.
const STACK: &str = r#"
version = 1
[material.soft]
type = "linear-elastic"
youngs_modulus = 2.0
poissons_ratio = 0.0
[body.low]
shape = { type = "block", x = [0.0, 1.0], y = [0.0, 1.0] }
material = "soft"
elements = [4, 2]
[body.middle]
shape = { type = "block", x = [0.0, 1.0], y = [0.0, 1.0] }
material = "soft"
elements = [7, 3]
position = [0.0, 1.0]
[body.top]
shape = { type = "block", x = [0.0, 1.0], y = [0.0, 1.0] }
material = "soft"
elements = [5, 2]
position = [0.0, 2.0]
[[support]]
body = "low"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "top"
edge = "top"
x = { displacement = 0.0 }
y = { displacement = { time = [0.0, 1.0], value = [0.0, -0.03] } }
[[contact]]
nonmortar = { body = "middle", edge = "bottom" }
mortar = { body = "low", edge = "top" }
law = { type = "coulomb", friction = 0.5 }
numerics = { integration = "segment" }
[[contact]]
nonmortar = { body = "top", edge = "bottom" }
mortar = { body = "middle", edge = "top" }
law = { type = "coulomb", friction = 0.5 }
numerics = { integration = "segment" }
[time]
end = 1.0
steps = 2
"#;

fn scene(text: &str, sets: &[&str]) -> Scene {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    Scene::parse(Path::new("pairs.toml"), text.to_string(), &sets).expect("a valid scene").0
}

#[test]
fn two_pairs_carry_the_same_uniform_pressure() {
    let model = build(&scene(STACK, &[]), Path::new(".")).expect("a model");
    let mut rows = vec![];
    let control = Control { end: 1.0, steps: 2, max_cuts: 2, strategy: Default::default() };
    let quiet = AtomicBool::new(false);
    let outcome = march(&model, State::initial(&model), &control, &mut CondensedSolver::default(), &quiet, |report| {
        rows = interface_rows(&model, report.evaluation, report.record.step);
        Ok::<(), Infallible>(())
    });
    assert_eq!(outcome.unwrap_or_else(|e| match e {}).status, Status::Done);
    // three springs in a row: p = E * shortening / height
    let expected = 2.0 * 0.03 / 3.0;
    assert!(rows.iter().any(|r| r.pair == 0) && rows.iter().any(|r| r.pair == 1));
    for row in rows {
        assert!((row.pressure - expected).abs() < 1e-9, "pair {}: {} {expected}", row.pair, row.pressure);
    }
}

#[test]
fn bodies_deep_inside_one_another_are_refused() {
    let error =
        build(&scene(STACK, &["body.middle.position=[0.0, 0.4]", "body.top.position=[0.0, 1.4]"]), Path::new("."));
    let said = error.expect_err("refused").to_string();
    assert!(said.contains("`middle` starts 6.000e-1 deep inside `low`"), "{said}");
    assert!(said.contains("below 2.500e-1"), "{said}");
}

/// One nominal step that would carry a body through its counterpart is divided: contact is met on the way.
#[test]
fn a_step_through_a_body_meets_it() {
    let drag = "drive.0.y={ displacement = { time = [0.0, 1.0], value = [0.0, -4.0] } }";
    let model = build(&scene(STACK, &[drag, "body.top.position=[0.0, 2.05]"]), Path::new(".")).expect("a model");
    let mut records: Vec<Record> = vec![];
    let control = Control { end: 1.0, steps: 1, max_cuts: 3, strategy: Default::default() };
    let quiet = AtomicBool::new(false);
    let outcome = march(&model, State::initial(&model), &control, &mut CondensedSolver::default(), &quiet, |report| {
        records.push(report.record);
        Ok::<(), Infallible>(())
    });
    let outcome = outcome.unwrap_or_else(|e| match e {});
    // It either is crushed or, linear as it is, ends in contact; never free on the other side.
    let pressed = outcome.state.pairs.iter().any(|pair| pair.pressure.iter().any(|p| *p > 0.0));
    assert!(pressed, "{:?} {records:?}", outcome.status);
}
