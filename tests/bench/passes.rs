//! Whole passes of the two asperities at level 1 in turn: linear solvers and strategies. Thread CPU time, medians, ratios
//! within the run; `cargo bench --bench passes`.

#[path = "../support/mod.rs"]
mod support;

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use asperity::math::{CondensedSolver, LinearSolver, SparseLu};
use asperity::model::{Model, State};
use asperity::solve::{self, Status, Strategy};
use cpu_time::ThreadTime;
use support::{Pass, pass};

/// Passes of each kind.
const TURNS: usize = 3;

type Solver = fn() -> Box<dyn LinearSolver>;

/// CPU time and linear solves of a pass.
fn cost(model: &Model, steps: usize, strategy: Strategy, mut solver: Box<dyn LinearSolver>) -> (Duration, usize) {
    let control = solve::Control { end: 1.0, steps, max_cuts: 8, strategy };
    let (clock, quiet) = (ThreadTime::now(), AtomicBool::new(false));
    let report = |_: solve::StepReport| Ok::<(), Infallible>(());
    let outcome = solve::march(model, State::initial(model), &control, solver.as_mut(), &quiet, report);
    let outcome = outcome.unwrap_or_else(|e| match e {});
    assert_eq!(outcome.status, Status::Done);
    (clock.elapsed(), outcome.iterations)
}

fn main() {
    let solvers: [(&str, Solver); 2] =
        [("condensed", || Box::new(CondensedSolver::default())), ("sparse LU", || Box::new(SparseLu::default()))];
    let strategies = [Strategy::Monolithic, Strategy::Interface];
    let kinds: Vec<_> = solvers.iter().flat_map(|solver| strategies.map(|strategy| (solver, strategy))).collect();
    println!("basis          solver     strategy     iterations   CPU s   ratio");
    for (name, degree, lagrange) in [("B-spline 2", 2, false), ("Lagrange 1", 1, true)] {
        let setup = Pass { element: 0.05, degree, lagrange, ..Pass::default() };
        let model = pass(&setup);
        let mut times = vec![vec![]; kinds.len()];
        let mut iterations = vec![0; kinds.len()];
        for _ in 0..TURNS {
            for (k, ((_, solver), strategy)) in kinds.iter().enumerate() {
                let (time, count) = cost(&model, setup.steps, *strategy, solver());
                times[k].push(time);
                iterations[k] = count;
            }
        }
        let median = |times: &mut Vec<Duration>| {
            times.sort_unstable();
            times[TURNS / 2].as_secs_f64()
        };
        let times: Vec<f64> = times.iter_mut().map(median).collect();
        for (k, ((solver, _), strategy)) in kinds.iter().enumerate() {
            let strategy = format!("{strategy:?}").to_lowercase();
            let (time, ratio) = (times[k], times[k] / times[0]);
            println!("{name:14} {solver:10} {strategy:12} {:10} {time:7.2} {ratio:7.2}", iterations[k]);
        }
    }
}
