//! Profiles against their formulas.

use asperity::geometry::{BasisSpec, Edge, Point, build_edge};

use super::{assert_on_circle, edge, inside, nurbs, shape};

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
