//! Hertz' line contact: a cylinder on a rigid plane and two cylinders, against the half-space solution
//! (Johnson, Contact Mechanics, 1985, section 4.2(c); theory.md 4.2)
//!
//! ```text
//! a = sqrt(4 F R/(pi E*)),   p0 = 2 F/(pi a),   p = p0 sqrt(1 - x^2/a^2)
//! ```
//!
//! E = 1, nu = 0.3, small strain, a = 1, cylinders of radius 2000 cut to blocks 80 wide and 40 high, pressed by a force.
//! The errors depend on where the contact edge lies inside an element: every figure is the mean (and the worst) over
//! loads whose a/h is spread evenly over one element. L2 and maximal error are taken inside |x| < 0.9 a.

use std::convert::Infallible;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::LinearElastic;
use asperity::contact::{Integration, InterfaceForces, Sites};
use asperity::geometry::shapes::{Along, ArcProfile, Block};
use asperity::geometry::{BasisSpec, Edge, Grading, Profile, ShapeSpec, build, build_edge};
use asperity::laws::builtin::Frictionless;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve::{self, Status};

const NU: f64 = 0.3;
const RADIUS: f64 = 2000.0;
/// Half the width of the zone of small elements.
const FINE: f64 = 1.5;
/// Growth from element to element outside.
const GROWTH: f64 = 0.25;
/// Loads per element.
const PHASES: usize = 5;

#[derive(Clone, Copy, Debug)]
struct Case {
    /// Cylinder on a rigid plane, or two cylinders.
    plane: bool,
    /// Elements on the nominal half-width of the contact.
    per_a: f64,
    /// Half-width of the contact that is aimed at.
    a: f64,
    basis: BasisSpec,
    sites: Sites,
    integration: Integration,
    r: f64,
    /// Half the width of a body, and its height.
    size: f64,
}

const PLANE: Case = Case {
    plane: true,
    per_a: 9.0,
    a: 1.0,
    basis: BasisSpec::Nurbs { degree: 2 },
    sites: Sites::Quadrature,
    integration: Integration::Element,
    r: 1.0,
    size: 40.0,
};
const TWO: Case = Case { plane: false, ..PLANE };

