//! Rate laws at steps of 1e-12 to 1e6, and a drive that turns round inside a step.

use asperity::solve::Status;

use crate::bench::{Found, run, solved};

fn timed(name: &str, law: &str, dt: f64) -> Found {
    let end = 32.0 * dt;
    let sets = [
        format!("contact.0.law={law}"),
        format!("time.end={end:e}"),
        format!("drive.0.x={{ displacement = {{ time = [0.0, {end:e}], value = [0.0, 1.6] }} }}"),
    ];
    solved(name, &[&sets[0], &sets[1], &sets[2]]).smooth(name)
}

/// Slip far below and far above the speed of a Stribeck law is Coulomb friction with the static and the kinetic coefficient.
#[test]
fn stribeck_law_at_both_ends() {
    let law = "{ type = \"stribeck\", static_friction = 0.3, kinetic_friction = 0.2, speed = 1.0, exponent = 2.0, viscous = 0.0 }";
    for (dt, limit) in [(1e-12, "0.2"), (1e-9, "0.2"), (1e6, "0.3")] {
        let coulomb = solved(limit, &[&format!("contact.0.law.friction={limit}")]);
        let change = timed(&format!("stribeck, dt = {dt:e}"), law, dt).difference(1.0, &coulomb);
        println!("stribeck against mu = {limit}, dt = {dt:e}: {change:.1e}");
        assert!(change < 1e-2, "dt = {dt:e}: {change:e}");
    }
}

/// Laws with a memory, from 1e-12 to 1e6 units of time for each step.
#[test]
fn laws_with_memory() {
    let lugre = "{ type = \"lugre\", rest = 0.4, kinetic = 0.2, speed = 1.0, stiffness = 100.0, damping = 0.0, viscosity = 0.0 }";
    let state = "{ type = \"rate-and-state\", friction = 0.3, direct_effect = 0.03, evolution_effect = 0.02, distance = 0.1, speed = 1.0 }";
    for dt in [1e-12, 1e-3, 1e6] {
        let slow = dt > 1.0;
        let limits = [(lugre, if slow { "0.4" } else { "0.2" })];
        for (law, limit) in limits {
            let coulomb = solved(limit, &[&format!("contact.0.law.friction={limit}")]);
            let change = timed(&format!("lugre, dt = {dt:e}"), law, dt).difference(1.0, &coulomb);
            println!("lugre against mu = {limit}, dt = {dt:e}: {change:.1e}");
            assert!(change < 1e-2, "dt = {dt:e}: {change:e}");
        }
        timed(&format!("rate and state, dt = {dt:e}"), state, dt);
    }
}

/// The drive turns round inside a step (and would be forgotten by it): what follows is as if a step had ended there, but for the
/// slip that the step does not see.
#[test]
fn reversal_inside_a_step() {
    let drive = "drive.0.x={ displacement = { time = [0.0, 0.5, 1.0], value = [0.0, 0.9, 0.5] } }";
    let [inside, at] =
        [25, 24].map(|steps| solved(&format!("{steps} steps"), &[drive, &format!("time.steps={steps}")]));
    let change = [0, 1].map(|c| (inside.last().force[c] - at.last().force[c]).abs() / at.peak(c));
    println!("reversal inside a step: {change:.1?}");
    assert!(inside.last().contact_length > 0.0 && change.iter().all(|c| *c < 0.02), "{change:?}");
}

/// Slip at 5e10 units of speed under a law with a viscous part bears far more than the bodies can: no solution, and the reason said.
#[test]
fn a_viscous_law_at_a_step_of_nothing_is_named() {
    let stribeck = "{ type = \"stribeck\", static_friction = 0.3, kinetic_friction = 0.2, speed = 1.0, exponent = 2.0, viscous = 0.01 }";
    let lugre = "{ type = \"lugre\", rest = 0.4, kinetic = 0.2, speed = 1.0, stiffness = 100.0, damping = 1.0, viscosity = 0.01 }";
    for law in [stribeck, lugre] {
        let sets = [
            format!("contact.0.law={law}"),
            "time.end=3.2e-11".into(),
            "time.max_cuts=2".into(),
            "drive.0.x={ displacement = { time = [0.0, 3.2e-11], value = [0.0, 1.6] } }".into(),
        ];
        let found = run(&[&sets[0], &sets[1], &sets[2], &sets[3]]);
        let Status::NotConverged { reason, .. } = &found.outcome.status else { panic!("{:?}", found.outcome.status) };
        println!("{reason}");
        assert!(reason.contains("flanks and friction interlock") && reason.contains("a slower drive"), "{reason}");
    }
}
