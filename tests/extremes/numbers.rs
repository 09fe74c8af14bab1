//! Coefficients, slopes, overlaps, Poisson's ratios and augmentations far from the usual.

use crate::bench::solved;
use std::f64::consts::PI;

#[test]
fn friction_from_nothing_to_ten() {
    let zero = solved("mu = 0", &["contact.0.law.friction=0.0"]).smooth("mu = 0");
    let tiny = solved("mu = 1e-12", &["contact.0.law.friction=1e-12"]).smooth("mu = 1e-12");
    assert!(tiny.difference(1.0, &zero) < 1e-9);
    // beyond: the flanks interlock and let go by snaps, which are counted and whose energy is told
    for friction in ["1.0", "10.0"] {
        let found = solved(&format!("mu = {friction}"), &[&format!("contact.0.law.friction={friction}")]);
        let told: f64 = found.records.iter().map(|r| r.snap_loss).fold(0.0, f64::max);
        assert!(found.outcome.snaps == 0 || told > 0.0, "mu = {friction}: a snap that sets no energy free");
    }
}

#[test]
fn poissons_ratio_up_to_incompressible() {
    for nu in ["0.0", "0.49", "0.4999"] {
        let sets = ["low", "up"].map(|m| format!("material.{m}.poissons_ratio={nu}"));
        solved(&format!("nu = {nu}"), &[&sets[0], &sets[1]]).smooth(nu);
    }
}

/// Overlaps to 0.8 of the height and beyond: without friction the pass gives its work back.
#[test]
fn overlap_up_to_the_height() {
    for overlap in [0.32, 0.4] {
        for friction in ["0.0", "0.3"] {
            let place = format!("body.upper.position=[-0.8, {}]", 0.8 - overlap);
            let name = format!("overlap {overlap}, mu = {friction}");
            let found = solved(&name, &[&place, &format!("contact.0.law.friction={friction}")]).smooth(&name);
            if friction == "0.0" {
                // from the mirrored place to its image: the energies at both ends are equal
                let [first, last] = [found.records[0].external_work, found.last().external_work];
                let most = found.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
                assert!((last - first).abs() < 0.05 * most, "{name}: {first:e} {last:e} of {most:e}");
            }
        }
    }
}

/// Steepest flanks from 45 to 80 degrees, tips overlapping by 0.1.
#[test]
fn slopes_up_to_eighty_degrees() {
    for degrees in [45.0_f64, 60.0, 70.0, 80.0] {
        let height = 1.6 * degrees.to_radians().tan() / PI;
        let profile = format!("{{ type = \"cosine\", height = {height}, wavelength = 1.6, centers = [0.0] }}");
        let sets = [
            format!("body.lower.shape.top={profile}"),
            format!("body.upper.shape.bottom={profile}"),
            format!("body.upper.position=[-0.8, {}]", 2.0 * height - 0.1),
        ];
        for friction in ["contact.0.law.friction=0.0", "contact.0.law.friction=0.3"] {
            let name = format!("{degrees} degrees, {friction}");
            let found = solved(&name, &[&sets[0], &sets[1], &sets[2], friction]);
            // an energy that no step explains must be told by a snap or by the energy balance
            let last = found.last();
            let missing = last.external_work - last.strain_energy - last.dissipated - last.snap_loss;
            let most = found.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
            let told = found.findings.iter().any(|f| f.warns() && ["energy_balance", "snap"].contains(&f.name));
            assert!(missing.abs() < 0.02 * most || told, "{name}: {missing:e} of {most:e} goes unsaid");
        }
    }
}

/// Augmentations from a thousandth to a thousandfold of `E/h`. Nodal sites: the same solution, in one pass by other cuts perhaps.
/// Quadrature sites: the smaller the nearer to a penalty; far above they are unstable, which is said before the run.
#[test]
fn augmentations_over_six_decades() {
    let numerics = |sites: &str, r: f64| format!("contact.0.numerics={{ sites = \"{sites}\", r = {r:e} }}");
    // on the coarse mesh of the others averages over a control point cycle
    let fine = ["body.lower.elements=[40, 10]", "body.upper.elements=[21, 11]"];
    let nodal = solved("nodal", &[&numerics("nodal", 1.0), fine[0], fine[1]]).smooth("nodal");
    for r in [1e-3, 1e3] {
        let name = format!("nodal, r = {r:e}");
        let found = solved(&name, &[&numerics("nodal", r), fine[0], fine[1]]).smooth(&name);
        let change = found.difference(1.0, &nodal);
        println!("{name}: {change:.1e}");
        assert!(change < 1e-3, "{name}: {change:e}");
    }
    let [usual, sharp] = [&[][..], &fine].map(|mesh| solved("quadrature", mesh).smooth("quadrature"));
    for r in [1e-1, 1e1] {
        let [coarse, fine] = [(&[][..], &usual), (&fine, &sharp)].map(|(mesh, usual)| {
            let name = format!("quadrature, r = {r:e}");
            let sets = numerics("quadrature", r);
            solved(&name, &[mesh, &[sets.as_str()]].concat()).smooth(&name).difference(1.0, usual)
        });
        println!("quadrature, r = {r:e}: {coarse:.1e} coarse, {fine:.1e} fine");
        assert!(fine < 0.7 * coarse, "r = {r:e}: {coarse:e} and {fine:e}");
    }
    solved("quadrature, r = 1e-3", &[&numerics("quadrature", 1e-3)]).smooth("quadrature, r = 1e-3");
    let hard = solved("quadrature, r = 1e3", &[&numerics("quadrature", 1e3)]);
    assert!(hard.warnings.iter().any(|w| w.contains("unstable")), "{:?}", hard.warnings);
    assert!(usual.warnings.is_empty() && nodal.warnings.is_empty());
}
