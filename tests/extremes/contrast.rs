//! Moduli, meshes and weights that differ by many orders.

use crate::bench::{FLAT, PRESS, SWAP, against_rigid, solved};

/// A body a million times stiffer than its counterpart is a rigid one: against the same scene without its unknowns.
#[test]
fn a_stiff_body_is_a_rigid_one() {
    for (stiff, soft, nu) in [("low", "up", 0.3), ("up", "low", 0.3), ("up", "low", 0.49)] {
        // the rigid side is the mortar
        let (body, sides) = if stiff == "low" { ("lower", vec![]) } else { ("upper", SWAP.to_vec()) };
        let ratio = format!("material.{soft}.poissons_ratio={nu}");
        let reference = against_rigid(body, &[&sides[..], &[&ratio]].concat());
        for modulus in [1e3, 1e6] {
            let name = format!("{stiff} x {modulus:e}, nu = {nu}");
            let contrast = format!("material.{stiff}.youngs_modulus={modulus:e}");
            let found = solved(&name, &[&sides[..], &[&contrast, &ratio]].concat()).smooth(&name);
            let change = found.difference(1.0, &reference);
            println!("{name}: differs from rigid by {change:.1e}");
            assert!(change < 10.0 / modulus, "{name}: {change:e}");
        }
    }
}

/// A soft body on one of unit modulus gives the forces of the same contrast the other way, times its modulus.
#[test]
fn only_the_ratio_of_the_moduli_counts() {
    let stiff = solved("low x 1e6", &["material.low.youngs_modulus=1e6"]);
    let soft = solved("up x 1e-6", &["material.up.youngs_modulus=1e-6"]);
    let change = soft.difference(1e6, &stiff);
    println!("up x 1e-6 against low x 1e6: {change:.1e}");
    assert!(change < 1e-5, "{change:e}");
}

/// Either side twenty times finer than the other: near the forces of similar meshes, on coarse meshes. A nonmortar side that is much
/// coarser gets integration points enough to see the mortar elements, and who takes them away is warned.
#[test]
fn meshes_that_differ_twentyfold() {
    let reference = solved("alike", &["body.lower.elements=[48, 5]", "body.upper.elements=[23, 5]"]);
    for (name, lower, upper) in [("nonmortar finer", [8, 3], [80, 2]), ("mortar finer", [320, 2], [8, 3])] {
        let sets = [format!("body.lower.elements={lower:?}"), format!("body.upper.elements={upper:?}")];
        let found = solved(name, &[&sets[0], &sets[1]]).smooth(name);
        let blind = |w: &String| w.contains("cannot see");
        assert!(!found.warnings.iter().any(blind), "{name}: {:?}", found.warnings);
        let change = found.difference(1.0, &reference);
        println!("{name}: {change:.1e}");
        assert!(change < 0.25, "{name}: {change:e}");
    }
}

#[test]
fn degrees_one_to_five() {
    let reference = solved("degree 2, finer", &["body.lower.elements=[48, 10]", "body.upper.elements=[26, 10]"]);
    for degree in 1..=5 {
        let name = format!("degree {degree}");
        let sets =
            ["lower", "upper"].map(|body| format!("body.{body}.basis={{ type = \"nurbs\", degree = {degree} }}"));
        let found = solved(&name, &[&sets[0], &sets[1]]).smooth(&name);
        let change = found.difference(1.0, &reference);
        println!("{name}: {change:.1e}");
        assert!(change < 0.08, "{name}: {change:e}");
    }
}

/// A block whose lower edge is a straight line with one weight far from the others.
fn weighted(body: &str, weight: f64) -> String {
    format!(
        "body.{body}.shape={{ type = \"nurbs\", degrees = [2, 1], knots = [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]], points = [[-1, 0], \
         [0, 0], [1, 0], [-1, 1], [0, 1], [1, 1]], weights = [1, {weight:e}, 1, 1, {weight:e}, 1] }}"
    )
}

/// A straight edge stays what it is under any weights: forces are those of equal weights, or a warning before the run says that
/// the elements are too crowded to measure the edge.
#[test]
fn weights_over_six_orders() {
    let drag = "drive.0.x={ displacement = { time = [0.0, 0.2, 1.0], value = [0.0, 0.0, 0.5] } }";
    let narrow =
        ["body.upper.shape.x=[-0.6, 0.6]", "body.upper.position=[-0.2, 0.0]", "body.lower.position=[0.0, -1.0]"];
    let nonmortar = |weight| solved("nonmortar", &[FLAT[0], FLAT[2], &weighted("upper", weight), PRESS, drag]);
    let mortar =
        |weight| solved("mortar", &[FLAT[1], narrow[0], narrow[1], narrow[2], &weighted("lower", weight), PRESS, drag]);
    let sides: [(_, &dyn Fn(f64) -> _); 2] = [("nonmortar", &nonmortar), ("mortar", &mortar)];
    for (side, with) in sides {
        let reference = with(1.0);
        for weight in [1e-3, 1e-2, 1e2, 1e3] {
            let found = with(weight);
            let crowded = found.warnings.iter().any(|w| w.contains("integration points measure"));
            let change = found.difference(1.0, &reference);
            println!("{side} weight {weight:e}: {change:.1e}, warned: {crowded}");
            assert!(change < 0.1 || crowded, "{side} weight {weight:e}: {change:e}");
            assert!(change > 0.05 || !crowded, "{side} weight {weight:e}: warned of nothing");
        }
    }
}
