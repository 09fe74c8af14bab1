//! Points computed in parallel: threads across points, one thread inside each, so that every run is bitwise what it is alone.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Instant;

use super::{Point, PointState, PointStatus, Study, StudyFolder};
use crate::model::Record;
use crate::output::{OutputError, RunFolder};
use crate::scene::{self, Checkpoint, RunReport, SceneError};
use crate::solve::Status;
use crate::verify::Finding;

/// How a sweep goes about its work.
#[derive(Clone, Copy, Debug)]
pub struct Jobs<'a> {
    /// Points computed at the same time, at least 1.
    pub workers: usize,
    /// Compute points again that failed.
    pub retry: bool,
    /// Set from outside to stop at the next iteration.
    pub interrupt: &'a AtomicBool,
}

impl Jobs<'_> {
    /// The points that are still to be computed, each folder once.
    pub fn pending<'p>(&self, folder: &StudyFolder, points: &'p [Point]) -> Vec<&'p Point> {
        let open = |point: &&Point| {
            let state = folder.status(point).status;
            !state.is_final() || (self.retry && state.failed())
        };
        let mut seen = BTreeSet::new();
        points.iter().filter(|point| seen.insert(&point.folder)).filter(open).collect()
    }
}

/// What is told of a sweep while it goes on.
#[derive(Debug)]
pub enum Event<'p> {
    /// A point reached its next nominal step.
    Step(&'p Point),
    /// A point is over.
    Finished(&'p Point, PointStatus),
}

/// Computes points, and tells `watch` on the way. Whatever becomes of one point, the others are computed.
pub fn sweep(study: &Study, folder: &StudyFolder, points: &[&Point], jobs: &Jobs, mut watch: impl FnMut(Event)) {
    let next = AtomicUsize::new(0);
    let (sender, events) = channel();
    thread::scope(|scope| {
        for _ in 0..jobs.workers.clamp(1, points.len().max(1)) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || work(study, folder, points, next, jobs.interrupt, &sender));
        }
        drop(sender);
        events.iter().for_each(&mut watch);
    });
}

fn work<'p>(
    study: &Study,
    folder: &StudyFolder,
    points: &[&'p Point],
    next: &AtomicUsize,
    interrupt: &AtomicBool,
    events: &Sender<Event<'p>>,
) {
    while !interrupt.load(Ordering::Relaxed) {
        let Some(point) = points.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
        // nobody listens any more only if the sweep is being torn down
        let status = compute(study, folder, point, interrupt, |_| drop(events.send(Event::Step(point))));
        let _ = events.send(Event::Finished(point, status));
    }
}

/// Computes one point into its folder, from where it was stopped if it was, and leaves its status there.
pub fn compute(
    study: &Study,
    folder: &StudyFolder,
    point: &Point,
    interrupt: &AtomicBool,
    watch: impl FnMut(&Record),
) -> PointStatus {
    let clock = Instant::now();
    let path = folder.point(point);
    let stopped = matches!(folder.status(point).status, PointState::Interrupted | PointState::Running);
    let attempt = || {
        let run = RunFolder::create(&path)?;
        PointStatus::plain(PointState::Running).write(&path)?;
        computed(study, point, &run, stopped, interrupt, watch)
    };
    let over = catch_unwind(AssertUnwindSafe(attempt));
    let (status, reason) = match over {
        Ok(Ok(ending)) => ending,
        Ok(Err(error)) => (PointState::Internal, error.to_string()),
        Err(panic) => (PointState::Internal, said(&*panic)),
    };
    let status = PointStatus { status, reason, wall_s: clock.elapsed().as_secs_f64() };
    match status.write(&path) {
        Ok(()) => status,
        Err(error) => PointStatus { status: PointState::Internal, reason: error.to_string(), ..status },
    }
}

fn computed(
    study: &Study,
    point: &Point,
    folder: &RunFolder,
    stopped: bool,
    interrupt: &AtomicBool,
    watch: impl FnMut(&Record),
) -> Result<(PointState, String), OutputError> {
    let built = study.scene(point.index).and_then(|(scene, _)| {
        let model = scene::build(&scene, study.base_dir())?;
        Ok((scene, model))
    });
    match built {
        Ok((scene, model)) => {
            // a checkpoint that cannot be read costs the steps before it, no more
            let kept = stopped.then(|| Checkpoint::load(folder, &scene, &model).ok().flatten()).flatten();
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
