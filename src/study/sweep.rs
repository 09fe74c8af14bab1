//! Points computed in parallel: threads across points, one thread inside each, so that every run is bitwise what it is alone.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;

use super::compute::{Start, compute_scene};
use super::{Point, PointStatus, Study, StudyFolder};
use crate::model::Record;

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
    let scene = || study.scene(point.index).map(|(scene, _)| scene);
    compute_scene(scene, study.base_dir(), &folder.point(point), Start::GoOn, interrupt, watch)
}
