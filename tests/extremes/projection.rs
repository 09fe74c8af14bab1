//! Closest points of steep, wavy and hollow curves against a plain search through thousands of places.

use asperity::contact::{Projection, Seeker, Target};
use asperity::geometry::shapes::{Block, Cosine};
use asperity::geometry::{BasisSpec, Curve, Edge, Point, Profile, ShapeSpec, build_edge};
use proptest::prelude::*;
use std::path::Path;

/// Places of the plain search.
const PLACES: usize = 20_000;

fn curve(height: f64, wavelength: f64, elements: usize, degree: usize) -> Curve {
    let cosine = Cosine {
        height,
        wavelength,
        centers: Some(vec![-0.5 * wavelength, 0.5 * wavelength]),
        count: None,
        spacing: None,
    };
    let top = Profile::Cosine(cosine);
    let block = Block { x: [-1.5, 1.5], y: [-1.0, 0.0], top, bottom: Profile::default() };
    let shape = ShapeSpec::Block(block);
    let basis = BasisSpec::Nurbs { degree };
    build_edge(&shape, Edge::Top, &basis, [elements, 1], None, [0.0; 2], Path::new(".")).expect("an edge")
}

/// The nearest place whose normal opposes the seeker's: parameter and distance.
fn nearest(curve: &Curve, seeker: &Seeker) -> Option<(f64, f64)> {
    let breaks = curve.basis.breaks();
    let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
    let places = (0..=PLACES).map(|k| start + (end - start) * k as f64 / PLACES as f64);
    let opposing = places.filter(|&xi| curve.normal(xi).dot(&seeker.normal) < 0.0);
    opposing.map(|xi| (xi, (curve.point(xi) - seeker.x).norm())).min_by(|a, b| a.1.total_cmp(&b.1))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    /// Above, on and inside two hills or two hollows with flanks of up to 80 degrees, at least four elements each: no other place is nearer, and the
    /// distance is along the normal.
    #[test]
    fn no_place_is_nearer(
        slope in -80.0..80.0f64, wavelength in 0.3..1.2f64, density in 4..16usize, degree in 2..5usize,
        x in -1.0..1.0f64, above in -0.3..0.6f64, lean in -0.6..0.6f64,
    ) {
        let height = wavelength * slope.to_radians().tan() / std::f64::consts::PI;
        let elements = (3.0 / wavelength * density as f64) as usize;
        let curve = curve(height, wavelength, elements, degree);
        let top = curve.points.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p.y));
        let normal = Point::new(lean.sin(), -lean.cos());
        let seeker = Seeker { x: Point::new(x, top * 0.5 + above), tangent: Point::new(normal.y, -normal.x), normal };
        let Some((xi, distance)) = nearest(&curve, &seeker) else { return Ok(()) };
        let breaks = curve.basis.breaks();
        let [start, end] = [breaks[0], breaks[breaks.len() - 1]];
        let step = (end - start) / PLACES as f64;
        let stationary = {
            let [before, after] = [xi - step, xi + step].map(|xi| (curve.point(xi.clamp(start, end)) - seeker.x).norm());
            before >= distance && after >= distance && xi > start && xi < end
        };
        prop_assume!(stationary); // else the nearest place is an end, or where the normals stop to oppose
        let target = Target::new(&curve, &curve.points, Projection::Closest, 10.0);
        let partner = target.project(&seeker);
        prop_assert!(partner.is_some(), "no partner, but one at {xi} in a distance of {distance}");
        let partner = partner.unwrap();
        let [y, a] = [0, 1].map(|k| curve.place(&partner.shape, k, &curve.points));
        let d = seeker.x - y;
        prop_assert!(d.norm() <= distance * (1.0 + 1e-6) + 1e-9, "{} instead of {distance}", d.norm());
        prop_assert!(d.dot(&a).abs() <= 1e-9 * a.norm(), "{:e} along the curve", d.dot(&a) / a.norm());
    }
}
