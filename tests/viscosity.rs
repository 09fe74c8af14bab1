//! Viscous regularisation: what it takes is booked, falls with it, and takes the place of a snap.

#[path = "dynamics/scene.rs"]
mod scene;
mod support;

use std::f64::consts::PI;

use asperity::solve::Status;
use support::{Pass, Run, pass, run};

/// Flanks of 60 degrees, overlapping by half of their height, without friction: the path of equilibria ends.
fn steep(viscosity: f64, steps: usize) -> Run {
    let height = 1.6 * 60.0_f64.to_radians().tan() / PI;
    let setup = Pass { friction: 0.0, height, overlap: 0.5 * height, steps, ..Pass::default() };
    let model = pass(&setup);
    let model = if viscosity > 0.0 { model.with_viscosity(viscosity) } else { model };
    let found = run(model, steps);
    assert_eq!(found.outcome.status, Status::Done);
    found
}

#[test]
fn viscosity_takes_what_a_snap_sets_free() {
    let snap = steep(0.0, 304);
    let free = snap.records[303].snap_loss;
    for viscosity in [1e-2, 1e-3, 1e-4] {
        let clock = std::time::Instant::now();
        let found = steep(viscosity, 304);
        let end = &found.records[303];
        println!(
            "{viscosity:e}: {:.5} of the snap, open {:.1e}, snaps {}, cuts {}, iterations {}, {:.1} s",
            end.viscous_loss / free,
            (end.external_work - end.accounted()) / free,
            found.outcome.snaps,
            found.outcome.cuts,
            found.outcome.iterations,
            clock.elapsed().as_secs_f64()
        );
    }
}
