//! Rubber near incompressibility (papers/incompressible): projected dilatations are exact in uniform strain, consistent,
//! free of locking and of oscillating pressures, at any Poisson's ratio.

#[path = "support/hertz.rs"]
mod hertz;
#[path = "support/rubber.rs"]
mod rubber;
#[path = "support/shrink_fit.rs"]
mod shrink_fit;
mod support;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{Elements, LinearElastic, Material, NeoHookean, SaintVenantKirchhoff, VolumeSpace};
use asperity::geometry::shapes::{AnnulusSector, Nurbs};
use asperity::geometry::{BasisSpec, Patch, Point, ShapeSpec, build};
use asperity::math::CondensedSolver;
use asperity::solve::{Strategy, solve_step};
use hertz::{Case, PLANE};
use nalgebra::{DMatrix, DVector, Matrix2};
use support::{Pass, done};

const NU: f64 = 0.4999;

fn bases() -> Vec<BasisSpec> {
    let nurbs = (1..=5).map(|degree| BasisSpec::Nurbs { degree });
    nurbs.chain((1..=2).map(|degree| BasisSpec::Lagrange { degree })).collect()
}

fn materials(poissons_ratio: f64) -> [Box<dyn Material>; 3] {
    let youngs_modulus = 1.0;
    [
        Box::new(NeoHookean { youngs_modulus, poissons_ratio }),
        Box::new(SaintVenantKirchhoff { youngs_modulus, poissons_ratio }),
        Box::new(LinearElastic { youngs_modulus, poissons_ratio }),
    ]
}

/// A distorted quadrilateral, or a sector of a ring where the basis can be rational. The numbers of elements are no multiples
/// of a block.
fn patches(basis: BasisSpec) -> Vec<Patch> {
    let line = vec![0.0, 0.0, 1.0, 1.0];
    let points = vec![[0.0, 0.0], [2.0, -0.3], [0.2, 1.0], [1.7, 1.4]];
    let mut shapes =
        vec![ShapeSpec::Nurbs(Nurbs { degrees: [1, 1], knots: [line.clone(), line], points, weights: None })];
    if !matches!(basis, BasisSpec::Nurbs { degree: 1 } | BasisSpec::Lagrange { .. }) {
        shapes.push(ShapeSpec::AnnulusSector(AnnulusSector {
            center: [0.0; 2],
            radii: [1.0, 2.0],
            angles: [0.0, 90.0],
        }));
    }
    let patch = |shape| build(&shape, &basis, [7, 5], None, [0.0; 2], Path::new(".")).expect("a patch");
    shapes.into_iter().map(patch).collect()
}

/// Energy, nodal forces and, where asked for, the stiffness in full.
fn integrate(
    elements: &Elements,
    material: &dyn Material,
    u: &[Point],
    stiffness: bool,
) -> (f64, DVector<f64>, DMatrix<f64>) {
    let n = 2 * u.len();
    let (mut forces, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, if stiffness { n } else { 0 }));
    let energy = elements.integrate(material, u, stiffness, |_, found| {
        for (&a, f) in found.nodes.iter().zip(found.forces) {
            forces[2 * a] += f.x;
            forces[2 * a + 1] += f.y;
        }
        let unknown = |i: usize| 2 * found.nodes[i / 2] + i % 2;
        let size = if stiffness { 2 * found.nodes.len() } else { 0 };
        for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
            matrix[(unknown(i), unknown(j))] += found.stiffness[Elements::place(i, j)];
        }
    });
    (energy.expect("admissible"), forces, matrix)
}

#[test]
fn uniform_strain_keeps_its_energy_and_forces() {
    let f = Matrix2::new(1.05, 0.2, -0.1, 0.93);
    for (basis, material) in bases().into_iter().flat_map(|basis| materials(NU).map(|material| (basis, material))) {
        for patch in patches(basis) {
            let space = VolumeSpace::needed(&patch, material.as_ref());
            let [plain, projected] = [None, space].map(|space| Elements::new(&patch, space).expect("regular"));
            assert_eq!((projected.volume(), projected.volume().is_some()), (space, true));
            let u: Vec<Point> = patch.points.iter().map(|x| f * x - x).collect();
            let expected = integrate(&plain, material.as_ref(), &u, false);
            let found = integrate(&projected, material.as_ref(), &u, false);
            let scale = expected.1.amax();
            assert!((found.0 / expected.0 - 1.0).abs() < 1e-11, "{basis:?} {}", material.name());
            assert!((found.1 - expected.1).amax() < 1e-11 * scale, "{basis:?} {}", material.name());
        }
    }
}

