//! Shrink fit of two quarter rings: the contact pressure is uniform by symmetry, and Lame's solution in plane strain is exact.

use std::path::Path;
use std::sync::Arc;

use asperity::contact::Integration;
use asperity::geometry::shapes::AnnulusSector;
use asperity::geometry::{BasisSpec, Edge, Patch, ShapeSpec, build};
use asperity::laws::builtin::Frictionless;
use asperity::model::{Builder, Control, Model, PairSpec, Table};

/// Inner radius, radius of the fit, outer radius.
pub const RADII: [f64; 3] = [1.0, 1.5, 2.0];
const INTERFERENCE: f64 = 1e-6;

/// The contact pressure.
pub fn pressure(modulus: f64, nu: f64) -> f64 {
    let [a, b, c] = RADII;
    let compliance = |r: f64| ((1.0 - 2.0 * nu) * b * b + r * r) / (r * r - b * b).abs();
    INTERFERENCE * modulus / (b * (1.0 + nu) * (compliance(a) + compliance(c)))
}

/// The rings, with so many elements in the inner and in the outer one; `add` makes bodies of them.
pub fn model(
    basis: BasisSpec,
    elements: [[usize; 2]; 2],
    integration: Integration,
    add: impl Fn(&mut Builder, &str, Patch),
) -> Model {
    let mut builder = Builder::default();
    let [a, b, c] = RADII;
    let rings = [("inner", [a, b + INTERFERENCE]), ("outer", [b, c])];
    for ((name, radii), elements) in rings.into_iter().zip(elements) {
        let shape = ShapeSpec::AnnulusSector(AnnulusSector { center: [0.0; 2], radii, angles: [0.0, 90.0] });
        add(&mut builder, name, build(&shape, &basis, elements, None, [0.0; 2], Path::new(".")).expect("a sector"));
    }
    let mut pair = PairSpec::new(("outer", Edge::Bottom), ("inner", Edge::Top), Arc::new(Frictionless {}));
    pair.integration = Some(integration);
    let built = (|| {
        for name in ["inner", "outer"] {
            let held = || Control::Displacement(Table::constant(0.0));
            builder.motion(name, Edge::Left, 0, held(), false)?.motion(name, Edge::Right, 1, held(), false)?;
        }
        builder.contact(pair);
        builder.build()
    })();
    built.expect("a valid model")
}
