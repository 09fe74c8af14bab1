//! The scenes of `papers/peers` run, and agree with what another program computes. GetFEM itself is not needed here.

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity::output::tables::read_history;

fn peers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("papers/peers")
}

/// Drive, Fx and Fy of every second of the 76 steps of GetFEM's finest run (Q2, size 0.0125).
fn getfem() -> Vec<[f64; 3]> {
    let text = std::fs::read_to_string(peers().join("getfem_fine.csv")).expect("getfem_fine.csv");
    let row = |line: &str| {
        let mut cells = line.split(',').map(|cell| cell.parse().expect("a number"));
        std::array::from_fn(|_| cells.next().expect("three columns"))
    };
    text.lines().skip(2).step_by(2).map(row).collect()
}

/// Largest differences of Fx and Fy from GetFEM's at the same places, over the largest Fx and Fy.
fn differences(scene: &str, sets: &[&str]) -> [f64; 2] {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers").join(format!("{scene}-{}", sets.len()));
    let _ = std::fs::remove_dir_all(&out);
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.arg("run").arg(peers().join(format!("{scene}.toml"))).arg("--quiet").arg("--out").arg(&out);
    command.args(["--set", "time.steps=38"]).args(sets.iter().flat_map(|set| ["--set", set]));
    assert!(command.status().expect("the program starts").success(), "{scene}");
    let history = read_history(&out.join("history.csv")).expect("history.csv");
    let other = getfem();
    assert_eq!(history.len(), other.len());
    for (record, row) in history.iter().zip(&other) {
        assert!((record.drive[0] - row[0]).abs() < 1e-9, "{} is not {}", record.drive[0], row[0]);
    }
    [0, 1].map(|c| {
        let peak = other.iter().fold(0.0_f64, |m, row| m.max(row[c + 1].abs()));
        let apart = history.iter().zip(&other).map(|(record, row)| (record.force[c] - row[c + 1]).abs());
        apart.fold(0.0, f64::max) / peak
    })
}

/// Half as fine as the scene; see the README for the error of the scene itself.
#[test]
fn linear_elements_agree_with_getfem() {
    let coarse = ["body.lower.elements=[40, 10]", "body.upper.elements=[22, 11]"];
    let found = differences("lagrange", &coarse);
    assert!(found[0] < 5e-2 && found[1] < 2e-2, "{found:?}");
}

#[test]
fn graded_splines_agree_with_getfem() {
    let found = differences("nurbs", &[]);
    assert!(found[0] < 1.2e-2 && found[1] < 1e-2, "quadratic: {found:?}");
    let cubic = [
        "body.lower.basis={ type = 'nurbs', degree = 3 }",
        "body.upper.basis={ type = 'nurbs', degree = 3 }",
        "body.lower.elements=[29, 5]",
        "body.upper.elements=[26, 5]",
    ];
    let found = differences("nurbs", &cubic);
    assert!(found[0] < 3e-3 && found[1] < 2e-3, "cubic: {found:?}");
}
