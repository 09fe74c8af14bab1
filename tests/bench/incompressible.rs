//! Rubber near incompressibility: locking, pressure and cost, for every basis and for other spaces of the dilatations
//! (papers/incompressible): `cargo bench --bench incompressible [-- ratios | spaces | ring | cook | cost]`.

#[path = "../support/hertz.rs"]
mod hertz;
#[path = "../support/rubber.rs"]
mod rubber;
#[path = "../support/shrink_fit.rs"]
mod shrink_fit;
#[path = "../support/mod.rs"]
mod support;

use asperity::bulk::VolumeSpace;
use asperity::geometry::BasisSpec;
use asperity::math::{CondensedSolver, LinearSolver};
use asperity::model::{Tangent, evaluate};
use cpu_time::ThreadTime;
use hertz::{Case, PLANE};
use rubber::Choice;
use support::{Pass, done};

const EXTREME: f64 = 0.4999;
const NURBS: [BasisSpec; 4] = [nurbs(1), nurbs(2), nurbs(3), nurbs(4)];
const BASES: [BasisSpec; 6] = [nurbs(1), nurbs(2), nurbs(3), nurbs(4), lagrange(1), lagrange(2)];
/// With and without projection.
const CHOICES: [(&str, Choice); 2] = [("standard", Some(None)), ("projected", None)];

const fn nurbs(degree: usize) -> BasisSpec {
    BasisSpec::Nurbs { degree }
}

const fn lagrange(degree: usize) -> BasisSpec {
    BasisSpec::Lagrange { degree }
}

fn name(basis: BasisSpec) -> String {
    match basis {
        BasisSpec::Nurbs { degree } => format!("NURBS {degree}"),
        BasisSpec::Lagrange { degree } => format!("Lagrange {degree}"),
    }
}

/// A row of errors at every Poisson's ratio.
fn ratios() {
    println!("\nHertz: L2, peak, ripple of the contact pressure; L2, ripple of tau below it; % of p0, mean of 3 loads");
    for per_a in [9.0, 18.0] {
        println!("\n| a/h = {per_a} | nu | standard | projected |\n|---|---|---|---|");
        for basis in BASES {
            for nu in [0.3, 0.4, 0.45, 0.49, 0.499, EXTREME] {
                let cells = CHOICES.map(|(_, volume)| {
                    let found = rubber::hertz_mean(&Case { nu, basis, per_a, volume, ..PLANE });
                    found.map(|e| format!("{e:.2}")).join(", ")
                });
                println!("| {} | {nu} | {} | {} |", name(basis), cells[0], if nu > 0.4 { &cells[1] } else { "" });
            }
        }
    }
}

/// Other spaces at the extreme, under refinement.
fn spaces() {
    println!("\nHertz, nu = {EXTREME}: L2, peak, ripple of the contact pressure; L2, ripple below; a/h = 9, 18, 36");
    println!("\n| basis | space | 9 | 18 | 36 |\n|---|---|---|---|---|");
    let candidates = [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (4, 2), (4, 3), (5, 3)];
    let of_lagrange = [(1, 0), (1, 1), (2, 1), (2, 2)].map(|space| (lagrange(2), space));
    let cases = NURBS.into_iter().flat_map(|basis| candidates.map(|space| (basis, space))).chain(of_lagrange);
    for (basis, (block, degree)) in cases {
        let space = VolumeSpace { block, degree };
        let cell = |per_a| {
            let case = Case { nu: EXTREME, basis, per_a, volume: Some(Some(space)), ..PLANE };
            rubber::hertz_mean(&case).map(|e| format!("{e:.2}")).join(", ")
        };
        println!("| {} | {space} | {} | {} | {} |", name(basis), cell(9.0), cell(18.0), cell(36.0));
    }
}

