//! Scenes as text, run through the library.
#![allow(dead_code)] // each test binary uses its part

use std::convert::Infallible;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use asperity::geometry::Point;
use asperity::math::CondensedSolver;
use asperity::model::{Model, Record, State};
use asperity::scene::{Scene, build, time_plan};
use asperity::solve::{Outcome, Status, march};
use asperity::verify::{Audit, Expectations, Finding};

/// A finished run.
pub struct Run {
    pub model: Model,
    pub records: Vec<Record>,
    pub states: Vec<State>,
    pub outcome: Outcome,
    pub findings: Vec<Finding>,
}

/// The model of a scene, and the scene.
pub fn model(text: &str) -> (Scene, Model) {
    let (scene, _) = Scene::parse(Path::new("scene.toml"), text.to_string(), &[]).unwrap_or_else(|e| panic!("{e}"));
    let model = build(&scene, Path::new(".")).unwrap_or_else(|e| panic!("{e}"));
    (scene, model)
}

/// Runs a scene to its end.
pub fn run(text: &str) -> Run {
    run_from(text, |_, _| ())
}

/// Runs a scene to its end from a state that `prepare` may change.
pub fn run_from(text: &str, prepare: impl Fn(&Model, &mut State)) -> Run {
    let (scene, model) = model(text);
    let mut start = State::initial(&model);
    prepare(&model, &mut start);
    let (mut records, mut states) = (vec![], vec![start.clone()]);
    let mut audit = Audit::new(Expectations::of(&model));
    let (quiet, mut solver) = (AtomicBool::new(false), CondensedSolver::default());
    let outcome = march(&model, start, &time_plan(&scene), &mut solver, &quiet, |report| {
        audit.take(&report.record);
        records.push(report.record);
        states.push(report.state.clone());
        Ok::<(), Infallible>(())
    });
    let outcome = outcome.unwrap_or_else(|e| match e {});
    assert_eq!(outcome.status, Status::Done, "{text}");
    Run { model, records, states, outcome, findings: audit.findings() }
}

impl Run {
    /// Control points whose reference position fulfils a condition.
    pub fn nodes(&self, which: impl Fn(Point) -> bool) -> Vec<usize> {
        self.model.reference().enumerate().filter(|(_, x)| which(*x)).map(|(i, _)| i).collect()
    }

    /// Mean displacement of control points at every state.
    pub fn mean(&self, nodes: &[usize], component: usize) -> Vec<f64> {
        let of = |state: &State| nodes.iter().map(|&i| state.u[i][component]).sum::<f64>() / nodes.len() as f64;
        self.states.iter().map(of).collect()
    }

    /// Times of all states.
    pub fn times(&self) -> Vec<f64> {
        self.states.iter().map(|state| state.time).collect()
    }

    /// Momentum of all bodies at every state.
    pub fn momentum(&self) -> Vec<Point> {
        let inertia = self.model.inertia.as_ref().expect("a dynamic scene");
        let of = |state: &State| inertia.times(&state.rates.velocity).iter().sum();
        self.states.iter().map(of).collect()
    }

    pub fn last(&self) -> &Record {
        self.records.last().expect("steps")
    }

    /// Asserts that all audits hold.
    pub fn passes(&self) {
        let broken: Vec<String> = self.findings.iter().filter(|f| !f.passed).map(|f| f.to_string()).collect();
        assert!(broken.is_empty(), "{broken:?}");
    }
}
