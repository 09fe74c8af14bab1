//! A bar that vibrates along its length.

use std::f64::consts::PI;

use crate::scene::{run, run_from};

/// A bar of unit length, held at the bottom and sideways: `E = 2`, `nu = 0.3`, density 0.5.
fn bar(elements: usize, radius: f64, end: f64, steps: usize) -> String {
    format!(
        r#"
version = 1
[material.m]
type = "linear-elastic"
youngs_modulus = 2.0
poissons_ratio = 0.3
density = 0.5
[body.bar]
shape = {{ type = "block", x = [0.0, 0.1], y = [0.0, 1.0] }}
material = "m"
elements = [1, {elements}]
[[support]]
body = "bar"
edge = "left"
displacement = {{ x = 0.0 }}
[[support]]
body = "bar"
edge = "right"
displacement = {{ x = 0.0 }}
[[support]]
body = "bar"
edge = "bottom"
displacement = {{ y = 0.0 }}
[time]
end = {end}
steps = {steps}
[dynamics]
spectral_radius = {radius}
"#
    )
}

/// Speed of pressure waves with lateral motion held: `sqrt((lambda + 2 mu)/rho)`.
fn speed() -> f64 {
    (2.0 * (1.0 - 0.3) / ((1.0 + 0.3) * (1.0 - 0.6)) / 0.5_f64).sqrt()
}

fn mode(y: f64) -> f64 {
    (0.5 * PI * y).sin()
}

/// End of the bar over time, started with the velocity of the first mode.
fn first_mode(elements: usize, radius: f64, periods: f64, steps: usize) -> (Vec<f64>, Vec<f64>, f64) {
    let period = 4.0 / speed();
    let found = run_from(&bar(elements, radius, periods * period, steps), |model, state| {
        let places: Vec<_> = model.reference().collect();
        for (v, x) in state.rates.velocity.iter_mut().zip(places) {
            v.y = 1e-3 * mode(x.y);
        }
    });
    let shape: Vec<f64> = found.model.reference().map(|x| mode(x.y)).collect();
    let weights = asperity::bulk::lumped_areas(found.model.bodies[0].patch().expect("a block"));
    let part = |u: &[asperity::geometry::Point]| {
        u.iter().zip(&shape).zip(&weights).map(|((u, s), w)| 20.0 * w * u.y * s).sum()
    };
    let top = found.states.iter().map(|state| part(&state.u)).collect();
    (found.times(), top, found.last().numerical_loss / found.records[0].kinetic_energy)
}

/// `f = c/(4 L)`: zero crossings of the end.
#[test]
fn a_bar_vibrates_at_the_frequency_of_its_pressure_wave() {
    let (time, top, _) = first_mode(20, 1.0, 5.25, 1050);
    let crossings: Vec<f64> = (1..top.len())
        .filter(|&k| top[k - 1] < 0.0 && top[k] >= 0.0)
        .map(|k| time[k - 1] + (time[k] - time[k - 1]) * top[k - 1] / (top[k - 1] - top[k]))
        .collect();
    let measured = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    let period = 4.0 / speed();
    println!("period {measured}, theory {period}, {:.1e}", measured / period - 1.0);
    assert!((measured / period - 1.0).abs() < 1e-4, "{measured} against {period}");
}

#[test]
fn convergence_is_of_second_order_in_the_step() {
    for radius in [0.0, 0.5, 0.8, 1.0] {
        let at = |steps: usize| *first_mode(8, radius, 0.35, steps).1.last().unwrap();
        let values = [100, 200, 400, 800].map(at);
        let rates: Vec<f64> = values.windows(3).map(|v| ((v[0] - v[1]) / (v[1] - v[2])).abs().log2()).collect();
        println!("radius {radius}: {values:?}, orders {rates:?}");
        assert!((rates[1] - 2.0).abs() < 0.1, "radius {radius}: {rates:?}");
    }
}

#[test]
fn energy_is_kept_at_radius_one() {
    let found = run_from(&bar(8, 1.0, 10.0, 200), |model, state| {
        let places: Vec<_> = model.reference().collect();
        state.rates.velocity.iter_mut().zip(places).for_each(|(v, x)| v.y = mode(x.y) + 0.3 * mode(3.0 * x.y));
    });
    let start = found.model.kinetic_energy(&found.states[0]);
    let worst = found.records.iter().fold(0.0_f64, |m, r| m.max((r.kinetic_energy + r.strain_energy - start).abs()));
    let loss = found.records.iter().fold(0.0_f64, |m, r| m.max(r.numerical_loss.abs()));
    println!("energy kept to {:.1e}, loss {:.1e}", worst / start, loss / start);
    assert!(worst < 1e-10 * start && loss < 1e-10 * start);
}

/// Far above the frequencies that the steps resolve, two roots of the amplification are `-rho` and one is 0, so that
/// `u'' + 2 rho u' + rho^2 u = 0` from step to step.
#[test]
fn fast_vibrations_shrink_by_the_spectral_radius() {
    for radius in [0.2, 0.5, 0.8, 1.0] {
        let found = run_from(&bar(1, radius, 1e6, 12), |model, state| {
            let places: Vec<_> = model.reference().collect();
            state.rates.acceleration.iter_mut().zip(places).for_each(|(a, x)| a.y = 1e-3 * x.y);
        });
        let top = found.mean(&found.nodes(|x| x.y > 0.999), 1);
        for u in top.windows(3).skip(2) {
            let left = u[2] + 2.0 * radius * u[1] + radius * radius * u[0];
            assert!(left.abs() < 1e-5 * u[0].abs(), "radius {radius}: {u:?}");
        }
        println!("radius {radius}: {top:?}");
    }
}

/// What the integrator takes is the energy that is missing.
#[test]
fn numerical_loss_is_the_energy_that_is_missing() {
    for radius in [0.0, 0.5, 0.8] {
        let found = run(&bar(8, radius, 10.0, 2000).replace("elements", "velocity = [0.0, 0.1]\nelements"));
        let start = found.model.kinetic_energy(&found.states[0]);
        let end = found.last();
        let open = (end.kinetic_energy + end.strain_energy + end.numerical_loss - start) / start;
        println!("radius {radius}: lost {:.3e}, open {open:.1e}", end.numerical_loss / start);
        assert!(open.abs() < 1e-3 && end.numerical_loss > 0.0);
        found.passes();
    }
}
