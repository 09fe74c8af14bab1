//! Refinement changes nothing but the mesh.

use std::path::Path;
use std::sync::Arc;

use asperity::geometry::{Basis, Curve, Edge, Grading, Point, build};

use super::{BODIES, SECTOR, inside, nurbs, patch, shape, uneven};

fn wavy_curve(degree: usize) -> Curve {
    let basis = uneven(degree);
    let n = basis.len();
    let at = |i: usize| i as f64;
    Curve {
        points: (0..n).map(|i| Point::new(at(i), (at(i) * 2.1).sin())).collect(),
        weights: (0..n).map(|i| 1.0 + 0.4 * (at(i) * 1.3).cos()).collect(),
        nodes: (0..n).collect(),
        basis: Arc::new(basis),
        side: 1.0,
    }
}

fn assert_same_curve(a: &Curve, b: &Curve, tolerance: f64) {
    for (_, xi) in inside(b.basis.breaks()) {
        let distance = (a.point(xi) - b.point(xi)).norm();
        assert!(distance < tolerance, "moved by {distance} at {xi}");
    }
}

#[test]
fn refinement_leaves_a_curve_where_it_is() {
    for degree in 1..=5 {
        let curve = wavy_curve(degree);
        let mut fine = curve.clone();
        for xi in [0.1, 0.9, 0.9, 2.25, 2.9] {
            if let Ok(next) = fine.insert_knot(xi) {
                assert_eq!(next.points.len(), fine.points.len() + 1);
                fine = next;
            }
        }
        assert!(fine.points.len() > curve.points.len() + 2);
        assert_same_curve(&curve, &fine, 1e-13);
        let raised = curve.elevate().and_then(|c| c.elevate()).expect("degree below 8");
        assert_eq!(raised.basis.degree(), degree + 2);
        assert_same_curve(&curve, &raised, 1e-13);
        assert!(curve.insert_knot(-0.5).is_err() && curve.insert_knot(f64::NAN).is_err());
    }
}

#[test]
fn refinement_leaves_a_patch_where_it_is() {
    let original = patch(SECTOR, nurbs(2), [4, 2]).expect("valid");
    let raised = original.elevate(0).and_then(|p| p.elevate(1)).expect("degree below 8");
    let fine = raised.insert_knot(0, 0.37).and_then(|p| p.insert_knot(1, 0.61)).expect("inside");
    assert_eq!(fine.elements(), [5, 3]);
    for (i, u) in inside(fine.basis[0].breaks()) {
        for (j, v) in inside(fine.basis[1].breaks()) {
            let (x, columns) = fine.map([i, j], [u, v]);
            let (y, expected) = original.map(original.element_of([u, v]), [u, v]);
            assert!((x - y).norm() < 1e-13);
            assert!((columns[0] - expected[0]).norm() < 1e-12);
            assert!((columns[1] - expected[1]).norm() < 1e-12);
        }
    }
}

#[test]
fn an_explicit_patch_keeps_its_geometry() {
    let text = "type = 'nurbs'\ndegrees = [2, 1]\nknots = [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]\npoints = [[0, 0], [1, -0.5], [2, 0], [0, 1], [1, 1.5], [2, 1]]\nweights = [1, 0.7, 1, 1, 0.9, 1]";
    let coarse = patch(text, nurbs(2), [1, 1]).expect("valid");
    let fine = patch(text, nurbs(3), [5, 3]).expect("valid");
    for (i, u) in inside(fine.basis[0].breaks()) {
        for (j, v) in inside(fine.basis[1].breaks()) {
            let distance = (fine.map([i, j], [u, v]).0 - coarse.map([0, 0], [u, v]).0).norm();
            assert!(distance < 1e-13);
        }
    }
    let middle = (0.25 * 0.0 + 0.5 * 0.7 * -0.5) / (0.25 + 0.5 * 0.7 + 0.25);
    assert!((coarse.boundary(Edge::Bottom).point(0.5).y - middle).abs() < 1e-15);
}

#[test]
fn grading_makes_elements_small_where_it_says() {
    let grading: Grading =
        toml::from_str("toward = 'top'\nratio = 8.0\nalong = { center = 0.5, half_width = 0.3, ratio = 10.0 }")
            .expect("valid");
    let block = shape("type = 'block'\nx = [-2.0, 2.0]\ny = [-1.0, 0.0]");
    let patch = build(&block, &nurbs(2), [60, 10], Some(&grading), [1.0, 2.0], Path::new(".")).expect("valid");
    assert_eq!(patch.elements(), [60, 10]);
    let sizes = |d: usize| -> Vec<f64> { patch.basis[d].breaks().windows(2).map(|b| b[1] - b[0]).collect() };
    let v = sizes(1);
    for pair in v.windows(2) {
        assert!((pair[1] / pair[0] - 8f64.powf(-0.1)).abs() < 1e-9, "not geometric towards the top");
    }
    let u = sizes(0);
    let (smallest, largest) = u.iter().fold((f64::MAX, 0f64), |(a, b), s| (a.min(*s), b.max(*s)));
    assert!((7.0..10.0).contains(&(largest / smallest)), "{}", largest / smallest);
    for (b, s) in patch.basis[0].breaks().windows(2).zip(&u) {
        if b[0] > 0.2 && b[1] < 0.8 {
            assert!((s / smallest - 1.0).abs() < 1e-9, "fine zone is not uniform");
        }
    }
    let (lowest, highest) = (patch.points[0], patch.points[patch.points.len() - 1]);
    assert!((lowest - Point::new(-1.0, 1.0)).norm() < 1e-14 && (highest - Point::new(3.0, 2.0)).norm() < 1e-14);
}

#[test]
fn a_symmetric_body_has_a_symmetric_mesh() {
    for n in 7..40 {
        let patch = patch(BODIES[3], nurbs(2), [n, 2]).expect("valid");

        let breaks = patch.basis[0].breaks();
        let symmetric = breaks.iter().zip(breaks.iter().rev()).all(|(a, b)| (a + b).abs() < 1e-12);
        assert!(symmetric, "{n} elements: {breaks:?}");
    }
    let body =
        "type = 'block'\nx = [-1.0, 1.0]\ny = [0.6, 1.6]\nbottom = { type = 'cosine', height = 0.4, wavelength = 1.6 }";
    for n in 3..60 {
        let patch = patch(body, nurbs(2), [n, 2]).expect("valid");
        let breaks = patch.basis[0].breaks();
        assert!(breaks.iter().zip(breaks.iter().rev()).all(|(a, b)| (a + b).abs() < 1e-12), "{n} elements");
    }
}