impl Case {
    /// Contact modulus E* and radius R.
    fn contact(&self) -> (f64, f64) {
        let modulus = 1.0 / (1.0 - NU * NU);
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
        BodySpec::Deformable(patch, Arc::new(LinearElastic { youngs_modulus: 1.0, poissons_ratio: NU }))
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
            builder.body("upper", self.cylinder(Edge::Bottom, 1.0 / self.per_a, -0.1 / RADIUS))?;
            builder.body("lower", self.counterpart())?;
            builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
            builder.motion("upper", Edge::Top, 0, hold(), true)?.motion("upper", Edge::Top, 1, press, true)?;
            builder.contact(pair);
            builder.build()
        })();
        built.expect("a valid model")
    }

    /// Errors against Hertz' solution for the force that is found, in percent.
    fn errors(&self) -> [f64; 3] {
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
        let interface = found.expect("one step");
        self.compare(interface.normal_force.y, &pressures(&model, &outcome.state, &interface, self.sites))
    }

    /// `[relative L2, maximum over p0, peak]` inside 0.9 a, in percent, from `[x, p, weight]`.
    fn compare(&self, force: f64, found: &[[f64; 3]]) -> [f64; 3] {
        let (modulus, radius) = self.contact();
        let a = (4.0 * force * radius / (PI * modulus)).sqrt();
        let p0 = 2.0 * force / (PI * a);
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

/// `[x, pressure, weight]`: the sites themselves, or the multiplier field of `nodal` sites at eight places per element.
fn pressures(model: &Model, state: &State, interface: &InterfaceForces, sites: Sites) -> Vec<[f64; 3]> {
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

/// Mean and worst `[L2, maximum, peak]` over the phases; prints a row.
fn measure(name: &str, case: Case) -> [[f64; 3]; 2] {
    let phase = |k: usize| 1.0 + ((k as f64 + 0.5) / PHASES as f64 - 0.5) / case.per_a;
    let all: Vec<[f64; 3]> = (0..PHASES).map(|k| Case { a: phase(k), ..case }.errors()).collect();
    let mean = [0, 1, 2].map(|i| all.iter().map(|e| e[i]).sum::<f64>() / PHASES as f64);
    let worst = [0, 1, 2].map(|i| all.iter().map(|e| e[i]).fold(0.0, f64::max));
    let cell = |i: usize| format!("{:6.3} ({:6.3})", mean[i], worst[i]);
    println!("{name:44} {:4.1}  {}  {}  {}", case.per_a, cell(0), cell(1), cell(2));
    [mean, worst]
}

fn heading() {
    println!("{:44}  a/h  L2 mean (worst)  max of p0        peak         all in %", "");
}

/// Errors at a/h = 4.5, 9, 18 with the defaults, their bounds and rates.
///
/// The means are below the best peers (issue: 1.1 %, 1.9 % and 0.9 % at a/h = 9; 2.9 % maximal at 18). The worst load is
/// the one whose contact ends just inside an element: the error is that of the last half element before x = a.
fn converges(name: &str, case: Case) {
    heading();
    let [coarse, middle, fine] = [4.5, 9.0, 18.0].map(|per_a| measure(name, Case { per_a, ..case }));
    let rate = |i: usize| (coarse[0][i] / fine[0][i]).log2() / 2.0;
    println!("{name:44} rate {:5.2}            {:5.2}", rate(0), rate(1));
    below(middle, [0.8, 1.9, 0.1], [1.5, 4.0, 0.2]);
    below(fine, [0.25, 0.9, 0.2], [0.4, 1.4, 0.2]);
    assert!(rate(0) > 1.3 && rate(1) > 0.8, "p has a vertical tangent at x = a");
}

/// Asserts bounds of the mean and of the worst.
fn below(found: [[f64; 3]; 2], mean: [f64; 3], worst: [f64; 3]) {
    for (found, bound) in found.into_iter().zip([mean, worst]) {
        assert!(found.iter().zip(bound).all(|(e, b)| *e < b), "{found:?} should be below {bound:?}");
    }
}

#[test]
fn cylinder_on_a_rigid_plane() {
    converges("plane, nurbs 2", PLANE);
    below(measure("plane, nurbs 2, r = 2", Case { r: 2.0, ..PLANE }), [0.6, 1.5, 0.1], [0.9, 2.5, 0.2]);
}

#[test]
fn two_cylinders() {
    converges("two, nurbs 2", TWO);
}

#[test]
fn other_bases_and_sites() {
    heading();
    let lagrange = |degree| Case { basis: BasisSpec::Lagrange { degree }, ..PLANE };
    let cubic = Case { basis: BasisSpec::Nurbs { degree: 3 }, ..PLANE };
    below(measure("plane, nurbs 3", cubic), [0.8, 1.9, 0.2], [1.2, 2.5, 0.2]);
    // Lagrange elements of degree 2 have twice the nodes.
    below(measure("plane, lagrange 2", lagrange(2)), [0.4, 1.5, 0.1], [0.8, 2.2, 0.1]);
    below(measure("plane, lagrange 1", lagrange(1)), [1.8, 5.5, 0.9], [2.8, 8.0, 0.9]);
    let segments = Case { plane: false, integration: Integration::Segment, ..lagrange(2) };
    below(measure("two, lagrange 2, segments", segments), [0.5, 1.7, 0.1], [0.9, 3.0, 0.2]);
    let nodal = Case { sites: Sites::Nodal, ..PLANE };
    below(measure("plane, nurbs 2, nodal sites", nodal), [2.2, 6.0, 0.2], [4.0, 10.0, 0.2]);
    let nodal = Case { per_a: 18.0, ..nodal };
    below(measure("plane, nurbs 2, nodal sites", nodal), [0.7, 2.9, 0.1], [1.1, 4.0, 0.2]);
    let fine = Case { per_a: 18.0, ..lagrange(2) };
    below(measure("plane, lagrange 2", fine), [0.1, 0.4, 0.1], [0.2, 0.6, 0.1]);
}

/// Kinks of the mortar side inside a nonmortar element: Gauss points on the elements integrate across them, which
/// spoils the pressure of quadratic Lagrange elements and does not go away with h. Segments end at the kinks.
#[test]
fn kinks_of_the_mortar_side_want_segments() {
    let case = Case { basis: BasisSpec::Lagrange { degree: 2 }, per_a: 14.0, ..TWO };
    let element = case.errors();
    let segment = Case { integration: Integration::Segment, ..case }.errors();
    println!("two, lagrange 2, a/h = 14: elements {element:.3?}, segments {segment:.3?} (L2, max, peak in %)");
    assert!(segment[0] < 0.3 && segment[0] < 0.2 * element[0]);
}

/// What the half-space solution itself is worth here: twice the domain moves the errors by less than 0.1 % of p0.
#[test]
fn domain_is_large_enough() {
    for case in [PLANE, TWO] {
        let case = Case { per_a: 14.0, ..case };
        let [small, large] = [40.0, 80.0].map(|size| Case { size, ..case }.errors());
        println!("domain 40 a {small:.3?}, 80 a {large:.3?} (L2, max, peak in %)");
        assert!(small.iter().zip(large).all(|(s, l)| (s - l).abs() < 0.1));
    }
}
