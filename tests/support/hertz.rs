//! Hertz' line contact with everything adjustable, see `tests/hertz.rs`.
#![allow(dead_code)] // each test binary uses its part

use std::convert::Infallible;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{LinearElastic, VolumeSpace};
use asperity::contact::{Integration, InterfaceForces, Sites};
use asperity::geometry::shapes::{Along, ArcProfile, Block};
use asperity::geometry::{BasisSpec, Edge, Grading, Profile, ShapeSpec, build, build_edge};
use asperity::laws::builtin::Frictionless;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve::{self, Status};

/// Radius of a cylinder.
pub const RADIUS: f64 = 2000.0;
/// Half the width of the zone of small elements.
const FINE: f64 = 1.5;
/// Growth from element to element outside.
const GROWTH: f64 = 0.25;
/// A cylinder pressed against a rigid plane or another cylinder.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Cylinder on a rigid plane, or two cylinders.
    pub plane: bool,
    /// Elements on the nominal half-width of the contact.
    pub per_a: f64,
    /// Half-width of the contact that is aimed at.
    pub a: f64,
    pub basis: BasisSpec,
    pub sites: Sites,
    pub integration: Integration,
    pub r: f64,
    /// Half the width of a body, and its height.
    pub size: f64,
    /// Poisson's ratio.
    pub nu: f64,
    /// Space of the dilatations; `None` leaves it to the program.
    pub volume: Option<Option<VolumeSpace>>,
}

pub const PLANE: Case = Case {
    plane: true,
    per_a: 9.0,
    a: 1.0,
    basis: BasisSpec::Nurbs { degree: 2 },
    sites: Sites::Quadrature,
    integration: Integration::Element,
    r: 1.0,
    size: 40.0,
    nu: 0.3,
    volume: None,
};
pub const TWO: Case = Case { plane: false, ..PLANE };

impl Case {
    /// Contact modulus E* and radius R.
    pub fn contact(&self) -> (f64, f64) {
        let modulus = 1.0 / (1.0 - self.nu * self.nu);
        if self.plane { (modulus, RADIUS) } else { (0.5 * modulus, 0.5 * RADIUS) }
    }

    fn force(&self) -> f64 {
        let (modulus, radius) = self.contact();
        PI * modulus * self.a.powi(2) / (4.0 * radius)
    }

    /// A cylinder whose round side has elements of length `h` at the contact; its apex is at `apex`.
    fn cylinder(&self, round: Edge, h: f64, apex: f64) -> BodySpec {
        let arc = ArcProfile { radius: RADIUS, height: None, centers: None, count: None, spacing: None };
        let (arc, flat, x) = (Profile::Arc(arc), Profile::default(), [-self.size, self.size]);
        let rise = RADIUS - (RADIUS.powi(2) - self.size.powi(2)).sqrt();
        let (block, y) = match round {
            Edge::Top => (Block { x, y: [-self.size, 0.0], top: arc, bottom: flat }, apex - rise),
            _ => (Block { x, y: [0.0, self.size], top: flat, bottom: arc }, apex + rise),
        };
        let [aside, across] = [self.size - FINE, self.size].map(|length| 1.0 + GROWTH * length / h);
        let along = Along { center: 0.0, half_width: FINE, ratio: aside };
        let grading = Grading { toward: Some(round), ratio: Some(across), along: Some(along) };
        let counts = [2.0 * (FINE / h + aside.ln() / GROWTH), across.ln() / GROWTH].map(|n| n.round() as usize);
        let shape = ShapeSpec::Block(block);
        let patch = build(&shape, &self.basis, counts, Some(&grading), [0.0, y], Path::new(".")).expect("a block");
        BodySpec::Deformable(patch, Arc::new(LinearElastic { youngs_modulus: 1.0, poissons_ratio: self.nu }))
    }

    fn counterpart(&self) -> BodySpec {
        if !self.plane {
            return self.cylinder(Edge::Top, 0.93 / self.per_a, 0.0);
        }
        let block = Block {
            x: [-2.0 * self.size, 2.0 * self.size],
            y: [-1.0, 0.0],
            top: Profile::default(),
            bottom: Profile::default(),
        };
        let (shape, basis) = (ShapeSpec::Block(block), BasisSpec::Nurbs { degree: 1 });
        let line = build_edge(&shape, Edge::Top, &basis, [1, 1], None, [0.0; 2], Path::new(".")).expect("a line");
        BodySpec::Rigid(vec![(Edge::Top, line)])
    }

