//! The geometry room against independent formulas: de Boor's recursion, circles, differences.

#[path = "geometry/bases.rs"]
mod bases;
#[path = "geometry/bodies.rs"]
mod bodies;
#[path = "geometry/keys.rs"]
mod keys;
#[path = "geometry/profiles.rs"]
mod profiles;
#[path = "geometry/refinement.rs"]
mod refinement;

use std::path::Path;

use asperity::geometry::{BSpline, BasisSpec, Curve, Edge, GeometryError, Patch, Point, ShapeSpec, build, build_edge};

const NURBS: [BasisSpec; 3] = [nurbs(2), nurbs(3), nurbs(4)];

const fn nurbs(degree: usize) -> BasisSpec {
    BasisSpec::Nurbs { degree }
}

fn shape(text: &str) -> ShapeSpec {
    toml::from_str(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn patch(text: &str, basis: BasisSpec, elements: [usize; 2]) -> Result<Patch, GeometryError> {
    build(&shape(text), &basis, elements, None, [0.0; 2], Path::new("."))
}

fn edge(text: &str, edge: Edge, basis: BasisSpec, n: usize) -> Result<Curve, GeometryError> {
    build_edge(&shape(text), edge, &basis, [n, 1], None, [0.0; 2], Path::new("."))
}

/// Parameters spread over all spans, none on a break.
fn inside(breaks: &[f64]) -> impl Iterator<Item = (usize, f64)> {
    let spans: Vec<[f64; 2]> = breaks.windows(2).map(|b| [b[0], b[1]]).collect();
    spans.into_iter().enumerate().flat_map(|(s, [a, b])| [0.03, 0.31, 0.5, 0.77, 0.98].map(|t| (s, a + t * (b - a))))
}

fn uneven(degree: usize) -> BSpline {
    let knots = [0.3, 0.7, 0.7, 1.1, 1.9, 1.9, 1.9];
    let mut all = vec![-0.5; degree + 1];
    all.extend(knots.iter().filter(|_| degree > 2).copied());
    all.extend([2.25, 2.5]);
    all.extend(vec![3.0; degree + 1]);
    BSpline::new(degree, all).expect("valid knots")
}

fn assert_on_circle(curve: &Curve, center: Point, radius: f64, xi: f64) {
    let error = ((curve.point(xi) - center).norm() - radius).abs();
    assert!(error < 1e-14 * radius.max(1.0), "off the circle by {error} at {xi}");
}

const SECTOR: &str = "type = 'annulus_sector'\nradii = [1.0, 1.5]\nangles = [-20.0, 185.0]\ncenter = [0.5, -0.25]";

const BODIES: [&str; 9] = [
    "type = 'block'\nx = [0.0, 2.0]\ny = [0.0, 1.0]",
    "type = 'block'\nx = [-2.0, 2.0]\ny = [-1.0, 0.0]\ntop = { type = 'cosine', height = 0.4, wavelength = 1.6, centers = [0.0] }",
    "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\nbottom = { type = 'arc', radius = 2.0 }\ntop = { type = 'cosine', height = 0.1, wavelength = 0.5, count = 3, spacing = 0.6 }",
    "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\ntop = { type = 'arc', radius = 0.3, height = 0.25, centers = [-0.4, 0.4] }",
    "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\nbottom = { type = 'wedge', height = 0.4, half_width = 0.6, tip_radius = 0.1 }",
    "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\ntop = { type = 'polyline', points = [[-0.5, 0.0], [0.0, 0.3], [0.4, 0.0]] }",
    "type = 'disk'\nradius = 2.0",
    "type = 'half_disk'\nradius = 2.0\nround = 'top'",
    SECTOR,
];
