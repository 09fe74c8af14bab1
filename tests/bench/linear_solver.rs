//! Factorisation and solution of the Newton systems of the two-asperity problem, in thread CPU time:
//! `cargo bench --bench linear_solver`. Ends with a table of ratios from runs in turn (medians).

#[path = "../support/mod.rs"]
mod support;

use std::hint::black_box;
use std::time::Duration;

use asperity::math::{Condensed, CondensedSolver, DenseLu, DenseMatrix, LinearSolver, SparseLu, System};
use asperity::model::{State, Tangent, evaluate};
use cpu_time::ThreadTime;
use criterion::{Criterion, criterion_group, criterion_main};
use support::{Pass, pass};

/// Runs in turn for the table.
const TURNS: usize = 9;

/// A Newton system of two asperities that overlap, and a right-hand side.
fn system(setup: &Pass) -> (System, Vec<f64>) {
    let model = pass(setup);
    let start = State::initial(&model);
    let found = evaluate(&model, &start, &start, Tangent::Exact).expect("admissible");
    (found.system.expect("with tangent"), found.residual.iter().map(|v| -v).collect())
}

fn problems() -> Vec<(&'static str, Pass)> {
    let at = |element, lagrange, degree| Pass { element, lagrange, degree, from: -0.3, to: 0.3, ..Pass::default() };
    vec![
        ("level 1, B-spline p = 2", at(0.05, false, 2)),
        ("level 1, Lagrange p = 1", at(0.05, true, 1)),
        ("level 2, B-spline p = 2", at(0.025, false, 2)),
        ("level 2, Lagrange p = 1", at(0.025, true, 1)),
    ]
}

/// The parts of a solution, each on its own.
struct Bench {
    system: System,
    right: Vec<f64>,
    sparse_lu: SparseLu,
    solver: CondensedSolver,
    condensed: Condensed,
    block: DenseMatrix,
    lu: DenseLu,
}

type Part = (&'static str, fn(&mut Bench));

/// First the two that are compared, then what the second consists of.
const PARTS: [Part; 6] = [
    ("sparse LU", |b| drop(black_box(b.sparse_lu.solve(&b.system, &b.right).expect("regular")))),
    ("condensed", |b| {
        b.touch();
        drop(black_box(b.solver.solve(&b.system, &b.right).expect("regular")));
    }),
    ("bulk unchanged", |b| drop(black_box(b.solver.solve(&b.system, &b.right).expect("regular")))),
    ("Cholesky", |b| {
        b.touch();
        b.condensed.factor(&b.system.bulk, &[]).expect("definite");
    }),
    ("dense LU", |b| b.lu.factor(&b.block)),
    ("triangular solves", |b| {
        let mut x = b.right[..b.system.bulk.pattern.n].to_vec();
        b.condensed.reduce(&mut x);
        b.condensed.back_substitute(&mut x);
        black_box(x);
    }),
];

impl Bench {
    fn new(setup: &Pass) -> Self {
        let (system, right) = system(setup);
        let mut condensed = Condensed::new(system.bulk.pattern.clone(), system.boundary.clone()).expect("small");
        condensed.factor(&system.bulk, &[]).expect("definite");
        let (inner, contact) = (system.bulk.pattern.n, condensed.boundary().len());
        let row = |e: usize| if e < inner { condensed.slot(e) } else { Some(contact + e - inner) };
        let mut block = DenseMatrix::default();
        block.reset(contact + system.n - inner);
        condensed.add_condensed(&mut block);
        for &(i, j, v) in &system.interface {
            block.add(row(i).expect("on the boundary"), row(j).expect("on the boundary"), v);
        }
        let (sparse_lu, solver, lu) = (SparseLu::default(), CondensedSolver::default(), DenseLu::default());
        Self { system, right, sparse_lu, solver, condensed, block, lu }
    }

    /// Changes the bulk by round-off, so that nothing is reused.
    fn touch(&mut self) {
        let factor = if self.system.bulk.values[0] > 1.0 { 1.0 - 1e-15 } else { 1.0 + 1e-15 };
        self.system.bulk.values.iter_mut().for_each(|v| *v *= factor);
    }
}

fn parts(criterion: &mut Criterion) {
    for (name, setup) in problems() {
        let mut bench = Bench::new(&setup);
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for (part, run) in PARTS {
            group.bench_function(part, |bencher| {
                bencher.iter_custom(|times| (0..times).map(|_| timed(&mut bench, run)).sum());
            });
        }
    }
    table();
}

fn timed(bench: &mut Bench, run: fn(&mut Bench)) -> Duration {
    let clock = ThreadTime::now();
    run(bench);
    clock.elapsed()
}

fn table() {
    println!("\nmilliseconds, medians of {TURNS} runs in turn");
    let names: String = PARTS.iter().map(|(part, _)| format!("{part:>18}")).collect();
    println!("{:24}{:>9}{names}{:>8}", "", "unknowns", "ratio");
    for (name, setup) in problems() {
        let mut bench = Bench::new(&setup);
        let mut times = vec![vec![]; PARTS.len()];
        for _ in 0..TURNS {
            times.iter_mut().zip(PARTS).for_each(|(list, (_, run))| list.push(timed(&mut bench, run)));
        }
        let median = |list: &mut Vec<Duration>| {
            list.sort();
            1e3 * list[TURNS / 2].as_secs_f64()
        };
        let found: Vec<f64> = times.iter_mut().map(median).collect();
        let row: String = found.iter().map(|t| format!("{t:18.2}")).collect();
        println!("{name:24}{:9}{row}{:8.2}", bench.system.n, found[0] / found[1]);
    }
}

criterion_group!(benches, parts);
criterion_main!(benches);