fn ring() {
    println!(
        "\nShrink fit of rings, nu = {EXTREME}: largest error of the interface pressure; of tau inside, % of the pressure"
    );
    println!("\n| basis | | 8 x 4 elements | 16 x 8 | 32 x 16 |\n|---|---|---|---|---|");
    for (basis, (label, choice)) in NURBS[1..].iter().flat_map(|&basis| CHOICES.map(|choice| (basis, choice))) {
        let cell = |n| rubber::ring(basis, EXTREME, n, choice).map(|e| format!("{e:.1e}")).join("; ");
        println!("| {} | {label} | {} | {} | {} |", name(basis), cell(1), cell(2), cell(4));
    }
}

fn cook() {
    let reference = rubber::cook(lagrange(2), EXTREME, 128, None);
    let other = rubber::cook(nurbs(4), EXTREME, 64, None);
    println!(
        "\nCook's membrane, nu = {EXTREME}: error of the deflection {reference:.5} (Lagrange 2, n = 128; NURBS 4, 64: {other:.5}), %"
    );
    println!("\n| basis | | n = 4 | 8 | 16 | 32 |\n|---|---|---|---|---|---|");
    for (basis, (label, choice)) in BASES.iter().flat_map(|&basis| CHOICES.map(|choice| (basis, choice))) {
        let error = |n| 100.0 * (rubber::cook(basis, EXTREME, n, choice) / reference - 1.0);
        let cells = [4, 8, 16, 32].map(|n| format!("{:.2}", error(n))).join(" | ");
        println!("| {} | {label} | {cells} |", name(basis));
    }
}

/// Median CPU times of an evaluation with tangent and of a linear solution in contact, in milliseconds.
fn times(setup: &Pass) -> ([f64; 2], usize, usize) {
    let mut run = done(setup);
    let (end, start) = (run.states.pop().expect("six steps"), run.states.pop().expect("six steps"));
    let mut solver = CondensedSolver::default();
    let mut times = [const { Vec::<f64>::new() }; 2];
    for _ in 0..15 {
        let clock = ThreadTime::now();
        let found = evaluate(&run.model, &start, &end, Tangent::Exact).expect("admissible");
        times[0].push(1e3 * clock.elapsed().as_secs_f64());
        let (clock, system) = (ThreadTime::now(), found.system.expect("with tangent"));
        solver.solve(&system, &found.residual).expect("regular");
        times[1].push(1e3 * clock.elapsed().as_secs_f64());
    }
    let median = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[7]
    });
    (median, run.model.equations.pattern.rows.len(), run.outcome.iterations)
}

fn cost() {
    println!(
        "\nTwo asperities, nu = 0.499: entries of the bulk stiffness, CPU time of an iteration in ms, iterations of 6 steps"
    );
    println!(
        "\n| h | basis | | entries | evaluation | solution | together | ratio | iterations |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (element, basis) in [0.05, 0.025].into_iter().flat_map(|h| BASES.map(|basis| (h, basis))) {
        let (lagrange, degree) = match basis {
            BasisSpec::Nurbs { degree } => (false, degree),
            BasisSpec::Lagrange { degree } => (true, degree),
        };
        let mut before = None;
        for (label, volume) in CHOICES {
            let (from, to, steps) = (-0.6, -0.3, 6);
            let setup =
                Pass { element, lagrange, degree, volume, from, to, steps, poissons_ratio: 0.499, ..Pass::default() };
            let ([evaluation, solution], entries, iterations) = times(&setup);
            let together = evaluation + solution;
            let ratio = together / *before.get_or_insert(together);
            println!(
                "| {element} | {} | {label} | {entries} | {evaluation:.2} | {solution:.2} | {together:.2} | {ratio:.2} | {iterations} |",
                name(basis)
            );
        }
    }
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let tables: [(&str, fn()); 5] =
        [("ratios", ratios), ("spaces", spaces), ("ring", ring), ("cook", cook), ("cost", cost)];
    for (name, table) in tables {
        if wanted.is_empty() || wanted.iter().any(|w| w == name) {
            table();
        }
    }
}
