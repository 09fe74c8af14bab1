//! What a run needs to go on bit for bit, and the proof that it is the same run.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::issue::KeyPath;
use super::spec::{Scene, TimeSpec};
use crate::contact::ContactDiscretization;
use crate::math::{SolverMemory, checksum};
use crate::model::{Model, PairState, State};
use crate::output::{OutputError, RunFolder, checkpoint};
use crate::solve::{Outcome, StepReport};
use crate::verify::{Audit, Estimate, Estimator, Expectations, Finding};

/// Differences that are listed; the rest is counted.
const LISTED: usize = 8;

/// Why a run cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint cannot be read, or is not one of this program.
    #[error(transparent)]
    Unreadable(#[from] OutputError),
    /// The checkpoint belongs to another scene.
    #[error("the checkpoint {} is of another run:{}", path.display(), listed(differences))]
    OtherRun {
        /// The checkpoint.
        path: PathBuf,
        /// What differs, one entry a key.
        differences: Vec<String>,
    },
}

fn listed(differences: &[String]) -> String {
    let more = differences.len().saturating_sub(LISTED);
    let lines: String = differences.iter().take(LISTED).map(|line| format!("\n  - {line}")).collect();
    if more > 0 { format!("{lines}\n  - and {more} more") } else { lines }
}

/// A run at the end of a nominal step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The scene with all defaults, as JSON.
    scene: String,
    /// Checksum of all control points and weights: files that the scene names may change without it.
    geometry: u64,
    step: usize,
    done: bool,
    wall_s: f64,
    pub(super) outcome: Outcome,
    pub(super) solver: SolverMemory,
    audit: Audit,
    estimator: Estimator,
}

impl Checkpoint {
    /// Before the first step.
    pub fn start(scene: &Scene, model: &Model) -> Self {
        Self {
            scene: json(scene).to_string(),
            geometry: geometry(model),
            step: 0,
            done: false,
            wall_s: 0.0,
            outcome: Outcome::at(State::initial(model)),
            solver: SolverMemory::default(),
            audit: Audit::new(Expectations::of(model)),
            estimator: Estimator::new(model),
        }
    }

    /// The checkpoint in a folder, if it is of this scene; `None` where there is none. A later end with steps of the same length
    /// is still the same run; more cuts are let through, so that a run that did not converge can be tried on from its last step.
    ///
    /// # Errors
    /// A file that cannot be used, or what differs.
    pub fn load(folder: &RunFolder, scene: &Scene, model: &Model) -> Result<Option<Self>, ResumeError> {
        let path = file(folder);
        let Some(found) = checkpoint::read::<Self>(&path)? else { return Ok(None) };
        let differences = found.differences(scene, model);
        if !differences.is_empty() {
            return Err(ResumeError::OtherRun { path, differences });
        }
        if !fits(&found.outcome.state, model) {
            return Err(
                OutputError::content(&path, "its state is not one of this scene: written by another build?").into()
            );
        }
        Ok(Some(Self { scene: json(scene).to_string(), ..found }))
    }

    /// Last nominal step and number of steps of an unfinished run in a folder, if there is one.
    pub fn unfinished(folder: &RunFolder) -> Option<(usize, u64)> {
        let found = checkpoint::read::<Self>(&file(folder)).ok()??;
        let steps = serde_json::from_str::<Value>(&found.scene).ok()?["time"]["steps"].as_u64()?;
        (!found.done && found.step > 0).then_some((found.step, steps))
    }

    /// Last nominal step.
    pub fn step(&self) -> usize {
        self.step
    }

    /// Wall time of all steps so far in seconds.
    pub fn wall_s(&self) -> f64 {
        self.wall_s
    }

    /// True where nothing is left to be computed or written of a scene.
    pub fn finished(&self, scene: &Scene) -> bool {
        self.done && self.step == scene.time.steps
    }

    /// Audits of all steps so far.
    pub fn findings(&self) -> Vec<Finding> {
        self.audit.findings()
    }

    /// How accurate all steps so far are.
    pub fn estimate(&self) -> Estimate {
        self.estimator.estimate()
    }

