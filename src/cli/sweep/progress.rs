//! How far a sweep is, and when it will be done.

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::study::{Event, Point, PointState};

/// A bar on a terminal, one line a point elsewhere, nothing when quiet. On stderr: stdout stays for results.
pub struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    clock: Instant,
    /// Nominal steps of all points, and of those that are over.
    steps: u64,
    done: u64,
    /// Nominal steps reached by points that are not over yet.
    open: BTreeMap<usize, u64>,
    points: usize,
    finished: usize,
    failed: usize,
}

impl Progress {
    /// Progress of the points that are to be computed.
    pub fn new(points: &[&Point], quiet: bool) -> Self {
        let steps = points.iter().map(|point| point.steps as u64).sum();
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet && !points.is_empty()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{bar:30} {percent}% {elapsed} (left {eta})  {msg}");
            bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        let (lines, count) = (!terminal && !quiet, points.len());
        Self {
            bar,
            lines,
            clock: Instant::now(),
            steps,
            done: 0,
            open: BTreeMap::new(),
            points: count,
            finished: 0,
            failed: 0,
        }
    }

    /// Takes what is told of the sweep.
    pub fn take(&mut self, event: &Event) {
        match event {
            Event::Step(point) => *self.open.entry(point.index).or_default() += 1,
            Event::Finished(point, status) => {
                // the steps of a point that failed early need not be waited for
                self.finished += 1;
                self.failed += usize::from(status.status.failed());
                self.done += point.steps as u64;
                self.open.remove(&point.index);
                if self.lines && status.status != PointState::Interrupted {
                    self.line(point, status.status.name(), &status.reason);
                }
            }
        }
        if let Some(bar) = &self.bar {
            let failed = if self.failed > 0 { format!(", {} failed", self.failed) } else { String::new() };
            bar.set_position(self.reached());
            bar.set_message(format!("{}/{} points{failed}", self.finished, self.points));
        }
    }

    fn reached(&self) -> u64 {
        self.done + self.open.values().sum::<u64>()
    }

    fn line(&self, point: &Point, state: &str, reason: &str) {
        let reason = if reason.is_empty() { String::new() } else { format!(": {reason}") };
        let (count, all) = (self.finished, self.points);
        let left = HumanDuration(self.left());
        // a closed stderr must not stop a computation
        let _ = writeln!(std::io::stderr(), "{count}/{all}  point {} {state}{reason}  (left: {left})", point.index);
    }

    /// Time left if the remaining steps take as long as those so far.
    fn left(&self) -> Duration {
        let (done, all) = (self.reached() as f64, self.steps as f64);
        if done == 0.0 { Duration::ZERO } else { self.clock.elapsed().mul_f64((all - done) / done) }
    }

    /// Leaves the last state on the terminal.
    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.abandon();
        }
    }
}
