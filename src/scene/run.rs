//! A scene computed into a folder: march, record, draw, and say in `run.json` how it went.

use std::cell::RefCell;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use serde_json::{Map, Value, json};

use crate::contact::ContactDiscretization;
use crate::math::Counters;
use crate::model::{Body, Model, Pair, Record};
use crate::output::tables::{CertifyRow, write_events};
use crate::output::{OutputError, RunFolder, checkpoint};
use crate::solve::{Control, Outcome, Recall, Status, Tools, Ways, proceed};
use crate::verify::conic::{Companion, Stage};
use crate::verify::{self, Estimate, Finding};

use super::archive::Archive;
use super::certify::{self, Certifier};
use super::checkpoint::Checkpoint;
use super::describe::{left_out, modelled};
use super::recorder::Recorder;
use super::spec::Scene;

/// Time between two waits for the disk itself. A killed program loses no step that was reached, whatever this is; a power failure
/// loses those since. Waiting after every step would cost more than a step of a small scene.
const SYNC_EVERY: Duration = Duration::from_secs(1);

/// How a run went.
#[derive(Debug)]
pub struct RunReport {
    /// How the march ended.
    pub outcome: Outcome,
    /// Audits of all records, also of a march that ended early.
    pub findings: Vec<Finding>,
    /// Accepted steps that were certified.
    pub certified: Vec<CertifyRow>,
    /// How accurate the forces are.
    pub estimate: Estimate,
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
    watch: impl FnMut(&Record),
) -> Result<RunReport, OutputError> {
    resume(scene, model, folder, Checkpoint::start(scene, model), interrupt, watch)
}

/// Goes on from a checkpoint of this scene in `folder`: in the end all files are those of a run in one go, bit for bit, wall
/// times apart. A new checkpoint is written after every nominal step.
///
/// # Errors
/// As [`run`].
pub fn resume(
    scene: &Scene,
    model: &Model,
    folder: &RunFolder,
    mut at: Checkpoint,
    interrupt: &AtomicBool,
    mut watch: impl FnMut(&Record),
) -> Result<RunReport, OutputError> {
    let (clock, before) = (Instant::now(), at.wall_s());
    let wall_s = || before + clock.elapsed().as_secs_f64();
    let plan = time_plan(scene);
    let mut warnings = verify::warnings(model, &plan);
    folder.tidy()?;
    checkpoint::create_folder(&folder.checkpoint())?;
    at.write(folder, false, true)?;
    folder.write_run(&summary(scene, model, &warnings, json!({ "status": "running" })))?;
    let mut recorder = Recorder::open(scene, model, folder, at.step())?;
    let mut solver = scene.solution.solver.create();
    solver.recall(at.solver.clone());
    let mut certifier = Certifier::new(scene, folder, at.step())?;
    let fresh = RefCell::default();
    let companion =
        Companion { certified: scene.solution.certify.then_some(&fresh), interrupt, stage: Stage::default() };
    let ways = Ways::new(model, &plan);
    let (mut archive, seen) = Archive::open(folder, model, &ways, at.step())?;
    let mut recall = Recall::new(&ways, companion, seen);
    let tools = Tools { solver: solver.as_mut(), witness: &mut recall };
    let mut synced = Instant::now();
    let outcome = proceed(model, at.outcome.clone(), &plan, tools, interrupt, |report| {
        recorder.step(&report)?;
        archive.step(report.record.step, report.state)?;
        certifier.take(report.record.step, fresh.take())?;
        at.take(model, &report, wall_s());
        let sync = synced.elapsed() >= SYNC_EVERY;
        if sync {
            recorder.sync()?;
            archive.sync()?;
            synced = Instant::now();
        }
        at.write(folder, false, sync)?;
        watch(&report.record);
        Ok::<(), OutputError>(())
    })?;
    certifier.take(at.step() + 1, fresh.take())?;
    write_events(&folder.events(), &outcome.log.events)?;
    recorder.finish(scene)?;
    recorder.sync()?;
    certifier.draw(scene)?;
    let mut findings = at.findings();
    findings.extend(certifier.findings());
    let report = RunReport { outcome, findings, certified: certifier.rows, estimate: at.estimate() };
    warnings.extend(report.estimate.warning(model));
    warnings.extend(report.findings.iter().filter(|finding| finding.warns()).map(Finding::to_string));
    let result = conclusion(model, &report, &solver.counters(), at.step(), wall_s());
    folder.write_run(&summary(scene, model, &warnings, result))?;
    at.write(folder, report.outcome.status == Status::Done, true)?;
    Ok(report)
}

fn conclusion(model: &Model, report: &RunReport, solver: &Counters, reached: usize, wall_s: f64) -> Value {
    let outcome = &report.outcome;
    json!({
        "status": status_name(&outcome.status),
        "reason": reason(&outcome.status),
        "time_reached": outcome.state.time,
        "counters": {
            "nominal_steps": reached, "steps": outcome.steps, "cuts": outcome.cuts,
            "newton_iterations": outcome.iterations, "factorisations": solver.factorisations,
            "recalled_steps": outcome.recalled, "lagged_steps": outcome.lagged, "rescued_steps": outcome.rescued, "snaps": outcome.snaps,
            "analyses": solver.analyses, "dense_rows": solver.dense_rows,
        },
        "sparse_lu_instead": {
            "indefinite": solver.indefinite, "coupled": solver.coupled, "inaccurate": solver.inaccurate,
        },
        "events": outcome.log.events,
        "earlier_events": outcome.log.dropped,
        "certified": certify::summary(&report.certified),
        "audit": {
            "passed": !report.findings.iter().any(Finding::failed),
            "checks": report.findings,
        },
        "estimated_error": report.estimate,
        "advice": report.estimate.advice(model),
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
        "modelled": modelled(scene, model),
        "left_out": left_out(scene, model),
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
        "volumetric": model.bodies.iter().filter_map(volumetric).collect::<Map<_, _>>(),
        "pairs": model.pairs.iter().map(pair).collect::<Vec<_>>(),
    })
}

fn volumetric(body: &Body) -> Option<(String, Value)> {
    Some((body.name.clone(), body.volumetric()?.into()))
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
