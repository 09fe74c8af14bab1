//! One evaluation of the two-asperity problem in contact, with and without tangent; what the contact kernel and the friction
//! law take of a Newton iteration (tables of medians from runs in turn): `cargo bench --bench assembly`.

#[path = "../support/mod.rs"]
mod support;

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use asperity::contact::{Configuration, ContactDiscretization, ContactStatus, InterfaceStart, InterfaceTrial};
use asperity::geometry::Point;
use asperity::laws::{FrictionLaw, InterfacePoint, dual, parse};
use asperity::math::{CondensedSolver, LinearSolver};
use asperity::model::{Model, Side, State, Tangent, evaluate};
use criterion::{Criterion, criterion_group, criterion_main};
use support::{Pass, done};

/// Runs in turn for the table.
const TURNS: usize = 15;

/// One law of every kind: without state, with a falling bound, with a state of its own, and read from text.
const LAWS: [(&str, &str); 5] = [
    ("coulomb", "type = 'coulomb'\nfriction = 0.3"),
    ("stribeck", "type = 'stribeck'\nstatic_friction = 0.32\nkinetic_friction = 0.3\nspeed = 10.0"),
    ("lugre", "type = 'lugre'\nrest = 0.4\nkinetic = 0.3\nspeed = 1.0\nstiffness = 100.0"),
    (
        "rate-and-state",
        "type = 'rate-and-state'\nfriction = 0.3\ndirect_effect = 0.03\nevolution_effect = 0.01\ndistance = 0.05\nspeed = 1.0",
    ),
    (
        "expression",
        "type = 'expression'\ntraction = '100*p*z'\nstates.z = { rate = 'v - 250*abs(v)*z', open = 'reset', unit = 'length' }",
    ),
];

/// Start and end of a step in contact.
struct Bench {
    model: Model,
    start: State,
    end: State,
    solver: CondensedSolver,
}

impl Bench {
    fn new(setup: &Pass) -> Self {
        let mut run = done(setup);
        let end = run.states.pop().expect("six steps");
        let start = run.states.pop().expect("six steps");
        Self { model: run.model, start, end, solver: CondensedSolver::default() }
    }

    fn evaluate(&self, tangent: Tangent) {
        black_box(evaluate(&self.model, &self.start, &self.end, tangent));
    }

    /// The contact kernel alone.
    fn contact(&self, tangent: Tangent) {
        let (pair, old, new) = (&self.model.pairs[0], &self.start.pairs[0], &self.end.pairs[0]);
        let place = |side: &Side, state: &State| -> Vec<Point> {
            let body = &self.model.bodies[side.body];
            side.nodes.iter().map(|&i| body.points[i - body.offset] + state.u[i]).collect()
        };
        let [nonmortar, mortar] = [&pair.nonmortar, &pair.mortar].map(|side| place(side, &self.start));
        let start = InterfaceStart { at: Configuration { nonmortar: &nonmortar, mortar: &mortar }, sites: &old.sites };
        let [nonmortar, mortar] = [&pair.nonmortar, &pair.mortar].map(|side| place(side, &self.end));
        let trial = InterfaceTrial {
            at: Configuration { nonmortar: &nonmortar, mortar: &mortar },
            pressure: &new.pressure,
            traction: &new.traction,
            dt: self.end.time - self.start.time,
        };
        black_box(pair.contact.evaluate(&start, &trial, tangent));
    }

    /// Evaluation and linear solution.
    fn iteration(&mut self) {
        let found = evaluate(&self.model, &self.start, &self.end, Tangent::Exact).expect("admissible");
        let system = found.system.expect("with tangent");
        black_box(self.solver.solve(&system, &found.residual).expect("regular"));
    }

    /// What the closed sites tell the law, and their variables at the start of the step.
    fn questions(&self) -> Vec<(InterfacePoint, &[f64])> {
        let found = evaluate(&self.model, &self.start, &self.end, Tangent::None).expect("admissible");
        let sites = found.interfaces[0].sites.iter().zip(&self.start.pairs[0].sites);
        let closed = sites.filter(|(site, _)| site.status != ContactStatus::Open);
        let dt = self.end.time - self.start.time;
        closed.map(|(site, old)| (InterfacePoint::new(site.pressure, site.slip, dt), &old.variables[..])).collect()
    }
}

