//! `asperity sweep`: points, tables, what is computed again and what is not, and the messages for bad studies.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

#[path = "sweep/bad_input.rs"]
mod bad_input;
#[path = "sweep/many.rs"]
mod many;
#[path = "sweep/shipped.rs"]
mod shipped;

/// Two blocks, pressed and dragged: four steps of a few milliseconds.
const SCENE: &str = r#"
version = 1
title = "block on block"
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-1.0, 1.0], y = [-1.0, 0.0] }
material = "rubber"
elements = [5, 2]
[body.upper]
shape = { type = "block", x = [-0.5, 0.5], y = [0.0, 0.5] }
material = "rubber"
elements = [4, 2]
position = [0.0, 0.0]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = { time = [0.0, 0.5, 1.0], value = [0.0, 0.0, 0.2] } }
y = { displacement = { time = [0.0, 0.5], value = [0.0, -0.05] } }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "coulomb", friction = 0.2 }
[time]
end = 1.0
steps = 4
"#;

const STUDY: &str = r#"
version = 1
title = "two axes"
scene = "scene.toml"
formula = ["drive.0.y.displacement.value.1 = -depth"]
[[axis]]
name = "depth"
values = { linear = { from = 0.02, to = 0.05, count = 2 } }
[[axis]]
name = "mu"
path = "contact.0.law.friction"
values = [0.1, 0.2]
zip = [{ path = "body.lower.elements", values = [[5, 2], [6, 3]] }]
[[quantity]]
name = "mu_end"
column = "mu_global"
take = "last"
[[quantity]]
name = "work"
column = "fx"
take = "integral"
along = "drive_x"
"#;

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sweep").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    std::fs::write(folder.join("study.toml"), STUDY).unwrap();
    folder
}

fn start(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).env_remove("SLURM_ARRAY_TASK_ID").args(["sweep", "study.toml"]).args(arguments);
    command
}

/// Runs a sweep and returns what it says on stdout and stderr; the exit code must be as given.
fn sweep(folder: &Path, arguments: &[&str], code: i32) -> [String; 2] {
    told(start(folder, arguments).output().unwrap(), code)
}

pub fn told(output: Output, code: i32) -> [String; 2] {
    let said = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert_eq!(output.status.code(), Some(code), "{}\n{}", said[0], said[1]);
    said
}

/// Rows of a table by column.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    reader.deserialize().map(|row| row.unwrap()).collect()
}

/// The columns of a table that do not depend on the clock.
fn timeless(path: &Path) -> Vec<Vec<String>> {
    let mut rows = table(path);
    rows.iter_mut().for_each(|row| drop(row.remove("wall_s")));
    rows.into_iter().map(|row| row.into_values().collect()).collect()
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap()
}

#[test]
fn every_point_is_the_run_of_its_scene_and_its_quantities_are_those_of_its_history() {
    let folder = folder("points");
    let [said, _] = sweep(&folder, &[], 0);
    assert!(said.contains("4 points: 4 done; results in out/study"), "{said}");
    let rows = table(&folder.join("out/study/study.csv"));
    let axes: Vec<[&str; 2]> = rows.iter().map(|row| [row["depth"].as_str(), row["mu"].as_str()]).collect();
    assert_eq!(axes, [["0.02", "0.1"], ["0.02", "0.2"], ["0.05", "0.1"], ["0.05", "0.2"]]);
    let alone =
        ["drive.0.y.displacement.value=[0.0, -0.05]", "contact.0.law.friction=0.2", "body.lower.elements=[6, 3]"];
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
    run.current_dir(&folder).args(["run", "scene.toml", "--quiet", "--out", "alone", "--set", "output.figures=false"]);
    told(run.args(alone.iter().flat_map(|set| ["--set", set])).output().unwrap(), 0);
    let point = folder.join("out/study").join(&rows[3]["folder"]);
    assert_eq!(timeless(&point.join("history.csv")), timeless(&folder.join("alone/history.csv")), "bit for bit");
    let history = table(&point.join("history.csv"));
    let last = &history[history.len() - 1];
    assert_eq!(rows[3]["mu_end"], last["mu_global"]);
    let pair = |k: usize| {
        let [fx, x] = ["fx", "drive_x"].map(|name| [number(&history[k - 1], name), number(&history[k], name)]);
        0.5 * (fx[0] + fx[1]) * (x[1] - x[0])
    };
    let work: f64 = (1..history.len()).map(pair).sum();
    assert!(work > 0.0 && (number(&rows[3], "work") / work - 1.0).abs() < 1e-12, "{work}");
    for figure in ["mu_end-over-depth.svg", "work-over-depth.png"] {
        let bytes = std::fs::read(folder.join("out/study/figures").join(figure)).expect(figure);
        assert!(bytes.len() > 1000 && !String::from_utf8_lossy(&bytes).contains("NaN"), "{figure}");
    }
    assert!(!point.join("figures").exists() && !point.join("fields").exists(), "points keep their histories only");
}

