//! Lagrange elements on steep flanks: curves with corners, rays along nearly horizontal normals.

use std::f64::consts::PI;

use crate::bench::{Found, solved};

/// A pass of two asperities of this steepness whose tips overlap by half of their height, from the place `from` on.
fn pass(name: &str, (degree, degrees): (usize, f64), from: f64, more: &[&str]) -> Found {
    let height = 1.6 * degrees.to_radians().tan() / PI;
    let profile = format!("{{ type = \"cosine\", height = {height}, wavelength = 1.6, centers = [0.0] }}");
    let rows = (height / 0.2).ceil() as usize + 5;
    let mut sets = vec![
        format!("body.lower.shape.top={profile}"),
        format!("body.upper.shape.bottom={profile}"),
        format!("body.upper.position=[{from}, {}]", 1.5 * height),
    ];
    for (body, columns) in [("lower", 24), ("upper", 13)] {
        sets.push(format!("body.{body}.basis={{ type = \"lagrange\", degree = {degree} }}"));
        sets.push(format!("body.{body}.elements=[{columns}, {rows}]"));
    }
    let sets: Vec<&str> = sets.iter().map(String::as_str).chain(more.iter().copied()).collect();
    solved(name, &sets)
}

/// Nothing pulls at what lies behind a flank: the first force comes where flanks of the height `(1 + cos)` meet, both a sixth
/// of the wavelength from their tips.
#[test]
fn contact_begins_where_the_leading_flanks_meet() {
    let (from, step) = (-0.95, 0.03);
    let drag = format!("drive.0.x={{ displacement = {{ time = [0.0, 1.0], value = [0.0, {}] }} }}", 16.0 * step);
    for degree in [1, 2] {
        for degrees in [60.0, 70.0, 80.0] {
            let name = format!("Lagrange {degree}, {degrees} degrees");
            let found = pass(&name, (degree, degrees), from, &[&drag, "time.steps=16"]);
            let met = found.records.iter().find(|r| r.contact_length > 0.0).expect("contact");
            let place = from + step * met.step as f64;
            println!("{name}: first contact at {place}");
            // polygons cut the corners of the curve, and a step is as long as it is
            assert!((place + 1.6 / 3.0).abs() < 1.5 * step, "{name}: {place}");
            let before = found.records.iter().take_while(|r| r.step < met.step);
            assert!(
                before.into_iter().all(|r| r.force.iter().all(|f| f.abs() < 1e-10)),
                "{name}: force without contact"
            );
        }
    }
}

/// Without friction the two bodies keep nothing, so the pass costs what its snap sets free.
#[test]
fn a_frictionless_pass_costs_its_snap() {
    let law = "contact.0.law.friction=0.0";
    for degree in [1, 2] {
        let name = format!("Lagrange {degree}, 60 degrees, no friction");
        let found = pass(&name, (degree, 60.0), -0.8, &[law, "time.steps=40"]);
        let most = found.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
        let last = found.last();
        println!("{name}: work {:.3e}, set free {:.3e}, most {most:.3e}", last.external_work, last.snap_loss);
        assert!(last.strain_energy < 1e-6 * most, "{name}: still in contact");
        assert!((last.external_work - last.snap_loss).abs() < 0.05 * most, "{name}");
    }
}

/// Quadratic elements with friction of 45 degrees, where segments lost their way.
#[test]
fn quadratic_elements_at_unit_friction() {
    let found = pass("Lagrange 2, 40 degrees, mu = 1", (2, 40.0), -0.8, &["contact.0.law.friction=1.0"]);
    let last = found.last();
    let missing = last.external_work - last.strain_energy - last.dissipated - last.snap_loss;
    let most = found.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
    println!("mu = 1: {missing:.2e} of {most:.2e} unaccounted for");
    assert!(missing.abs() < 0.1 * most);
}
