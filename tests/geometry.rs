//! The geometry room against independent formulas: de Boor's recursion, circles, differences.

use std::path::Path;
use std::sync::Arc;

use asperity::geometry::{
    BSpline, Basis, BasisSpec, Curve, Edge, GeometryError, Grading, Lagrange, Patch, Point, ShapeSpec, build,
    build_edge, rational,
};

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

/// de Boor's recursion straight from the definition (0/0 = 0), for function `i` of degree `p`.
fn de_boor(knots: &[f64], i: usize, p: usize, xi: f64) -> f64 {
    if p == 0 {
        return f64::from(u8::from(knots[i] <= xi && xi < knots[i + 1]));
    }
    let part = |numerator: f64, denominator: f64, j: usize| {
        if denominator == 0.0 { 0.0 } else { numerator / denominator * de_boor(knots, j, p - 1, xi) }
    };
    part(xi - knots[i], knots[i + p] - knots[i], i)
        + part(knots[i + p + 1] - xi, knots[i + p + 1] - knots[i + 1], i + 1)
}

#[test]
fn bspline_values_match_de_boor_recursion() {
    for degree in 0..=8 {
        let basis = uneven(degree);
        for (span, xi) in inside(basis.breaks()) {
            let s = basis.evaluate(span, xi);
            let sum: f64 = s.d[0].iter().sum();
            assert!((sum - 1.0).abs() < 1e-14, "degree {degree} at {xi}: sum {sum}");
            for i in 0..basis.len() {
                let alive = (s.first..s.first + s.count).contains(&i);
                let value = if alive { s.d[0][i - s.first] } else { 0.0 };
                let exact = de_boor(basis.knot_vector(), i, degree, xi);
                assert!((value - exact).abs() < 1e-14, "degree {degree}, function {i} at {xi}: {value} {exact}");
            }
        }
    }
}

/// Fourth-order central difference of row `k - 1` against row `k`.
fn check_derivatives(evaluate: impl Fn(f64) -> asperity::geometry::Shape, xi: f64, what: &str) {
    let h = 1e-3;
    let s = evaluate(xi);
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|t| evaluate(xi + t * h));
    for k in 1..=3 {
        for i in 0..s.count {
            let at = |s: &asperity::geometry::Shape| s.d[k - 1][i];
            let difference = (at(&a) - 8.0 * at(&b) + 8.0 * at(&c) - at(&d)) / (12.0 * h);
            let scale = s.d[k].iter().fold(1.0, |m: f64, v| m.max(v.abs()));
            assert!(
                (s.d[k][i] - difference).abs() < 1e-6 * scale,
                "{what}, order {k}, function {i} at {xi}: {} {difference}",
                s.d[k][i]
            );
        }
    }
}

#[test]
fn derivatives_match_differences_also_rational_and_outside_the_span() {
    for degree in 1..=6 {
        let basis = uneven(degree);
        let weights: Vec<f64> = (0..basis.len()).map(|i| 1.0 + 0.3 * (i as f64 * 1.7).sin()).collect();
        for (span, xi) in inside(basis.breaks()) {
            check_derivatives(|t| basis.evaluate(span, t), xi, "polynomial");
            check_derivatives(|t| rational(&basis.evaluate(span, t), &weights), xi, "rational");
        }
        check_derivatives(|t| basis.evaluate(0, t), -0.6, "outside");
    }
    for degree in 1..=2 {
        let basis = Lagrange::new(degree, vec![0.0, 0.4, 1.0, 2.5]).expect("valid");
        for (span, xi) in inside(basis.breaks()) {
            check_derivatives(|t| basis.evaluate(span, t), xi, "lagrange");
        }
    }
}

