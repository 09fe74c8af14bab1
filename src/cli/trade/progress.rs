//! How far a trade is.

use std::io::{IsTerminal, Write};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::study::trade::Event;

/// Ticks of the bar for a second of CPU time.
const TICKS: f64 = 10.0;

/// A bar over the effort on a terminal, one line a run elsewhere, nothing when quiet. On stderr: stdout stays for results.
pub struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    effort: f64,
    runs: usize,
    /// The run in progress: words, steps, steps reached.
    run: (String, usize, usize),
}

impl Progress {
    /// Progress of a search that may take so many seconds of CPU time.
    pub fn new(effort: f64, quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet).then(|| {
            let length = Some((TICKS * effort).ceil() as u64);
            let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template(
                "{bar:30} {percent}% of the effort, {elapsed} (left at most {eta})  {msg}",
            );
            bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        });
        Self { bar, lines: !terminal && !quiet, effort, runs: 0, run: (String::new(), 0, 0) }
    }

    /// Takes what is told of the search.
    pub fn take(&mut self, event: &Event) {
        match event {
            Event::Started(words, steps) => self.run = ((*words).to_owned(), *steps, 0),
            Event::Step => self.run.2 += 1,
            Event::Finished(point, spent) => {
                self.runs += 1;
                if let Some(bar) = &self.bar {
                    bar.set_position((TICKS * spent) as u64);
                }
                if self.lines {
                    let (state, cost) = (point.status.status.name(), point.status.cpu_s);
                    let (runs, effort) = (self.runs, self.effort);
                    // a closed stderr must not stop a computation
                    let _ = writeln!(
                        std::io::stderr(),
                        "{runs}  {}: {state}, {cost:.2} s  ({spent:.0} of at most {effort:.0} s)",
                        point.words
                    );
                }
            }
        }
        if let Some(bar) = &self.bar {
            let (words, steps, reached) = &self.run;
            bar.set_message(format!("run {}: {words}, step {reached}/{steps}", self.runs + 1));
        }
    }

    /// Leaves the last state on the terminal.
    pub fn end(&self) {
        if let Some(bar) = &self.bar {
            bar.abandon();
        }
    }
}