fn in_contact(element: f64, lagrange: bool, degree: usize) -> Pass {
    Pass { element, lagrange, degree, from: -0.6, to: -0.3, steps: 6, ..Pass::default() }
}

fn problems() -> [(&'static str, Pass); 4] {
    [
        ("level 1, B-spline p = 2", in_contact(0.05, false, 2)),
        ("level 1, Lagrange p = 1", in_contact(0.05, true, 1)),
        ("level 2, B-spline p = 2", in_contact(0.025, false, 2)),
        ("level 2, Lagrange p = 1", in_contact(0.025, true, 1)),
    ]
}

fn evaluations(criterion: &mut Criterion) {
    for (name, setup) in problems() {
        let bench = Bench::new(&setup);
        let mut group = criterion.benchmark_group(name);
        group.sample_size(20);
        for tangent in [Tangent::Exact, Tangent::None] {
            group.bench_function(format!("tangent {tangent:?}"), |b| b.iter(|| bench.evaluate(tangent)));
        }
    }
}

/// Median of the times of some jobs that are done in turn, in microseconds.
fn medians<const N: usize>(mut jobs: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut times = [const { Vec::<Duration>::new() }; N];
    for _ in 0..TURNS {
        for (job, times) in jobs.iter_mut().zip(&mut times) {
            let clock = Instant::now();
            job();
            times.push(clock.elapsed());
        }
    }
    times.map(|mut times| {
        times.sort();
        1e6 * times[TURNS / 2].as_secs_f64()
    })
}

fn law_shares(_: &mut Criterion) {
    println!("\nmicroseconds, medians of {TURNS} runs in turn; level 1, B-spline p = 2");
    println!("{:16}{:>8}{:>12}{:>14}{:>14}{:>9}", "law", "sites", "law", "evaluation", "iteration", "share");
    for (name, text) in LAWS {
        let law: Arc<dyn FrictionLaw> = parse(text.parse().expect("TOML")).expect("a law").into();
        let mut bench = Bench::new(&Pass { law: Some(law.clone()), ..in_contact(0.05, false, 2) });
        let other = Bench {
            model: bench.model.clone(),
            start: bench.start.clone(),
            end: bench.end.clone(),
            solver: CondensedSolver::default(),
        };
        let questions = other.questions();
        let mut new = vec![dual::constant(f64::NAN); law.variables().len()];
        let mut ask = || {
            for (at, old) in &questions {
                black_box(law.response(at, old, &mut new));
            }
        };
        let [law, evaluation, iteration] =
            medians([&mut ask, &mut || other.evaluate(Tangent::Exact), &mut || bench.iteration()]);
        println!(
            "{name:16}{:8}{law:12.1}{evaluation:14.1}{iteration:14.1}{:8.2}%",
            questions.len(),
            100.0 * law / iteration
        );
    }
}

fn contact_shares(_: &mut Criterion) {
    println!("\nmicroseconds, medians of {TURNS} runs in turn; Coulomb friction 0.3");
    println!(
        "{:26}{:>8}{:>10}{:>16}{:>12}{:>8}",
        "problem", "sites", "contact", "without tangent", "iteration", "share"
    );
    for (name, setup) in problems() {
        let [other, mut bench] = [Bench::new(&setup), Bench::new(&setup)];
        let [contact, forces, iteration] =
            medians([&mut || other.contact(Tangent::Exact), &mut || other.contact(Tangent::None), &mut || {
                bench.iteration()
            }]);
        let sites = other.start.pairs[0].sites.len();
        let share = 100.0 * contact / iteration;
        println!("{name:26}{sites:8}{contact:10.1}{forces:16.1}{iteration:12.1}{share:7.1}%");
    }
}

criterion_group!(benches, contact_shares, law_shares, evaluations);
criterion_main!(benches);