/// Energy against forces and forces against stiffness by central differences, at a rough deformation.
#[test]
fn forces_and_stiffness_are_derivatives() {
    let wave = |seed: f64, size: f64| {
        move |i: usize| Point::new((seed * i as f64).sin(), (1.7 * seed * i as f64 + 1.0).cos()) * size
    };
    for (basis, material) in bases().into_iter().flat_map(|basis| materials(0.49).map(|material| (basis, material))) {
        for patch in patches(basis) {
            let elements = Elements::new(&patch, VolumeSpace::needed(&patch, material.as_ref())).expect("regular");
            let u: Vec<Point> = (0..patch.points.len()).map(wave(2.3, 0.01)).collect();
            let direction: Vec<Point> = (0..u.len()).map(wave(4.1, 1.0)).collect();
            let moved = |step: f64| {
                let u: Vec<Point> = u.iter().zip(&direction).map(|(u, d)| u + d * step).collect();
                integrate(&elements, material.as_ref(), &u, false)
            };
            let flat = DVector::from_iterator(2 * u.len(), direction.iter().flat_map(|d| [d.x, d.y]));
            let (_, forces, stiffness) = integrate(&elements, material.as_ref(), &u, true);
            // of fourth order
            let step = 1e-5;
            let (near, far) = ([moved(step), moved(-step)], [moved(2.0 * step), moved(-2.0 * step)]);
            let (change, power) = (&stiffness * &flat, forces.dot(&flat));
            let slope = (8.0 * (near[0].0 - near[1].0) - (far[0].0 - far[1].0)) / (12.0 * step);
            let energy = (slope - power).abs() / forces.amax();
            let slope = ((&near[0].1 - &near[1].1) * 8.0 - (&far[0].1 - &far[1].1)) / (12.0 * step);
            let forces = (slope - &change).amax() / change.amax();
            assert!(energy < 1e-6 && forces < 1e-6, "{basis:?} {}: {energy:.1e} {forces:.1e}", material.name());
            assert!((&stiffness - stiffness.transpose()).amax() < 1e-13 * stiffness.amax());
        }
    }
}

/// The contact pressure at `nu = 0.4999` is as good as that of the plain method at 0.3, which itself is useless there.
#[test]
fn hertz_does_not_see_poissons_ratio() {
    println!("Hertz, a/h = 9: L2, peak, ripple of the contact pressure; L2, ripple below, % of p0");
    for basis in bases() {
        let mean = |nu, volume| rubber::hertz_mean(&Case { nu, basis, volume, ..PLANE });
        let [reference, found, plain] = [(0.3, None), (NU, None), (NU, Some(None))].map(|(nu, v)| mean(nu, v));
        let row = |name: &str, e: &[f64; 5]| println!("{basis:?} {name:20} {e:8.3?}");
        row("0.3", &reference);
        row("0.4999", &found);
        row("0.4999, standard", &plain);
        assert!(found[0] < 1.4 * reference[0] && found[1] < 0.6 && found[2] < 1.2 * reference[2], "{basis:?}");
        assert!(found[0] < 0.2 * plain[0] && found[2] < 0.3 * plain[2] && found[3] < 4.0, "{basis:?}");
    }
}

/// Lame's closed form for a shrink fit: interface pressure and a pressure that is constant in each ring.
#[test]
fn rings_do_not_lock() {
    for degree in 2..=4 {
        let basis = BasisSpec::Nurbs { degree };
        let [coarse, fine] = [1, 2].map(|n| rubber::ring(basis, NU, n, None));
        let plain = rubber::ring(basis, NU, 1, Some(None));
        println!("p = {degree}: interface, inside (%): {coarse:?}, refined {fine:?}; standard {plain:?}");
        assert!(coarse[0] < 1e-2 && coarse[1] < 5.0 && coarse[1] < 0.1 * plain[1], "p = {degree}: {coarse:?}");
        assert!(fine[0] < coarse[0].max(1e-4) && fine[1] < 0.5 * coarse[1], "p = {degree}: {fine:?}");
    }
}

