//! One case: some steps of a scene, with what they took.

use std::convert::Infallible;
use std::fmt;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use asperity::math::{
    CondensedSolver, Counters, DenseLu, DenseMatrix, LinearSolver, SolveError, SolverMemory, SparseLu, System,
};
use asperity::model::{State, Tangent, evaluate};
use asperity::solve::{Control, march};
use cpu_time::ThreadTime;

use super::scene::{Case, many, two};

/// What one case took; times in seconds of thread CPU time per Newton iteration, memory in bytes.
#[derive(Default)]
pub struct Found {
    pub unknowns: usize,
    pub iterations: usize,
    pub analyses: usize,
    /// Rows of the largest dense block, and of one with all that may come into contact.
    pub dense: usize,
    pub possible: usize,
    /// Residual and tangent, once.
    pub evaluation: f64,
    /// Linear solution: mean, analyses included.
    pub mean: f64,
    /// Linear solution: median.
    pub median: f64,
    /// LU of a dense block of that size.
    pub dense_lu: f64,
    pub memory: f64,
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { unknowns, iterations, analyses, dense, possible, .. } = self;
        let Self { evaluation, mean, median, dense_lu, memory, .. } = self;
        write!(
            f,
            "{unknowns} {iterations} {analyses} {dense} {possible} {evaluation} {mean} {median} {dense_lu} {memory}"
        )
    }
}

impl Found {
    /// Reads what `Display` wrote.
    pub fn parse(text: &str) -> Option<Self> {
        let values: Vec<f64> = text.split_whitespace().map(|v| v.parse().ok()).collect::<Option<_>>()?;
        let [unknowns, iterations, analyses, dense, possible, evaluation, mean, median, dense_lu, memory] = values[..]
        else {
            return None;
        };
        let [unknowns, iterations, analyses, dense, possible] =
            [unknowns, iterations, analyses, dense, possible].map(|v| v as usize);
        Some(Self { unknowns, iterations, analyses, dense, possible, evaluation, mean, median, dense_lu, memory })
    }
}

/// A solver with a clock.
struct Clocked {
    solver: Box<dyn LinearSolver>,
    times: Vec<f64>,
}

impl LinearSolver for Clocked {
    fn solve(&mut self, system: &System, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        let clock = ThreadTime::now();
        let found = self.solver.solve(system, rhs);
        self.times.push(clock.elapsed().as_secs_f64());
        found
    }

    fn counters(&self) -> Counters {
        self.solver.counters()
    }

    fn memory(&self) -> SolverMemory {
        self.solver.memory()
    }

    fn recall(&mut self, memory: SolverMemory) {
        self.solver.recall(memory);
    }
}

/// Marches through a case with one of the solvers.
pub fn run(kind: &str, size: usize, solver: &str) -> Found {
    let Case { model, control, steps } = if kind == "many" { many(size) } else { two(kind == "lagrange", size) };
    let solver: Box<dyn LinearSolver> = match solver {
        "sparse" => Box::new(SparseLu::default()),
        _ => Box::new(CondensedSolver::default()),
    };
    let mut clocked = Clocked { solver, times: vec![] };
    let (mut evaluation, mut times) = (Duration::ZERO, 0);
    let enough = AtomicBool::new(false);
    let outcome = march(&model, State::initial(&model), &Control { ..control }, &mut clocked, &enough, |report| {
        if report.record.contact_length > 0.0 {
            let clock = ThreadTime::now();
            std::hint::black_box(evaluate(&model, report.state, report.state, Tangent::Exact));
            evaluation += clock.elapsed();
            times += 1;
        }
        enough.store(report.record.step >= steps, std::sync::atomic::Ordering::Relaxed);
        Ok::<(), Infallible>(())
    });
    let Ok(outcome) = outcome;
    let counters = clocked.counters();
    assert!(outcome.state.time > 0.0 && !clocked.times.is_empty(), "{:?}", outcome.status);
    assert_eq!((counters.indefinite, counters.coupled, counters.inaccurate), (0, 0, 0));
    let memory = peak();
    Found {
        unknowns: model.unknowns(),
        iterations: clocked.times.len(),
        analyses: counters.analyses,
        dense: counters.dense_rows,
        possible: model.boundary.len() + model.unknowns() - model.equations.count,
        evaluation: evaluation.as_secs_f64() / f64::from(times),
        mean: clocked.times.iter().sum::<f64>() / clocked.times.len() as f64,
        median: median(&mut clocked.times),
        dense_lu: dense_lu(counters.dense_rows),
        memory,
    }
}

/// Peak of the resident memory of this process (Linux).
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    1024.0 * kilobytes.unwrap_or(f64::NAN)
}

/// Time of the LU of a dense matrix.
fn dense_lu(n: usize) -> f64 {
    let (mut matrix, mut lu) = (DenseMatrix::default(), DenseLu::default());
    matrix.reset(n);
    for j in 0..n {
        (0..n).for_each(|i| matrix.add(i, j, (1.0 + i as f64 * 0.7 + (j * j) as f64).sin()));
        matrix.add(j, j, n as f64);
    }
    let mut times = [0; 3].map(|_| {
        let clock = ThreadTime::now();
        lu.factor(&matrix);
        clock.elapsed().as_secs_f64()
    });
    median(&mut times)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
