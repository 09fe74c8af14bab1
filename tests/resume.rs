//! Checkpoints: a run that was killed, stopped or starved ends, once resumed, with the files of a run in one go, bit for bit.

#[path = "resume/folders.rs"]
mod folders;
#[path = "resume/laws.rs"]
mod laws;
#[path = "resume/refusals.rs"]
mod refusals;

use folders::{Run, SCENE, asperity, differences, folder, said};
use std::path::Path;
use std::time::{Duration, Instant};

/// The scene in one go, and how long that takes.
fn reference(folder: &Path) -> Duration {
    let clock = Instant::now();
    let output = asperity(folder, &["run", "scene.toml", "--quiet", "--out", "whole"]);
    assert!(output.status.success(), "{}", said(&output));
    clock.elapsed()
}

/// Resumes until the run is done; how often it was started.
fn resume(folder: &Path, out: &str) -> usize {
    for count in 1.. {
        let output = asperity(folder, &["run", "scene.toml", "--quiet", "--out", out, "--resume"]);
        match output.status.code() {
            Some(0) => return count,
            other => assert!(count < 3, "{other:?}: {}", said(&output)),
        }
    }
    unreachable!()
}

/// `ASPERITY_KILLS=200 cargo test --release --test resume kill` is the long form.
#[test]
fn killed_at_any_instant_and_resumed_it_is_the_run_in_one_go() {
    let kills: usize = std::env::var("ASPERITY_KILLS").map_or(8, |n| n.parse().expect("a number"));
    // long enough that most kills meet a step
    let long = SCENE.replace("[24, 4]", "[36, 6]").replace("[13, 4]", "[20, 6]").replace("steps = 20", "steps = 200");
    let folder = folder("kills", &long.replace("fields = 3", "fields = 50\ninterface = 5"));
    let whole = reference(&folder);
    let (mut landed, mut steps) = (0, std::collections::BTreeSet::new());
    for k in 0..kills {
        let out = format!("killed-{k}");
        // spread over the whole run, one in three killed once more after it was resumed
        let share = |salt: usize| ((k + salt) as f64 * 0.618_033_988_749_895).fract() * 1.05;
        for (turn, again) in [(k, false), (k + 7, true)].into_iter().filter(|(_, again)| !again || k % 3 == 0) {
            let mut run = Run::start(&folder, &out, if again { &["--resume"] } else { &[] });
            std::thread::sleep(whole.mul_f64(share(turn)));
            landed += usize::from(run.kill());
            steps.insert(folders::rows(&folder.join(&out)));
        }
        resume(&folder, &out);
        let found = differences(&folder.join("whole"), &folder.join(&out));
        assert!(found.is_empty(), "kill {k}: {found:?}");
        std::fs::remove_dir_all(folder.join(&out)).unwrap();
    }
    println!("{kills} runs, {landed} kills before the end, {} different numbers of rows: {steps:?}", steps.len());
    assert!(landed * 2 > kills && steps.len() > 3, "the kills must land: {landed}, {steps:?}");
}

#[cfg(unix)]
#[test]
fn interrupted_by_hand_it_says_how_to_go_on() {
    let folder = folder("interrupt", SCENE);
    reference(&folder);
    let mut run = Run::start(&folder, "it", &["--set", "title=\"it's\""]);
    while folders::rows(&folder.join("it")) < 3 {
        std::thread::sleep(Duration::from_millis(2));
    }
    let (code, told) = run.interrupt();
    assert_eq!(code, Some(5), "{told}");
    let command = told.lines().find(|line| line.contains("--resume")).expect("a command").trim();
    let output = std::process::Command::new("sh").current_dir(&folder).args(["-c", command]).output().unwrap();
    assert!(output.status.success(), "{command}: {}", said(&output));
    assert!(said(&output).contains("going on after step "), "{}", said(&output));
    let found = differences(&folder.join("whole"), &folder.join("it"));
    assert_eq!(found, ["README.txt", "run.json"], "the title, and nothing else");
}

#[test]
fn a_finished_run_is_left_alone_and_may_be_extended() {
    let folder = folder("extended", SCENE);
    reference(&folder);
    let short = ["run", "scene.toml", "--out", "it", "--set", "time.end=0.5", "--set", "time.steps=10"];
    let output = asperity(&folder, &short);
    assert!(output.status.success(), "{}", said(&output));
    let before = folders::contents(&folder.join("it"));
    let output = asperity(&folder, &[&short[..], &["--resume"]].concat());
    assert!(output.status.success() && said(&output).contains("already done: 10 steps"), "{}", said(&output));
    assert!(before == folders::contents(&folder.join("it")), "a finished run is not touched");
    assert_eq!(resume(&folder, "it"), 1);
    let found = differences(&folder.join("whole"), &folder.join("it"));
    assert!(found.is_empty(), "{found:?}");
}

