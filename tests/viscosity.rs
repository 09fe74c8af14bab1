//! Viscous regularisation: what it takes is booked, falls with it, and takes the place of a snap.

#[path = "dynamics/scene.rs"]
mod scene;
mod support;

use std::f64::consts::PI;

use asperity::model::Record;
use asperity::solve::Status;
use support::{Pass, Run, climb, pass, run};

fn viscous(setup: &Pass, viscosity: f64) -> Run {
    let model = pass(setup);
    let found = run(if viscosity > 0.0 { model.with_viscosity(viscosity) } else { model }, setup.steps);
    assert_eq!(found.outcome.status, Status::Done, "{viscosity}");
    found
}

fn end(run: &Run) -> &Record {
    run.records.last().expect("a whole pass")
}

/// A block under a force from time 0 creeps by `u (1 - exp(-t/tau))`; steps of backward Euler obey `u' = (u tau/dt + U)/(1 + tau/dt)`.
#[test]
fn a_loaded_block_creeps_like_a_kelvin_voigt_solid() {
    let text = r#"
version = 1
[material.m]
type = "linear-elastic"
youngs_modulus = 4.0
poissons_ratio = 0.3
[body.block]
shape = { type = "block", x = [0.0, 1.0], y = [0.0, 1.0] }
material = "m"
elements = [2, 2]
[[support]]
body = "block"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "block"
edge = "top"
x = { displacement = 0.0 }
y = { force = -0.1 }
[time]
end = 2.0
steps = 400
[solution]
viscosity = 0.125
"#;
    let found = scene::run(text);
    let (tau, full) = (0.25, scene::run(&text.replace("0.125", "0.0")));
    let top = found.nodes(|x| x.y > 0.999);
    let (u, at_rest) = (found.mean(&top, 1), full.mean(&top, 1)[1]);
    let dt = 0.005;
    for (k, pair) in u.windows(2).enumerate() {
        let (step, exact) =
            ((pair[0] * tau / dt + at_rest) / (1.0 + tau / dt), at_rest * (1.0 - (-(k as f64 + 1.0) * dt / tau).exp()));
        assert!((pair[1] - step).abs() < 1e-9 * at_rest.abs(), "{} against {step}", pair[1]);
        assert!((pair[1] - exact).abs() < 0.5 * dt / tau * at_rest.abs(), "{} against {exact}", pair[1]);
    }
    // a force that acts at once does twice the work that is stored
    let record = found.last();
    println!(
        "stored {:.4e}, viscous {:.4e}, work {:.4e}",
        record.strain_energy, record.viscous_loss, record.external_work
    );
}

/// Share of the work and change of the forces fall with the viscosity.
#[test]
fn a_little_viscosity_changes_little() {
    let setup = Pass { friction: 0.0, ..climb() };
    let plain = viscous(&setup, 0.0);
    let peak = plain.peak(0).hypot(plain.peak(1));
    let measured = [1e-2, 1e-3, 1e-4].map(|viscosity| {
        let found = viscous(&setup, viscosity);
        let pairs = found.records.iter().zip(&plain.records);
        let change = pairs.map(|(a, b)| (a.force[0] - b.force[0]).hypot(a.force[1] - b.force[1])).fold(0.0, f64::max);
        [end(&found).viscous_loss / end(&found).external_work, change / peak]
    });
    println!("{measured:?}");
    for pair in measured.windows(2) {
        for k in 0..2 {
            let fall = pair[0][k] / pair[1][k];
            assert!(fall > 8.0 && fall < 12.0, "{measured:?}");
        }
    }
}

/// Flanks of 60 degrees, overlapping by half of their height, without friction: the path of equilibria ends.
#[test]
fn viscosity_takes_what_a_snap_sets_free() {
    let height = 1.6 * 60.0_f64.to_radians().tan() / PI;
    let setup = Pass { friction: 0.0, height, overlap: 0.5 * height, steps: 152, ..Pass::default() };
    let snap = viscous(&setup, 0.0);
    let free = end(&snap).snap_loss;
    let shares = [3e-3, 1e-3, 3e-4].map(|viscosity| {
        let found = viscous(&setup, viscosity);
        let open = (end(&found).external_work - end(&found).accounted()) / free;
        assert!(found.outcome.snaps == 0 && open.abs() < 0.03, "{open}");
        end(&found).viscous_loss / free
    });
    println!("viscous loss over the energy that the snap sets free: {shares:?}");
    // away from the snap viscosity takes its share in proportion, at the snap it comes late by less and less
    assert!(shares[0] > shares[1] && shares[1] > shares[2] && (shares[2] - 1.0).abs() < 0.05, "{shares:?}");
    assert!((shares[2] - 1.0) < 0.4 * (shares[1] - 1.0), "{shares:?}");
}
