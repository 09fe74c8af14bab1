//! Cattaneo and Mindlin: two equal cylinders are pressed together by F, then sheared by Q < mu F (Johnson, Contact
//! Mechanics, 1985, section 7.2(a); theory.md 4.3):
//!
//! ```text
//! c = a sqrt(1 - Q/(mu F))
//! q = mu p0 sqrt(1 - x^2/a^2)                                     c <= |x| <= a   (slip)
//! q = mu p0 [sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)]                |x| <= c   (stick)
//! ```
//!
//! mu = 0.2 and Q/F = 0.093616 as in the reference (R = 8, E = 200, F = 10: a = 0.680778, c = 0.496511, p0 = 9.351351,
//! q_max = q(c) = 1.279571), here with E = 1 and a = 1 on cylinders of radius 2000, where half-space theory holds.
//!
//! q has a cusp at c, and sites stand on both sides of it. So c is read from the stick zone, where theory makes
//! `(mu p - q)^2 = (mu p0 c/a)^2 (1 - x^2/c^2)` a straight line over x^2, and q_max is mu p at that c.

use std::convert::Infallible;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::LinearElastic;
use asperity::contact::{ContactStatus, InterfaceForces, SiteRecord, Sites};
use asperity::geometry::shapes::{Along, ArcProfile, Block};
use asperity::geometry::{BasisSpec, Edge, Grading, Profile, ShapeSpec, build};
use asperity::laws::builtin::Coulomb;
use asperity::math::CondensedSolver;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, State, Table};
use asperity::solve::{self, Status};

const NU: f64 = 0.3;
const FRICTION: f64 = 0.2;
/// Q/F.
const SHARE: f64 = 0.093616;
const RADIUS: f64 = 2000.0;
/// Half the width of a body, and its height.
const SIZE: f64 = 40.0;
const FINE: f64 = 1.3;
const GROWTH: f64 = 0.25;
const PRESS_STEPS: usize = 4;
const SHEAR_STEPS: usize = 4;
/// Of the reference.
const P0: f64 = 9.351351;
const Q_MAX: f64 = 1.279571;
const C_OVER_A: f64 = 0.72933;

/// A cylinder with elements of length `h` at the contact and its apex at `apex`.
fn cylinder(round: Edge, h: f64, apex: f64) -> BodySpec {
    let arc = ArcProfile { radius: RADIUS, height: None, centers: None, count: None, spacing: None };
    let (arc, flat, x) = (Profile::Arc(arc), Profile::default(), [-SIZE, SIZE]);
    let rise = RADIUS - (RADIUS.powi(2) - SIZE.powi(2)).sqrt();
    let (block, y) = match round {
        Edge::Top => (Block { x, y: [-SIZE, 0.0], top: arc, bottom: flat }, apex - rise),
        _ => (Block { x, y: [0.0, SIZE], top: flat, bottom: arc }, apex + rise),
    };
    let [aside, across] = [SIZE - FINE, SIZE].map(|length| 1.0 + GROWTH * length / h);
    let along = Along { center: 0.0, half_width: FINE, ratio: aside };
    let grading = Grading { toward: Some(round), ratio: Some(across), along: Some(along) };
    let counts = [2.0 * (FINE / h + aside.ln() / GROWTH), across.ln() / GROWTH].map(|n| n.round() as usize);
    let (shape, basis) = (ShapeSpec::Block(block), BasisSpec::Nurbs { degree: 2 });
    let patch = build(&shape, &basis, counts, Some(&grading), [0.0, y], Path::new(".")).expect("a block");
    BodySpec::Deformable(patch, Arc::new(LinearElastic { youngs_modulus: 1.0, poissons_ratio: NU }))
}

/// Force that makes the half-width 1.
fn force() -> f64 {
    let (modulus, radius) = (0.5 / (1.0 - NU * NU), 0.5 * RADIUS);
    PI * modulus / (4.0 * radius)
}

