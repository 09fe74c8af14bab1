//! A block on a rigid incline under a vertical force: it sticks while `tan(theta) < mu`; beyond there is no equilibrium.
//!
//! The block is a parallelogram with vertical sides whose top is parallel to the incline. A vertical force on the top
//! calls for uniaxial stress along the sides; with Poisson's ratio `nu = sin(theta)^2` that state (linear elasticity, plane
//! strain: `eps_xx/eps_yy = -nu/(1 - nu)`) leaves lines along the incline unstretched. The block then sits on the rigid
//! plane without any tendency to slip at its ends: `q/p = tan(theta)` at every point, and the limit is sharp.

mod support;

use std::path::Path;
use std::sync::Arc;

use asperity::bulk::LinearElastic;
use asperity::contact::{ContactStatus, Sites};
use asperity::geometry::shapes::Nurbs;
use asperity::geometry::{BasisSpec, Edge, ShapeSpec, build, build_edge};
use asperity::laws::builtin::Coulomb;
use asperity::model::{BodySpec, Builder, Control, Model, PairSpec, Table};
use asperity::solve::Status;
use support::{Run, run};

const FORCE: f64 = 2.0;
const MODULUS: f64 = 1000.0;
/// The block starts this deep in the plane, so that it touches from the start: where it has to fall first, the fall itself
/// counts as slip and Newton's method may visit states in which everything slides and nothing resists.
const DEPTH: f64 = 1e-6;

/// Between two vertical and two parallel lines, which rise with the given slope.
fn parallelogram(x: [f64; 2], y: [f64; 2], slope: f64) -> ShapeSpec {
    let line = vec![0.0, 0.0, 1.0, 1.0];
    let corner = |i: usize, j: usize| [x[i], y[j] + slope * x[i]];
    let points = vec![corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
    ShapeSpec::Nurbs(Nurbs { degrees: [1, 1], knots: [line.clone(), line], points, weights: None })
}

fn model(theta: f64, friction: f64, basis: BasisSpec, sites: Sites) -> Model {
    let slope = theta.tan();
    let (block, plane) = (parallelogram([0.0, 1.0], [0.0, 0.5], slope), parallelogram([-1.0, 2.0], [-0.2, 0.0], slope));
    let here = Path::new(".");
    let patch = build(&block, &basis, [6, 3], None, [0.0, -DEPTH], here).expect("a block");
    let curve = build_edge(&plane, Edge::Top, &BasisSpec::Nurbs { degree: 1 }, [1, 1], None, [0.0; 2], here);
    let material = LinearElastic { youngs_modulus: MODULUS, poissons_ratio: theta.sin().powi(2) };
    let mut pair = PairSpec::new(("block", Edge::Bottom), ("plane", Edge::Top), Arc::new(Coulomb { friction }));
    pair.sites = Some(sites);
    let mut builder = Builder::default();
    let built = (|| {
        builder.body("plane", BodySpec::Rigid(vec![(Edge::Top, curve.expect("an edge"))]))?;
        builder.body("block", BodySpec::Deformable(patch, Arc::new(material)))?;
        let weight = Table { time: vec![0.0, 1.0], value: vec![0.0, -FORCE] };
        builder.motion("block", Edge::Top, 0, Control::Force(Table::constant(0.0)), true)?;
        builder.motion("block", Edge::Top, 1, Control::Force(weight), true)?.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}

fn pressed(degrees: f64, share: f64, basis: BasisSpec, sites: Sites) -> Run {
    let theta = degrees.to_radians();
    run(model(theta, theta.tan() / share, basis, sites), 4)
}

const BASES: [BasisSpec; 3] =
    [BasisSpec::Nurbs { degree: 2 }, BasisSpec::Nurbs { degree: 1 }, BasisSpec::Lagrange { degree: 2 }];

#[test]
fn sticks_without_any_slip_below_the_limit() {
    for degrees in [5.0, 20.0, 35.0] {
        for (basis, sites) in BASES.into_iter().flat_map(|b| [(b, Sites::Quadrature), (b, Sites::Nodal)]) {
            let found = pressed(degrees, 0.99, basis, sites);
            assert_eq!(found.outcome.status, Status::Done, "{degrees} {basis:?} {sites:?}");
            let (last, rows) = (found.records.last().expect("steps"), found.rows.last().expect("steps"));
            let theta = degrees.to_radians();
            let slip = rows.iter().fold(0.0_f64, |m, r| m.max(r.slip.abs()));
            let ratio = rows.iter().fold(0.0_f64, |m, r| m.max((r.traction.abs() / r.pressure - theta.tan()).abs()));
            println!(
                "{degrees:4} {basis:?} {sites:?}: {} iterations, {} cuts, slip {slip:.1e}, q/p - tan {ratio:.1e}, Fx {:.1e}, Fy - F {:.1e}",
                found.outcome.iterations,
                found.outcome.cuts,
                last.force[0],
                last.force[1] - FORCE
            );
            assert!(rows.iter().all(|r| r.status == ContactStatus::Stick), "{rows:?}");
            assert!(slip < 1e-12 && ratio < 1e-8, "slip {slip:.1e}, q/p {ratio:.1e}");
            assert!(last.force[0].abs() < 1e-8 && (last.force[1] - FORCE).abs() < 1e-8, "{last:?}");
        }
    }
}

#[test]
fn has_no_equilibrium_beyond_the_limit() {
    for degrees in [5.0, 20.0, 35.0] {
        for sites in [Sites::Quadrature, Sites::Nodal] {
            let found = pressed(degrees, 1.01, BASES[0], sites);
            println!("{degrees:4} {sites:?}: {:?}, {} iterations", found.outcome.status, found.outcome.iterations);
            let Status::NotConverged { time: 0.0, reason } = &found.outcome.status else {
                panic!("{:?}", found.outcome.status)
            };
            assert!(reason.contains("drive by displacement instead of force"), "{reason}");
            assert!(found.records.is_empty());
        }
    }
}
