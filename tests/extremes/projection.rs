//! Closest points of steep, wavy and hollow curves against a plain search through thousands of places, and which side of the curve a
//! partner puts a point on.

use asperity::contact::{Projection, Seeker, Target};
use asperity::geometry::shapes::{Block, Cosine};
use asperity::geometry::{BasisSpec, Curve, Edge, Point, Profile, ShapeSpec, build_edge};
use proptest::prelude::*;
use std::f64::consts::PI;
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

/// A point of an asperity that points down, tip at `tip`, with the profile `height/2 (1 + cos)`; `phase` from -pi to pi.
fn seeker(tip: Point, [height, wavelength]: [f64; 2], phase: f64) -> Seeker {
    let x = tip + Point::new(phase * wavelength / (2.0 * PI), 0.5 * height * (1.0 - phase.cos()));
    let tangent = Point::new(1.0, height * PI / wavelength * phase.sin()).normalize();
    Seeker { x, tangent, normal: Point::new(tangent.y, -tangent.x) }
}

/// Distance of the partner, negative where the point is behind the curve there.
fn gap(curve: &Curve, projection: Projection, seeker: &Seeker) -> Option<f64> {
    let partner = Target::new(curve, &curve.points, projection, 10.0).project(seeker)?;
    let back = seeker.x - curve.place(&partner.shape, 0, &curve.points);
    Some(back.norm().copysign(back.dot(&curve.normal(partner.xi))))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// A steep asperity anywhere above, between and inside two steep ones: a point is said to be inside if and only if it lies below
    /// the closed formula of their height.
    #[test]
    fn gaps_have_the_sign_of_the_height(
        slope in 45.0..84.0f64, at in -1.3..1.3f64, depth in 0.02..0.98f64, phase in -3.1..3.1f64, degree in 1..4usize,
    ) {
        let wavelength = 0.8;
        let height = wavelength * f64::to_radians(slope).tan() / PI;
        let curve = curve(height, wavelength, 120, degree);
        let seeker = seeker(Point::new(at, height * (1.0 - depth)), [height, wavelength], phase);
        let top = |x: f64| if x.abs() < wavelength { 0.5 * height * (1.0 - (2.0 * PI * x / wavelength).cos()) } else { 0.0 };
        // how far the point is from the surface sideways: the fitted curve is no better than that
        let [above, below] = [-0.01, 0.01].map(|d| seeker.x.y - top(seeker.x.x + d));
        prop_assume!(above * below > 0.0 && seeker.x.x.abs() < 1.4);
        let inside = seeker.x.y < top(seeker.x.x);
        let ray = gap(&curve, Projection::Ray, &seeker);
        prop_assert_eq!(inside, ray.is_some_and(|g| g < 0.0), "ray: {:?}", ray);
        let closest = gap(&curve, Projection::Closest, &seeker);
        prop_assert!(closest.is_none_or(|g| inside == (g < 0.0)), "closest: {:?}", closest);
    }
}

/// Steep asperities side by side, 80 degrees: leading flanks face each other, and behind the trailing one there is nothing, whether
/// the bodies are apart or the leading flanks overlap a little.
#[test]
fn behind_a_trailing_flank_is_nothing() {
    let (wavelength, slope) = (0.8, f64::to_radians(80.0).tan());
    let height = wavelength * slope / PI;
    let curve = curve(height, wavelength, 120, 1);
    // tip half as high as the counterpart at -0.4: flanks are parallel where both are a sixth of the wavelength off
    for shift in [-0.3, -0.02, 0.02] {
        let tip = Point::new(-0.4 - wavelength / 3.0 + shift, 0.5 * height);
        for projection in [Projection::Ray, Projection::Closest] {
            let leading = gap(&curve, projection, &seeker(tip, [height, wavelength], PI / 3.0));
            let trailing = gap(&curve, projection, &seeker(tip, [height, wavelength], -0.5 * PI));
            println!("{shift} {projection:?}: {leading:?} {trailing:?}");
            assert!(trailing.is_none_or(|g| g > 0.0), "{shift}, {projection:?}: {trailing:?}");
            let leading = leading.expect("a partner on the facing flank");
            assert_eq!(leading < 0.0, shift > 0.0, "{shift}, {projection:?}: {leading}");
        }
    }
}
