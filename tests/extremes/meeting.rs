//! How curves meet: exactly touching, mirror images, valleys, grooves, several asperities, corners, and sliding off the end.

use crate::bench::{FLAT, PRESS, SWAP, solved};

const DOWN: &str = "drive.0.x={ displacement = 0.0 }";

/// Apex on apex: the mirror image is the same, so nothing pushes sideways.
#[test]
fn touching_exactly_and_mirrored() {
    let press = "drive.0.y={ displacement = { time = [0.0, 1.0], value = [0.0, -0.2] } }";
    for (name, lower, upper) in [("nodes meet", 24, 12), ("nodes apart", 24, 13)] {
        let elements = [format!("body.lower.elements=[{lower}, 5]"), format!("body.upper.elements=[{upper}, 5]")];
        let sets = ["body.upper.position=[0.0, 0.8]", DOWN, press, "time.steps=6", &elements[0], &elements[1]];
        let found = solved(name, &sets).smooth(name);
        assert_eq!(
            found.records.iter().filter(|r| r.contact_length > 0.0).count(),
            6,
            "{name}: in contact from the first step"
        );
        let sideways = found.peak(0) / found.peak(1);
        assert!(sideways < 1e-7, "{name}: {sideways:e}");
        let overlapping = ["body.upper.position=[0.0, 0.6]", DOWN, "time.steps=1", &elements[0], &elements[1]];
        let sideways = solved(name, &overlapping).last().force.map(f64::abs);
        assert!(sideways[0] < 1e-7 * sideways[1], "{name}, overlapping from the start: {sideways:?}");
    }
}

/// Flat faces pressed and dragged past the end of the mortar edge: the force fades with the length in contact, and what has left
/// is free.
#[test]
fn sliding_off_the_end() {
    let drag = "drive.0.x={ displacement = { time = [0.0, 0.2, 1.0], value = [0.0, 0.0, 3.0] } }";
    for friction in ["0.0", "0.3", "1.0"] {
        let name = format!("sliding off, mu = {friction}");
        let sets = [FLAT[0], FLAT[1], "body.upper.position=[0.6, 0.0]", PRESS, drag];
        let law = format!("contact.0.law.friction={friction}");
        let found = solved(&name, &[sets[0], sets[1], sets[2], sets[3], sets[4], &law]).smooth(&name);
        let gone = found.last();
        assert!(gone.contact_length == 0.0 && gone.force.iter().all(|f| f.abs() < 1e-8), "{name}: {:?}", gone.force);
        let lengths: Vec<f64> = found.records.iter().map(|r| r.contact_length).skip(12).collect();
        assert!(lengths.windows(2).all(|l| l[1] <= l[0] + 0.17), "{name}: {lengths:?}");
    }
}

/// The lower body narrower than the upper one, whose face overhangs both ends: points beyond have no partner.
#[test]
fn overhanging_corners() {
    let sets = [FLAT[0], FLAT[1], "body.lower.shape.x=[-0.7, 0.7]", "body.upper.position=[0.0, 0.0]", PRESS, DOWN];
    let found = solved("overhang", &sets).smooth("overhang");
    let ratio = found.last().contact_length / 1.4;
    assert!((0.85..1.1).contains(&ratio), "{ratio}");
    assert!(found.peak(0) < 1e-7 * found.peak(1));
}

fn profiles(lower: [&str; 3], upper: [&str; 3]) -> [String; 2] {
    [("lower.shape.top", lower), ("upper.shape.bottom", upper)].map(|(place, [height, wavelength, centers])| {
        format!(
            "body.{place}={{ type = \"cosine\", height = {height}, wavelength = {wavelength}, centers = {centers} }}"
        )
    })
}

const FINER: [&str; 2] = ["body.lower.elements=[40, 5]", "body.upper.elements=[21, 5]"];

/// A tip sinks into the valley between two asperities and touches both flanks at once, whichever side is projected.
#[test]
fn valley_with_two_flanks() {
    let [lower, upper] = profiles(["0.4", "0.8", "[-0.4, 0.4]"], ["0.4", "0.8", "[0.0]"]);
    let sink = "drive.0.y={ displacement = { time = [0.0, 1.0], value = [0.0, -0.25] } }";
    let place = "body.upper.position=[0.0, 0.5]";
    let sets = [&lower, &upper, place, DOWN, sink, "time.steps=12", FINER[0], FINER[1]];
    let one = solved("valley", &sets).smooth("valley");
    let other = solved("valley, sides swapped", &[&sets[..], &SWAP[..]].concat()).smooth("valley, sides swapped");
    for found in [&one, &other] {
        assert!(found.peak(0) < 1e-6 * found.peak(1), "{:e}", found.peak(0) / found.peak(1));
    }
    let change = other.difference(1.0, &one);
    println!("valley, sides swapped: {change:.1e}");
    assert!(change < 0.1, "{change:e}");
}

/// A tip in a groove hardly wider than itself (points near the centre of curvature), dragged out over its edge.
#[test]
fn groove_that_fits() {
    let [lower, upper] = profiles(["-0.4", "1.0", "[0.0]"], ["0.4", "0.9", "[0.0]"]);
    let ways = [
        "drive.0.x={ displacement = { time = [0.0, 0.2, 1.0], value = [0.0, 0.0, 1.0] } }",
        "drive.0.y={ displacement = { time = [0.0, 0.2, 1.0], value = [0.0, -0.05, 0.45] } }",
    ];
    let sets = [&lower, &upper, "body.upper.position=[0.0, 0.02]", ways[0], ways[1], FINER[0], FINER[1]];
    let found = solved("groove", &sets).smooth("groove");
    assert!(found.peak(0) > 0.0);
}

/// Two asperities pass four at once, from valley to valley: without friction the pass gives its work back.
#[test]
fn several_asperities() {
    let [lower, upper] = profiles(["0.15", "0.8", "[-1.2, -0.4, 0.4, 1.2]"], ["0.15", "0.8", "[-0.4, 0.4]"]);
    let drag = "drive.0.x={ displacement = { time = [0.0, 1.0], value = [0.0, 0.8] } }";
    let law = "contact.0.law.friction=0.0";
    let sets = [&lower, &upper, "body.upper.position=[-0.4, 0.22]", drag, law, FINER[0], FINER[1]];
    let found = solved("several", &sets).smooth("several");
    let most = found.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
    let kept = found.last().external_work / most;
    assert!(most > 0.0 && kept.abs() < 0.05, "{kept:e}");
}
