//! Where no guess leads Newton's method to the end of a step the conic method offers one: passes alone and with a companion.

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use asperity::contact::Sites;
use asperity::math::CondensedSolver;
use asperity::model::State;
use asperity::solve::{Control, Outcome, Status, Strategy, Tools, Witness, proceed};
use asperity::verify::conic::{Companion, Stage};

use super::support::{Pass, pass};

fn march(setup: &Pass, witness: &mut dyn Witness) -> (Outcome, f64) {
    let model = pass(setup);
    let control = Control { end: 1.0, steps: setup.steps, max_cuts: 8, strategy: Strategy::default() };
    let mut solver = CondensedSolver::default();
    let (tools, clock) = (Tools { solver: &mut solver, witness }, Instant::now());
    let quiet = AtomicBool::new(false);
    let Ok(outcome) =
        proceed(&model, Outcome::at(State::initial(&model)), &control, tools, &quiet, |_| Ok::<(), Infallible>(()));
    (outcome, clock.elapsed().as_secs_f64())
}

/// Both outcomes; with the companion the end is reached, with no more cuts.
fn compare(name: &str, setup: &Pass) -> [Outcome; 2] {
    let never = AtomicBool::new(false);
    let mut companion = Companion { certified: None, interrupt: &never, stage: Stage::default() };
    let (alone, accompanied) = (march(setup, &mut ()), march(setup, &mut companion));
    for (who, (o, seconds)) in [("alone", &alone), ("with rescue", &accompanied)] {
        let Outcome { steps, iterations, cuts, rescued, .. } = o;
        let reached = o.state.time;
        println!("| {name} | {who} | {reached:.3} | {steps} | {iterations} | {cuts} | {rescued} | {seconds:.1} |");
    }
    let [alone, accompanied] = [alone.0, accompanied.0];
    assert_eq!(accompanied.status, Status::Done, "{name}");
    assert!(accompanied.cuts <= alone.cuts, "{name}: {} cuts instead of {}", accompanied.cuts, alone.cuts);
    [alone, accompanied]
}

#[test]
fn a_pass_that_cycles_is_rescued() {
    let nodal = Pass { sites: Some(Sites::Nodal), ..Pass::default() };
    let [alone, with] = compare("nodal, h = 0.2, mu = 0.1", &Pass { element: 0.2, friction: 0.1, ..nodal });
    assert!(with.rescued > 0 && with.cuts < alone.cuts);
}

#[test]
fn high_friction_and_coarse_steps_need_no_cuts() {
    let cases = [
        ("nodal, mu = 1", Pass { sites: Some(Sites::Nodal), friction: 1.0, ..Pass::default() }),
        ("quadrature, mu = 1", Pass { friction: 1.0, ..Pass::default() }),
        ("quadrature, mu = 1, 19 steps", Pass { friction: 1.0, steps: 19, ..Pass::default() }),
        ("nodal, mu = 0.3, 19 steps", Pass { sites: Some(Sites::Nodal), steps: 19, ..Pass::default() }),
        ("quadrature, mu = 0.3, 10 steps", Pass { steps: 10, ..Pass::default() }),
    ];
    let rescued: usize = cases.iter().map(|(name, setup)| compare(name, setup)[1].rescued).sum();
    assert!(rescued > 0);
}
