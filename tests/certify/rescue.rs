//! Where Newton's method fails the conic method is asked.

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use asperity::contact::Sites;
use asperity::math::CondensedSolver;
use asperity::model::State;
use asperity::solve::{Control, Outcome, Strategy, Tools, Witness, accompanied};
use asperity::verify::conic::{Companion, Stage};

use super::support::{Pass, pass};

fn march(setup: &Pass, max_cuts: u32, witness: &mut dyn Witness) -> Outcome {
    let model = pass(setup);
    let control = Control { end: 1.0, steps: setup.steps, max_cuts, strategy: Strategy::default() };
    let mut solver = CondensedSolver::default();
    let tools = Tools { solver: &mut solver, witness };
    let quiet = AtomicBool::new(false);
    let Ok(outcome) =
        accompanied(&model, State::initial(&model), &control, tools, &quiet, |_| Ok::<(), Infallible>(()));
    outcome
}

#[test]
#[ignore = "a study; its table is in papers/certify"]
fn study() {
    for (name, setup) in [
        ("nodal h=.2 mu=.1", Pass { sites: Some(Sites::Nodal), element: 0.2, friction: 0.1, ..Pass::default() }),
        ("nodal h=.1 mu=.1", Pass { sites: Some(Sites::Nodal), element: 0.1, friction: 0.1, ..Pass::default() }),
        ("nodal h=.1 mu=.3", Pass { sites: Some(Sites::Nodal), element: 0.1, ..Pass::default() }),
        ("nodal h=.1 mu=1", Pass { sites: Some(Sites::Nodal), element: 0.1, friction: 1.0, ..Pass::default() }),
        ("quadr h=.1 mu=1", Pass { element: 0.1, friction: 1.0, ..Pass::default() }),
        ("quadr h=.1 mu=1 19", Pass { element: 0.1, friction: 1.0, steps: 19, ..Pass::default() }),
        ("quadr h=.1 mu=.3 19", Pass { element: 0.1, steps: 19, ..Pass::default() }),
        ("nodal h=.1 mu=.3 19", Pass { sites: Some(Sites::Nodal), element: 0.1, steps: 19, ..Pass::default() }),
        ("quadr h=.1 mu=.3 10", Pass { element: 0.1, steps: 10, ..Pass::default() }),
        (
            "lagrange 1 h=.1 mu=1 38",
            Pass { element: 0.1, lagrange: true, degree: 1, steps: 38, friction: 1.0, ..Pass::default() },
        ),
    ] {
        let never = AtomicBool::new(false);
        let mut companion = Companion { certified: None, interrupt: &never, stage: Stage::default() };
        for (who, witness) in [("alone", &mut () as &mut dyn Witness), ("with", &mut companion)] {
            let clock = Instant::now();
            let o = march(&setup, 8, witness);
            println!(
                "{name:24} {who:6} {:?} t {:.3} steps {} its {} cuts {} rescued {} {:.1} s",
                o.status == asperity::solve::Status::Done,
                o.state.time,
                o.steps,
                o.iterations,
                o.cuts,
                o.rescued,
                clock.elapsed().as_secs_f64()
            );
        }
    }
}
