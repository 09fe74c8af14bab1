//! The error estimate of a run: zero where nothing is wrong, of the right order, and near the true error.

mod support;

use std::convert::Infallible;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{Elements, LinearElastic, NeoHookean, Recovery};
use asperity::geometry::shapes::Block;
use asperity::geometry::{BasisSpec, Patch, Point, ShapeSpec, build};
use asperity::math::CondensedSolver;
use asperity::model::{Model, Record, State};
use asperity::scene::{self, Scene};
use asperity::solve::{self, Status};
use asperity::verify::{Estimate, Estimator};
use support::{Pass, pass};

fn estimated(model: &Model, control: &solve::Control) -> (Vec<Record>, Estimate) {
    let (mut records, mut estimator, quiet) = (vec![], Estimator::new(model), AtomicBool::new(false));
    let solver = &mut CondensedSolver::default();
    let outcome = solve::march(model, State::initial(model), control, solver, &quiet, |report| {
        estimator.take(model, &report.record, report.state, report.evaluation);
        records.push(report.record);
        Ok::<(), Infallible>(())
    });
    assert_eq!(outcome.unwrap_or_else(|e| match e {}).status, Status::Done);
    (records, estimator.estimate())
}

fn over(setup: &Pass) -> (Vec<Record>, Estimate) {
    let control = solve::Control { end: 1.0, steps: setup.steps, max_cuts: 8, strategy: solve::Strategy::default() };
    estimated(&pass(setup), &control)
}

/// A scene of `examples/` with changes.
fn example(name: &str, sets: &[&str]) -> (Model, Estimate) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name).with_extension("toml");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    let (scene, _) = Scene::load(&path, &sets).expect("a scene");
    let model = scene::build(&scene, path.parent().expect("a folder")).expect("a model");
    let found = estimated(&model, &scene::time_plan(&scene)).1;
    (model, found)
}

