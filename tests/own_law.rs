//! The crate of `examples/own_law`: a law outside of this repository's crates conforms and runs from a scene by its name.

use std::path::Path;
use std::process::{Command, Output};

use asperity::model::ContactStatus;
use asperity::output::tables::{read_history, read_interface};

/// Runs cargo in the crate, with the target folder of this test.
fn cargo(arguments: &[&str]) -> Output {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/own_law");
    let mut command = Command::new(env!("CARGO"));
    command.args(arguments).current_dir(folder).env("CARGO_TARGET_DIR", target);
    let output = command.output().expect("cargo starts");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo {arguments:?}: {text}");
    output
}

#[test]
fn a_law_of_ones_own_is_built_checked_listed_and_run() {
    cargo(&["test", "--release", "--quiet"]);
    let listed = cargo(&["run", "--release", "--quiet", "--", "laws", "film"]);
    let text = String::from_utf8_lossy(&listed.stdout);
    assert!(text.contains("recovery [time]") && text.contains("set-valued"), "{text}");

    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("own_law");
    let _ = std::fs::remove_dir_all(&out);
    let out_text = out.to_string_lossy().into_owned();
    cargo(&["run", "--release", "--quiet", "--", "run", "film.toml", "--quiet", "--out", &out_text]);
    assert!(out.join("figures/states.svg").is_file());
    let history = read_history(&out.join("history.csv")).expect("history.csv");
    assert_eq!(history.len(), 76);
    // where a site slips, its friction is that of its film
    let slipping = read_interface(&out.join("interface.csv")).expect("interface.csv");
    let slipping: Vec<_> = slipping.iter().filter(|row| row.status == ContactStatus::Slip).collect();
    assert!(slipping.len() > 100);
    for row in &slipping {
        let expected = 0.4 - 0.3 * row.variables[0];
        assert!((row.traction.abs() / row.pressure - expected).abs() < 1e-9, "{row:?}");
    }
    let worn = slipping.iter().map(|row| row.variables[0]).fold(1.0, f64::min);
    assert!(worn < 0.5, "rubbing has worn the film: {worn}");
}
