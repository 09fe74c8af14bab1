//! One asperity passing another on a coarse mesh, any number of it replaced, and what came of it.

use std::convert::Infallible;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use asperity::model::{Record, State};
use asperity::scene::{Scene, build, time_plan};
use asperity::solve::{Outcome, Status, march};
use asperity::verify::{Audit, Expectations, Finding, warnings};

const SCENE: &str = r#"
version = 1
[material.low]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[material.up]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-2.0, 2.0], y = [-1.0, 0.0], top = { type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] } }
material = "low"
elements = [24, 5]
[body.upper]
shape = { type = "block", x = [-1.0, 1.0], y = [0.0, 1.0], bottom = { type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] } }
material = "up"
elements = [13, 5]
position = [-0.8, 0.6]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = { time = [0.0, 1.0], value = [0.0, 1.6] } }
y = { displacement = 0.0 }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "coulomb", friction = 0.3 }
[time]
end = 1.0
steps = 32
"#;

/// Flat faces in place of the asperities, touching exactly.
pub const FLAT: [&str; 3] = [
    "body.lower.shape.top={ type = \"flat\" }",
    "body.upper.shape.bottom={ type = \"flat\" }",
    "body.upper.position=[-0.8, 0.0]",
];

/// Pressed down by 0.05 in the first fifth of the time.
pub const PRESS: &str = "drive.0.y={ displacement = { time = [0.0, 0.2, 1.0], value = [0.0, -0.05, -0.05] } }";

/// Nonmortar and mortar side exchanged.
pub const SWAP: [&str; 2] = [
    "contact.0.nonmortar={ body = \"lower\", edge = \"top\" }",
    "contact.0.mortar={ body = \"upper\", edge = \"bottom\" }",
];

/// A finished or given up run.
pub struct Found {
    pub records: Vec<Record>,
    pub outcome: Outcome,
    pub findings: Vec<Finding>,
    /// What is said before the run.
    pub warnings: Vec<String>,
}

/// A run, however it ends.
pub fn run(sets: &[&str]) -> Found {
    compute(SCENE.to_string(), sets)
}

/// Runs a scene with these replacements.
fn compute(text: String, sets: &[&str]) -> Found {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    let (scene, _) = Scene::parse(Path::new("extreme.toml"), text, &sets).expect("a valid scene");
    let model = build(&scene, Path::new(".")).expect("a model");
    let (mut audit, mut records) = (Audit::new(Expectations::of(&model)), vec![]);
    let (plan, quiet, mut solver) = (time_plan(&scene), AtomicBool::new(false), scene.solution.solver.create());
    let outcome = march(&model, State::initial(&model), &plan, solver.as_mut(), &quiet, |report| {
        audit.take(&report.record);
        records.push(report.record);
        Ok::<(), Infallible>(())
    });
    let outcome = outcome.unwrap_or_else(|e| match e {});
    Found { records, outcome, findings: audit.findings(), warnings: warnings(&model, &plan) }
}

/// A run that must reach its end with all audits green.
pub fn solved(name: &str, sets: &[&str]) -> Found {
    let found = run(sets);
    found.check(name);
    found
}

/// The same with one body rigid.
pub fn against_rigid(body: &str, sets: &[&str]) -> Found {
    let held = "[[support]]\nbody = \"lower\"\nedge = \"bottom\"\ndisplacement = { x = 0.0, y = 0.0 }\n";
    let text = match body {
        "lower" => SCENE.replace("material = \"low\"", "rigid = true").replace(held, ""),
        _ => SCENE.replace("material = \"up\"", "rigid = true"),
    };
    let found = compute(text, sets);
    found.check(&format!("rigid {body} body"));
    found
}

impl Found {
    fn check(&self, name: &str) {
        let Outcome { status, iterations, cuts, snaps, .. } = &self.outcome;
        println!("{name}: {status:?}, {iterations} iterations, {cuts} cuts, {snaps} snaps");
        assert_eq!(*status, Status::Done, "{name}");
        let failed: Vec<_> = self.findings.iter().filter(|f| f.failed()).map(Finding::to_string).collect();
        assert!(failed.is_empty(), "{name}: {failed:?}");
        assert!(self.records.iter().any(|r| r.contact_length > 0.0), "{name}: never in contact");
    }

    /// The same without an end of the equilibrium path.
    pub fn smooth(self, name: &str) -> Self {
        assert_eq!(self.outcome.snaps, 0, "{name}: {:?}", self.outcome.status);
        self
    }

    pub fn last(&self) -> &Record {
        self.records.last().expect("a step")
    }

    /// Largest force of a component.
    pub fn peak(&self, c: usize) -> f64 {
        self.records.iter().fold(0.0, |m, r| m.max(r.force[c].abs()))
    }

    /// Largest difference of the forces times `unit` from another run, over its peak.
    pub fn difference(&self, unit: f64, other: &Self) -> f64 {
        let pairs = self.records.iter().zip(&other.records);
        let worst = pairs.flat_map(|(a, b)| [0, 1].map(|c| (unit * a.force[c] - b.force[c]).abs())).fold(0.0, f64::max);
        worst / other.peak(0).max(other.peak(1))
    }
}
