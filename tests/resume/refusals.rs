//! Checkpoints that cannot be used are refused by name, and what is in the folder stays as it was.

use super::folders::{SCENE, asperity, contents, folder, said};
use std::path::Path;

/// A run that could not reach its end: its folder holds an unfinished checkpoint.
fn unfinished(name: &str) -> std::path::PathBuf {
    let folder = folder(name, SCENE);
    let stop = ["--set", "time.end=0.5", "--set", "time.steps=10"];
    let output = asperity(&folder, &[&["run", "scene.toml", "--quiet", "--out", "it"][..], &stop].concat());
    assert!(output.status.success(), "{}", said(&output));
    folder
}

/// Resuming is refused with all of `says`; nothing is touched.
fn refused(folder: &Path, arguments: &[&str], says: &[&str]) {
    let before = contents(folder);
    let output = asperity(folder, &[&["run", "scene.toml", "--out", "it", "--resume"], arguments].concat());
    let told = said(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    for part in says.iter().chain(&["nothing was changed"]) {
        assert!(told.contains(part), "expected {part:?} in\n{told}");
    }
    assert!(!told.contains("panicked"), "{told}");
    assert!(before == contents(folder), "a refusal touches nothing");
}

#[test]
fn another_scene_is_refused_and_what_differs_is_named() {
    let folder = unfinished("other-scene");
    refused(
        &folder,
        &["--set", "contact.0.law.friction=0.25"],
        &["contact.0.law.friction: 0.3 in the checkpoint, 0.25 now"],
    );
    refused(
        &folder,
        &["--set", "body.upper.elements=[14, 4]"],
        &["body.upper.elements.0: 13 in the checkpoint, 14 now"],
    );
    refused(&folder, &["--set", "output.fields=2"], &["output.fields: 3 in the checkpoint, 2 now"]);
    refused(&folder, &["--set", "time.steps=21"], &["time.steps: 10 in the checkpoint, 21 now"]);
    refused(&folder, &["--set", "time.max_cuts=3"], &["time.max_cuts: 12 in the checkpoint, 3 now"]);
    refused(
        &folder,
        &["--set", "time.end=0.25", "--set", "time.steps=5"],
        &["time.steps: 10 in the checkpoint, 5 now"],
    );
}

#[test]
fn damaged_and_foreign_checkpoints_are_refused() {
    let folder = unfinished("damaged");
    let path = folder.join("it/checkpoint/state.bin");
    let good = std::fs::read(&path).unwrap();
    let head = good.iter().position(|b| *b == b'\n').unwrap();
    let mut flipped = good.clone();
    flipped[head + 100] ^= 4;
    let version = String::from_utf8_lossy(&good[..head]).replace(env!("CARGO_PKG_VERSION"), "0.0.1");
    let format = String::from_utf8_lossy(&good[..head]).replacen("checkpoint 1", "checkpoint 7", 1);
    for (bytes, says) in [
        (vec![], "the file is empty"),
        (b"step,time\n1,2\n".to_vec(), "not a checkpoint of asperity"),
        (good[..head / 2].to_vec(), "not a checkpoint of asperity"),
        (good[..head + 1].to_vec(), "truncated: 0 bytes"),
        (good[..good.len() - 1].to_vec(), "truncated"),
        (flipped, "damaged: the checksum does not fit"),
        ([version.as_bytes(), &good[head..]].concat(), "written by asperity 0.0.1"),
        ([format.as_bytes(), &good[head..]].concat(), "in format 7"),
    ] {
        std::fs::write(&path, bytes).unwrap();
        refused(&folder, &[], &["it/checkpoint/state.bin", says]);
    }
    std::fs::remove_file(&path).unwrap();
    refused(&folder, &[], &["it holds results but no checkpoint"]);
    std::fs::write(&path, &good).unwrap();
    let output = asperity(&folder, &["run", "scene.toml", "--quiet", "--out", "it", "--resume"]);
    assert!(output.status.success(), "{}", said(&output));
}

/// Results that were tampered with do not fit the checkpoint.
#[test]
fn missing_rows_are_named() {
    let folder = unfinished("rows");
    let history = folder.join("it/history.csv");
    let text = std::fs::read_to_string(&history).unwrap();
    let short: String = text.split_inclusive('\n').take(6).collect();
    std::fs::write(&history, short).unwrap();
    let output = asperity(&folder, &["run", "scene.toml", "--out", "it", "--resume"]);
    let told = said(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("history.csv: holds 5 steps, the checkpoint stands at step 10"), "{told}");
}

#[test]
fn a_changed_profile_file_is_noticed() {
    let scene = SCENE.replace(
        "bottom = { type = \"cosine\", height = 0.4, wavelength = 1.6, centers = [0.0] }",
        "bottom = { type = \"csv\", file = \"profile.csv\" }",
    );
    let folder = folder("profile", &scene);
    let profile = |height: f64| format!("-1,0\n-0.5,{}\n0,{height}\n0.5,{}\n1,0\n", 0.5 * height, 0.5 * height);
    std::fs::write(folder.join("profile.csv"), profile(0.4)).unwrap();
    let stop = ["run", "scene.toml", "--quiet", "--out", "it", "--set", "time.end=0.1", "--set", "time.steps=2"];
    let output = asperity(&folder, &stop);
    assert!(output.status.success(), "{}", said(&output));
    std::fs::write(folder.join("profile.csv"), profile(0.41)).unwrap();
    refused(&folder, &[], &["the control points of the bodies: has a profile file changed?"]);
}

#[test]
fn nothing_to_resume_starts_from_the_beginning_and_a_replaced_run_is_mentioned() {
    let folder = folder("nothing", SCENE);
    let short = ["run", "scene.toml", "--out", "it", "--set", "time.end=0.1", "--set", "time.steps=2"];
    let output = asperity(&folder, &[&short[..], &["--resume"]].concat());
    assert!(output.status.success() && said(&output).contains("starts from the beginning"), "{}", said(&output));
    // left unfinished: the next step cannot be written
    let bound = folder.join("it/fields/step_000003.vtu");
    std::fs::create_dir_all(&bound).unwrap();
    let output = asperity(&folder, &["run", "scene.toml", "--quiet", "--out", "it", "--resume"]);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    std::fs::remove_dir(&bound).unwrap();
    let output = asperity(&folder, &short);
    let told = said(&output);
    assert!(output.status.success(), "{told}");
    assert!(told.contains("warning: it held an unfinished run (step 2 of 20); it is replaced, --resume"), "{told}");
}
