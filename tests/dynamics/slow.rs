//! Slow motions: inertia fades, and what is left is the quasi-static result.

use crate::scene::{Run, run};

/// One asperity climbs over another, with a density or quasi-static.
fn pass(density: Option<f64>) -> Run {
    let (mass, velocity, dynamics) = match density {
        Some(density) => (format!("density = {density:e}"), "velocity = [0.8, 0.0]", "[dynamics]"),
        None => (String::new(), "", ""),
    };
    run(&format!(
        r#"
version = 1
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
{mass}
[body.lower]
shape = {{ type = "block", x = [-2.0, 2.0], y = [-1.0, 0.0], top = {{ type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] }} }}
material = "rubber"
elements = [24, 4]
[body.upper]
shape = {{ type = "block", x = [-1.0, 1.0], y = [0.0, 1.0], bottom = {{ type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] }} }}
material = "rubber"
elements = [13, 4]
position = [-0.8, 0.6]
{velocity}
[[support]]
body = "lower"
edge = "bottom"
displacement = {{ x = 0.0, y = 0.0 }}
[[drive]]
body = "upper"
edge = "top"
x = {{ displacement = {{ time = [0.0, 1.0], value = [0.0, 0.8] }} }}
y = {{ displacement = 0.0 }}
[[contact]]
nonmortar = {{ body = "upper", edge = "bottom" }}
mortar = {{ body = "lower", edge = "top" }}
law = {{ type = "coulomb", friction = 0.3 }}
[time]
end = 1.0
steps = 20
{dynamics}
"#
    ))
}

/// Where the steps are long against all vibrations the difference falls in proportion to the density.
#[test]
fn a_slow_pass_is_the_quasi_static_one() {
    let still = pass(None);
    let peak = still.records.iter().fold(0.0_f64, |m, r| m.max(r.force[1].abs()));
    let differences = [1e-4, 1e-6, 1e-8].map(|density| {
        let moving = pass(Some(density));
        let pairs = moving.records.iter().zip(&still.records);
        pairs.fold(0.0_f64, |m, (a, b)| m.max((a.force[0] - b.force[0]).abs().max((a.force[1] - b.force[1]).abs())))
            / peak
    });
    println!("{differences:?}");
    assert!(differences[1] < 0.05 * differences[0] && differences[2] < 0.02 * differences[1], "{differences:?}");
    assert!(differences[2] < 1e-5);
}
