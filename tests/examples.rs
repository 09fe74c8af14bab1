//! Every example is a test: each scene of `examples/` runs through the program, leaves its files, and shows what its
//! first lines promise. The probe of a law has its test in `probe.rs`.

use std::path::{Path, PathBuf};
use std::process::Command;

use asperity::model::{ContactStatus, InterfaceRow, Record};
use asperity::output::tables::{read_history, read_interface};

/// Scenes with a test of their own below.
const SCENES: [&str; 8] = [
    "cattaneo_mindlin",
    "expression_law",
    "hertz",
    "impact",
    "incline",
    "multi_asperity",
    "patch_test",
    "single_asperity",
];

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")
}

/// Runs a scene into a fresh folder; returns the folder and the exit code.
fn start(name: &str, sets: &[&str]) -> (PathBuf, Option<i32>) {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("examples").join(format!("{name}-{}", sets.len()));
    let _ = std::fs::remove_dir_all(&out);
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.arg("run").arg(examples().join(format!("{name}.toml"))).arg("--quiet").arg("--out").arg(&out);
    command.args(sets.iter().flat_map(|set| ["--set", set]));
    (out, command.status().expect("the program starts").code())
}

/// Runs a scene that must succeed and leave everything; returns its tables.
fn run(name: &str, sets: &[&str]) -> (Vec<Record>, Vec<InterfaceRow>) {
    let (out, code) = start(name, sets);
    assert_eq!(code, Some(0), "{name}");
    for file in ["run.json", "history.csv", "interface.csv", "fields.pvd", "README.txt"] {
        assert!(out.join(file).is_file(), "{name}: {file}");
    }
    for figure in ["forces", "mu_global", "energy", "interface", "bodies"] {
        for kind in ["svg", "png"] {
            let bytes = std::fs::read(out.join(format!("figures/{figure}.{kind}"))).expect(figure);
            assert!(bytes.len() > 1000, "{name}: {figure}.{kind}");
            assert!(kind == "png" || !String::from_utf8_lossy(&bytes).contains("NaN"), "{name}: {figure}.svg");
        }
    }
    assert!(std::fs::read_dir(out.join("fields")).expect("fields").count() >= 2, "{name}: fields");
    let history = read_history(&out.join("history.csv")).expect("history.csv");
    assert!(history.iter().all(|record| record.converged), "{name}");
    (history, read_interface(&out.join("interface.csv")).expect("interface.csv"))
}

/// Rows in contact of the last step.
fn last_contact(rows: &[InterfaceRow]) -> Vec<&InterfaceRow> {
    let last = rows.iter().map(|row| row.step).max().expect("rows");
    rows.iter().filter(|row| row.step == last && row.status != ContactStatus::Open).collect()
}

/// `mu_global = tan(atan mu + contact_angle)` wherever the whole contact slips one way.
fn assert_identity(history: &[Record], friction: f64) {
    let slipping: Vec<&Record> = history.iter().filter(|record| record.fully_slipping).collect();
    assert!(slipping.len() > 10, "{} steps slip", slipping.len());
    for record in slipping {
        let expected = (friction.atan() + record.contact_angle).tan();
        assert!((record.mu_global - expected).abs() < 1e-8, "{} is not {expected}: {record:?}", record.mu_global);
    }
}

#[test]
fn no_scene_is_forgotten() {
    let mut found: Vec<String> = std::fs::read_dir(examples())
        .expect("examples")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned())
        .collect();
    found.retain(|name| name != "probe");
    found.sort();
    assert_eq!(found, SCENES);
}

