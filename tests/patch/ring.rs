//! Curved interface under uniform pressure.

use asperity::contact::Integration;
use asperity::geometry::BasisSpec;
use asperity::model::BodySpec;

use crate::{MODULUS, RATIO, material, shrink_fit, solve};

/// Largest relative error of the site pressures against Lame's solution in plane strain.
fn ring_error(degree: usize, refinement: usize, integration: Integration) -> f64 {
    let elements = [[7, 3], [5, 2]].map(|counts: [usize; 2]| counts.map(|n| n * refinement));
    let model = shrink_fit::model(BasisSpec::Nurbs { degree }, elements, integration, |builder, name, patch| {
        let added = builder.body(name, BodySpec::Deformable(patch, material(false, RATIO)));
        added.map(drop).expect("a valid patch");
    });
    let pressure = shrink_fit::pressure(MODULUS, RATIO);
    let (_, evaluation) = solve(&model, 1);
    let sites = &evaluation.interfaces[0].sites;
    sites.iter().fold(0.0, |m, s| m.max((s.pressure - pressure).abs() / pressure))
}

/// The ring needs 1/r in the displacement, so it is exact up to the discretisation error: with segments that falls like
/// h^(p+1) or faster down to the size of the interference (round-off of a gap that small included); element by element the quadrature error of the flat patch remains.
#[test]
fn pressure_ring() {
    for degree in [2, 3] {
        for integration in [Integration::Segment, Integration::Element] {
            let errors = [1, 2, 4].map(|refinement| ring_error(degree, refinement, integration));
            let rate = (errors[0] / errors[1]).log2();
            println!(
                "ring p = {degree} {integration:?}: {:.1e} {:.1e} {:.1e}, first rate {rate:.2}",
                errors[0], errors[1], errors[2]
            );
            match integration {
                Integration::Segment => assert!(errors[2] < 1e-6 && (degree > 2 || rate > 2.5), "{errors:?}"),
                Integration::Element => assert!(errors[2] < [2e-2, 2e-3][degree - 2], "{errors:?}"),
            }
        }
    }
}
