//! The two-asperity problem of the design (section 8) with everything adjustable, and a way to run it.
#![allow(dead_code)] // each test binary uses its part

use std::convert::Infallible;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{NeoHookean, VolumeSpace};
use asperity::contact::{Integration, Projection, Sites};
use asperity::geometry::shapes::{Block, Cosine};
use asperity::geometry::{BasisSpec, Edge, Profile, ShapeSpec, build};
use asperity::laws::FrictionLaw;
use asperity::laws::builtin::Coulomb;
use asperity::math::CondensedSolver;
use asperity::model::{
    BodySpec, Builder, Control, InterfaceRow, Model, PairSpec, Record, State, Table, interface_rows,
};
use asperity::solve::{self, Outcome, Status, Strategy};

/// What can be varied. Lengths are multiples of `length`, moduli of `stress`.
#[derive(Clone, Debug)]
pub struct Pass {
    pub friction: f64,
    pub law: Option<Arc<dyn FrictionLaw>>,
    pub degree: usize,
    pub lagrange: bool,
    pub element: f64,
    pub steps: usize,
    pub sites: Option<Sites>,
    pub projection: Option<Projection>,
    pub integration: Option<Integration>,
    pub points: Option<usize>,
    pub r: f64,
    pub length: f64,
    pub stress: f64,
    /// Height of the asperities, and how far the tips overlap when one passes the other.
    pub height: f64,
    pub overlap: f64,
    pub poissons_ratio: f64,
    /// Space of the dilatations; `None` leaves it to the program.
    pub volume: Option<Option<VolumeSpace>>,
    /// Part of the path: positions of the upper asperity.
    pub from: f64,
    pub to: f64,
}

impl Default for Pass {
    fn default() -> Self {
        Self {
            friction: 0.3,
            law: None,
            degree: 2,
            lagrange: false,
            element: 0.1,
            steps: 76,
            sites: None,
            projection: None,
            integration: None,
            points: None,
            r: 1.0,
            length: 1.0,
            stress: 1.0,
            height: 0.4,
            overlap: 0.2,
            poissons_ratio: 0.3,
            volume: None,
            from: -1.9,
            to: 1.9,
        }
    }
}

fn body(setup: &Pass, up: bool, h: f64) -> BodySpec {
    let l = setup.length;
    let bump =
        Cosine { height: setup.height * l, wavelength: 1.6 * l, centers: Some(vec![0.0]), count: None, spacing: None };
    let (bump, flat) = (Profile::Cosine(bump), Profile::default());
    let (block, position) = if up {
        (Block { x: [-2.0 * l, 2.0 * l], y: [-l, 0.0], top: bump, bottom: flat }, [0.0, 0.0])
    } else {
        (
            Block { x: [-l, l], y: [0.0, l], top: flat, bottom: bump },
            [setup.from * l, (2.0 * setup.height - setup.overlap) * l],
        )
    };
    let basis = match setup.lagrange {
        true => BasisSpec::Lagrange { degree: setup.degree },
        false => BasisSpec::Nurbs { degree: setup.degree },
    };
    let count = |length: f64| (length / l / h).round() as usize;
    let elements = [count(block.x[1] - block.x[0]), count(l)];
    let patch = build(&ShapeSpec::Block(block), &basis, elements, None, position, Path::new(".")).expect("a block");
    let material = NeoHookean { youngs_modulus: setup.stress, poissons_ratio: setup.poissons_ratio };
    BodySpec::Deformable(patch, Arc::new(material))
}

/// The model of a pass.
pub fn pass(setup: &Pass) -> Model {
    let mut builder = Builder::default();
    let travel = (setup.to - setup.from) * setup.length;
    let hold = || Control::Displacement(Table::constant(0.0));
    let drag = Control::Displacement(Table { time: vec![0.0, 1.0], value: vec![0.0, travel] });
    let law = setup.law.clone().unwrap_or_else(|| Arc::new(Coulomb { friction: setup.friction }));
    let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), law);
    pair.sites = setup.sites;
    pair.projection = setup.projection;
    pair.integration = setup.integration;
    pair.points = setup.points;
    pair.r = Some(setup.r);
    let built = (|| {
        for (name, spec) in
            [("lower", body(setup, true, setup.element)), ("upper", body(setup, false, 0.93 * setup.element))]
        {
            match setup.volume {
                None => builder.body(name, spec)?,
                Some(space) => builder.body_in(name, spec, space)?,
            };
        }
        builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
        builder.motion("upper", Edge::Top, 0, drag, true)?.motion("upper", Edge::Top, 1, hold(), true)?;
        builder.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}

/// A finished run.
pub struct Run {
    pub model: Model,
    pub records: Vec<Record>,
    pub states: Vec<State>,
    pub rows: Vec<Vec<InterfaceRow>>,
    pub outcome: Outcome,
}

impl Run {
    /// Records with contact.
    pub fn touching(&self) -> impl Iterator<Item = &Record> {
        self.records.iter().filter(|r| r.contact_length > 0.0)
    }

    /// Largest magnitude of a force component.
    pub fn peak(&self, component: usize) -> f64 {
        self.records.iter().fold(0.0, |m, r| m.max(r.force[component].abs()))
    }
}

/// Runs a model over `[0, 1]`.
pub fn run(model: Model, steps: usize) -> Run {
    run_by(model, steps, Strategy::default())
}

/// The same by a strategy.
pub fn run_by(model: Model, steps: usize, strategy: Strategy) -> Run {
    let (mut records, mut states, mut rows) = (vec![], vec![], vec![]);
    let control = solve::Control { end: 1.0, steps, max_cuts: 8, strategy };
    let quiet = AtomicBool::new(false);
    let outcome =
        solve::march(&model, State::initial(&model), &control, &mut CondensedSolver::default(), &quiet, |report| {
            rows.push(interface_rows(&model, report.evaluation, report.record.step));
            records.push(report.record);
            states.push(report.state.clone());
            Ok::<(), Infallible>(())
        });
    let outcome = outcome.unwrap_or_else(|e| match e {});
    Run { model, records, states, rows, outcome }
}

/// The finished run of a pass that must reach its end.
pub fn done(setup: &Pass) -> Run {
    let found = run(pass(setup), setup.steps);
    assert_eq!(found.outcome.status, Status::Done, "{setup:?}");
    found
}

/// Contact lasts from about -0.53 to 0.53; this climbs into it.
pub fn climb() -> Pass {
    Pass { element: 0.2, steps: 8, from: -0.6, to: -0.2, ..Pass::default() }
}

/// All kinds of sites with all projections.
pub fn all_choices() -> Vec<(Sites, Projection)> {
    let projections = [Projection::Closest, Projection::Ray];
    [Sites::Quadrature, Sites::Nodal].into_iter().flat_map(|s| projections.map(|p| (s, p))).collect()
}
