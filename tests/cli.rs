//! The command line: commands, exit codes, and what a run leaves behind.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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
[output]
fields = 2
figures = false
"#;

/// An empty folder of this test alone.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    folder
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

fn stdout(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn run_json(out: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(out.join("run.json")).unwrap()).unwrap()
}

#[test]
fn run_leaves_history_interface_fields_and_the_input() {
    let folder = folder("run");
    let said = asperity(&folder, &["run", "scene.toml", "--set", "contact.0.law.friction=0.25"]);
    assert!(stdout(&said).contains("done: "), "{said:?}");
    let out = folder.join("out/scene");
    let history = std::fs::read_to_string(out.join("history.csv")).unwrap();
    assert!(history.starts_with(
        "step,time,drive_x,drive_y,fx,fy,mu_global,contact_angle,contact_length,pressure_max,penetration_max,\
         strain_energy,dissipated,external_work,newton_iterations,cuts,converged,wall_s"
    ));
    assert_eq!(history.lines().count(), 1 + 4);
    let mu: f64 = history.lines().last().unwrap().split(',').nth(6).unwrap().parse().unwrap();
    assert!(mu > 0.2 && mu < 0.3, "a flat block dragged over a flat block shows about its local friction, not {mu}");
    assert!(out.join("interface.csv").exists() && out.join("fields.pvd").exists() && out.join("README.txt").exists());
    assert_eq!(std::fs::read_dir(out.join("fields")).unwrap().count(), 3);
    let json = run_json(&out);
    assert_eq!(json["result"]["status"], "done");
    assert_eq!(json["scene"]["contact"][0]["law"]["friction"], 0.25);
    assert_eq!(json["scene"]["contact"][0]["numerics"]["sites"], "quadrature");
    let lines = String::from_utf8_lossy(&said.stderr);
    assert_eq!(lines.lines().filter(|line| line.starts_with("step ")).count(), 4, "{lines}");
}

#[test]
fn certify_solves_every_step_twice_and_says_what_it_found() {
    let folder = folder("certify");
    for (command, flag) in [("certify", None), ("run", Some("--certify"))] {
        let mut arguments = vec![command, "scene.toml", "--out", command, "--set", "time.steps=2"];
        arguments.extend(flag);
        let output = asperity(&folder, &arguments);
        assert!(output.status.success(), "{output:?}");
        assert!(stdout(&output).starts_with("conic cross-check of 2 steps: 2 agree, 0 inconclusive, 0 disagree"));
        let table = std::fs::read_to_string(folder.join(command).join("certify.csv")).unwrap();
        let rows: Vec<&str> = table.lines().collect();
        assert!(rows[0].starts_with("step,time,verdict,du,dp,dq,dfx,dfy,newton_iterations,programmes"));
        assert_eq!(rows.iter().filter(|row| row.contains(",agrees,")).count(), 2, "{table}");
        let result = &run_json(&folder.join(command))["result"];
        assert_eq!(result["certified"]["agrees"], 2);
        assert_eq!(result["counters"]["rescued_steps"], 0);
    }
}

#[test]
fn quiet_is_quiet() {
    let folder = folder("quiet");
    let said = asperity(
        &folder,
        &["run", "scene.toml", "--quiet", "--out", "there", "--set", "time.steps=1", "--set", "time.end=0.1"],
    );
    assert_eq!(stdout(&said), "");
    assert!(said.stderr.is_empty(), "{said:?}");
    assert!(folder.join("there/history.csv").exists());
}

#[test]
fn two_runs_write_the_same_bytes() {
    let folder = folder("same");
    for out in ["a", "b"] {
        stdout(&asperity(&folder, &["run", "scene.toml", "--quiet", "--out", out]));
    }
    let read = |out: &str| std::fs::read_to_string(folder.join(out).join("interface.csv")).unwrap();
    assert_eq!(read("a"), read("b"));
}

