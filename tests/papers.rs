//! Everything under `papers/` runs: scenes with few steps, studies as far as their points; and the passes of the 2021 paper obey what
//! the physics demands of them. The committed results are those of the commands in the READMEs.

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity::model::Record;
use asperity::output::tables::read_history;

fn papers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("papers")
}

fn out(name: &str) -> PathBuf {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("papers").join(name);
    let _ = std::fs::remove_dir_all(&out);
    out
}

fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files_below(&path, found);
        } else if path.extension().is_some_and(|end| end == "toml") {
            found.push(path);
        }
    }
}

/// Files under `papers/` that are studies, or that are scenes.
fn files(studies: bool) -> Vec<PathBuf> {
    let mut found = Vec::new();
    files_below(&papers(), &mut found);
    let key = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).expect("text");
        text.lines().any(|line| line.starts_with(if studies { "scene = " } else { "[time]" }))
    };
    found.retain(key);
    found.sort();
    found
}

fn run(scene: &Path, name: &str, sets: &[&str]) -> Vec<Record> {
    let out = out(name);
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.arg("run").arg(scene).arg("--quiet").arg("--out").arg(&out);
    command.args(["--set", "output.figures=false", "--set", "output.fields=0", "--set", "output.interface=0"]);
    command.args(sets.iter().flat_map(|set| ["--set", set]));
    assert!(command.status().expect("the program starts").success(), "{}", scene.display());
    read_history(&out.join("history.csv")).expect("history.csv")
}

#[test]
fn every_scene_runs_with_few_steps() {
    let scenes = files(false);
    assert!(scenes.len() >= 5, "{scenes:?}");
    for (k, scene) in scenes.iter().enumerate() {
        let history = run(scene, &format!("scene-{k}"), &["time.steps=20"]);
        assert!(history.iter().all(|record| record.converged), "{}", scene.display());
        assert!(history.iter().any(|record| record.contact_length > 0.0), "{} never touches", scene.display());
    }
}

#[test]
fn every_study_makes_all_its_scenes() {
    let studies = files(true);
    assert!(studies.len() >= 5, "{studies:?}");
    for (k, study) in studies.iter().enumerate() {
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        let output =
            command.arg("sweep").arg(study).arg("--list").arg("--out").arg(out(&format!("study-{k}"))).output();
        let output = output.expect("the program starts");
        assert!(output.status.success(), "{}: {}", study.display(), String::from_utf8_lossy(&output.stderr));
    }
}

/// The pass of the README with 34 steps of 0.05.
fn pass(name: &str, sets: &[&str]) -> Vec<Record> {
    run(&papers().join("ostermeyer-2021/single.toml"), name, &[&["time.steps=34"][..], sets].concat())
}

#[test]
fn mu_global_follows_from_the_contact_angle() {
    let history = pass("identity", &[]);
    let slipping: Vec<&Record> = history.iter().filter(|record| record.fully_slipping).collect();
    assert!(slipping.len() > 15, "{}", slipping.len());
    for record in slipping {
        let expected = (0.3_f64.atan() + record.contact_angle).tan();
        assert!((record.mu_global - expected).abs() < 1e-8, "{} is not {expected}", record.mu_global);
    }
}

#[test]
fn the_way_back_is_the_mirror_image() {
    let forth = pass("forth", &[]);
    let back = pass("back", &["body.upper.position.0=0.62", "drive.0.x.displacement.value.1=-1.7"]);
    let peak = forth.iter().fold(0.0_f64, |peak, record| peak.max(record.force[1]));
    for (forth, back) in forth.iter().zip(&back) {
        assert!((forth.drive[0] + back.drive[0]).abs() < 1e-12);
        assert!((forth.force[0] + back.force[0]).abs() < 1e-8 * peak, "{} {}", forth.force[0], back.force[0]);
        assert!((forth.force[1] - back.force[1]).abs() < 1e-8 * peak, "{} {}", forth.force[1], back.force[1]);
    }
}

#[test]
fn without_friction_nothing_is_spent_and_with_it_all_goes_into_friction() {
    let spent = |history: &[Record]| {
        let largest = history.iter().fold(0.0_f64, |most, record| most.max(record.strain_energy));
        let last = history.last().expect("steps");
        (last.external_work / largest, last.dissipated / largest)
    };
    let (work, dissipated) = spent(&pass("free", &["contact.0.law.friction=0"]));
    assert!(work.abs() < 1e-2 && dissipated == 0.0, "{work} {dissipated}");
    let (work, dissipated) = spent(&pass("rough", &["time.steps=100"]));
    assert!(dissipated > 1.0 && (work / dissipated - 1.0).abs() < 1e-2, "{work} {dissipated}");
}

/// NAFEMS contact benchmark 1 against the published displacements of the middle of the block's surface (MARC).
#[test]
fn the_steel_cylinder_sinks_as_far_as_published() {
    for (friction, published) in [("0", -1.308_019), ("0.1", -1.302_636)] {
        let out = out(&format!("roller-{friction}"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        command.arg("run").arg(papers().join("konter-2006/roller.toml")).arg("--quiet").arg("--out").arg(&out);
        command.args(["--set", "output.figures=false", "--set", "output.fields=0"]);
        let law = format!("contact.0.law.friction={friction}");
        assert!(command.args(["--set", &law]).status().expect("the program starts").success());
        let text = std::fs::read_to_string(out.join("interface.csv")).expect("interface.csv");
        let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let header = lines.next().expect("a header");
        let column = |name: &str| header.iter().position(|found| *found == name).expect("a column");
        let (step, x, y) = (column("step"), column("x"), column("y"));
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let last = lines.filter(|row| row[step] == "10");
        let middle = last.min_by(|a, b| number(a[x]).abs().total_cmp(&number(b[x]).abs())).expect("sites");
        let found = number(middle[y]);
        assert!((found / published - 1.0).abs() < 1e-3, "friction {friction}: {found}, published {published}");
    }
}
