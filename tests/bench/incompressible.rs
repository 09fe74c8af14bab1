//! Rubber near incompressibility: locking, pressure and cost by space of the dilatations, for every basis
//! (papers/incompressible): `cargo bench --bench incompressible [-- hertz | ring | cook | cost]`.

#[path = "../support/hertz.rs"]
mod hertz;
#[path = "../support/rubber.rs"]
mod rubber;

use asperity::bulk::VolumeSpace;
use asperity::geometry::BasisSpec;
use hertz::{Case, PLANE};

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
    if runs("extreme") {
        hertz_table(&[0.4999], 9.0);
    }
}
