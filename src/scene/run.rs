//! A scene computed into a folder: march, record, draw, and say in `run.json` how it went.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde_json::{Value, json};

use crate::contact::ContactDiscretization;
use crate::math::SparseLu;
use crate::model::{Model, Pair, Record, State};
use crate::output::{OutputError, RunFolder};
use crate::solve::{Control, Outcome, Status, march};

use super::recorder::Recorder;
use super::spec::Scene;

/// Computes a scene and writes everything into `folder`; `watch` sees each nominal step as it is reached. Whatever the
/// outcome, all steps before it are on disk. Setting `interrupt` stops at the next iteration.
///
/// # Errors
/// A file that cannot be written; how the computation went is told by the [`Outcome`].
pub fn run(
    scene: &Scene,
    model: &Model,
    folder: &RunFolder,
    interrupt: &AtomicBool,
    mut watch: impl FnMut(&Record),
) -> Result<Outcome, OutputError> {
    let clock = Instant::now();
    folder.write_run(&summary(scene, model, json!({ "status": "running" })))?;
    let mut recorder = Recorder::new(scene, model, folder)?;
    let state = State::initial(model);
    recorder.start(&state)?;
    let control = Control { end: scene.time.end, steps: scene.time.steps, max_cuts: scene.time.max_cuts };
    let mut worst = Worst::default();
    let outcome = march(model, state, &control, &mut SparseLu::default(), interrupt, |report| {
        recorder.step(&report)?;
        worst.take(&report.record);
        watch(&report.record);
        Ok::<(), OutputError>(())
    })?;
    recorder.finish(scene)?;
    let result = conclusion(&outcome, &worst, clock.elapsed().as_secs_f64());
    folder.write_run(&summary(scene, model, result))?;
    Ok(outcome)
}

fn conclusion(outcome: &Outcome, worst: &Worst, wall_s: f64) -> Value {
    json!({
        "status": status_name(&outcome.status),
        "reason": reason(&outcome.status),
        "time_reached": outcome.state.time,
        "counters": {
            "nominal_steps": worst.steps, "steps": outcome.steps, "cuts": outcome.cuts,
            "newton_iterations": outcome.iterations, "factorisations": outcome.factorisations,
        },
        "audit": worst.to_json(),
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

fn summary(scene: &Scene, model: &Model, result: Value) -> Value {
    json!({
        "program": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
        "scene": scene,
        "model": sizes(model),
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

/// Largest violations of balance over all steps.
#[derive(Default)]
struct Worst {
    steps: usize,
    force_imbalance: f64,
    moment_imbalance: f64,
    reaction_mismatch: f64,
    largest_force: f64,
}

impl Worst {
    fn take(&mut self, record: &Record) {
        self.steps = record.step;
        self.force_imbalance = self.force_imbalance.max(record.force_imbalance);
        self.moment_imbalance = self.moment_imbalance.max(record.moment_imbalance);
        for (top, base) in record.force.iter().zip(record.reaction_base) {
            self.reaction_mismatch = self.reaction_mismatch.max((top - base).abs());
            self.largest_force = self.largest_force.max(top.abs());
        }
    }

    fn to_json(&self) -> Value {
        let relative = if self.largest_force > 0.0 { self.reaction_mismatch / self.largest_force } else { 0.0 };
        json!({
            "interface_force_imbalance": self.force_imbalance,
            "interface_moment_imbalance": self.moment_imbalance,
            "driven_minus_base_reaction": relative,
        })
    }
}
