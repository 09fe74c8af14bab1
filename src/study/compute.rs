//! One scene computed into a folder of a study, and what became of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use cpu_time::ThreadTime;

use super::{PointState, PointStatus};
use crate::model::Record;
use crate::output::{OutputError, RunFolder};
use crate::scene::{self, Checkpoint, RunReport, Scene, SceneError};
use crate::solve::Status;
use crate::verify::Finding;

/// Where a run begins that was stopped before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// At its last checkpoint.
    GoOn,
    /// At the beginning, so that its cost is that of the whole.
    Anew,
}

/// Computes a scene on this thread into the folder at `path`, and leaves its status there. Files that the scene names are
/// looked for in `base_dir`.
pub(super) fn compute_scene(
    scene: impl FnOnce() -> Result<Scene, SceneError>,
    base_dir: &Path,
    path: &Path,
    start: Start,
    interrupt: &AtomicBool,
    watch: impl FnMut(&Record),
) -> PointStatus {
    let (clock, cpu) = (Instant::now(), ThreadTime::now());
    let stopped = matches!(PointStatus::read(path).status, PointState::Interrupted | PointState::Running);
    let attempt = || {
        let run = RunFolder::create(path)?;
        PointStatus::plain(PointState::Running).write(path)?;
        computed(scene, base_dir, &run, stopped && start == Start::GoOn, interrupt, watch)
    };
    let over = catch_unwind(AssertUnwindSafe(attempt));
    let (status, reason) = match over {
        Ok(Ok(ending)) => ending,
        Ok(Err(error)) => (PointState::Internal, error.to_string()),
        Err(panic) => (PointState::Internal, said(&*panic)),
    };
    let (wall_s, cpu_s) = (clock.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
    let status = PointStatus { status, reason, wall_s, cpu_s, ..PointStatus::plain(status) };
    match status.write(path) {
        Ok(()) => status,
        Err(error) => PointStatus { status: PointState::Internal, reason: error.to_string(), ..status },
    }
}

fn computed(
    scene: impl FnOnce() -> Result<Scene, SceneError>,
    base_dir: &Path,
    folder: &RunFolder,
    resume: bool,
    interrupt: &AtomicBool,
    watch: impl FnMut(&Record),
) -> Result<(PointState, String), OutputError> {
    let built = scene().and_then(|scene| {
        let model = scene::build(&scene, base_dir)?;
        Ok((scene, model))
    });
    match built {
        Ok((scene, model)) => {
            // a checkpoint that cannot be read costs the steps before it, no more
            let kept = resume.then(|| Checkpoint::load(folder, &scene, &model).ok().flatten()).flatten();
            let start = kept.unwrap_or_else(|| Checkpoint::start(&scene, &model));
            Ok(ending(&scene::resume(&scene, &model, folder, start, interrupt, watch)?))
        }
        Err(error) => Ok((PointState::BadInput, in_one_line(&error))),
    }
}

/// State of a run that is over, and why it is not done.
fn ending(RunReport { outcome, findings, .. }: &RunReport) -> (PointState, String) {
    let failed: Vec<String> = findings.iter().filter(|f| f.failed()).map(Finding::to_string).collect();
    match &outcome.status {
        Status::Done if failed.is_empty() => (PointState::Done, String::new()),
        Status::Done => (PointState::AuditFailed, failed.join("; ")),
        Status::NotConverged { time, reason } => {
            (PointState::NotConverged, format!("no convergence after time {time}: {reason}"))
        }
        Status::Interrupted { time } => (PointState::Interrupted, format!("stopped after time {time}")),
    }
}

fn in_one_line(error: &SceneError) -> String {
    let one = |issue: &crate::scene::Issue| format!("{}: {}", issue.key, issue.message);
    error.0.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// The message of a panic.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("panicked: {}", text.unwrap_or("no message"))
}
