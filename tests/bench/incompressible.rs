//! Rubber near incompressibility: locking, pressure and cost by space of the dilatations, for every basis
//! (papers/incompressible): `cargo bench --bench incompressible [-- hertz | ring | cook | cost]`.

#[path = "../support/hertz.rs"]
mod hertz;
#[path = "../support/rubber.rs"]
mod rubber;
#[path = "../support/mod.rs"]
mod support;

use asperity::bulk::VolumeSpace;
use asperity::geometry::BasisSpec;
use asperity::math::{CondensedSolver, LinearSolver};
use asperity::model::{Tangent, evaluate};
use cpu_time::ThreadTime;
use hertz::{Case, PLANE};
use support::{Pass, done};

fn bases() -> Vec<BasisSpec> {
    let nurbs = (1..=4).map(|degree| BasisSpec::Nurbs { degree });
    let lagrange = (1..=2).map(|degree| BasisSpec::Lagrange { degree });
    nurbs.chain(lagrange).collect()
}

fn name(basis: BasisSpec) -> String {
    match basis {
        BasisSpec::Nurbs { degree } => format!("NURBS {degree}"),
        BasisSpec::Lagrange { degree } => format!("Lagrange {degree}"),
    }
}

fn degree(basis: BasisSpec) -> usize {
    match basis {
        BasisSpec::Nurbs { degree } | BasisSpec::Lagrange { degree } => degree,
    }
}

/// Candidates.
fn spaces(basis: BasisSpec) -> Vec<Option<VolumeSpace>> {
    let p = degree(basis);
    let mut found = vec![None, Some(VolumeSpace { block: 1, degree: 0 })];
    let mut add = |block, degree| {
        let space = Some(VolumeSpace { block, degree });
        if !found.contains(&space) {
            found.push(space);
        }
    };
    match basis {
        BasisSpec::Lagrange { .. } => {
            add(1, p - 1);
            add(2, 1);
        }
        BasisSpec::Nurbs { .. } => {
            add(1, 1);
            add(2, 1);
            add(2, p.saturating_sub(1));
            add(p, p - 1);
        }
    }
    found
}

fn label(space: Option<VolumeSpace>) -> String {
    space.map_or("standard".into(), |s| format!("P{} on {}x{}", s.degree, s.block, s.block))
}

fn hertz_table(nus: &[f64], per_a: f64) {
    println!(
        "\nHertz, a/h = {per_a}: L2, peak, ripple of the contact pressure; L2, ripple of tau in the body, % (mean of 3 loads)"
    );
    for basis in bases() {
        for space in spaces(basis) {
            for &nu in nus {
                let mut sum = [0.0; 5];
                for k in 0..3 {
                    let a = 1.0 + ((k as f64 + 0.5) / 3.0 - 0.5) / per_a;
                    let found = rubber::hertz(&Case { nu, basis, per_a, a, volume: Some(space), ..PLANE });
                    sum.iter_mut().zip(found).for_each(|(s, v)| *s += v / 3.0);
                }
                let [l2, peak, ripple, body, wild] = sum;
                println!(
                    "{:11}{:12}{nu:7} {l2:8.3}{peak:8.3}{ripple:8.3} | {body:9.3}{wild:9.3}",
                    name(basis),
                    label(space)
                );
            }
        }
    }
}

fn few_table(nus: &[f64], per_a: f64) {
    println!("\nHertz, a/h = {per_a}");
    for basis in bases() {
        let p = degree(basis);
        let block = if matches!(basis, BasisSpec::Nurbs { .. }) { p } else { 1 };
        for space in [None, Some(VolumeSpace { block: 1, degree: 0 }), Some(VolumeSpace { block, degree: p - 1 })] {
            for &nu in nus {
                let mut sum = [0.0; 5];
                for k in 0..3 {
                    let a = 1.0 + ((k as f64 + 0.5) / 3.0 - 0.5) / per_a;
                    let found = rubber::hertz(&Case { nu, basis, per_a, a, volume: Some(space), ..PLANE });
                    sum.iter_mut().zip(found).for_each(|(s, v)| *s += v / 3.0);
                }
                let [l2, peak, ripple, body, wild] = sum;
                println!(
                    "{:11}{:12}{nu:7} {l2:8.3}{peak:8.3}{ripple:8.3} | {body:9.3}{wild:9.3}",
                    name(basis),
                    label(space)
                );
            }
        }
    }
}

fn ring_table(nu: f64) {
    println!("\nShrink fit of rings, nu = {nu}: error of the contact pressure; of tau in the rings, %, by refinement");
    for basis in bases().into_iter().filter(|basis| degree(*basis) > 1) {
        for space in spaces(basis) {
            let errors = [1, 2, 4].map(|refinement| rubber::ring(basis, nu, refinement, Some(space)));
            let row = |i: usize| errors.map(|e| format!("{:10.1e}", e[i])).concat();
            println!("{:11}{:12}{} | {}", name(basis), label(space), row(0), row(1));
        }
    }
}

