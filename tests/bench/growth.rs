//! How the cost of a Newton iteration grows with the unknowns and with the number of asperities, each case in a process of its
//! own: `cargo bench --bench growth` (minutes), `-- many` or `-- size` for one of the two tables, `-- short` without the
//! largest cases.

mod growth {
    pub mod case;
    pub mod scene;
}

use std::process::Command;

use growth::case::{self, Found};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    if let [flag, kind, size, solver] = &arguments[..]
        && flag == "case"
    {
        return println!("{}", case::run(kind, size.parse().expect("a number"), solver));
    }
    let asked = |word: &str| arguments.iter().any(|a| a == word);
    let short = asked("short");
    if !asked("size") {
        many(if short { &[1, 4, 16] } else { &[1, 4, 16, 64] });
    }
    if !asked("many") {
        size("B-spline p = 2", "spline", short);
        size("Lagrange p = 1", "lagrange", short);
    }
}

/// One case in a fresh process, so that its memory is its own.
fn alone(kind: &str, size: usize, solver: &str) -> Found {
    let program = std::env::current_exe().expect("this program");
    let output = Command::new(program).args(["case", kind, &size.to_string(), solver]).output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout);
    Found::parse(&text).unwrap_or_else(|| panic!("{text}{}", String::from_utf8_lossy(&output.stderr)))
}

fn many(counts: &[usize]) {
    println!(
        "\n| asperities | unknowns | iterations | analyses | dense rows (all) | evaluation, ms | condensed, ms | of it dense LU | sparse LU, ms | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for &count in counts {
        let (found, lu) = (alone("many", count, "condensed"), alone("many", count, "sparse"));
        println!(
            "| {count} | {} | {} | {} | {} ({}) | {:.1} | {:.1} | {:.0} % | {:.1} | {:.1} |",
            found.unknowns,
            found.iterations,
            found.analyses,
            found.dense,
            found.possible,
            1e3 * found.evaluation,
            1e3 * found.mean,
            100.0 * found.dense_lu / found.mean,
            1e3 * lu.mean,
            lu.mean / found.mean,
        );
    }
}

fn size(name: &str, kind: &str, short: bool) {
    println!("\n{name}\n");
    println!(
        "| unknowns | dense rows | analyses | evaluation, ms | solution, ms | of it dense LU | together, ms | memory, MB |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let (mut times, mut memory) = (vec![], vec![]);
    let sizes: &[usize] = if short { &[5_000, 20_000, 50_000] } else { &[5_000, 20_000, 50_000, 100_000, 300_000] };
    for &size in sizes {
        let found = alone(kind, size, "condensed");
        let (n, together) = (found.unknowns as f64, found.evaluation + found.median);
        println!(
            "| {n} | {} | {} | {:.0} | {:.0} | {:.0} % | {:.0} | {:.0} |",
            found.dense,
            found.analyses,
            1e3 * found.evaluation,
            1e3 * found.median,
            100.0 * found.dense_lu / found.median,
            1e3 * together,
            found.memory / 1e6,
        );
        times.push((n, together));
        memory.push((n, found.memory));
    }
    println!("\nexponents: time {:.2}, memory {:.2}", exponent(&times), exponent(&memory));
}

/// Slope of the straight line through the logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x).powi(2))
}
