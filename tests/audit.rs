//! Audits find planted faults and let a good run pass; steps that contact cannot follow are announced before the run.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use asperity::model::Record;
use asperity::verify::{Audit, Expectations, Finding};

const STEPS: usize = 40;
const FRICTION: f64 = 0.3;
const EXPECTED: Expectations = Expectations {
    friction: Some(FRICTION),
    dissipative: true,
    single_drive: true,
    inertia: false,
    viscosity: false,
    element_size: 0.05,
    negligible_force: 1e-8,
};

/// A pass whose figures agree with each other: a support that rises and falls, the local friction, no elasticity.
fn good() -> Vec<Record> {
    let mut work = 0.0;
    let mut before = [0.0; 2];
    let pass = |step: usize| {
        let place = step as f64 / STEPS as f64;
        let support = 0.02 * (PI * place).sin().max(0.0);
        let angle = 0.4 * (1.0 - 2.0 * place);
        let mu = (angle + FRICTION.atan()).tan();
        let force = if step == STEPS { [0.0, 0.0] } else { [mu * support, support] };
        let contact = force[1] > 0.0;
        let drive = [0.05 * step as f64, 0.0];
        work += 0.5 * (force[0] + before[0]) * 0.05;
        before = force;
        let dissipated = 3e-4 * place;
        Record {
            step,
            time: place,
            drive,
            force,
            mu_global: if contact { mu } else { f64::NAN },
            contact_angle: if contact { angle } else { f64::NAN },
            contact_length: if contact { 0.2 } else { 0.0 },
            penetration_max: if contact { 1e-3 } else { 0.0 },
            strain_energy: work - dissipated,
            dissipated,
            external_work: work,
            converged: true,
            reaction_base: force,
            fully_slipping: contact,
            force_imbalance: 1e-16,
            moment_imbalance: 1e-16,
            ..Record::default()
        }
    };
    (1..=STEPS).map(pass).collect()
}

fn findings(records: &[Record], expected: Expectations) -> Vec<Finding> {
    let mut audit = Audit::new(expected);
    records.iter().for_each(|record| audit.take(record));
    audit.findings()
}

/// Names and steps of what did not pass.
fn broken(records: &[Record], expected: Expectations) -> Vec<(&'static str, Option<usize>)> {
    findings(records, expected).iter().filter(|f| !f.passed).map(|f| (f.name, f.step)).collect()
}

/// Plants a fault at one step of the good run and asserts that this audit alone finds it, there.
fn finds(name: &str, step: usize, failure: bool, plant: impl Fn(&mut Record)) {
    let mut records = good();
    plant(&mut records[step - 1]);
    assert_eq!(broken(&records, EXPECTED), [(name, Some(step))]);
    let found = findings(&records, EXPECTED).into_iter().find(|f| f.name == name).unwrap();
    assert_eq!((found.failed(), found.warns()), (failure, !failure), "{found}");
}

#[test]
fn good_records_pass_and_every_audit_judges_some() {
    let found = findings(&good(), EXPECTED);
    assert_eq!(found.len(), 11);
    for finding in found {
        assert!(finding.passed && finding.judged > 20, "{finding:?}");
    }
}

#[test]
fn each_fault_is_found_where_it_was_planted() {
    finds("interface_force", 12, true, |r| r.force_imbalance = 1e-9);
    finds("interface_moment", 13, true, |r| r.moment_imbalance = 1e-9);
    finds("driven_reaction", 14, true, |r| r.reaction_base[1] += 1e-6);
    finds("friction_identity", 15, true, |r| r.mu_global += 1e-5);
    finds("friction_identity", 16, true, |r| r.contact_angle = f64::NAN);
    finds("dissipation", 17, true, |r| {
        r.dissipated -= 1e-4;
        r.strain_energy += 1e-4;
    });
    finds("energy_balance", 18, false, |r| r.external_work += 3e-4);
    finds("penetration", 19, false, |r| r.penetration_max = 0.011);
    finds("contact_lost", 10, false, |r| {
        r.contact_length = 0.0;
        r.fully_slipping = false;
    });
}