#[test]
fn what_is_there_is_not_computed_again_and_new_values_are() {
    let folder = folder("again");
    sweep(&folder, &[], 0);
    let out = folder.join("out/study");
    let before = table(&out.join("study.csv"));
    let [_, said] = sweep(&folder, &[], 0);
    assert_eq!(said, "", "nothing was left to compute");
    assert_eq!(table(&out.join("study.csv")), before, "wall times included");
    // a program that was killed leaves a point running, a torn file says nothing: both are computed again
    for (row, left) in before.iter().zip([r#"{"status":"running","reason":"","wall_s":0.0}"#, "{\"sta"]) {
        std::fs::write(out.join(&row["folder"]).join("point.json"), left).unwrap();
    }
    let [_, said] = sweep(&folder, &[], 0);
    assert!(said.lines().count() == 2 && said.contains("2/2  point"), "{said}");
    let before = table(&out.join("study.csv"));
    let more = STUDY.replace("values = [0.1, 0.2]", "values = [0.1, 0.2, 0.3]").replace("[6, 3]]", "[6, 3], [5, 2]]");
    std::fs::write(folder.join("study.toml"), more).unwrap();
    let [_, said] = sweep(&folder, &[], 0);
    assert!(said.lines().count() == 2 && said.contains("1/2  point"), "{said}");
    let after = table(&out.join("study.csv"));
    assert_eq!([&after[0], &after[1]].map(|row| &row["wall_s"]), [&before[0], &before[1]].map(|row| &row["wall_s"]));
    let folders: std::collections::BTreeSet<&String> = after.iter().map(|row| &row["folder"]).collect();
    assert_eq!(folders.len(), 6);
}

#[test]
fn jobs_do_not_change_a_bit() {
    let folder = folder("jobs");
    sweep(&folder, &["--jobs", "1", "--out", "one"], 0);
    sweep(&folder, &["--jobs", "3", "--out", "three"], 0);
    assert_eq!(timeless(&folder.join("one/study.csv")), timeless(&folder.join("three/study.csv")));
}

/// One point starts far inside its counterpart, one is driven through its own base, the others are fine.
#[test]
fn failed_points_are_recorded_and_do_not_stop_the_rest() {
    let folder = folder("failed");
    let study = STUDY.replace("{ linear = { from = 0.02, to = 0.05, count = 2 } }", "[0.02, 1.6]");
    let study = study.replace(
        "zip = [{ path = \"body.lower.elements\", values = [[5, 2], [6, 3]] }]",
        "zip = [{ path = \"body.upper.position.1\", values = [0.0, -0.7] }]",
    );
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let [said, error] = sweep(&folder, &["--set", "time.max_cuts=2"], 3);
    assert!(said.contains("1 done") && said.contains("2 bad input") && said.contains("1 not converged"), "{said}");
    assert!(error.contains("reasons are in out/study/study.csv"), "{error}");
    let rows = table(&folder.join("out/study/study.csv"));
    let status: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(status, ["done", "bad input", "not converged", "bad input"]);
    assert!(rows[1]["reason"].contains("deep inside") && rows[2]["reason"].contains("no convergence after"));
    assert_eq!(rows[2]["mu_end"], "nan");
    let [_, error] = sweep(&folder, &["--set", "time.max_cuts=2"], 3);
    assert!(!error.contains("1/"), "a failed point is not computed again: {error}");
    let [_, error] = sweep(&folder, &["--set", "time.max_cuts=2", "--retry"], 3);
    assert!(error.contains("3/3"), "unless it is asked for: {error}");
}

#[test]
fn points_one_by_one_and_collected_are_the_same_study() {
    let folder = folder("distributed");
    sweep(&folder, &["--out", "whole"], 0);
    let [list, _] = sweep(&folder, &["--list"], 0);
    assert!(list.contains("4 points: 4 pending") && !folder.join("out").exists(), "{list}");
    sweep(&folder, &["--index", "1", "--quiet"], 0);
    sweep(&folder, &["--collect"], 0);
    let rows = table(&folder.join("out/study/study.csv"));
    assert_eq!(rows.iter().filter(|row| row["status"] == "done").count(), 1);
    assert_eq!(rows[1]["status"], "done");
    for index in ["0", "2", "3"] {
        told(start(&folder, &["--quiet"]).env("SLURM_ARRAY_TASK_ID", index).output().unwrap(), 0);
    }
    sweep(&folder, &["--collect"], 0);
    assert_eq!(timeless(&folder.join("out/study/study.csv")), timeless(&folder.join("whole/study.csv")));
    let [list, _] = sweep(&folder, &["--list"], 0);
    assert!(list.contains("4 points: 4 done"), "{list}");
    let [_, error] = sweep(&folder, &["--index", "4"], 2);
    assert!(error.contains("0 to 3"), "{error}");
    told(start(&folder, &[]).env("SLURM_ARRAY_TASK_ID", "many").output().unwrap(), 2);
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on_where_it_stopped() {
    let folder = folder("interrupt");
    sweep(&folder, &["--out", "whole", "--set", "time.steps=200"], 0);
    let mut child = start(&folder, &["--quiet", "--jobs", "1", "--set", "time.steps=200"]).spawn().unwrap();
    let under_way = || {
        let states = states(&folder);
        let rows = |(path, state): &(PathBuf, String)| {
            state == "running" && std::fs::read_to_string(path.join("history.csv")).is_ok_and(|t| t.lines().count() > 1)
        };
        states.iter().any(|(_, state)| state == "done") && states.iter().any(rows)
    };
    while !under_way() {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    assert_eq!(child.wait().unwrap().code(), Some(5));
    let before = table(&folder.join("out/study/study.csv"));
    assert!(before.iter().any(|row| row["status"] == "done") && before.iter().any(|row| row["status"] != "done"));
    let stopped = before.iter().find(|row| row["status"] == "interrupted").expect("one was under way");
    let history = folder.join("out/study").join(&stopped["folder"]).join("history.csv");
    let rows = std::fs::read_to_string(&history).unwrap();
    assert!(rows.lines().count() > 1);
    sweep(&folder, &["--set", "time.steps=200"], 0);
    assert_eq!(timeless(&folder.join("out/study/study.csv")), timeless(&folder.join("whole/study.csv")));
    let more = std::fs::read_to_string(&history).unwrap();
    assert!(more.starts_with(&rows), "wall times of the steps before show that they were kept");
    let after = table(&folder.join("out/study/study.csv"));
    for (before, after) in before.iter().zip(&after).filter(|(before, _)| before["status"] == "done") {
        assert_eq!(before["wall_s"], after["wall_s"], "done is done");
    }
}

/// Folder and status of all points that have one.
fn states(folder: &Path) -> Vec<(PathBuf, String)> {
    let Ok(points) = std::fs::read_dir(folder.join("out/study/points")) else { return vec![] };
    let state = |path: PathBuf| {
        let text = std::fs::read_to_string(path.join("point.json")).ok()?;
        let json: serde_json::Value = serde_json::from_str(&text).ok()?;
        Some((path, json["status"].as_str()?.to_owned()))
    };
    points.filter_map(|point| state(point.ok()?.path())).collect()
}