/// A body whose top is driven below its own bottom has no solution: what came before is kept.
#[test]
fn no_convergence_is_exit_code_3_and_keeps_results() {
    let folder = folder("no-convergence");
    let crush = "[[drive]]\nbody = \"lower\"\nedge = \"top\"\nx = { displacement = 0.0 }\n\
                 y = { displacement = { time = [0.5, 1.0], value = [0.0, -1.5] } }\n";
    std::fs::write(folder.join("scene.toml"), format!("{SCENE}{crush}")).unwrap();
    let said = asperity(&folder, &["run", "scene.toml", "--out", "out", "--set", "time.max_cuts=2"]);
    let error = String::from_utf8_lossy(&said.stderr);
    assert_eq!(said.status.code(), Some(3), "{error}");
    assert!(error.contains("no convergence after time") && error.contains("kept in out"), "{error}");
    let history = std::fs::read_to_string(folder.join("out/history.csv")).unwrap();
    assert!((1 + 2..1 + 4).contains(&history.lines().count()), "{history}");
    assert_eq!(run_json(&folder.join("out"))["result"]["status"], "not converged");
}

#[cfg(unix)]
#[test]
fn interrupt_is_exit_code_5_and_keeps_results() {
    let folder = folder("interrupt");
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(&folder)
        .args([
            "run",
            "scene.toml",
            "--quiet",
            "--out",
            "out",
            "--set",
            "time.steps=100000",
            "--set",
            "output.fields=0",
        ])
        .spawn()
        .unwrap();
    let history = folder.join("out/history.csv");
    let rows = || std::fs::read_to_string(&history).unwrap_or_default().lines().count();
    while rows() < 3 {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    assert_eq!(child.wait().unwrap().code(), Some(5));
    let json = run_json(&folder.join("out"));
    assert_eq!(json["result"]["status"], "interrupted");
    assert_eq!(json["result"]["counters"]["nominal_steps"], rows() - 1);
}

#[test]
fn check_tells_what_is_modelled_and_what_is_not() {
    let folder = folder("check");
    let said = stdout(&asperity(&folder, &["check", "scene.toml"]));
    for part in [
        "body lower: neo-hookean",
        "law coulomb",
        "closest projection",
        "left out, because:",
        "inertia",
        "no memory",
        "unknowns:",
    ] {
        assert!(said.contains(part), "{part:?} missing in\n{said}");
    }
    let said =
        stdout(&asperity(&folder, &["check", "scene.toml", "--set", "contact.0.law={ type = \"frictionless\" }"]));
    assert!(said.contains("tangential unknowns, slip history and state variables of contact 0"), "{said}");
    let sets = ["--set", "dynamics={}", "--set", "material.rubber.density=4.0", "--set", "solution.viscosity=0.01"];
    let said = stdout(&asperity(&folder, &[&["check", "scene.toml"][..], &sets].concat()));
    for part in ["inertia: consistent mass", "spectral radius 0.8", "mass of body upper", "viscosity: Kelvin-Voigt"] {
        assert!(said.contains(part), "{part:?} missing in\n{said}");
    }
    assert!(!said.contains("the analysis is quasi-static"), "{said}");
    let said = stdout(&asperity(&folder, &["check", "scene.toml", "--set", "material.rubber.density=4.0"]));
    assert!(said.contains("inertia: the analysis is quasi-static: there is a `density`, but no [dynamics]"), "{said}");
    assert!(!folder.join("out").exists());
}

#[test]
fn every_law_is_listed_and_explained() {
    let folder = folder("laws");
    let list = stdout(&asperity(&folder, &["laws"]));
    for law in asperity::laws::linked() {
        assert!(list.contains(law.name));
        let said = stdout(&asperity(&folder, &["laws", law.name]));
        assert!(said.contains(law.equation) && said.contains(law.reference), "{said}");
        for parameter in law.parameters {
            let (name, unit, range) = (parameter.name, parameter.unit, parameter.range);
            assert!(said.contains(&format!("{name} [{unit}]")) && said.contains(&range.to_string()), "{said}");
        }
    }
}

#[test]
fn schema_is_json_and_help_teaches_exit_codes() {
    let folder = folder("schema");
    let schema: serde_json::Value = serde_json::from_str(&stdout(&asperity(&folder, &["schema"]))).unwrap();
    assert_eq!(schema["title"], "asperity scene");
    let help = stdout(&asperity(&folder, &["--help"]));
    for code in [
        "0  done",
        "1  internal",
        "2  bad input",
        "3  did not converge",
        "4  converged, but an audit",
        "5  interrupted",
    ] {
        assert!(help.contains(code), "{help}");
    }
}