#[test]
fn single_asperity_shows_more_friction_than_its_law_and_then_less() {
    let (history, _) = run("single_asperity", &[]);
    assert_eq!(history.len(), 76);
    let touching: Vec<&Record> = history.iter().filter(|record| record.contact_length > 0.0).collect();
    assert!(touching[0].mu_global > 0.9, "first contact: {}", touching[0].mu_global);
    assert!(touching[touching.len() - 1].mu_global < -0.2, "last contact");
    let largest = history.iter().fold(0.0_f64, |m, record| m.max(record.force[0]));
    let smallest = history.iter().fold(0.0_f64, |m, record| m.min(record.force[0]));
    assert!(smallest < -0.1 * largest, "the upper body is pushed downhill: {smallest} against {largest}");
    assert_identity(&history, 0.3);
    let end = &history[75];
    assert!(end.strain_energy.abs() < 1e-12, "apart again: {}", end.strain_energy);
    let open = (end.external_work - end.dissipated) / end.dissipated;
    assert!(open.abs() < 0.02, "work against dissipation at 76 steps: {open}");
    for record in &history {
        let lack = (0..2).map(|c| (record.force[c] - record.reaction_base[c]).abs()).fold(0.0, f64::max);
        assert!(lack < 1e-8, "driven and base reaction differ by {lack}");
    }
}

/// A coarser mesh and half the steps: 3 s instead of 10 s.
#[test]
fn multi_asperity_never_loses_contact_and_repeats_itself() {
    let coarse = ["body.lower.elements=[50, 6]", "body.upper.elements=[38, 6]", "time.steps=40", "output.fields=20"];
    let (history, _) = run("multi_asperity", &coarse);
    let sliding: Vec<&Record> = history.iter().filter(|record| record.drive[0] > 0.0).collect();
    assert!(sliding.iter().all(|record| record.contact_length > 0.1), "contact is lost");
    assert_identity(&history, 0.3);
    // One wavelength of the lower surface apart, when the contact is fully slipping, the state is nearly the same.
    let [early, late] = [1.2, 2.8].map(|x| {
        let at = |record: &&&Record| (record.drive[0] - x).abs() < 1e-9;
        *sliding.iter().find(at).expect("a step at this place")
    });
    assert!((late.force[1] / early.force[1] - 1.0).abs() < 0.1, "{early:?} {late:?}");
    let work = late.external_work - early.external_work;
    let kept = late.strain_energy - early.strain_energy + late.dissipated - early.dissipated;
    assert!((work / kept - 1.0).abs() < 0.05, "work {work}, stored and dissipated {kept}");
}

#[test]
fn expression_law_weakens_with_the_slip_of_each_site() {
    let (history, rows) = run("expression_law", &[]);
    let slipping: Vec<&InterfaceRow> = rows.iter().filter(|row| row.status == ContactStatus::Slip).collect();
    for row in &slipping {
        let friction = 0.3 + 0.3 * (-row.variables[0] / 0.1).exp();
        assert!((row.traction.abs() / row.pressure / friction - 1.0).abs() < 1e-8, "{row:?}");
    }
    let reached = |z: f64| slipping.iter().any(|row| row.variables[0] > z);
    assert!(reached(0.3), "some site has slid far");
    assert!(history.iter().any(|record| record.mu_global > 1.2), "the first touch has static friction");
    let forgotten = |row: &InterfaceRow| row.status != ContactStatus::Open || row.variables[0] == 0.0;
    assert!(rows.iter().all(forgotten), "an open site forgets its slip");
    let (history, _) = run("expression_law", &["contact.0.law.parameters.mu_s=0.3"]);
    assert_identity(&history, 0.3);
}

#[test]
fn hertz_has_the_pressure_and_the_width_of_the_theory() {
    let (history, rows) = run("hertz", &[]);
    let record = history.last().expect("steps");
    let p0 = 2.7473e-4;
    assert!((record.pressure_max / p0 - 1.0).abs() < 0.002, "{}", record.pressure_max / p0);
    assert!((record.contact_length / 2.0 - 1.0).abs() < 0.05, "{}", record.contact_length);
    let load = 4.315375e-4;
    assert!((record.force[1] / load - 1.0).abs() < 1e-6 && record.force[0].abs() < 1e-9 * load);
    for row in last_contact(&rows).into_iter().filter(|row| row.x.abs() < 0.9) {
        let error = (row.pressure - p0 * (1.0 - row.x * row.x).sqrt()) / p0;
        assert!(error.abs() < 0.03, "at {}: {error}", row.x);
    }
}