    /// The upper body starts with a small overlap and is held by the contact alone.
    fn model(&self) -> Model {
        let mut builder = Builder::default();
        let hold = || Control::Displacement(Table::constant(0.0));
        let press = Control::Force(Table::constant(-self.force()));
        let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), Arc::new(Frictionless {}));
        pair.sites = Some(self.sites);
        pair.integration = Some(self.integration);
        pair.r = Some(self.r);
        let built = (|| {
            let bodies = [
                ("upper", self.cylinder(Edge::Bottom, 1.0 / self.per_a, -0.1 / RADIUS)),
                ("lower", self.counterpart()),
            ];
            for (name, spec) in bodies {
                match self.volume {
                    None => builder.body(name, spec)?,
                    Some(space) => builder.body_in(name, spec, space)?,
                };
            }
            builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
            builder.motion("upper", Edge::Top, 0, hold(), true)?.motion("upper", Edge::Top, 1, press, true)?;
            builder.contact(pair);
            builder.build()
        })();
        built.expect("a valid model")
    }

    /// The state that carries the load.
    pub fn solve(&self) -> Solved {
        let model = self.model();
        let control = solve::Control { end: 1.0, steps: 1, max_cuts: 0, strategy: Default::default() };
        let (quiet, mut solver) = (AtomicBool::new(false), CondensedSolver::default());
        let mut found = None;
        let outcome = solve::march(&model, State::initial(&model), &control, &mut solver, &quiet, |report| {
            found = Some(report.evaluation.interfaces[0].clone());
            Ok::<(), Infallible>(())
        });
        let outcome = outcome.unwrap_or_else(|e| match e {});
        assert_eq!(outcome.status, Status::Done, "{self:?}");
        Solved { model, state: outcome.state, interface: found.expect("one step") }
    }

    /// Errors against Hertz' solution for the force that is found, in percent.
    pub fn errors(&self) -> [f64; 3] {
        let found = self.solve();
        self.compare(found.interface.normal_force.y, &found.pressures(self.sites))
    }

    /// `a` and `p0` for a force.
    pub fn hertz(&self, force: f64) -> [f64; 2] {
        let (modulus, radius) = self.contact();
        let a = (4.0 * force * radius / (PI * modulus)).sqrt();
        [a, 2.0 * force / (PI * a)]
    }

    /// `[relative L2, maximum over p0, peak]` inside 0.9 a, in percent, from `[x, p, weight]`.
    fn compare(&self, force: f64, found: &[[f64; 3]]) -> [f64; 3] {
        let [a, p0] = self.hertz(force);
        assert!((a / self.a - 1.0).abs() < 1e-7, "the contact carries the load");
        let exact = |x: f64| p0 * (1.0 - (x / a).powi(2)).max(0.0).sqrt();
        let (mut square, mut scale, mut worst, mut peak) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        for &[x, p, w] in found.iter().filter(|s| s[0].abs() < 0.9 * a) {
            let error = p - exact(x);
            square += w * error.powi(2);
            scale += w * exact(x).powi(2);
            worst = worst.max(error.abs());
            peak = peak.max(p);
        }
        [(square / scale).sqrt(), worst / p0, (peak / p0 - 1.0).abs()].map(|e| 100.0 * e)
    }
}

/// A pressed pair.
pub struct Solved {
    pub model: Model,
    pub state: State,
    pub interface: InterfaceForces,
}

impl Solved {
    /// `[x, pressure, weight]`: the sites themselves, or the multiplier field of `nodal` sites at eight places per element.
    pub fn pressures(&self, sites: Sites) -> Vec<[f64; 3]> {
        let Self { model, state, interface } = self;
        if sites == Sites::Quadrature {
            return interface.sites.iter().map(|s| [s.x.x, s.pressure, s.weight]).collect();
        }
        let curve = model.bodies[0].edge(Edge::Bottom).expect("the nonmortar edge");
        let breaks = curve.basis.breaks().to_vec();
        let at = |k: usize| {
            let (span, length) = (k / 8, breaks[k / 8 + 1] - breaks[k / 8]);
            let shape = curve.shape(span, breaks[span] + length * ((k % 8) as f64 + 0.5) / 8.0);
            let p: f64 = (0..shape.count).map(|i| shape.d[0][i] * state.pairs[0].pressure[shape.first + i]).sum();
            [curve.place(&shape, 0, &curve.points).x, p, length]
        };
        (0..8 * curve.spans()).map(at).collect()
    }
}