#[test]
fn lagrange_functions_are_one_at_their_node_and_zero_at_the_others() {
    for degree in 1..=2 {
        let basis = Lagrange::new(degree, vec![0.0, 0.4, 1.0, 2.5]).expect("valid");
        let nodes = basis.nodes();
        assert_eq!(nodes.len(), basis.len());
        for span in 0..3 {
            for (i, &node) in nodes.iter().enumerate().skip(degree * span).take(degree + 1) {
                let s = basis.evaluate(span, node);
                assert_eq!(s.first, degree * span);
                for a in 0..s.count {
                    let expected = f64::from(u8::from(s.first + a == i));
                    assert!((s.d[0][a] - expected).abs() < 1e-14);
                }
            }
        }
    }
}

#[test]
fn greville_nodes_reproduce_the_linear_map() {
    for degree in 1..=5 {
        let basis = uneven(degree);
        let nodes = basis.nodes();
        for (span, xi) in inside(basis.breaks()) {
            let s = basis.evaluate(span, xi);
            let x: f64 = (0..s.count).map(|a| s.d[0][a] * nodes[s.first + a]).sum();
            assert!((x - xi).abs() < 1e-14);
        }
    }
}

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

fn assert_on_circle(curve: &Curve, center: Point, radius: f64, xi: f64) {
    let error = ((curve.point(xi) - center).norm() - radius).abs();
    assert!(error < 1e-14 * radius.max(1.0), "off the circle by {error} at {xi}");
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

#[test]
fn lagrange_nodes_lie_on_the_arc() {
    for degree in [1, 2] {
        let basis = BasisSpec::Lagrange { degree };
        let curve = edge(
            "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 9.0]\nbottom = { type = 'arc', radius = 1.5 }",
            Edge::Bottom,
            basis,
            9,
        )
        .expect("valid");
        let center = Point::new(0.0, 1.25f64.sqrt());
        curve.basis.nodes().into_iter().for_each(|xi| assert_on_circle(&curve, center, 1.5, xi));
        assert!(curve.weights.iter().all(|w| *w == 1.0));
    }
}

fn cosine(x: f64, c: f64) -> f64 {
    if (x - c).abs() > 0.8 {
        return 0.0;
    }
    0.2 * (1.0 + (2.0 * std::f64::consts::PI * (x - c) / 1.6).cos())
}

#[test]
fn the_cosine_converges_at_order_degree_plus_one() {
    // the joints at 0.13 -+ 0.8 lie on no uniform grid
    let text = "type = 'block'\nx = [-2.0, 2.0]\ny = [-1.0, 0.0]\ntop = { type = 'cosine', height = 0.4, wavelength = 1.6, centers = [0.13] }";
    for basis in [1, 2, 3, 4].map(nurbs).into_iter().chain([1, 2].map(|degree| BasisSpec::Lagrange { degree })) {
        let error = |n: usize| {
            let curve = edge(text, Edge::Top, basis, n).expect("valid");
            inside(curve.basis.breaks())
                .map(|(_, xi)| {
                    let x = curve.point(xi);
                    assert!((x.x - xi).abs() < 1e-13, "u is not x");
                    (x.y - cosine(x.x, 0.13)).abs()
                })
                .fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(40), error(160));
        let rate = (coarse / fine).log2() / 2.0;
        let expected = (basis.degree() + 1) as f64;
        assert!(rate > expected - 0.35, "{basis:?}: rate {rate}, errors {coarse} {fine}");
    }
}

#[test]
fn the_wedge_has_straight_flanks_and_a_tangent_tip() {
    let by_width = "{ type = 'wedge', height = 0.4, half_width = 0.6, tip_radius = 0.1 }";
    let curve = edge(
        &format!("type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\nbottom = {by_width}"),
        Edge::Bottom,
        nurbs(2),
        20,
    )
    .expect("valid");
    let middle = curve.basis.breaks().iter().copied().filter(|b| b.abs() < 0.6);
    let normals: Vec<(f64, f64)> =
        middle.flat_map(|b| [b - 1e-9, b + 1e-9]).map(|xi| (xi, curve.normal(xi).x)).collect();
    let lowest = inside(curve.basis.breaks()).map(|(_, xi)| curve.point(xi).y).fold(0.0, f64::min);
    assert!((lowest + 0.4).abs() < 1e-4 && lowest >= -0.4 - 1e-15, "the tip is at {lowest}");
    for pair in normals.chunks(2) {
        assert!((pair[0].1 - pair[1].1).abs() < 1e-6, "kink at {}", pair[0].0);
    }
    let slope = (-curve.normal(-0.4).x / -curve.normal(-0.4).y).atan();
    let text = format!(
        "type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\nbottom = {{ type = 'wedge', height = 0.4, angle = {}, tip_radius = 0.1 }}",
        slope.to_degrees().abs()
    );
    let twin = edge(&text, Edge::Bottom, nurbs(2), 20).expect("valid");
    for (a, b) in curve.points.iter().zip(&twin.points) {
        assert!((a - b).norm() < 1e-12, "half_width and angle disagree");
    }
}

#[test]
fn a_polyline_is_met_exactly_and_a_file_at_its_points() {
    let corners = [[-0.5, 0.0], [0.0, 0.3], [0.4, 0.1], [0.9, 0.2]];
    let text =
        format!("type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\ntop = {{ type = 'polyline', points = {corners:?} }}");
    let curve = edge(&text, Edge::Top, nurbs(3), 11).expect("valid");
    for [x, h] in corners {
        assert!((curve.point(x) - Point::new(x, 1.0 + h)).norm() < 1e-14);
    }
    assert!((curve.point(0.95).y - 1.2).abs() < 1e-14 && (curve.point(-0.75).y - 1.0).abs() < 1e-14);
    let dir = std::env::temp_dir().join(format!("asperity-geometry-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("temporary directory");
    let rows: Vec<String> =
        (0..=40).map(|i| -1.0 + 0.05 * f64::from(i)).map(|x| format!("{x}, {}", 0.1 * (3.0 * x).sin())).collect();
    std::fs::write(dir.join("good.csv"), format!("x, height\n# measured\n{}\n", rows.join("\n"))).expect("written");
    std::fs::write(dir.join("bad.csv"), "x,h\n-1,0\n0;oops\n1,0\n").expect("written");
    let spec = |file: &str| {
        shape(&format!("type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\ntop = {{ type = 'csv', file = '{file}' }}"))
    };
    let from = |file: &str| build_edge(&spec(file), Edge::Top, &nurbs(2), [80, 1], None, [0.0; 2], &dir);
    let curve = from("good.csv").expect("valid");
    for (_, xi) in inside(curve.basis.breaks()) {
        assert!((curve.point(xi).y - 1.0 - 0.1 * (3.0 * xi).sin()).abs() < 1e-3);
    }
    let error = from("bad.csv").expect_err("line 3 is broken");
    assert_eq!(error.key(), "top.file");
    assert!(error.to_string().contains("bad.csv:3:"), "{error}");
    assert!(from("none.csv").is_err());
    std::fs::remove_dir_all(&dir).expect("removed");
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

#[test]
fn what_is_not_allowed_is_named_by_its_key() {
    let block = |rest: &str| format!("type = 'block'\nx = [-1.0, 1.0]\ny = [0.0, 1.0]\n{rest}");
    let square = |knots: &str, points: &str| {
        format!("type = 'nurbs'\ndegrees = [1, 1]\nknots = [{knots}, [0, 0, 1, 1]]\npoints = {points}")
    };
    let points = "[[0, 0], [1, 0], [0, 1], [1, 1]]";
    let cases = [
        ("type = 'block'\nx = [1.0, 1.0]\ny = [0.0, 1.0]".to_owned(), "shape.x"),
        ("type = 'block'\nx = [0.0, 1.0]\ny = [0.0, nan]".to_owned(), "shape.y"),
        (block("top = { type = 'cosine', height = 0.1, wavelength = 0.0 }"), "shape.top.wavelength"),
        (block("top = { type = 'cosine', height = inf, wavelength = 1.0 }"), "shape.top.height"),
        (block("top = { type = 'cosine', height = 0.1, wavelength = 1.0, centers = [3.0] }"), "shape.top.centers"),
        (block("top = { type = 'cosine', height = 0.1, wavelength = 1.0, count = 3 }"), "shape.top.spacing"),
        (block("top = { type = 'cosine', height = -1.2, wavelength = 1.0 }"), "shape.y"),
        (block("bottom = { type = 'arc', radius = 0.9 }"), "shape.bottom.radius"),
        (block("bottom = { type = 'arc', radius = 0.3, height = 0.3 }"), "shape.bottom.height"),
        (block("bottom = { type = 'arc', radius = 0.3, height = 0.2, centers = [0.0, 0.3] }"), "shape.bottom.centers"),
        (block("top = { type = 'wedge', height = 0.1, half_width = 0.3, tip_radius = 0.6 }"), "shape.top.half_width"),
        (block("top = { type = 'wedge', height = 0.1, angle = 60.0, tip_radius = 0.3 }"), "shape.top.tip_radius"),
        (block("top = { type = 'wedge', height = 0.1, angle = 91.0, tip_radius = 0.3 }"), "shape.top.angle"),
        (block("top = { type = 'polyline', points = [[0.0, 0.0], [0.0, 1.0]] }"), "shape.top.points"),
        (block("top = { type = 'csv', file = 'no such file' }"), "shape.top.file"),
        ("type = 'disk'\nradius = -1.0".to_owned(), "shape.radius"),
        ("type = 'annulus_sector'\nradii = [2.0, 1.0]\nangles = [0.0, 90.0]".to_owned(), "shape.radii"),
        ("type = 'annulus_sector'\nradii = [1.0, 2.0]\nangles = [0.0, 360.0]".to_owned(), "shape.angles"),
        (square("[0, 0, 2, 1, 1]", points), "shape.knots"),
        (square("[0, 1, 1]", points), "shape.knots"),
        (square("[0, 0, 1, 1]", "[[0, 0], [1, 0], [0, 1]]"), "shape.points"),
        (square("[0, 0, 1, 1]", points) + "\nweights = [1, 1, 0, 1]", "shape.weights"),
        (square("[0, 0, 1, 1]", "[[0, 0], [0, 1], [1, 0], [1, 1]]"), "shape"),
    ];
    for (text, key) in cases {
        let error = patch(&text, nurbs(2), [8, 2]).expect_err(&text);
        assert_eq!(error.path(), key, "{error}");
    }
    let plain = shape(BODIES[0]);
    let with = |basis, elements, grading: Option<&str>| {
        let grading = grading.map(|g| toml::from_str::<Grading>(g).expect("valid toml"));
        let built = build(&plain, &basis, elements, grading.as_ref(), [0.0; 2], Path::new("."));
        built.expect_err("not allowed").path()
    };
    assert_eq!(with(nurbs(0), [2, 2], None), "basis.degree");
    assert_eq!(with(nurbs(9), [2, 2], None), "basis.degree");
    assert_eq!(with(BasisSpec::Lagrange { degree: 3 }, [2, 2], None), "basis.degree");
    assert_eq!(with(nurbs(2), [2, 0], None), "elements");
    assert_eq!(with(nurbs(2), [2, 2], Some("toward = 'top'")), "grading.ratio");
    assert_eq!(with(nurbs(2), [2, 2], Some("toward = 'top'\nratio = 0.5")), "grading.ratio");
    assert_eq!(
        with(nurbs(2), [2, 2], Some("along = { center = 9.0, half_width = 1.0, ratio = 2.0 }")),
        "grading.along.center"
    );
    assert_eq!(patch(BODIES[3], nurbs(2), [3, 2]).expect_err("too few").path(), "elements");
    assert_eq!(patch("type = 'disk'\nradius = 1.0", nurbs(1), [3, 2]).expect_err("not exact").path(), "basis.degree");
    assert!(
        toml::from_str::<ShapeSpec>("type = 'block'\nx = [0, 1]\ny = [0, 1]\ntop = { type = 'flat', hight = 1 }")
            .is_err()
    );
}
