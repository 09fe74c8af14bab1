//! `asperity laws NAME --probe FILE`: tables, figures, and what is said of bad input.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const PROBE: &str = r#"
[units]
length = "mm"
stress = "MPa"
time = "s"
[law]
friction = 0.4
[[programme]]
type = "velocity-steps"
pressure = 2.0
velocity = [1.0, -10.0]
distance = 0.5
steps = 20
[[programme]]
type = "spring-slider"
pressure = 2.0
stiffness = 3.0
mass = 0.5
velocity = 0.1
duration = 20.0
"#;

/// A folder of this test alone, with the probe in it.
fn folder(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("probe").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("law.toml"), text).unwrap();
    folder
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn probe(folder: &Path, law: &str) -> Output {
    asperity(folder, &["laws", law, "--probe", "law.toml"])
}

/// A column of a table.
fn column(file: &Path, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let at = text.lines().next().unwrap().split(',').position(|column| column == name).expect(name);
    text.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

#[test]
fn tables_and_figures_of_every_programme_are_written() {
    let folder = folder("coulomb", PROBE);
    let output = probe(&folder, "coulomb");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("2 programmes; results in out/law"));
    let steps = folder.join("out/law/1-velocity-steps.csv");
    let (slip, traction) = (column(&steps, "slip"), column(&steps, "traction"));
    assert!(slip.len() == 41 && (slip[20] - 0.5).abs() < 1e-12 && slip[40].abs() < 1e-12);
    assert!((1..=20).all(|k| traction[k] == 0.8 && traction[20 + k] == -0.8), "{traction:?}");
    let spring = column(&folder.join("out/law/2-spring-slider.csv"), "force");
    // the mass swings about the bound with the amplitude v sqrt(m k)
    let largest = spring.iter().fold(0.0_f64, |a, b| a.max(*b));
    assert!((largest - 0.8 - 0.1 * 1.5_f64.sqrt()).abs() < 1e-4, "{largest}");
    for name in ["1-velocity-steps-friction", "1-velocity-steps-loop", "2-spring-slider-friction"] {
        for kind in ["svg", "png"] {
            let bytes = std::fs::read(folder.join(format!("out/law/figures/{name}.{kind}"))).expect(name);
            assert!(
                bytes.len() > 1000 && (kind == "png" || !String::from_utf8_lossy(&bytes).contains("NaN")),
                "{name}"
            );
        }
    }
    let readme = std::fs::read_to_string(folder.join("out/law/README.txt")).unwrap();
    assert!(readme.contains("Friction law coulomb") && readme.contains("mm s^-1"), "{readme}");
}

#[test]
fn the_shipped_example_shows_what_its_comments_say() {
    let folder = folder("example", "");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/probe.toml");
    let output = asperity(&folder, &["laws", "rate-and-state", "--out", "here", "--probe", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let out = folder.join("here");
    let friction = column(&out.join("1-velocity-steps.csv"), "friction");
    let ratio = 10.0_f64.ln();
    // ten times Dc after a jump to the tenfold, theta is still 1 + 9 exp(-10) times that of steady sliding
    let end = 0.6 - 0.005 * ratio + 0.015 * (9.0 * (-10.0_f64).exp()).ln_1p();
    assert!((friction[1000] - 0.6).abs() < 1e-9 && (friction[2000] - end).abs() < 1e-9, "{} {end}", friction[2000]);
    let held = column(&out.join("2-slide-hold-slide.csv"), "friction");
    let peak = |k: usize| held[k..k + 1000].iter().fold(0.0_f64, |a, b| a.max(*b)) - 0.6;
    assert!(peak(4001) > 1.5 * peak(2001), "{} after the long hold, {} after the short", peak(4001), peak(2001));
    let force = column(&out.join("4-spring-slider.csv"), "force");
    let swing = |part: &[f64]| part.iter().fold(0.0_f64, |a, b| a.max((b - 6e5).abs()));
    assert!(swing(&force[9000..]) > 3.0 * swing(&force[..3000]), "the oscillation grows");
    assert!(out.join("figures/3-harmonic-states.png").is_file());
}

/// What is said on stderr of a changed probe, which must be refused as bad input.
fn refused(name: &str, law: &str, found: &str, replaced: &str) -> String {
    assert!(PROBE.contains(found));
    let folder = folder(name, &PROBE.replacen(found, replaced, 1));
    let output = probe(&folder, law);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(!folder.join("out").exists(), "nothing is written");
    said
}

#[test]
fn bad_input_is_named_with_file_line_key_and_what_is_meant() {
    let cases = [
        ("key", "distance = 0.5", "distanse = 0.5", "law.toml:12:1", "programme.0.distanse", "`distance`"),
        ("type", "spring-slider", "spring-slide", "law.toml:15:8", "programme.1.type", "`spring-slider`"),
        ("range", "stiffness = 3.0", "stiffness = -3.0", "law.toml:17:13", "programme.1.stiffness", "> 0"),
        ("law-key", "friction = 0.4", "frction = 0.4", "law.toml:7:1", "law.frction", "`friction`"),
        ("law-range", "friction = 0.4", "friction = -1.0", "law.toml:7:12", "law.friction", ">= 0"),
        (
            "zero",
            "velocity = [1.0, -10.0]",
            "velocity = [1.0, 0.0]",
            "law.toml:11:18",
            "programme.0.velocity.1",
            "slide-hold",
        ),
        ("other-law", "friction = 0.4", "type = \"tresca\"\nstrength = 1.0", "law.toml:7:8", "law.type", "`coulomb`"),
    ];
    for (name, found, replaced, place, key, meant) in cases {
        let said = refused(name, "coulomb", found, replaced);
        for part in [place, key, meant] {
            assert!(said.contains(part), "{name}: no {part} in\n{said}");
        }
    }
}

#[test]
fn absent_files_unknown_laws_and_lone_options_are_bad_input() {
    let folder = folder("absent", PROBE);
    for arguments in [
        ["laws", "coulomb", "--probe", "nothing.toml"].as_slice(),
        &["laws", "culomb", "--probe", "law.toml"],
        &["laws", "--probe", "law.toml"],
        &["laws", "coulomb", "--out", "x"],
    ] {
        let output = asperity(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    let said =
        String::from_utf8_lossy(&asperity(&folder, &["laws", "culomb", "--probe", "law.toml"]).stderr).into_owned();
    assert!(said.contains("did you mean `coulomb`"), "{said}");
}

#[test]
fn a_law_without_answer_is_told_with_time_and_values_and_the_rest_is_kept() {
    let folder = folder("overflow", &PROBE.replacen("pressure = 2.0", "pressure = 1e10", 1).replace("0.4", "1e300"));
    let output = probe(&folder, "coulomb");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    for part in ["1-velocity-steps: no step beyond time 0e0", "pressure 1e10", "no answer", "kept in out/law"] {
        assert!(said.contains(part), "no {part} in\n{said}");
    }
    assert_eq!(column(&folder.join("out/law/1-velocity-steps.csv"), "slip"), [0.0]);
    assert!(column(&folder.join("out/law/2-spring-slider.csv"), "slip").len() > 1000, "the others still run");
}

#[test]
fn laws_point_to_the_probe() {
    let folder = folder("help", PROBE);
    for arguments in [["laws"].as_slice(), &["laws", "coulomb"]] {
        assert!(String::from_utf8_lossy(&asperity(&folder, arguments).stdout).contains("--probe"));
    }
}
