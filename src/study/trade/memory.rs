//! Peak memory of this process during a run, where the operating system tells it (Linux).
//!
//! The process keeps memory that earlier runs have given back, so a run that is smaller than one before it cannot be measured.

use std::fs;

/// Share of the peak that the process may hold before the run.
const HELD_BEFORE: f64 = 0.7;

/// Memory of the process before a run, in megabytes.
pub(super) struct Before(Option<f64>);

impl Before {
    /// Forgets the peak so far.
    pub fn run() -> Self {
        let forgotten = fs::write("/proc/self/clear_refs", "5").is_ok();
        Self(status("VmRSS:").filter(|_| forgotten))
    }

    /// Peak resident memory in megabytes since then, if the run made it.
    pub fn peak_mb(&self) -> Option<f64> {
        let (before, peak) = (self.0?, status("VmHWM:")?);
        (before <= HELD_BEFORE * peak).then(|| (10.0 * peak).round() / 10.0)
    }
}

fn status(name: &str) -> Option<f64> {
    let text = fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kilobytes: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes / 1024.0)
}
