//! Patch tests: uniform stress across an interface of non-matching meshes, against closed forms.
//!
//! Two blocks of width 1 and total height 1 with 7 and 5 elements along the interface. In every setup the exact solution
//! is one affine map of both bodies, so it lies in every space; with segment-wise integration it must come out to
//! round-off, with element-wise integration up to the quadrature error that is printed and bounded here.

#[path = "patch/ring.rs"]
mod ring;
#[path = "support/shrink_fit.rs"]
mod shrink_fit;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{LinearElastic, Material, NeoHookean};
use asperity::contact::{ContactStatus, Integration, Sites, Tangent};
use asperity::geometry::shapes::Nurbs;
use asperity::geometry::{BasisSpec, Edge, Patch, Point, ShapeSpec, build};
use asperity::laws::builtin::Coulomb;
use asperity::math::{CondensedSolver, LinearSolver};
use asperity::model::{BodySpec, Builder, Control, Evaluation, Model, PairSpec, State, Table, evaluate};
use asperity::solve::{Strategy, solve_step};
use nalgebra::Matrix2;

const MODULUS: f64 = 1000.0;
const RATIO: f64 = 0.3;
/// Near incompressibility, where dilatations are projected.
const RUBBER: f64 = 0.4999;
const BASES: [BasisSpec; 5] = [
    BasisSpec::Nurbs { degree: 1 },
    BasisSpec::Nurbs { degree: 2 },
    BasisSpec::Nurbs { degree: 3 },
    BasisSpec::Lagrange { degree: 1 },
    BasisSpec::Lagrange { degree: 2 },
];

/// How the pair is loaded; `F` is uniform in all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Load {
    /// Top edge pushed down by this displacement, sides free.
    Displacement(f64),
    /// Top edge pushed down by this pressure, sides free.
    Pressure(f64),
    /// The same displacement with both sides held in x.
    Confined(f64),
    /// Top and right edge displaced inwards by the same strain: in-plane hydrostatic stress.
    Hydrostatic(f64),
}

#[derive(Clone, Copy, Debug)]
struct Setup {
    basis: BasisSpec,
    ratio: f64,
    finite_strain: bool,
    load: Load,
    /// Height of the interface at its left and right end.
    interface: [f64; 2],
    friction: f64,
    sites: Sites,
    integration: Integration,
}

fn material(finite_strain: bool, poissons_ratio: f64) -> Arc<dyn Material> {
    let youngs_modulus = MODULUS;
    match finite_strain {
        true => Arc::new(NeoHookean { youngs_modulus, poissons_ratio }),
        false => Arc::new(LinearElastic { youngs_modulus, poissons_ratio }),
    }
}

/// A quadrilateral on `0 <= x <= 1` between two straight lines.
fn quadrilateral(basis: BasisSpec, elements: [usize; 2], low: [f64; 2], high: [f64; 2]) -> Patch {
    let line = vec![0.0, 0.0, 1.0, 1.0];
    let points = vec![[0.0, low[0]], [1.0, low[1]], [0.0, high[0]], [1.0, high[1]]];
    let shape = Nurbs { degrees: [1, 1], knots: [line.clone(), line], points, weights: None };
    build(&ShapeSpec::Nurbs(shape), &basis, elements, None, [0.0; 2], Path::new(".")).expect("a quadrilateral")
}

fn ramp(value: f64) -> Table {
    Table { time: vec![0.0, 1.0], value: vec![0.0, value] }
}

