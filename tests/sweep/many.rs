//! Studies of many points.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use super::{STUDY, folder, sweep, told};

/// The figure that the issue asks for: 1e4 points list, resume and collect within seconds.
#[test]
fn ten_thousand_points_list_resume_and_collect_within_seconds() {
    let folder = folder("many");
    let out = memory(&folder);
    let out = ["--out", out.to_str().unwrap()];
    let count = |n: usize| format!("{{ linear = {{ from = 0.02, to = 0.05, count = {n} }} }}");
    let zip = "zip = [{ path = \"body.lower.elements\", values = [[5, 2], [6, 3]] }]\n";
    let study = STUDY.replace(&count(2), &count(100)).replace("[0.1, 0.2]", &count(100)).replace(zip, "");
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let clock = Instant::now();
    let [list, _] = sweep(&folder, &[&out[..], &["--list"]].concat(), 0);
    let listed = clock.elapsed().as_secs_f64();
    let points: Vec<&str> = list.lines().filter_map(|line| line.split("points/").nth(1)).collect();
    assert_eq!(points.len(), 10_000);
    std::fs::create_dir_all(out[1]).unwrap();
    let history = Path::new(out[1]).join("history");
    std::fs::write(&history, real_history(&folder)).unwrap();
    for point in points {
        let point = Path::new(out[1]).join("points").join(point);
        std::fs::create_dir_all(&point).unwrap();
        std::fs::write(point.join("point.json"), r#"{"status":"done","reason":"","wall_s":1.0}"#).unwrap();
        std::fs::hard_link(&history, point.join("history.csv")).unwrap();
    }
    let clock = Instant::now();
    sweep(&folder, &[&out[..], &["--collect", "--quiet"]].concat(), 0);
    let collected = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let [said, error] = sweep(&folder, &out, 0);
    let resumed = clock.elapsed().as_secs_f64();
    assert!(said.contains("10000 points: 10000 done") && !error.contains("point "), "{said}{error}");
    println!(
        "1e4 points of 76 rows: list {listed:.2} s, collect {collected:.2} s, resume with nothing to do {resumed:.2} s"
    );
    if !cfg!(debug_assertions) {
        assert!(listed < 20.0 && collected < 20.0 && resumed < 20.0, "{listed} {collected} {resumed}");
    }
    std::fs::remove_dir_all(out[1]).unwrap();
}

/// A folder in memory, where the machine has one: to make and remove 2e4 files on a disk takes longer than what is measured.
fn memory(folder: &Path) -> PathBuf {
    let shared = Path::new("/dev/shm");
    let name = format!("asperity-many-{}", std::process::id());
    if shared.is_dir() { shared.join(name) } else { folder.join(name) }
}

/// A history of 76 rows.
fn real_history(folder: &Path) -> String {
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
    run.current_dir(folder).args(["run", "scene.toml", "--quiet", "--out", "real", "--set", "output.figures=false"]);
    told(run.args(["--set", "output.fields=0", "--set", "time.steps=76"]).output().unwrap(), 0);
    std::fs::read_to_string(folder.join("real/history.csv")).unwrap()
}