/// Cook's membrane: bending and shear with a corner singularity; all bases tend to one deflection.
#[test]
fn cooks_membrane_does_not_lock() {
    for basis in bases() {
        let reference = rubber::cook(BasisSpec::Lagrange { degree: 2 }, NU, 64, None);
        let error = |n, choice| (rubber::cook(basis, NU, n, choice) / reference - 1.0).abs();
        let [coarse, fine] = [8, 16].map(|n| error(n, None));
        println!("{basis:?}: {coarse:.1e}, {fine:.1e}; standard {:.1e}", error(16, Some(None)));
        let linear = matches!(basis, BasisSpec::Nurbs { degree: 1 } | BasisSpec::Lagrange { degree: 1 });
        assert!(coarse < if linear { 0.12 } else { 0.015 } && fine < f64::max(0.6 * coarse, 1e-3), "{basis:?}");
        assert!(!linear || error(16, Some(None)) > 0.5);
    }
}

/// Up to 0.4 the program leaves projection out; above, it begins without a jump.
#[test]
fn projection_begins_without_a_jump() {
    let peak = |nu: f64, volume| {
        let setup =
            Pass { poissons_ratio: nu, volume, element: 0.2, from: -0.6, to: -0.2, steps: 8, ..Pass::default() };
        done(&setup).peak(1)
    };
    assert_eq!(peak(0.4, None), peak(0.4, Some(None)));
    let [just_above, plain] = [peak(0.4001, None), peak(0.4001, Some(None))];
    assert!(just_above != plain && (just_above / plain - 1.0).abs() < 1e-4, "{just_above} {plain}");
}

/// The two-asperity pass of rubber at `nu = 0.499`: every step found without cutting, identities, energy, Newton's order.
#[test]
fn the_pass_of_rubber() {
    for (degree, lagrange) in [(2, false), (1, true)] {
        let setup = Pass { poissons_ratio: 0.499, element: 0.1, degree, lagrange, ..Pass::default() };
        let found = done(&setup);
        let work = found.records.last().expect("records").external_work;
        let (mut identity, mut balance, mut energy) = (0.0_f64, 0.0_f64, 0.0_f64);
        for r in found.touching() {
            let expected = (setup.friction.atan() + r.contact_angle).tan();
            identity = identity.max(if r.fully_slipping { (r.mu_global - expected).abs() } else { 0.0 });
            balance = balance.max(r.force_imbalance).max(r.moment_imbalance);
            energy = energy.max((r.external_work - r.strain_energy - r.dissipated).abs() / work);
        }
        println!(
            "p = {degree}: {} iterations, {} cuts, identity {identity:.1e}, balance {balance:.1e}, energy {energy:.1e}",
            found.outcome.iterations, found.outcome.cuts
        );
        assert!(identity < 1e-8 && balance < 1e-12 && energy < 0.05, "p = {degree}");
        assert_eq!(found.outcome.cuts, 0);
    }
}

#[test]
fn frictionless_rubber_costs_no_work() {
    let setup = Pass { poissons_ratio: 0.499, friction: 0.0, element: 0.1, ..Pass::default() };
    let found = done(&setup);
    let net: f64 = found.records.iter().map(|r| r.force[0]).sum();
    let absolute: f64 = found.records.iter().map(|r| r.force[0].abs()).sum();
    println!("net work {:.1e} of the absolute", net / absolute);
    assert!(net.abs() < 1e-6 * absolute);
}

#[test]
fn last_iterations_are_quadratic() {
    let found = done(&Pass { poissons_ratio: NU, element: 0.1, from: -0.6, to: -0.2, steps: 8, ..Pass::default() });
    for (k, start) in found.states.iter().enumerate().skip(2).take(4) {
        let (mut solver, quiet, mut count) = (CondensedSolver::default(), AtomicBool::new(false), 0);
        let time = found.states[k + 1].time;
        let step = solve_step(&found.model, start, time, Strategy::default(), &mut solver, &quiet, &mut count);
        let step = step.expect("converges");
        let r: Vec<f64> = step.residuals.iter().map(|v| v / step.evaluation.force_scale).collect();
        println!("{r:?}");
        // above round-off, which is `lambda/E` larger than that of compressible bodies
        let last = r.len() - 1;
        let order = r[last].max(1e-12).ln() / r[last - 1].ln();
        assert!(order > 1.6, "order {order:.2}: {r:?}");
    }
}