/// Both components of the upper body are given as forces: F rises to its full value, then Q. F starts at what the
/// initial overlap of 0.1 a^2/R roughly carries, so that the body never floats.
fn model(per_a: f64, sites: Sites) -> Model {
    let [pressed, end] = [PRESS_STEPS, PRESS_STEPS + SHEAR_STEPS].map(|n| n as f64);
    let course = |time: [f64; 2], value: [f64; 2]| Table { time: time.to_vec(), value: value.to_vec() };
    let press = Control::Force(course([0.0, pressed], [-0.1 * force(), -force()]));
    let shear = Control::Force(course([pressed, end], [0.0, SHARE * force()]));
    let hold = || Control::Displacement(Table::constant(0.0));
    let law = Arc::new(Coulomb { friction: FRICTION });
    let mut pair = PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), law);
    pair.sites = Some(sites);
    let mut builder = Builder::default();
    let built = (|| {
        builder.body("upper", cylinder(Edge::Bottom, 1.0 / per_a, -0.1 / RADIUS))?;
        builder.body("lower", cylinder(Edge::Top, 0.93 / per_a, 0.0))?;
        builder.motion("lower", Edge::Bottom, 0, hold(), false)?.motion("lower", Edge::Bottom, 1, hold(), false)?;
        builder.motion("upper", Edge::Top, 0, shear, true)?.motion("upper", Edge::Top, 1, press, true)?;
        builder.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}

/// The interface after pressing and at the end, and the final forces.
struct Found {
    pressed: InterfaceForces,
    sheared: InterfaceForces,
    force: [f64; 2],
}

/// Presses, shears, and then holds both forces for some steps.
fn run(per_a: f64, sites: Sites, hold: usize) -> Found {
    let model = model(per_a, sites);
    let steps = PRESS_STEPS + SHEAR_STEPS + hold;
    let control = solve::Control { end: steps as f64, steps, max_cuts: 0, strategy: Default::default() };
    let (quiet, mut solver) = (AtomicBool::new(false), CondensedSolver::default());
    let (mut interfaces, mut force, mut iterations) = (vec![], [0.0; 2], vec![]);
    let outcome = solve::march(&model, State::initial(&model), &control, &mut solver, &quiet, |report| {
        interfaces.push(report.evaluation.interfaces[0].clone());
        force = report.record.force;
        iterations.push(report.record.newton_iterations);
        Ok::<(), Infallible>(())
    });
    assert_eq!(outcome.unwrap_or_else(|e| match e {}).status, Status::Done);
    println!("{sites:?}, a/h = {per_a}: {} unknowns, iterations {iterations:?}", model.unknowns());
    Found { pressed: interfaces[PRESS_STEPS - 1].clone(), sheared: interfaces.remove(steps - 1), force }
}

/// What is read from the tractions. Lengths over `a`, tractions over the theoretical values.
#[derive(Debug)]
struct Measured {
    c: f64,
    /// Stick zone by the status of the sites, and half the distance of the two sites at its end.
    c_status: [f64; 2],
    q_max: f64,
    /// Largest traction of any site.
    q_largest: f64,
    /// Relative L2 error of q inside 0.9 a.
    q_error: f64,
}

impl Found {
    fn measure(&self) -> Measured {
        let [q, f] = self.force;
        assert!((f / force() - 1.0).abs() < 1e-7 && (q / f / SHARE - 1.0).abs() < 1e-7);
        let sites = &self.sheared.sites;
        // The shear moves the upper body, and with it the contact, by some 1e-4 a.
        let centre = moment(sites, 1) / moment(sites, 0);
        let (c, p0) = ((1.0 - SHARE / FRICTION).sqrt(), 2.0 * f / PI);
        let root = |x: f64| (1.0 - x * x).max(0.0).sqrt();
        let theory = |x: f64| FRICTION * p0 * (root(x) - c * root(x / c));
        let (mut square, mut scale) = (0.0, 0.0);
        for s in sites.iter().filter(|s| (s.x.x - centre).abs() < 0.9) {
            let exact = theory(s.x.x - centre);
            square += s.weight * (s.traction.abs() - exact).powi(2);
            scale += s.weight * exact.powi(2);
        }
        let fitted = stick_radius(sites, centre);
        let at_ends = pressure(sites, centre + fitted) + pressure(sites, centre - fitted);
        Measured {
            c: fitted,
            c_status: stick_end(sites, centre),
            q_max: 0.5 * FRICTION * at_ends / theory(c),
            q_largest: sites.iter().fold(0.0_f64, |m, s| m.max(s.traction.abs())) / theory(c),
            q_error: (square / scale).sqrt(),
        }
    }
}

/// `int p x^k`.
fn moment(sites: &[SiteRecord], k: i32) -> f64 {
    sites.iter().filter(|s| s.pressure > 0.0).map(|s| s.weight * s.pressure * s.x.x.powi(k)).sum()
}

/// Where the straight line through `(mu p - q)^2` over x^2 of the sticking sites vanishes.
fn stick_radius(sites: &[SiteRecord], centre: f64) -> f64 {
    let mut sums = [0.0; 5];
    for s in sites.iter().filter(|s| s.status == ContactStatus::Stick) {
        let (u, v) = ((s.x.x - centre).powi(2), (FRICTION * s.pressure - s.traction.abs()).powi(2));
        sums.iter_mut().zip([1.0, u, v, u * u, u * v]).for_each(|(sum, term)| *sum += s.weight * term);
    }
    let [n, u, v, uu, uv] = sums;
    let slope = (n * uv - u * v) / (n * uu - u * u);
    ((u - v / slope) / n).sqrt()
}

/// Mean of the two ends of the stick zone, each half way between the last sticking and the first slipping site, and half
/// the distance of those.
fn stick_end(sites: &[SiteRecord], centre: f64) -> [f64; 2] {
    let mut ends = [0.0; 2];
    for pair in sites.windows(2) {
        let [left, right] = [0, 1].map(|k| (pair[k].x.x - centre).abs());
        let sticks = [0, 1].map(|k| pair[k].status == ContactStatus::Stick);
        if sticks[0] != sticks[1] {
            ends[0] += 0.25 * (left + right);
            ends[1] += 0.25 * (left - right).abs();
        }
    }
    ends
}

/// Pressure between the sites.
fn pressure(sites: &[SiteRecord], x: f64) -> f64 {
    let pair = sites.windows(2).find(|w| w[0].x.x <= x && x < w[1].x.x).expect("inside the edge");
    let share = (x - pair[0].x.x) / (pair[1].x.x - pair[0].x.x);
    pair[0].pressure * (1.0 - share) + pair[1].pressure * share
}

fn print(found: &Measured) {
    let [end, spacing] = found.c_status;
    println!("  c/a = {:.5} ({:+.2} %), by status {end:.4} +- {spacing:.4}", found.c, percent(found.c / C_OVER_A));
    let [q_max, largest] = [found.q_max, found.q_largest].map(percent);
    println!("  q_max {q_max:+.2} %, largest site {largest:+.2} %, q in L2 {:.2} %", 100.0 * found.q_error);
}

fn percent(ratio: f64) -> f64 {
    100.0 * (ratio - 1.0)
}

#[test]
fn the_reference_belongs_to_this_ratio_of_forces() {
    let c = (1.0 - SHARE / FRICTION).sqrt();
    assert!((c - C_OVER_A).abs() < 1e-5);
    assert!((FRICTION * P0 * (1.0 - c * c).sqrt() - Q_MAX).abs() < 1e-5);
}

#[test]
fn stick_zone_and_largest_traction() {
    let mut errors = vec![];
    for per_a in [9.0, 18.0] {
        let found = run(per_a, Sites::Quadrature, 0).measure();
        print(&found);
        assert!(percent(found.c / C_OVER_A).abs() < 1.0, "{found:?}");
        assert!(percent(found.q_max).abs() < 1.0, "{found:?}");
        // the boundary between sticking and slipping sites is known to a site or so: the deflection of sticking sites
        // (see `SiteMemory`) smears it
        assert!((found.c_status[0] - C_OVER_A).abs() < 1.5 * found.c_status[1], "{found:?}");
        assert!((-5.0..1.0).contains(&percent(found.q_largest)), "{found:?}");
        errors.push(found.q_error);
    }
    assert!(errors[0] < 0.05 && errors[1] < 0.02, "{errors:?}");
}

#[test]
fn nodal_sites_find_the_same() {
    let found = run(18.0, Sites::Nodal, 0).measure();
    print(&found);
    assert!(percent(found.c / C_OVER_A).abs() < 1.0 && percent(found.q_max).abs() < 1.5, "{found:?}");
}

/// Equal cylinders: pressing makes no traction, and shear does not change the pressure.
#[test]
fn pressing_and_shearing_are_uncoupled() {
    let Found { pressed, sheared, .. } = run(9.0, Sites::Quadrature, 0);
    let p0 = 2.0 * force() / PI;
    let traction = pressed.sites.iter().fold(0.0_f64, |m, s| m.max(s.traction.abs())) / (FRICTION * p0);
    let change =
        pressed.sites.iter().zip(&sheared.sites).fold(0.0_f64, |m, (a, b)| m.max((a.pressure - b.pressure).abs()));
    println!("  traction of pressing {traction:.1e} mu p0, change of pressure by shear {:.1e} p0", change / p0);
    assert!(traction < 0.03 && change < 2e-3 * p0, "{traction} {change}");
}

/// The largest change of any traction when the forces are held for ten steps, over mu p0.
fn creep(sites: Sites) -> f64 {
    let [before, after] = [0, 10].map(|hold| run(9.0, sites, hold).sheared.sites);
    let pairs = before.iter().zip(&after);
    pairs.fold(0.0_f64, |m, (a, b)| m.max((a.traction - b.traction).abs())) / (FRICTION * 2.0 * force() / PI)
}

#[test]
fn holding_the_forces_changes_nothing() {
    let found = creep(Sites::Nodal);
    assert!(found < 1e-6, "{found:.1e}");
}

#[test]
fn holding_the_forces_changes_nothing_at_quadrature_sites() {
    let found = creep(Sites::Quadrature);
    assert!(found < 1e-6, "{found:.1e}");
}
