//! The two-asperity problem of the design (section 8) from end to end: robustness, identity, energy, order of Newton.

mod support;

use asperity::contact::Sites;
use asperity::math::CondensedSolver;
use asperity::solve::{Strategy, solve_step};
use std::sync::atomic::AtomicBool;
use support::{Pass, Run, done, pass, run};

/// Linear solves per nominal step with contact.
fn mean_iterations(found: &Run) -> f64 {
    let (sum, count) = found.touching().fold((0, 0), |(s, n), r| (s + r.newton_iterations, n + 1));
    sum as f64 / count as f64
}

/// Largest deviation of `mu_global` from `tan(atan mu + contact_angle)` at fully slipping steps; how many there were.
fn identity(found: &Run, mu: f64) -> (f64, usize) {
    let slipping = found.touching().filter(|r| r.fully_slipping);
    slipping.fold((0.0, 0), |(worst, n), r| {
        let expected = (mu.atan() + r.contact_angle).tan();
        (f64::max(worst, (r.mu_global - expected).abs() / expected.abs().max(1.0)), n + 1)
    })
}

#[test]
fn level_1_runs_without_a_failed_step_in_few_iterations() {
    for (degree, lagrange) in [(2, false), (1, true)] {
        for friction in [0.0, 0.1, 0.3] {
            let found = done(&Pass { friction, degree, lagrange, element: 0.05, ..Pass::default() });
            let (deviation, slipping) = identity(&found, friction);
            let mean = mean_iterations(&found);
            println!(
                "p = {degree}, mu = {friction}: {mean:.2} iterations, identity {deviation:.1e} at {slipping} steps"
            );
            assert_eq!(found.outcome.cuts, 0);
            assert!(mean <= 5.0);
            assert!(deviation < 1e-8 && slipping >= 20);
            for r in &found.records {
                assert!(r.force_imbalance < 1e-12 && r.moment_imbalance < 1e-12);
                for c in 0..2 {
                    assert!((r.force[c] - r.reaction_base[c]).abs() < 1e-8 * found.peak(c), "step {}", r.step);
                }
            }
            let left = found.records.last().unwrap().strain_energy
                / found.records.iter().fold(0.0, |m, r| r.strain_energy.max(m));
            assert!(left < 1e-12, "strain energy is back to zero after separation: {left:.1e}");
        }
    }
}

#[test]
fn nodal_sites_and_few_steps_reach_the_end() {
    let nodal = done(&Pass { sites: Some(Sites::Nodal), element: 0.05, ..Pass::default() });
    println!("nodal: {:.2} iterations, {} cuts", mean_iterations(&nodal), nodal.outcome.cuts);
    let (deviation, _) = identity(&nodal, 0.3);
    assert!(deviation < 1e-8, "{deviation:.1e}");
    for steps in [38, 19] {
        let found = done(&Pass { element: 0.05, steps, ..Pass::default() });
        println!("{steps} steps: {:.2} iterations, {} cuts", mean_iterations(&found), found.outcome.cuts);
    }
}

#[test]
fn work_is_stored_or_dissipated() {
    let error = |steps: usize| {
        let found = done(&Pass { steps, element: 0.05, ..Pass::default() });
        let work = found.records.last().unwrap().external_work;
        let worst = found.records.iter().map(|r| (r.external_work - r.strain_energy - r.dissipated).abs() / work);
        worst.fold(0.0, f64::max)
    };
    let errors = [76, 152, 304].map(error);
    println!("energy error at 76, 152, 304 steps: {errors:?}");
    // First order: sites close and open inside a step.
    assert!(errors[1] < 5e-3);
    assert!(errors[1] < 0.7 * errors[0] && errors[2] < 0.7 * errors[1]);
}

#[test]
fn a_frictionless_pass_is_symmetric_and_costs_no_work() {
    let found = done(&Pass { friction: 0.0, element: 0.05, ..Pass::default() });
    let n = found.records.len();
    // step k and step n - 1 - k mirror each other; the last is the mirror of the start
    for k in 0..n - 1 {
        let (a, b) = (&found.records[k].force, &found.records[n - 2 - k].force);
        assert!((a[0] + b[0]).abs() < 1e-6 * found.peak(0), "Fx is odd: {a:?} {b:?}");
        assert!((a[1] - b[1]).abs() < 1e-6 * found.peak(1), "Fy is even: {a:?} {b:?}");
    }
    let travel = 3.8 / n as f64;
    let total: f64 = found.records.iter().map(|r| r.force[0] * travel).sum();
    let absolute: f64 = found.records.iter().map(|r| r.force[0].abs() * travel).sum();
    println!("net work {:.1e} of the absolute work", total / absolute);
    assert!(total.abs() < 1e-6 * absolute);
}

#[test]
fn last_iterations_are_quadratic() {
    let setup = Pass { element: 0.1, from: -0.6, to: -0.2, steps: 8, ..Pass::default() };
    let found = run(pass(&setup), setup.steps);
    for (k, start) in found.states.iter().enumerate().skip(2).take(4) {
        let time = found.states[k + 1].time;
        let (mut solver, quiet, mut count) = (CondensedSolver::default(), AtomicBool::new(false), 0);
        let step = solve_step(&found.model, start, time, Strategy::default(), &mut solver, &quiet, &mut count)
            .expect("converges");
        let scale = step.evaluation.force_scale;
        let r: Vec<f64> = step.residuals.iter().map(|v| v / scale).collect();
        println!("{r:?}");
        let last = r.len() - 1;
        // above round-off: r[k+1] <= C r[k]^2, so the exponent of the last step is near 2
        let order = r[last].max(1e-13).ln() / r[last - 1].ln();
        assert!(order > 1.6, "order {order:.2}: {r:?}");
    }
}
