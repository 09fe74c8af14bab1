//! Bodies that nothing holds, and bodies that only friction stops.

use crate::scene::run;

const BLOCK: &str = r#"
version = 1
[material.m]
type = "neo-hookean"
youngs_modulus = 3.0
poissons_ratio = 0.3
density = 0.7
[body.block]
shape = { type = "block", x = [0.0, 2.0], y = [0.0, 0.5], top = { type = "cosine", height = 0.2, wavelength = 1.0, centers = [0.8] } }
material = "m"
elements = [8, 2]
velocity = [0.3, -0.2]
rotation = 30.0
[time]
end = 5.0
steps = 17
[dynamics]
spectral_radius = 0.6
"#;

#[test]
fn free_flight_is_exact() {
    let found = run(BLOCK);
    for state in &found.states {
        for u in &state.u {
            let error = (u.x - 0.3 * state.time).hypot(u.y + 0.2 * state.time);
            assert!(error < 1e-14, "{error:.1e} at {}", state.time);
        }
    }
    assert_eq!((found.outcome.iterations, found.last().numerical_loss), (0, 0.0));
    assert!(found.last().strain_energy < 1e-15 * found.last().kinetic_energy);
    found.passes();
}

/// A constant force gives momentum in proportion to time, whatever vibrates; so does one that starts later.
#[test]
fn momentum_is_force_times_time() {
    for radius in [0.0, 0.6, 1.0] {
        let push =
            "[[drive]]\nbody = \"block\"\nedge = \"right\"\nx = { force = 0.02 }\ny = { force = -0.01 }\n[dynamics]";
        let found = run(&BLOCK.replace("[dynamics]", push).replace("0.6", &radius.to_string()));
        let momentum = found.momentum();
        for (p, time) in momentum.iter().zip(found.times()) {
            let gained = p - momentum[0];
            assert!(
                (gained.x - 0.02 * time).abs() < 1e-10 && (gained.y + 0.01 * time).abs() < 1e-10,
                "{gained} at {time}"
            );
        }
    }
}

/// A block pressed by `N` and pushed off at `v` decelerates by `mu N/m` and stops after `v^2 m/(2 mu N)`.
#[test]
fn a_sliding_block_stops_where_friction_stops_it() {
    let text = r#"
version = 1
[material.m]
type = "linear-elastic"
youngs_modulus = 1000.0
poissons_ratio = 0.3
density = 1.0
[body.block]
shape = { type = "block", x = [0.0, 2.0], y = [0.0, 0.25] }
material = "m"
elements = [8, 1]
velocity = [0.06, 0.0]
[body.floor]
shape = { type = "block", x = [-1.0, 4.0], y = [-1.0, 0.0] }
rigid = true
basis = { type = "nurbs", degree = 1 }
elements = [1, 1]
[[drive]]
body = "block"
edge = "top"
y = { force = -0.1 }
[[contact]]
nonmortar = { body = "block", edge = "bottom" }
mortar = { body = "floor", edge = "top" }
law = { type = "coulomb", friction = 0.3 }
[time]
end = 1.4
steps = 140
[dynamics]
"#;
    let found = run(text);
    let (mass, braking) = (0.5, 0.3 * 0.1);
    let (stop, way) = (0.06 * mass / braking, 0.06_f64.powi(2) * mass / (2.0 * braking));
    let all: Vec<usize> = found.model.bodies[0].nodes().collect();
    let (place, time) = (found.mean(&all, 0), found.times());
    let half = time.iter().position(|t| *t > 0.5 * stop - 1e-9).unwrap();
    let expected = 0.06 * time[half] - 0.5 * braking / mass * time[half].powi(2);
    println!("half way {} of {expected}, end {} of {way}", place[half], place[140]);
    println!("work of friction {} of {}", found.last().dissipated, 0.5 * mass * 0.06_f64.powi(2));
    assert!((place[half] / expected - 1.0).abs() < 0.01);
    assert!((place[140] / way - 1.0).abs() < 0.01);
    assert!((place[140] - place[130]).abs() < 1e-3 * way, "at rest after {stop}");
    assert!((found.last().dissipated / (0.5 * mass * 0.06_f64.powi(2)) - 1.0).abs() < 0.02);
    found.passes();
}
