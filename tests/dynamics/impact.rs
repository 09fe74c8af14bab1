//! A bar strikes a wall, and another bar: waves run through it once and back.
//!
//! A bar of length `L` that meets a rigid wall with velocity `v` presses with `rho c v` for the time `2 L/c` and leaves with `-v`
//! (one-dimensional theory; exact in plane strain at `nu = 0`).

use crate::scene::{Run, run};

const SPEED: f64 = 0.01;

/// `L = c = E = rho = 1`, width 0.1; all lengths, stresses and times multiplied by `units`.
fn bar(radius: f64, elements: usize, steps: usize, units: [f64; 3]) -> String {
    let [l, s, t] = units;
    format!(
        r#"
version = 1
[material.m]
type = "linear-elastic"
youngs_modulus = {s:e}
poissons_ratio = 0.0
density = {density:e}
[body.bar]
shape = {{ type = "block", x = [0.0, {width:e}], y = [0.0, {l:e}] }}
material = "m"
elements = [1, {elements}]
position = [0.0, {gap:e}]
velocity = [0.0, {velocity:e}]
[body.wall]
shape = {{ type = "block", x = [-{l:e}, {l:e}], y = [-{l:e}, 0.0] }}
rigid = true
basis = {{ type = "nurbs", degree = 1 }}
elements = [1, 1]
[[contact]]
nonmortar = {{ body = "bar", edge = "bottom" }}
mortar = {{ body = "wall", edge = "top" }}
law = {{ type = "frictionless" }}
[time]
end = {end:e}
steps = {steps}
[dynamics]
spectral_radius = {radius}
"#,
        density = s * t * t / (l * l),
        width = 0.1 * l,
        gap = 0.5 * SPEED * l,
        velocity = -SPEED * l / t,
        end = 3.5 * t,
    )
}

/// Duration of contact, largest mean of the force over an eighth of it, velocity after.
fn measured(found: &Run, mass: f64) -> [f64; 3] {
    let dt = found.records[0].time;
    let impulse: f64 = found.records.iter().map(|r| r.force[1] * dt).sum();
    // from 5 to 95 % of the impulse
    let passes = |share: f64| {
        let mut sum = 0.0;
        let reached = |r: &&asperity::model::Record| {
            sum += r.force[1] * dt;
            sum >= share * impulse
        };
        found.records.iter().find(reached).map_or(f64::NAN, |r| r.time)
    };
    let duration = (passes(0.95) - passes(0.05)) / 0.9;
    let after = found.momentum().last().unwrap().y / mass;
    [duration, impulse / duration, after]
}

#[test]
fn a_bar_bounces_off_a_wall_as_the_theory_of_waves_says() {
    let start = 0.5 * 0.1 * SPEED * SPEED;
    let open = |radius: f64, elements: usize, steps: usize| {
        let found = run(&bar(radius, elements, steps, [1.0; 3]));
        let [duration, force, after] = measured(&found, 0.1);
        let (force, after, end) = (force / (0.1 * SPEED), after / SPEED, found.last());
        let open = (1.0 - end.accounted() / start).abs();
        println!(
            "radius {radius}, {elements} elements: contact for {duration:.4} of 2, force {force:.4}, rebound {after:.4}; kinetic {:.4}, \
             elastic {:.4}, numerical {:.4}, open {open:.1e}",
            end.kinetic_energy / start,
            end.strain_energy / start,
            end.numerical_loss / start,
        );
        assert!((duration / 2.0 - 1.0).abs() < 0.015 && (force - 1.0).abs() < 0.01, "{duration} {force}");
        assert!(after > 0.96 && after < 1.0 && open < 1e-3, "{after} {open}");
        found.passes();
        1.0 - after
    };
    for radius in [0.0, 0.5, 1.0] {
        open(radius, 40, 350);
    }
    let [coarse, fine] = [(40, 350), (80, 700)].map(|(elements, steps)| open(0.8, elements, steps));
    assert!(fine < 0.7 * coarse, "what stays behind as vibration falls with the mesh: {coarse} {fine}");
}

/// A moving bar comes to rest and hands its velocity to an equal one at rest; what one loses the other gains, at every step.
#[test]
fn equal_bars_exchange_their_velocities() {
    let wall = bar(0.8, 40, 350, [1.0; 3]);
    let (bar_at, contact_at) = (wall.find("[body.wall]").unwrap(), wall.find("[[contact]]").unwrap());
    let other = "[body.wall]\nshape = { type = \"block\", x = [0.0, 0.1], y = [-1.0, 0.0] }\nmaterial = \"m\"\nelements = [1, 37]\n";
    let found = run(&(wall[..bar_at].to_string() + other + &wall[contact_at..]));
    let total = found.momentum();
    let worst = total.iter().fold(0.0_f64, |m, p| m.max((p.y + 0.1 * SPEED).abs()));
    let inertia = found.model.inertia.as_ref().expect("inertia");
    let momenta = inertia.times(&found.states[350].rates.velocity);
    let of = |k: usize| found.model.bodies[k].nodes().map(|i| momenta[i].y).sum::<f64>() / (-0.1 * SPEED);
    println!("momentum kept to {:.1e}; first bar {:.4} (0), second {:.4} (1)", worst / (0.1 * SPEED), of(0), of(1));
    assert!(worst < 1e-9 * 0.1 * SPEED);
    assert!(of(0).abs() < 0.03 && (of(1) - 1.0).abs() < 0.03);
    found.passes();
}

#[test]
fn units_do_not_matter() {
    let plain = run(&bar(0.8, 10, 80, [1.0; 3]));
    for units in [[1e-6, 1e9, 1e3], [1e3, 1e-6, 1e-9]] {
        let scaled = run(&bar(0.8, 10, 80, units));
        assert_eq!(scaled.outcome.iterations, plain.outcome.iterations, "{units:?}");
        let energy = units[1] * units[0].powi(2);
        for (a, b) in scaled.records.iter().zip(&plain.records) {
            let error = (a.kinetic_energy / energy - b.kinetic_energy).abs() / plain.records[0].kinetic_energy;
            assert!(error < 1e-9, "{units:?}: {error:.1e} at step {}", a.step);
        }
    }
}
