//! Orientation, area and exact arcs of whole bodies.

use asperity::geometry::{BasisSpec, Edge, Patch, Point};

use super::{BODIES, NURBS, SECTOR, assert_on_circle, edge, inside, nurbs, patch};

#[test]
fn every_body_has_positive_jacobian_and_outward_normals() {
    for text in BODIES {
        for basis in NURBS.into_iter().chain([1, 2].map(|degree| BasisSpec::Lagrange { degree })) {
            let patch = patch(text, basis, [12, 4]).unwrap_or_else(|e| panic!("{text} {basis:?}: {e}"));
            assert_eq!(patch.elements(), [12, 4]);
            for e in [Edge::Bottom, Edge::Right, Edge::Top, Edge::Left] {
                assert_outward(&patch, e, text, basis);
            }
        }
    }
}

/// The normal is perpendicular to the edge and points away from where the other parameter enters the patch.
fn assert_outward(patch: &Patch, edge: Edge, text: &str, basis: BasisSpec) {
    // quadratic Lagrange elements fold in the corner of a disk, where two edges of the patch are tangent
    let folds = text.contains("disk") && basis == BasisSpec::Lagrange { degree: 2 };
    let curve = patch.boundary(edge);
    let direction = 1 - edge.direction();
    let across = patch.basis[direction].breaks();
    let (fixed, inward) = match edge {
        Edge::Bottom | Edge::Left => (across[0], 1.0),
        Edge::Top | Edge::Right => (across[across.len() - 1], -1.0),
    };
    let ends = 0.05 * (curve.basis.breaks()[1] - curve.basis.breaks()[0]);
    let corner = |xi: f64| folds && (xi < ends || xi > 1.0 - ends);
    for (_, xi) in inside(curve.basis.breaks()).filter(|&(_, xi)| !corner(xi)) {
        let uv = if direction == 1 { [xi, fixed] } else { [fixed, xi] };
        let (x, columns) = patch.map(patch.element_of(uv), uv);
        assert!((x - curve.point(xi)).norm() < 1e-12, "{text} {edge:?}: edge is off the patch");
        let normal = curve.normal(xi);
        assert!(normal.dot(&columns[direction]) * inward < 0.0, "{text} {edge:?} at {xi}: normal points inward");
        assert!(normal.dot(&columns[1 - direction]).abs() < 1e-9);
    }
}

#[test]
fn the_area_of_round_bodies_is_exact() {
    use std::f64::consts::PI;
    let sector = 0.5 * (1.5f64.powi(2) - 1.0) * 205.0 * PI / 180.0;
    let areas =
        [("type = 'disk'\nradius = 2.0", 4.0 * PI), ("type = 'half_disk'\nradius = 2.0", 2.0 * PI), (SECTOR, sector)];
    for (text, exact) in areas {
        let patch = patch(text, nurbs(3), [24, 24]).expect("valid");
        let area = area(&patch);
        assert!((area / exact - 1.0).abs() < 1e-9, "{text}: {area} {exact}");
    }
}

/// Area by the three-point Gauss rule.
fn area(patch: &Patch) -> f64 {
    let root = 0.6f64.sqrt();
    let rule = [(0.5 - 0.5 * root, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + 0.5 * root, 5.0 / 18.0)];
    let [nu, nv] = patch.elements();
    let mut area = 0.0;
    for e in (0..nu * nv).map(|e| [e % nu, e / nu]) {
        let [[u0, u1], [v0, v1]] = patch.span_box(e);
        for (a, wa) in rule {
            for (b, wb) in rule {
                let uv = [u0 + a * (u1 - u0), v0 + b * (v1 - v0)];
                area += wa * wb * (u1 - u0) * (v1 - v0) * patch.jacobian(e, uv);
            }
        }
    }
    area
}

#[test]
fn arcs_are_circles() {
    for basis in NURBS {
        let arcs = [
            ("type = 'disk'\nradius = 2.0", Edge::Bottom, 2.0),
            ("type = 'disk'\nradius = 2.0", Edge::Left, 2.0),
            ("type = 'half_disk'\nradius = 1.0", Edge::Bottom, 1.0),
            ("type = 'half_disk'\nradius = 1.0\nround = 'top'", Edge::Right, 1.0),
            ("type = 'annulus_sector'\nradii = [1.0, 3.0]\nangles = [-100.0, 200.0]", Edge::Top, 3.0),
        ];
        for (text, e, radius) in arcs {
            let curve = edge(text, e, basis, 7).expect("valid");
            inside(curve.basis.breaks()).for_each(|(_, xi)| assert_on_circle(&curve, Point::zeros(), radius, xi));
        }
        let whole = edge(
            "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 9.0]\nbottom = { type = 'arc', radius = 1.5 }",
            Edge::Bottom,
            basis,
            9,
        )
        .expect("valid");
        let center = Point::new(0.0, 1.25f64.sqrt());
        inside(whole.basis.breaks()).for_each(|(_, xi)| assert_on_circle(&whole, center, 1.5, xi));
        assert!((whole.point(-1.0) - Point::new(-1.0, 0.0)).norm() < 1e-15);
        let bumps = edge("type = 'block'\nx = [-2.0, 2.0]\ny = [-1.0, 0.5]\ntop = { type = 'arc', radius = 0.5, height = 0.4, count = 2, spacing = 1.5 }", Edge::Top, basis, 17).expect("valid");
        for (_, xi) in inside(bumps.basis.breaks()) {
            let (x, c) = (bumps.point(xi), if xi < 0.0 { -0.75 } else { 0.75 });
            if (xi - c).abs() < 0.24f64.sqrt() {
                assert_on_circle(&bumps, Point::new(c, 0.4), 0.5, xi);
            } else {
                assert!((x.y - 0.5).abs() < 1e-14);
            }
        }
    }
}