fn model(setup: &Setup) -> Model {
    let mut builder = Builder::default();
    let body = |patch| BodySpec::Deformable(patch, material(setup.finite_strain, setup.ratio));
    let lower = quadrilateral(setup.basis, [7, 3], [0.0; 2], setup.interface);
    let upper = quadrilateral(setup.basis, [5, 2], setup.interface, [1.0; 2]);
    let mut pair =
        PairSpec::new(("upper", Edge::Bottom), ("lower", Edge::Top), Arc::new(Coulomb { friction: setup.friction }));
    (pair.sites, pair.integration) = (Some(setup.sites), Some(setup.integration));
    let built = (|| {
        builder.body("lower", body(lower))?.body("upper", body(upper))?;
        let held = || Control::Displacement(Table::constant(0.0));
        builder.motion("lower", Edge::Bottom, 1, held(), false)?;
        for name in ["lower", "upper"] {
            builder.motion(name, Edge::Left, 0, held(), false)?;
            match setup.load {
                Load::Confined(_) => builder.motion(name, Edge::Right, 0, held(), false)?,
                Load::Hydrostatic(e) => builder.motion(name, Edge::Right, 0, Control::Displacement(ramp(-e)), false)?,
                _ => &mut builder,
            };
        }
        let push = match setup.load {
            Load::Pressure(p) => Control::Force(ramp(-p)),
            Load::Displacement(d) | Load::Confined(d) | Load::Hydrostatic(d) => Control::Displacement(ramp(-d)),
        };
        builder.motion("upper", Edge::Top, 1, push, true)?.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}

/// Marches to time 1 in `steps` steps and goes on with Newton's method behind the tolerance of the solver down to
/// round-off. (That takes more than one iteration where the edges end together: the tangent leaves out that the end of
/// the integrated domain moves, which costs the quadratic rate when the mortar edge ends first.)
fn solve(model: &Model, steps: usize) -> (State, Evaluation) {
    let (mut state, mut solver) = (State::initial(model), CondensedSolver::default());
    let mut last = None;
    for step in 1..=steps {
        let time = step as f64 / steps as f64;
        let found = solve_step(model, &state, time, Strategy::default(), &mut solver, &AtomicBool::new(false), &mut 0);
        let mut trial = found.unwrap_or_else(|e| panic!("step {step}: {e}")).state;
        for _ in 0..12 {
            let evaluation = evaluate(model, &state, &trial, Tangent::Exact).expect("admissible");
            let right: Vec<f64> = evaluation.residual.iter().map(|v| -v).collect();
            let increment = solver.solve(evaluation.system.as_ref().expect("tangent"), &right).expect("solvable");
            trial.advance(model, &increment, 1.0);
        }
        let end = evaluate(model, &state, &trial, Tangent::None).expect("admissible");
        for (pair, interface) in trial.pairs.iter_mut().zip(&end.interfaces) {
            pair.sites.clone_from(&interface.memory); // of the polished state, not of the one before
        }
        last = Some(end);
        state = trial;
    }
    (state, last.expect("admissible"))
}

/// Deformation gradient `diag` and first Piola-Kirchhoff stress of the exact solution: a scalar Newton iteration for the
/// lateral stretch of a free side, and for the vertical one under force control.
fn exact(setup: &Setup) -> (Matrix2<f64>, Matrix2<f64>) {
    let material = material(setup.finite_strain, setup.ratio);
    let at = |f: &Matrix2<f64>| material.response(f).expect("admissible");
    let mut f = match setup.load {
        Load::Hydrostatic(e) => Matrix2::identity() * (1.0 - e),
        Load::Displacement(d) | Load::Confined(d) => Matrix2::new(1.0, 0.0, 0.0, 1.0 - d),
        Load::Pressure(_) => Matrix2::identity(),
    };
    for _ in 0..50 {
        let r = at(&f);
        match setup.load {
            Load::Displacement(_) => f[(0, 0)] -= r.stress[(0, 0)] / r.tangent[0][0],
            Load::Pressure(p) => {
                let tangent = Matrix2::new(r.tangent[0][0], r.tangent[0][3], r.tangent[3][0], r.tangent[3][3]);
                let right = nalgebra::Vector2::new(r.stress[(0, 0)], r.stress[(1, 1)] + p);
                let step = tangent.try_inverse().expect("stable") * right;
                f[(0, 0)] -= step.x;
                f[(1, 1)] -= step.y;
            }
            _ => break,
        }
    }
    (f, at(&f).stress)
}

/// Largest error of the site pressures and tractions (over the exact pressure) and of the displacements (over the
/// largest one).
fn errors(setup: &Setup) -> [f64; 2] {
    let model = model(setup);
    let (state, evaluation) = solve(&model, if setup.ratio == RATIO { 2 } else { 16 });
    let (f, stress) = exact(setup);
    // traction on the lower body per reference length, split along the deformed normal and tangent
    let slope = setup.interface[1] - setup.interface[0];
    let reference = Point::new(1.0, slope).normalize();
    let t = stress * Point::new(-reference.y, reference.x);
    let tangent = (f * reference).normalize();
    let (p, q) = (-t.dot(&Point::new(-tangent.y, tangent.x)), t.dot(&tangent));
    let mut worst = [0.0_f64; 2];
    for site in &evaluation.interfaces[0].sites {
        let expected = if setup.friction > 0.0 { ContactStatus::Stick } else { ContactStatus::Slip };
        if setup.integration == Integration::Segment {
            assert_eq!(site.status, expected, "{setup:?} at x = {}", site.x.x);
        }
        worst[0] = worst[0].max((site.pressure * site.stretch - p).abs() / p);
        worst[0] = worst[0].max((site.traction * site.stretch - q).abs() / p);
    }
    let largest = state.u.iter().fold(0.0_f64, |m, u| m.max(u.amax()));
    for (x, u) in model.reference().zip(&state.u) {
        worst[1] = worst[1].max((f * x - x - u).amax() / largest);
    }
    worst
}

const FLAT: [f64; 2] = [0.55, 0.55];
const INCLINED: [f64; 2] = [0.4, 0.65];

/// Setup and name of every exact case of a basis.
fn cases(basis: BasisSpec, finite_strain: bool, integration: Integration) -> Vec<(&'static str, Setup)> {
    let stress = if finite_strain { 100.0 } else { 10.0 };
    let strain = stress / MODULUS;
    let setup = |load, interface, friction| Setup {
        basis,
        ratio: RATIO,
        finite_strain,
        load,
        interface,
        friction,
        sites: Sites::Quadrature,
        integration,
    };
    vec![
        ("flat, displacement", setup(Load::Displacement(strain), FLAT, 0.0)),
        ("flat, pressure", setup(Load::Pressure(stress), FLAT, 0.0)),
        ("flat, confined", setup(Load::Confined(strain), FLAT, 0.0)),
        ("flat, confined, sticking", setup(Load::Confined(strain), FLAT, 0.5)),
        ("inclined, hydrostatic", setup(Load::Hydrostatic(strain), INCLINED, 0.0)),
        ("inclined, pressure, sticking", setup(Load::Pressure(stress), INCLINED, 0.3)),
    ]
}

#[test]
fn segment_wise_integration_is_exact() {
    let mut worst = [0.0_f64; 2];
    for basis in BASES {
        for finite_strain in [false, true] {
            for (name, setup) in cases(basis, finite_strain, Integration::Segment) {
                for sites in [Sites::Quadrature, Sites::Nodal] {
                    let [p, u] = errors(&Setup { sites, ..setup });
                    println!(
                        "{basis:?} finite {finite_strain:5} {sites:?} {name:30} pressure {p:.1e} displacement {u:.1e}"
                    );
                    worst = [worst[0].max(p), worst[1].max(u)];
                }
            }
        }
    }
    println!("segment-wise: pressure {:.1e}, displacement {:.1e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-10 && worst[1] < 1e-10, "{worst:?}");
}

#[test]
fn rubber_passes_as_well() {
    let mut worst = [0.0_f64; 2];
    for (basis, finite_strain) in BASES.into_iter().flat_map(|basis| [(basis, false), (basis, true)]) {
        for (name, setup) in cases(basis, finite_strain, Integration::Segment) {
            // strains without lateral freedom that ask for pressures of the size of those at `RATIO`, and small steps: Newton's
            // method changes volumes in second order, against which rubber is stiff
            let share = (1.0 - 2.0 * RUBBER) / (1.0 - 2.0 * RATIO);
            let load = match setup.load {
                Load::Confined(e) => Load::Confined(share * e),
                Load::Hydrostatic(e) => Load::Hydrostatic(share * e),
                Load::Displacement(e) => Load::Displacement(0.1 * e),
                Load::Pressure(p) => Load::Pressure(0.1 * p),
            };
            let [p, u] = errors(&Setup { ratio: RUBBER, load, ..setup });
            println!("{basis:?} finite {finite_strain:5} {name:30} pressure {p:.1e} displacement {u:.1e}");
            worst = [worst[0].max(p), worst[1].max(u)];
        }
    }
    println!("rubber: pressure {:.1e}, displacement {:.1e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-9 && worst[1] < 1e-9, "{worst:?}");
}

/// Element-wise Gauss rules do not see the kinks of the mortar functions: the error is that of quadrature. Measured
/// here for the default number of points and shown to fall with more of them.
#[test]
fn element_wise_integration_is_exact_up_to_quadrature() {
    for (basis, bound) in BASES.into_iter().zip([0.08, 0.02, 0.005, 0.08, 0.06]) {
        let mut worst = [0.0_f64; 2];
        for (name, setup) in cases(basis, true, Integration::Element) {
            let [p, u] = errors(&setup);
            println!("element-wise {basis:?} {name:30} pressure {p:.1e} displacement {u:.1e}");
            worst = [worst[0].max(p), worst[1].max(u)];
        }
        assert!(worst[0] < bound && worst[1] < bound, "{basis:?}: {worst:?}");
    }
}
