//! Peak memory of this process between two moments, where the operating system tells it (Linux).

/// Forgets the peak so far.
pub(super) fn reset() {
    // where it cannot be forgotten, the peak is that of the whole program: an upper bound
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Peak resident memory in megabytes since [`reset`].
pub(super) fn peak_mb() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some((kilobytes / 102.4).round() / 10.0)
}
