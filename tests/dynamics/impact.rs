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
youngs_modulus = {s}
poissons_ratio = 0.0
density = {density}
[body.bar]
shape = {{ type = "block", x = [0.0, {width}], y = [0.0, {l}] }}
material = "m"
elements = [1, {elements}]
position = [0.0, {gap}]
velocity = [0.0, {velocity}]
[body.wall]
shape = {{ type = "block", x = [-{l}, {l}], y = [-{l}, 0.0] }}
rigid = true
basis = {{ type = "nurbs", degree = 1 }}
elements = [1, 1]
[[contact]]
nonmortar = {{ body = "bar", edge = "bottom" }}
mortar = {{ body = "wall", edge = "top" }}
law = {{ type = "frictionless" }}
[time]
end = {end}
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
    for (radius, elements, steps) in [(0.0, 40, 350), (0.5, 40, 350), (0.8, 40, 350), (0.8, 80, 700), (1.0, 40, 350)] {
        let found = run(&bar(radius, elements, steps, [1.0; 3]));
        let [duration, force, after] = measured(&found, 0.1);
        let start = 0.5 * 0.1 * SPEED * SPEED;
        let end = found.last();
        println!(
            "radius {radius}, {elements} elements: contact {duration:.4} (2), force {:.4} (1), after {:.4} (1); kinetic {:.4}, \
             elastic {:.4}, numerical {:.4}, open {:.1e}, iterations {}, cuts {}, peak {:.3}",
            force / (0.1 * SPEED),
            after / SPEED,
            end.kinetic_energy / start,
            end.strain_energy / start,
            end.numerical_loss / start,
            1.0 - end.accounted() / start,
            found.outcome.iterations,
            found.outcome.cuts,
            found.records.iter().fold(0.0_f64, |m, r| m.max(r.force[1])) / (0.1 * SPEED),
        );
    }
}