fn cook_table(nu: f64) {
    println!("\nCook's membrane, nu = {nu}: deflection by refinement");
    for basis in bases() {
        for space in spaces(basis) {
            let found = [4, 8, 16, 32].map(|n| rubber::cook(basis, nu, n, Some(space)));
            println!("{:11}{:12}{}", name(basis), label(space), found.map(|v| format!("{v:11.5}")).concat());
        }
    }
    let fine =
        rubber::cook(BasisSpec::Lagrange { degree: 2 }, nu, 128, Some(Some(VolumeSpace { block: 1, degree: 1 })));
    println!("Lagrange 2, 128 {fine:11.5}");
}

/// CPU time of an evaluation with tangent and of a linear solution in contact, level 1, milliseconds.
fn cost_table(element: f64) {
    println!(
        "\nTwo asperities, h = {element}: entries of the bulk stiffness, evaluation, solution, together; ms, ratio"
    );
    for basis in bases() {
        let p = degree(basis);
        let mut before = 0.0;
        let finalists = match basis {
            BasisSpec::Lagrange { degree: 2 } => vec![(1, 1)],
            _ if p == 1 => vec![(2, 0)],
            _ if p == 2 => vec![(3, 1), (4, 2)],
            _ if p == 3 => vec![(2, 1), (3, 2), (4, 2)],
            _ => vec![(4, 2)],
        };
        let finalists = finalists.into_iter().map(|(block, degree)| Some(VolumeSpace { block, degree }));
        for space in [None].into_iter().chain(finalists) {
            let lagrange = matches!(basis, BasisSpec::Lagrange { .. });
            let setup = Pass {
                element,
                lagrange,
                degree: p,
                from: -0.6,
                to: -0.3,
                steps: 6,
                volume: Some(space),
                ..Pass::default()
            };
            let mut run = done(&setup);
            let end = run.states.pop().expect("six steps");
            let start = run.states.pop().expect("six steps");
            let mut solver = CondensedSolver::default();
            let mut times = vec![];
            for _ in 0..15 {
                let clock = ThreadTime::now();
                let found = evaluate(&run.model, &start, &end, Tangent::Exact).expect("admissible");
                let first = clock.elapsed().as_secs_f64();
                let system = found.system.expect("with tangent");
                solver.solve(&system, &found.residual).expect("regular");
                times.push([first, clock.elapsed().as_secs_f64() - first].map(|t| 1e3 * t));
            }
            let median = |i: usize| {
                let mut all: Vec<f64> = times.iter().map(|t| t[i]).collect();
                all.sort_by(f64::total_cmp);
                all[7]
            };
            let together = median(0) + median(1);
            if space.is_none() {
                before = together;
            }
            println!(
                "{:11}{:12}{:9}{:8.2}{:8.2}{together:8.2}{:7.2}  iterations {}",
                name(basis),
                label(space),
                run.model.equations.pattern.rows.len(),
                median(0),
                median(1),
                together / before,
                run.outcome.iterations
            );
        }
    }
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let runs = |name: &str| wanted.is_empty() || wanted.iter().any(|w| w == name);
    if runs("ring") {
        ring_table(0.4999);
    }
    if runs("cook") {
        cook_table(0.4999);
    }
    if runs("hertz") {
        hertz_table(&[0.3, 0.45, 0.49, 0.499, 0.4999], 9.0);
    }
    if runs("few") {
        few_table(&[0.3, 0.4, 0.45, 0.49, 0.499, 0.4999], 9.0);
        few_table(&[0.3, 0.45, 0.4999], 18.0);
    }
    if runs("blocks") {
        let nurbs = |degree| BasisSpec::Nurbs { degree };
        let mut list: Vec<(BasisSpec, usize, usize)> = vec![];
        for (b, d) in [(1, 0), (2, 0), (2, 1), (3, 1)] {
            list.push((nurbs(1), b, d));
        }
        for (b, d) in [(3, 1), (4, 2), (5, 3), (5, 2)] {
            list.push((nurbs(2), b, d));
        }
        for (b, d) in [(2, 1), (3, 2), (4, 3), (5, 4)] {
            list.push((nurbs(3), b, d));
        }
        for (b, d) in [(4, 2), (5, 3), (6, 4)] {
            list.push((nurbs(4), b, d));
        }
        for (b, d) in [(1, 1), (2, 2), (2, 1), (3, 3)] {
            list.push((BasisSpec::Lagrange { degree: 2 }, b, d));
        }
        for (basis, block, degree) in list {
            for per_a in [9.0, 18.0, 36.0] {
                let space = Some(VolumeSpace { block, degree });
                let mut sum = [0.0; 5];
                for k in 0..2 {
                    let a = 1.0 + ((k as f64 + 0.5) / 2.0 - 0.5) / per_a;
                    let found = rubber::hertz(&Case { nu: 0.4999, basis, per_a, a, volume: Some(space), ..PLANE });
                    sum.iter_mut().zip(found).for_each(|(s, v)| *s += v / 2.0);
                }
                let [l2, peak, ripple, body, wild] = sum;
                println!(
                    "{:11}{:12}{per_a:7} {l2:8.3}{peak:8.3}{ripple:8.3} | {body:9.3}{wild:9.3}",
                    name(basis),
                    label(space)
                );
            }
        }
    }
    if runs("cost") {
        cost_table(0.05);
        cost_table(0.025);
    }
    if runs("extreme") {
        hertz_table(&[0.4999], 9.0);
    }
}
