//! A scene computed into a folder: march, record, draw, and say in `run.json` how it went.

use std::cell::RefCell;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde_json::{Value, json};

use crate::contact::ContactDiscretization;
use crate::math::Counters;
use crate::model::{Model, Pair, Record, State};
use crate::output::tables::CertifyRow;
use crate::output::{OutputError, RunFolder};
use crate::solve::{Control, Outcome, Status, Tools, accompanied};
use crate::verify::conic::{Companion, Stage};
use crate::verify::{Audit, Expectations, Finding, step_warnings};

use super::certify::{self, Certifier};
use super::recorder::Recorder;
use super::spec::Scene;

/// How a run went.
#[derive(Debug)]
pub struct RunReport {
    /// How the march ended.
    pub outcome: Outcome,
    /// Audits of all records, also of a march that ended early.
    pub findings: Vec<Finding>,
    /// Accepted steps that were certified.
    pub certified: Vec<CertifyRow>,
}

/// The nominal steps of a scene.
pub fn time_plan(scene: &Scene) -> Control {
    Control {
        end: scene.time.end,
        steps: scene.time.steps,
        max_cuts: scene.time.max_cuts,
        strategy: scene.solution.strategy,
    }
}

/// Computes a scene and writes everything into `folder`; `watch` sees each nominal step as it is reached. Whatever the
/// outcome, all steps before it are on disk. Setting `interrupt` stops at the next iteration.
///
/// # Errors
/// A file that cannot be written; how the computation went is told by the [`RunReport`].
pub fn run(
    scene: &Scene,
    model: &Model,
    folder: &RunFolder,
    interrupt: &AtomicBool,
    mut watch: impl FnMut(&Record),
) -> Result<RunReport, OutputError> {
    let clock = Instant::now();
    let plan = time_plan(scene);
    let mut warnings = step_warnings(model, &plan);
    folder.write_run(&summary(scene, model, &warnings, json!({ "status": "running" })))?;
    let mut recorder = Recorder::new(scene, model, folder)?;
    let state = State::initial(model);
    recorder.start(&state)?;
    let mut audit = Audit::new(Expectations::of(model));
    let mut reached = 0;
    let mut solver = scene.solution.solver.create();
    let mut certifier = Certifier::new(scene, folder)?;
    let fresh = RefCell::default();
    let mut companion =
        Companion { certified: scene.solution.certify.then_some(&fresh), interrupt, stage: Stage::default() };
    let tools = Tools { solver: solver.as_mut(), witness: &mut companion };
    let outcome = accompanied(model, state, &plan, tools, interrupt, |report| {
        recorder.step(&report)?;
        certifier.take(report.record.step, fresh.take())?;
        audit.take(&report.record);
        reached = report.record.step;
        watch(&report.record);
        Ok::<(), OutputError>(())
    })?;
    certifier.take(reached + 1, fresh.take())?;
    recorder.finish(scene)?;
    certifier.draw(scene)?;
    let mut findings = audit.findings();
    findings.extend(certifier.findings());
    let report = RunReport { outcome, findings, certified: certifier.rows };
    warnings.extend(report.findings.iter().filter(|finding| finding.warns()).map(Finding::to_string));
    let result = conclusion(&report, &solver.counters(), reached, clock.elapsed().as_secs_f64());
    folder.write_run(&summary(scene, model, &warnings, result))?;
    Ok(report)
}

fn conclusion(report: &RunReport, solver: &Counters, reached: usize, wall_s: f64) -> Value {
    let outcome = &report.outcome;
    json!({
        "status": status_name(&outcome.status),
        "reason": reason(&outcome.status),
        "time_reached": outcome.state.time,
        "counters": {
            "nominal_steps": reached, "steps": outcome.steps, "cuts": outcome.cuts,
            "newton_iterations": outcome.iterations, "factorisations": solver.factorisations,
            "lagged_steps": outcome.lagged, "rescued_steps": outcome.rescued, "analyses": solver.analyses, "dense_rows": solver.dense_rows,
        },
        "sparse_lu_instead": {
            "indefinite": solver.indefinite, "coupled": solver.coupled, "inaccurate": solver.inaccurate,
        },
        "certified": certify::summary(&report.certified),
        "audit": {
            "passed": !report.findings.iter().any(Finding::failed),
            "checks": report.findings,
        },
        "wall_s": wall_s,
    })
}

/// Name of a status in `run.json`.
pub fn status_name(status: &Status) -> &'static str {
    match status {
        Status::Done => "done",
        Status::NotConverged { .. } => "not converged",
        Status::Interrupted { .. } => "interrupted",
    }
}

fn reason(status: &Status) -> Option<&str> {
    match status {
        Status::NotConverged { reason, .. } => Some(reason),
        _ => None,
    }
}

fn summary(scene: &Scene, model: &Model, warnings: &[String], result: Value) -> Value {
    json!({
        "program": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
        "scene": scene,
        "model": sizes(model),
        "warnings": warnings,
        "result": result,
    })
}

/// Sizes of a model and the numerical choices that were made for its pairs.
pub fn sizes(model: &Model) -> Value {
    json!({
        "bodies": model.bodies.len(),
        "control_points": model.nodes(),
        "unknowns": model.unknowns(),
        "displacement_unknowns": model.equations.count,
        "contact_unknowns": model.boundary.len(),
        "stress_scale": model.modulus,
        "element_size": model.element_size,
        "pairs": model.pairs.iter().map(pair).collect::<Vec<_>>(),
    })
}

fn pair(pair: &Pair) -> Value {
    let numerics = pair.contact.numerics();
    json!({
        "multipliers": pair.unknowns(),
        "sites": format!("{:?}", numerics.sites).to_lowercase(),
        "projection": format!("{:?}", numerics.projection).to_lowercase(),
        "integration": format!("{:?}", numerics.integration).to_lowercase(),
        "points": numerics.points,
        "r": numerics.r * pair.contact.augmentation(),
        "r_tangential": numerics.r_tangential * pair.contact.augmentation(),
    })
}