#[test]
fn no_number_is_never_a_pass() {
    finds("interface_force", 5, true, |r| r.force_imbalance = f64::NAN);
    finds("penetration", 6, false, |r| r.penetration_max = f64::NAN);
}

/// What a snap sets free is accounted for and told; a snap that gives energy is no snap.
#[test]
fn snaps_are_told_and_must_set_energy_free() {
    let snap = |sign: f64| {
        let mut records = good();
        records[20].snaps = 1;
        records[20..].iter_mut().for_each(|r| {
            r.snap_loss += sign * 0.02;
            r.strain_energy -= sign * 0.02;
        });
        broken(&records, EXPECTED).into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert_eq!(snap(1.0), ["snap"]);
    assert_eq!(snap(-1.0), ["energy_balance", "energy_created"]);
}

/// What integrator and viscosity took is accounted for, and told where it is much.
#[test]
fn losses_of_integrator_and_viscosity_are_told() {
    let expected = Expectations { inertia: true, viscosity: true, ..EXPECTED };
    let with = |share: f64, plant: fn(&mut Record, f64)| {
        let mut records = good();
        let peak = records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy.max(r.external_work)));
        records[20..].iter_mut().for_each(|r| {
            plant(r, share * peak);
            r.strain_energy -= share * peak;
        });
        broken(&records, expected).into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert_eq!(with(0.06, |r, energy| r.numerical_loss += energy), ["numerical_loss"]);
    assert_eq!(with(0.03, |r, energy| r.viscous_loss += energy), ["viscosity"]);
    let quiet: [fn(&mut Record, f64); 2] =
        [|r, energy| r.numerical_loss += energy, |r, energy| r.kinetic_energy += energy];
    assert!(quiet.map(|plant| with(0.04, plant)).iter().all(Vec::is_empty));
}

/// Energy from nowhere: more is stored than any rule of integration could make of the forces and ways on record.
#[test]
fn created_energy_fails_and_step_errors_do_not() {
    let mut records = good();
    records[20..].iter_mut().for_each(|r| r.strain_energy += 0.02);
    let names: Vec<_> = broken(&records, EXPECTED).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["energy_balance", "energy_created"]);
    // the same excess explained by few long steps: a warning only
    let mut coarse: Vec<Record> = good().into_iter().skip(9).step_by(10).take(2).collect();
    coarse[1].strain_energy += 0.005;
    let names: Vec<_> = broken(&coarse, EXPECTED).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["energy_balance"]);
    // what the bodies start with, for example by overlapping, is no creation
    let mut records = good();
    records.iter_mut().for_each(|r| r.strain_energy += 0.02);
    assert_eq!(broken(&records, EXPECTED), []);
}

/// Slip backwards, a resultant beyond the vertical, and laws without a known coefficient.
#[test]
fn identity_takes_either_direction_and_needs_a_coefficient() {
    let mut records = good();
    for r in records.iter_mut().filter(|r| r.fully_slipping) {
        r.mu_global = (r.contact_angle - FRICTION.atan()).tan();
    }
    assert_eq!(broken(&records, EXPECTED), []);
    for r in records.iter_mut().filter(|r| r.fully_slipping) {
        r.contact_angle = 1.5;
        r.mu_global = (1.5 + FRICTION.atan()).tan();
        assert!(r.mu_global < 0.0);
    }
    assert_eq!(broken(&records, EXPECTED), []);
    records[5].mu_global = 17.0;
    assert_eq!(broken(&records, EXPECTED), [("friction_identity", Some(6))]);
    assert_eq!(broken(&records, Expectations { friction: None, ..EXPECTED }), []);
}

const SCENE: &str = r#"
version = 1
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-1.0, 1.0], y = [-1.0, 0.0] }
material = "rubber"
elements = [8, 3]
[body.upper]
shape = { type = "block", x = [-0.5, 0.5], y = [0.0, 0.5], bottom = { type = "cosine", height = 0.2, wavelength = 0.8, centers = [0.0] } }
material = "rubber"
elements = [6, 3]
position = [0.0, 0.19]
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
steps = 8
[output]
fields = 0
figures = false
"#;