#[test]
fn cattaneo_mindlin_sticks_inside_and_slips_outside() {
    let (history, rows) = run("cattaneo_mindlin", &[]);
    let (a, c, q_max) = (1.0, 0.72933, 0.68416 * 0.2 * 2.7473e-4);
    let record = history.last().expect("steps");
    assert!((record.force[0] / 4.039881e-5 - 1.0).abs() < 1e-6, "{record:?}");
    let contact = last_contact(&rows);
    let center = contact.iter().map(|row| row.weight * row.pressure * row.x).sum::<f64>()
        / contact.iter().map(|row| row.weight * row.pressure).sum::<f64>();
    let of = |status| contact.iter().filter(move |row| row.status == status).map(|row| (row.x - center).abs());
    let stick = of(ContactStatus::Stick).fold(0.0, f64::max);
    let slip = of(ContactStatus::Slip).fold(f64::INFINITY, f64::min);
    // Sites are at most 0.05 a apart.
    assert!((stick - c).abs() < 0.05 * a && (slip - c).abs() < 0.05 * a, "stick to {stick}, slip from {slip}");
    let found = contact.iter().map(|row| row.traction.abs()).fold(0.0, f64::max);
    assert!((found / q_max - 1.0).abs() < 0.06, "q_max is {found} between sites, not {q_max}");
}

#[test]
fn incline_sticks_above_the_limit_and_runs_away_below() {
    let (_, rows) = run("incline", &[]);
    for row in last_contact(&rows) {
        assert_eq!(row.status, ContactStatus::Stick);
        assert!((row.traction.abs() / row.pressure - 20f64.to_radians().tan()).abs() < 1e-6, "{row:?}");
    }
    let (out, code) = start("incline", &["contact.0.law.friction=0.36"]);
    assert_eq!(code, Some(3), "below the limit there is no equilibrium");
    assert!(out.join("run.json").is_file() && out.join("history.csv").is_file());
}

#[test]
fn impact_flattens_the_disk_and_throws_it_off_again() {
    let (history, _) = run("impact", &[]);
    let start = 0.5 * std::f64::consts::PI * 0.25 * (0.3_f64.powi(2) + 0.2_f64.powi(2));
    let touching: Vec<&Record> = history.iter().filter(|record| record.contact_length > 0.0).collect();
    let end = &history[119];
    assert!(touching.len() > 10 && end.contact_length == 0.0, "{} steps in contact", touching.len());
    assert!((history[0].kinetic_energy / start - 1.0).abs() < 1e-3, "{} of {start}", history[0].kinetic_energy);
    let stored = history.iter().fold(0.0_f64, |m, record| m.max(record.strain_energy));
    assert!(stored > 0.3 * start && end.kinetic_energy > 0.3 * start, "stored {stored}, left {end:?}");
    for record in &history {
        assert!((record.accounted() / start - 1.0).abs() < 0.02 && record.external_work.abs() < 1e-12, "{record:?}");
    }
    assert!(end.dissipated > 0.0 && end.numerical_loss < 0.05 * start);
}

#[test]
fn patch_test_carries_one_uniform_stress() {
    let (history, rows) = run("patch_test", &[]);
    let record = history.last().expect("steps");
    assert!((record.force[1] / 100.0 - 1.0).abs() < 1e-9, "{record:?}");
    let contact = last_contact(&rows);
    assert!(contact.len() > 10 && contact.iter().all(|row| row.status == ContactStatus::Stick));
    for row in contact {
        assert!((row.pressure / record.pressure_max - 1.0).abs() < 1e-8, "{row:?}");
        assert!((row.traction.abs() / row.pressure - record.contact_angle.tan()).abs() < 1e-8, "{row:?}");
    }
}

/// The Rust example, where cargo has built it (`cargo test` does, `cargo test --test examples` does not).
#[test]
fn two_asperities_in_rust_reaches_the_end() {
    let own = std::env::current_exe().expect("a test binary");
    let name = format!("two_asperities{}", std::env::consts::EXE_SUFFIX);
    let binary = own.parent().and_then(Path::parent).expect("target folder").join("examples").join(name);
    if !binary.is_file() {
        println!("left out: {} is not built", binary.display());
        return;
    }
    let output = Command::new(&binary).args(["0.3", "0", "nurbs", "2", "38"]).output().expect("the example starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("Done after"), "{said}");
    assert!(said.lines().count() > 38, "{said}");
}
