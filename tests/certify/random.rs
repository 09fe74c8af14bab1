//! Small random bodies in frictional contact, solved by both methods.

use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{Material, NeoHookean};
use asperity::contact::Sites;
use asperity::geometry::shapes::{Block, Cosine};
use asperity::geometry::{BasisSpec, Edge, Profile, ShapeSpec, build};
use asperity::laws::builtin::Coulomb;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve::{Strategy as Treatment, solve_step};
use asperity::verify::conic::{Claim, Stage, Verdict, check};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

#[derive(Clone, Debug)]
struct Small {
    friction: f64,
    nodal: bool,
    degree: usize,
    height: f64,
    shift: f64,
    press: f64,
    drag: f64,
    poisson: f64,
}

fn small() -> impl Strategy<Value = Small> {
    (0.0..2.0, any::<bool>(), 1_usize..=2, 0.0..0.6, -0.6..0.6, 0.01..0.2, -0.4..0.4, 0.0..0.45).prop_map(
        |(friction, nodal, degree, height, shift, press, drag, poisson)| Small {
            friction,
            nodal,
            degree,
            height,
            shift,
            press,
            drag,
            poisson,
        },
    )
}

fn model(small: &Small) -> Model {
    let bump = |up: bool| {
        let cosine =
            Cosine { height: small.height, wavelength: 2.0, centers: Some(vec![0.0]), count: None, spacing: None };
        let (bump, flat) = (Profile::Cosine(cosine), Profile::default());
        let (block, position, elements) = if up {
            (
                Block { x: [-1.0, 1.0], y: [0.0, 1.0], top: flat, bottom: bump },
                [small.shift, 2.0 * small.height],
                [4, 1],
            )
        } else {
            (Block { x: [-2.0, 2.0], y: [-1.0, 0.0], top: bump, bottom: flat }, [0.0, 0.0], [7, 1])
        };
        let basis = BasisSpec::Nurbs { degree: small.degree };
        let patch = build(&ShapeSpec::Block(block), &basis, elements, None, position, Path::new(".")).expect("a block");
        let material: Arc<dyn Material> = Arc::new(NeoHookean { youngs_modulus: 1.0, poissons_ratio: small.poisson });
        BodySpec::Deformable(patch, material)
    };
    let hold = || Control::Displacement(Table::constant(0.0));
    let course = |value: Vec<f64>| Control::Displacement(Table { time: vec![0.0, 1.0, 2.0], value });
    let mut pair =
        PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), Arc::new(Coulomb { friction: small.friction }));
    pair.sites = Some(if small.nodal { Sites::Nodal } else { Sites::Quadrature });
    let mut builder = Builder::default();
    let built = (|| {
        builder.body("lower", bump(false))?.body("upper", bump(true))?;
        builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
        let (x, y) = (course(vec![0.0, 0.0, small.drag]), course(vec![0.0, -small.press, -small.press]));
        builder.motion("upper", Edge::Top, 0, x, true)?.motion("upper", Edge::Top, 1, y, true)?;
        builder.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}

#[test]
fn small_random_contacts_agree_where_they_are_unique() {
    let [agreed, unsure, unsolved, failed] = [0; 4].map(Cell::new);
    let config = Config { cases: 300, rng_seed: RngSeed::Fixed(11), failure_persistence: None, ..Config::default() };
    let outcome = TestRunner::new(config).run(&small(), |small| {
        let (model, quiet) = (model(&small), AtomicBool::new(false));
        let (mut solver, mut stage) = (CondensedSolver::default(), Stage::default());
        let mut start = State::initial(&model);
        for time in [1.0, 2.0] {
            let found = solve_step(&model, &start, time, Treatment::default(), &mut solver, &quiet, &mut 0);
            let Ok(found) = found else {
                failed.update(|n| n + 1);
                break;
            };
            let claim = Claim { state: &found.state, evaluation: &found.evaluation };
            let check = check(&model, &start, claim, &mut stage, &quiet);
            match &check.verdict {
                Verdict::Agrees => agreed.update(|n| n + 1),
                Verdict::Inconclusive(_) if !check.certificate.unique() => unsure.update(|n| n + 1),
                Verdict::Inconclusive(why) => {
                    println!("{why}: {small:?} at {time}");
                    unsolved.update(|n| n + 1);
                }
                Verdict::Disagrees(why) => {
                    prop_assert!(false, "{why} at {time}, coupling {}", check.certificate.coupling)
                }
            }
            start = found.state;
        }
        Ok(())
    });
    outcome.expect("no disagreement");
    let [agreed, unsure, unsolved, failed] = [agreed, unsure, unsolved, failed].map(Cell::into_inner);
    println!("{agreed} agree, {unsure} not unique, {unsolved} unsolved by the conic method, {failed} by Newton's");
    // sites that just touch are known to the square root of Clarabel's accuracy: no proof then, and no disagreement either
    assert!(agreed >= 500 && 100 * unsolved <= agreed);
}
