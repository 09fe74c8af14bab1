//! Effectivity of the error estimate of a run: estimate over true error, scenes of `examples/` and `papers/` at their own
//! resolution and at others. True error: against elements finer by a factor in both directions.
//! `cargo bench --bench effectivity` prints the table of `papers/trade/effectivity.md`, with `-- WORD` the rows that hold it.

use std::convert::Infallible;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use asperity::model::{Record, State};
use asperity::scene::{self, Scene};
use asperity::solve::{Outcome, Recall, Status, Tools, Ways, proceed};
use asperity::verify::{Estimate, Estimator, Quantity};
use cpu_time::ThreadTime;

/// A scene with changes, at some resolutions (factors on its numbers of elements), and the one that counts as exact.
struct Case(&'static str, &'static [&'static str], &'static [f64], f64);

const LAGRANGE_1: &[&str] =
    &["body.lower.basis={type=\"lagrange\",degree=1}", "body.upper.basis={type=\"lagrange\",degree=1}"];
const LAGRANGE_2: &[&str] =
    &["body.lower.basis={type=\"lagrange\",degree=2}", "body.upper.basis={type=\"lagrange\",degree=2}"];
const CUBIC: &[&str] = &["body.lower.basis={type=\"nurbs\",degree=3}", "body.upper.basis={type=\"nurbs\",degree=3}"];
const RUBBER: &[&str] = &["material.rubber.poissons_ratio=0.4999", "contact.0.law.friction=0.1"];

/// The first ones are those on which the estimate was chosen, the others came after.
const CASES: [Case; 15] = [
    Case("examples/single_asperity", &[], &[0.5, 1.0], 3.0),
    Case("examples/single_asperity", &["contact.0.law={type=\"frictionless\"}"], &[0.5, 1.0], 3.0),
    Case("examples/single_asperity", LAGRANGE_1, &[0.5, 1.0], 3.0),
    Case("examples/single_asperity", CUBIC, &[0.5, 1.0], 3.0),
    Case("examples/multi_asperity", &[], &[0.5, 1.0], 3.0),
    Case("examples/hertz", &[], &[0.5, 1.0, 2.0], 4.0),
    Case("examples/cattaneo_mindlin", &[], &[0.5, 1.0, 2.0], 4.0),
    Case("papers/ostermeyer-2021/single", &[], &[0.5, 1.0, 2.0], 4.0),
    Case("papers/ostermeyer-2021/load", &[], &[0.5, 1.0], 3.0),
    Case("papers/peers/nurbs", &[], &[1.0, 2.0], 4.0),
    Case("papers/stability/scene", &[], &[1.0], 3.0),
    Case("examples/expression_law", &[], &[1.0], 3.0),
    Case("papers/peers/nurbs", LAGRANGE_2, &[1.0, 2.0], 4.0),
    Case("papers/peers/nurbs", RUBBER, &[1.0, 2.0], 4.0),
    Case("papers/peers/nurbs", &["contact.0.numerics.sites=\"nodal\""], &[1.0, 2.0], 4.0),
];

/// A run with its estimate and the share of the time that this took.
struct Run {
    unknowns: usize,
    records: Vec<Record>,
    estimate: Estimate,
    share: f64,
}

fn compute(case: &Case, factor: f64) -> Result<Run, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(case.0).with_extension("toml");
    let sets: Vec<String> = case.1.iter().map(|set| set.to_string()).collect();
    let (mut scene, _) = Scene::load(&path, &sets).map_err(|error| error.to_string())?;
    for body in scene.body.values_mut() {
        body.elements = body.elements.map(|n| (n as f64 * factor).round() as usize);
    }
    let model = scene::build(&scene, path.parent().unwrap()).map_err(|error| error.to_string())?;
    let plan = scene::time_plan(&scene);
    let ways = Ways::new(&model, &plan);
    let (mut recall, mut solver) = (Recall::new(&ways, (), vec![]), scene.solution.solver.create());
    let tools = Tools { solver: solver.as_mut(), witness: &mut recall };
    let (mut records, mut estimator) = (vec![], Estimator::new(&model));
    let (clock, mut spent, quiet) = (ThreadTime::now(), Duration::ZERO, AtomicBool::new(false));
    let outcome = proceed(&model, Outcome::at(State::initial(&model)), &plan, tools, &quiet, |report| {
        let clock = ThreadTime::now();
        estimator.take(&model, &report.record, report.state, report.evaluation);
        spent += clock.elapsed();
        records.push(report.record);
        Ok::<(), Infallible>(())
    });
    match outcome.unwrap_or_else(|e| match e {}).status {
        Status::Done => {}
        status => return Err(format!("{status:?}")),
    }
    let share = spent.as_secs_f64() / clock.elapsed().as_secs_f64();
    Ok(Run { unknowns: model.unknowns(), records, estimate: estimator.estimate(), share })
}

/// Root mean square of the difference over the steps in contact of the reference, over the peak.
fn difference(run: &Run, exact: &Run) -> f64 {
    let value = |record: &Record| match run.estimate.quantity {
        Quantity::Forces => record.force,
        Quantity::Way => record.drive,
    };
    let (mut sum, mut count, mut peak) = (0.0, 0.0, 0.0_f64);
    for (a, b) in run.records.iter().zip(&exact.records) {
        let ([ax, ay], [bx, by]) = (value(a), value(b));
        peak = peak.max(bx.hypot(by));
        if b.contact_length > 0.0 {
            sum += (ax - bx).powi(2) + (ay - by).powi(2);
            count += 1.0;
        }
    }
    f64::sqrt(sum / count) / peak
}

fn measure(case: &Case) {
    let changes = if case.1.is_empty() { "as it is".to_string() } else { case.1[0].replace("body.lower.", "") };
    let exact = match compute(case, case.3) {
        Ok(exact) => exact,
        Err(why) => return println!("| {} | {changes} | no reference: {why} |", case.0),
    };
    for &factor in case.2 {
        match compute(case, factor) {
            Ok(run) => {
                let percent = |share: Option<f64>| share.map_or("?".into(), |share| format!("{:.3}", 100.0 * share));
                let (found, truth) = (&run.estimate, difference(&run, &exact));
                println!(
                    "| {} | {changes} | {factor} of {} | {} | {} | {}, {} | {:.3} | {:.2} | {} | {:.1} % |",
                    case.0,
                    case.3,
                    run.unknowns,
                    percent(found.error),
                    percent(found.space),
                    percent(found.contact),
                    100.0 * truth,
                    found.error.unwrap_or(f64::NAN) / truth,
                    percent(found.between_steps),
                    100.0 * run.share
                );
            }
            Err(why) => println!("| {} | {changes} | {factor} | {why} |", case.0),
        }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    println!(
        "| scene | change | elements | unknowns | estimate, % | mesh, contact, % | true, % | effectivity | between steps, % | CPU |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let wanted = |case: &&Case| words.iter().all(|word| format!("{} {:?}", case.0, case.1).contains(word));
    CASES.iter().filter(wanted).for_each(measure);
}
