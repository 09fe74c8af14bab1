//! What `asperity certify` prints.

use crate::output::tables::CertifyRow;
use crate::verify::conic::{Check, Difference};

/// Nominal steps without proof or agreement that are listed one by one.
const LISTED: usize = 10;

/// A short table: verdicts, largest differences, cost, and the steps that do not agree.
pub fn table(rows: &[CertifyRow]) -> String {
    let named = |name: &str| rows.iter().filter(|row| row.found.check.verdict.name() == name).count();
    let worst = |value: fn(&Difference) -> f64| {
        rows.iter().filter_map(|row| row.found.check.difference.as_ref()).map(value).fold(0.0, f64::max)
    };
    let sum = |value: fn(&CertifyRow) -> f64| rows.iter().map(value).sum::<f64>();
    let programmes = |check: &Check| check.solved.as_ref().map_or(0, |solved| solved.programmes) as f64;
    let mut text = format!(
        "conic cross-check of {} steps: {} agree, {} inconclusive, {} disagree\n",
        rows.len(),
        named("agrees"),
        named("inconclusive"),
        named("disagrees")
    );
    text += &format!("  {:<12} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "largest", "u", "p", "q", "Fx", "Fy");
    let largest = [worst(|d| d.u), worst(|d| d.p), worst(|d| d.q), worst(|d| d.force[0]), worst(|d| d.force[1])];
    text += &format!("  {:<12}", "difference");
    largest.iter().for_each(|value| text += &format!(" {value:>10.1e}"));
    let iterations = sum(|row| row.found.newton.iterations as f64);
    text += &format!(
        "\n  Newton: {iterations} iterations in {:.2} s; conic: {} programmes in {:.2} s\n",
        sum(|row| row.found.newton.wall_s),
        rows.iter().map(|row| programmes(&row.found.check)).sum::<f64>(),
        sum(|row| row.found.check.wall_s)
    );
    if rows.iter().any(|row| row.found.check.certificate.direct > 0) {
        text +=
            "  a direct law gives the traction itself: no cone is behind it, its sites are checked for that traction\n";
    }
    let doubtful = rows.iter().filter(|row| !row.found.check.verdict.reason().is_empty());
    for row in doubtful.take(LISTED) {
        let check = &row.found.check;
        text +=
            &format!("  step {} t {:.6}: {}, {}\n", row.step, check.time, check.verdict.name(), check.verdict.reason());
    }
    text
}