/// The tables of a dynamic run have more columns; they are gone on with all the same. A relaxation time is a share of the end, so that
/// another end would be another run.
#[test]
fn a_dynamic_run_may_be_extended_a_viscous_one_not() {
    let dense = SCENE.replace("poissons_ratio = 0.3", "poissons_ratio = 0.3\ndensity = 0.01") + "[dynamics]\n";
    let folder = folder("dynamic", &dense);
    reference(&folder);
    let history = std::fs::read_to_string(folder.join("whole/history.csv")).unwrap();
    assert!(history.lines().next().unwrap().ends_with(",snap_loss,kinetic_energy,numerical_loss,viscous_loss"));
    let short = ["run", "scene.toml", "--quiet", "--out", "it", "--set", "time.end=0.5", "--set", "time.steps=10"];
    assert!(asperity(&folder, &short).status.success());
    assert_eq!(resume(&folder, "it"), 1);
    let found = differences(&folder.join("whole"), &folder.join("it"));
    assert!(found.is_empty(), "{found:?}");
    let viscous = ["--set", "solution.viscosity=0.01"];
    assert!(asperity(&folder, &[&short[..], &viscous].concat()).status.success());
    let long = ["run", "scene.toml", "--quiet", "--out", "it", "--resume"];
    let output = asperity(&folder, &[&long[..], &viscous].concat());
    assert!(output.status.code() == Some(2) && said(&output).contains("time.end"), "{}", said(&output));
}

/// A run that could not go on is tried again from its last step: without a cut the end of the equilibrium path behind a
/// steep flank is not crossed.
#[test]
fn more_cuts_go_on_from_the_last_step() {
    let scene = SCENE
        .replace("[time]", "[time]\nmax_cuts = 0")
        .replace("{ type = \"dahl\", friction = 0.3, stiffness = 0.3 }", "{ type = \"coulomb\", friction = 0.1 }")
        .replace("material = \"hard\"", "material = \"rubber\"")
        .replace("height = 0.4", "height = 0.9")
        .replace("[-0.8, 0.6]", "[-0.8, 1.35]")
        .replace("[24, 4]", "[40, 8]")
        .replace("[13, 4]", "[21, 8]")
        .replace("steps = 20", "steps = 120");
    let folder = folder("cuts", &scene);
    let output = asperity(&folder, &["run", "scene.toml", "--quiet", "--out", "it"]);
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    let history = || std::fs::read_to_string(folder.join("it/history.csv")).unwrap();
    let before = history();
    let more = ["run", "scene.toml", "--quiet", "--out", "it", "--resume", "--set", "time.max_cuts=12"];
    let output = asperity(&folder, &more);
    assert!(output.status.success(), "{}", said(&output));
    assert!(history().starts_with(&before) && folders::rows(&folder.join("it")) == 120);
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_named_and_loses_nothing() {
    let folder = folder("full", &SCENE.replace("fields = 3", "fields = 0"));
    reference(&folder);
    let largest = std::fs::metadata(folder.join("whole/interface.csv")).unwrap().len();
    // no file may grow beyond three quarters of the largest table: writing fails as on a full disk
    let limited = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", largest * 3 / 4 / 512);
    let run = [env!("CARGO_BIN_EXE_asperity"), "run", "scene.toml", "--quiet", "--out", "it"];
    let output =
        std::process::Command::new("sh").current_dir(&folder).args(["-c", &limited, "sh"]).args(run).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let told = said(&output);
    assert!(
        told.contains("cannot append to it/interface.csv: ") && told.contains("--resume") && !told.contains("panicked"),
        "{told}"
    );
    assert!(folders::rows(&folder.join("it")) > 3);
    resume(&folder, "it");
    let found = differences(&folder.join("whole"), &folder.join("it"));
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn a_folder_that_vanishes_is_named() {
    let folder = folder("vanished", SCENE);
    let mut run = Run::start(&folder, "it", &["--set", "time.steps=100000", "--set", "output.figures=false"]);
    while folders::rows(&folder.join("it")) < 2 {
        std::thread::sleep(Duration::from_millis(2));
    }
    std::fs::rename(folder.join("it"), folder.join("elsewhere")).unwrap();
    let (code, told) = run.wait();
    assert_eq!(code, Some(1), "{told}");
    assert!(told.contains("it/") && told.contains("No such file") && !told.contains("panicked"), "{told}");
    assert!(folders::rows(&folder.join("elsewhere")) >= 2);
}