fn scene(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("audit").join(name);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    folder
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

#[test]
fn run_json_holds_audits_and_warnings() {
    let folder = scene("run");
    let said = asperity(&folder, &["run", "scene.toml", "--out", "out", "--set", "time.steps=4"]);
    let errors = String::from_utf8_lossy(&said.stderr);
    assert_eq!(said.status.code(), Some(0), "{errors}");
    let text = std::fs::read_to_string(folder.join("out/run.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["result"]["audit"]["passed"], true);
    let checks = json["result"]["audit"]["checks"].as_array().unwrap();
    assert_eq!(checks.len(), 11);
    let judged = |name: &str| checks.iter().find(|c| c["name"] == name).unwrap()["judged"].as_u64().unwrap();
    assert_eq!((judged("interface_force"), judged("energy_created")), (4, 4));
    assert!(judged("friction_identity") > 0, "the dragged block slips: {checks:?}");
    let warnings = json["warnings"].as_array().unwrap();
    assert_eq!(errors.lines().filter(|line| line.starts_with("warning: ")).count(), warnings.len());
    for warning in warnings {
        assert!(errors.contains(warning.as_str().unwrap()), "{warning} is not in\n{errors}");
    }
}

/// Contact elements of about 0.17: a drag of 2 is looked at as 8 steps of 0.5, then 2 steps of 2, then 64 short ones.
#[test]
fn check_warns_of_steps_that_contact_cannot_follow() {
    let folder = scene("check");
    let check = |steps: &str| {
        let drag = "drive.0.x.displacement.value=[0.0, 0.0, 2.0]";
        let said = asperity(&folder, &["check", "scene.toml", "--set", drag, "--set", steps]);
        assert!(said.status.success(), "{said:?}");
        String::from_utf8_lossy(&said.stdout).into_owned()
    };
    let long = check("time.steps=8");
    assert!(long.contains("`time.steps = 8`: body upper moves by 5.000e-1 in step 5, that is "), "{long}");
    let longer = check("time.steps=2");
    assert!(longer.contains("2.000e0 in step 2, farther than contact is looked for"), "{longer}");
    let short = check("time.steps=64");
    assert!(!short.contains("warnings:") && short.contains("shortest contact element h"), "{short}");
}

/// The set of degrees, by basis; the message names the key and what is allowed.
#[test]
fn multiplier_degrees_that_oscillate_are_refused() {
    let folder = scene("degrees");
    let check = |(basis, of_basis): (&str, usize), degree: usize| {
        let basis = format!("body.upper.basis={{ type = \"{basis}\", degree = {of_basis} }}");
        let degree = format!("contact.0.numerics.multiplier_degree={degree}");
        let said = asperity(&folder, &["check", "scene.toml", "--set", &basis, "--set", &degree]);
        (said.status.code(), String::from_utf8_lossy(&said.stderr).into_owned())
    };
    for (basis, degree, allowed) in [
        (("nurbs", 2), 1, "`2`, `0`"),
        (("nurbs", 3), 2, "`3`, `1`"),
        (("nurbs", 4), 1, "`4`, `2`, `0`"),
        (("lagrange", 1), 0, "`1`"),
    ] {
        let (code, said) = check(basis, degree);
        assert_eq!(code, Some(2), "{basis:?} {degree}: {said}");
        for part in ["key: contact.0.numerics.multiplier_degree\n", &format!("allowed: {allowed}"), "oscillates"] {
            assert!(said.contains(part), "{part:?} is not in\n{said}");
        }
    }
    for (basis, degree) in
        [(("nurbs", 2), 0), (("nurbs", 3), 1), (("nurbs", 2), 2), (("lagrange", 2), 1), (("lagrange", 1), 1)]
    {
        assert_eq!(check(basis, degree).0, Some(0), "{basis:?} {degree}");
    }
}
