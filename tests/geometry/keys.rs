//! What is not allowed is refused, with its key.

use std::path::Path;

use asperity::geometry::{BasisSpec, Grading, ShapeSpec, build};

use super::{BODIES, nurbs, patch, shape};

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