    /// Moves on to the end of another step, `wall_s` seconds after the beginning.
    pub(super) fn take(&mut self, model: &Model, report: &StepReport, wall_s: f64) {
        self.step = report.record.step;
        self.wall_s = wall_s;
        self.outcome.clone_from(report.outcome);
        self.solver = report.solver.memory();
        self.audit.take(&report.record);
        self.estimator.take(model, &report.record, report.state, report.evaluation);
    }

    /// Writes it, with `done` where everything else is written too; with `sync` to the disk itself.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub(super) fn write(&mut self, folder: &RunFolder, done: bool, sync: bool) -> Result<(), OutputError> {
        self.done = done;
        checkpoint::write(&file(folder), self, sync)
    }

    /// What would make going on under `scene` another run than one from the start.
    fn differences(&self, scene: &Scene, model: &Model) -> Vec<String> {
        let Ok(mut before) = serde_json::from_str::<Value>(&self.scene) else {
            return vec!["its scene cannot be read".into()];
        };
        let now = json(scene);
        let earlier = serde_json::from_value::<TimeSpec>(before["time"].clone());
        // a relaxation time is a share of the end
        let extends = |earlier: TimeSpec| {
            self.extends(&earlier, &scene.time) && (scene.solution.viscosity == 0.0 || earlier.end == scene.time.end)
        };
        if earlier.is_ok_and(extends) {
            before["time"] = now["time"].clone();
        }
        let mut found = vec![];
        compare(&before, &now, &KeyPath::default(), &mut found);
        if found.is_empty() && geometry(model) != self.geometry {
            found.push("the control points of the bodies: has a profile file changed?".into());
        }
        found
    }

    /// Whether all steps so far would have been the same under another time plan, but for cuts that were not allowed.
    fn extends(&self, before: &TimeSpec, now: &TimeSpec) -> bool {
        let nominal = |time: &TimeSpec| time.end / time.steps as f64;
        let step = nominal(now);
        let on_time = self.step == 0 || self.outcome.state.time == step * self.step as f64;
        let later = now.steps >= self.step && step == nominal(before) && on_time;
        now.max_cuts >= before.max_cuts && (later || (now.end, now.steps) == (before.end, before.steps))
    }
}

fn file(folder: &RunFolder) -> PathBuf {
    folder.checkpoint().join("state.bin")
}

fn json(scene: &Scene) -> Value {
    serde_json::to_value(scene).expect("a scene is plain data")
}

/// Keys at which two trees differ, with both values.
fn compare(before: &Value, now: &Value, key: &KeyPath, found: &mut Vec<String>) {
    match (before, now) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys().filter(|key| !a.contains_key(*key)));
            keys.for_each(|k| compare(&before[k], &now[k], &key.at(k), found));
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().for_each(|(k, (a, b))| compare(a, b, &key.at(k), found));
        }
        _ if before == now => {}
        _ => {
            let short = |value: &Value| match value {
                Value::Null => "nothing".into(),
                Value::Object(_) | Value::Array(_) => "another value".into(),
                value => value.to_string(),
            };
            found.push(format!("{key}: {} in the checkpoint, {} now", short(before), short(now)));
        }
    }
}

/// Checksum of all control points and weights.
fn geometry(model: &Model) -> u64 {
    let points = model.bodies.iter().flat_map(|body| &body.points).flat_map(|p| [p.x, p.y]);
    let weights = model.bodies.iter().filter_map(|body| body.patch()).flat_map(|patch| patch.weights.iter().copied());
    checksum(points.chain(weights).map(f64::to_bits))
}

/// Whether a state has the sizes of a model.
fn fits(state: &State, model: &Model) -> bool {
    let unknowns = state.flat().count();
    let pair = |(state, pair): (&PairState, &crate::model::Pair)| {
        let (n, variables) = (pair.contact.multipliers(), pair.contact.variable_names().len());
        state.pressure.len() == n
            && state.traction.len() == if pair.contact.rubs() { n } else { 0 }
            && state.sites.iter().all(|site| site.variables.len() == variables)
    };
    state.u.len() == model.nodes()
        && state.pairs.len() == model.pairs.len()
        && state.pairs.iter().zip(&model.pairs).all(pair)
        && state.ledger.forces.len() == model.motions.len()
        && state.rates.velocity.len() == if model.inertia.is_some() { model.nodes() } else { 0 }
        && state.trend.iter().all(|t| t.rate.len() == unknowns && [0, unknowns].contains(&t.change.len()))
}