/// Root mean square of the difference in contact over the peak.
fn difference(run: &[Record], exact: &[Record]) -> f64 {
    let peak = exact.iter().fold(0.0_f64, |m, r| m.max(r.force[0].hypot(r.force[1])));
    let touching = run.iter().zip(exact).filter(|(_, exact)| exact.contact_length > 0.0);
    let squares: Vec<f64> =
        touching.map(|(a, b)| (a.force[0] - b.force[0]).powi(2) + (a.force[1] - b.force[1]).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / peak
}

/// Elements that halve four times the error of the reference or more.
#[test]
fn the_estimate_is_near_the_true_error() {
    let setup = Pass { steps: 38, ..Pass::default() };
    let (exact, _) = over(&Pass { element: 0.04, ..setup.clone() });
    for (name, setup) in [
        ("NURBS 2, h = 0.2", Pass { element: 0.2, ..setup.clone() }),
        ("NURBS 2, h = 0.1", Pass { element: 0.1, ..setup.clone() }),
        ("Lagrange 1, h = 0.1", Pass { element: 0.1, degree: 1, lagrange: true, ..setup }),
    ] {
        let (records, found) = over(&setup);
        let (truth, estimate) = (difference(&records, &exact), found.error.expect("contact"));
        println!("{name}: estimate {estimate:.2e}, true {truth:.2e}, effectivity {:.2}", estimate / truth);
        assert!((0.3..3.0).contains(&(estimate / truth)));
        assert!(found.not_estimated.is_empty() && found.between_steps.expect("contact") > 0.0);
    }
}

#[test]
fn where_the_solution_is_exact_the_estimate_is_zero() {
    let (_, found) = example("patch_test", &[]);
    assert!(found.samples > 0 && found.error.expect("contact") < 1e-12, "{found}");
}

fn block(basis: &BasisSpec, n: usize) -> Patch {
    let flat = Block { x: [0.0, 1.0], y: [0.0, 1.0], top: Default::default(), bottom: Default::default() };
    build(&ShapeSpec::Block(flat), basis, [n, n], None, [0.0, 0.0], Path::new(".")).expect("a block")
}

/// `eta^2` of an interpolated displacement falls as `h^(2p)`.
#[test]
fn the_recovered_energy_has_the_order_of_the_error() {
    let material = LinearElastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
    for degree in [1, 2] {
        let error = |n: usize| {
            let patch = block(&BasisSpec::Lagrange { degree }, n);
            let elements = Elements::new(&patch, None).expect("a square");
            let u: Vec<Point> =
                patch.points.iter().map(|x| Point::new((2.0 * x.x + x.y).sin(), (x.x - 2.0 * x.y).cos())).collect();
            let found = Recovery::new(&elements, &patch, &material).expect("a basis").error(&u);
            found.expect("small strain").error
        };
        let [coarse, middle, fine] = [8, 16, 32].map(error);
        let order = (middle / fine).log2();
        println!("degree {degree}: {coarse:.2e} {middle:.2e} {fine:.2e}, order {order:.2}");
        assert!((order - 2.0 * degree as f64).abs() < 0.2 && coarse > middle);
    }
}

/// Any homogeneous deformation, rotations included, has a stress that needs no recovery.
#[test]
fn uniform_stress_is_recovered_exactly() {
    let material = NeoHookean { youngs_modulus: 2.0, poissons_ratio: 0.3 };
    for basis in [BasisSpec::Nurbs { degree: 3 }, BasisSpec::Lagrange { degree: 1 }] {
        let patch = block(&basis, 5);
        let elements = Elements::new(&patch, None).expect("a square");
        let u: Vec<Point> =
            patch.points.iter().map(|x| Point::new(0.2 * x.x - 0.3 * x.y, 0.4 * x.x + 0.1 * x.y)).collect();
        let found = Recovery::new(&elements, &patch, &material).expect("a basis").error(&u).expect("not inverted");
        assert!(found.stress > 1e-3 && found.error < 1e-24 * found.stress, "{found:?}");
        assert!((found.strain - 0.3_f64.sqrt()).abs() < 1e-12);
    }
}

/// Behind a snap the estimate says that it does not know.
#[test]
fn nothing_is_estimated_behind_a_snap() {
    let height = 1.6 * 60.0_f64.to_radians().tan() / std::f64::consts::PI;
    let (_, found) = over(&Pass { friction: 0.0, height, overlap: 0.5 * height, ..Pass::default() });
    assert!(found.error.is_none() && found.to_string().contains("behind a snap"), "{found}");
}

const COARSE: [&str; 3] = ["time.steps=19", "body.lower.elements=[24,6]", "body.upper.elements=[13,6]"];

#[test]
fn the_strain_measure_is_judged_by_the_error() {
    let small = "material.rubber.type=\"linear-elastic\"";
    let (model, found) = example("single_asperity", &[&COARSE[..], &[small]].concat());
    let warning = found.warning(&model).expect("strains are large");
    assert!(warning.contains("finite strain") && found.strain > 0.1 && found.advice(&model).is_none(), "{warning}");
    let (model, found) = example("single_asperity", &COARSE);
    assert_eq!((found.warning(&model), found.advice(&model)), (None, None));
    let (model, found) = example("hertz", &["material.linear.type=\"neo-hookean\""]);
    assert!(found.strain < 1e-2 && found.warning(&model).is_none());
    assert!(found.advice(&model).is_some_and(|advice| advice.contains("would do")), "{found:?}");
    let (model, found) = example("hertz", &[]);
    assert_eq!((found.warning(&model), found.advice(&model)), (None, None));
}

#[test]
fn what_is_not_seen_is_said() {
    let law = "contact.0.law={type=\"dahl\",friction=0.3,stiffness=3.0}";
    let (_, found) = example("single_asperity", &[&COARSE[..], &[law]].concat());
    assert!(found.to_string().contains("time steps in contact 0: its law has memory"), "{found}");
}
