//! The tangent of a contact step against central differences, in every branch.

mod support;

use asperity::contact::{ContactStatus, Integration, Projection, Sites, Tangent};
use asperity::model::{Matter, Model, State, evaluate};
use support::{Pass, pass};

/// A state in contact: the upper asperity pushed against the lower one, with multipliers of the right size.
fn touching(model: &Model, time: f64, ripple: f64) -> (State, State) {
    let start = asperity::solve::predict(model, &State::initial(model), time - 0.004);
    let mut trial = asperity::solve::predict(model, &start, time);
    for (i, u) in trial.u.iter_mut().enumerate() {
        u.x += ripple * (7.3 * i as f64).sin();
        u.y += ripple * (3.1 * i as f64).cos();
    }
    trial.prescribe(model, time);
    for pair in &mut trial.pairs {
        pair.pressure.iter_mut().enumerate().for_each(|(i, p)| *p = 0.02 * (1.0 + (1.7 * i as f64).sin()));
        pair.traction.iter_mut().enumerate().for_each(|(i, q)| *q = 0.01 * (2.9 * i as f64).sin());
    }
    (start, trial)
}

/// Relative error of the tangent in a random direction, by central differences; the statuses met.
fn error(model: &Model, start: &State, trial: &State, seed: usize) -> (f64, Vec<ContactStatus>) {
    let direction: Vec<f64> =
        (0..model.unknowns()).map(|i| ((i * 7919 + seed * 104_729) % 1009) as f64 / 504.5 - 1.0).collect();
    let here = evaluate(model, start, trial, Tangent::Exact).expect("admissible");
    let product = here.system.as_ref().expect("with tangent").assemble().times(&direction);
    let step = 1e-6 * model.element_size;
    let moved = |factor: f64| {
        let mut state = trial.clone();
        state.advance(model, &direction, factor);
        evaluate(model, start, &state, Tangent::None).expect("admissible")
    };
    let (plus, minus) = (moved(step), moved(-step));
    let status = |e: &asperity::model::Evaluation| -> Vec<ContactStatus> {
        e.interfaces.iter().flat_map(|i| i.sites.iter().map(|s| s.status)).collect()
    };
    assert_eq!(status(&plus), status(&minus), "the directions must not cross a kink");
    let scale = product.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let worst = (0..product.len())
        .map(|i| ((plus.residual[i] - minus.residual[i]) / (2.0 * step) - product[i]).abs())
        .fold(0.0_f64, f64::max);
    (worst / scale, status(&here))
}

/// Inertia and viscosity of a step as short as their time scales, edges without mass and drives included.
#[test]
fn tangent_holds_with_inertia_and_viscosity() {
    for degree in [1, 2, 3] {
        let setup = Pass { degree, element: 0.2, projection: Some(Projection::Ray), ..Pass::default() };
        let matter = |_: &asperity::model::Body| Matter { density: 0.3, velocity: [0.1, -0.2] };
        let still = pass(&setup);
        let model = still.clone().with_inertia(0.6, matter).with_viscosity(0.01);
        let (start, trial) = touching(&model, 0.45, 0.003);
        let (error, _) = error(&model, &start, &trial, degree);
        assert!(error < 1e-7, "degree {degree}: {error:.1e}");
        let size = |model: &Model| {
            let found = evaluate(model, &start, &trial, Tangent::Exact).expect("admissible");
            found.system.expect("a tangent").bulk.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()))
        };
        assert!(size(&model) > 3.0 * size(&still), "they must matter");
    }
}

#[test]
fn tangent_equals_differences_in_all_branches() {
    let mut met = [false; 3];
    for (degree, lagrange) in [(1, true), (2, true), (2, false), (3, false)] {
        for sites in [Sites::Nodal, Sites::Quadrature] {
            for projection in [Projection::Closest, Projection::Ray] {
                if lagrange && projection == Projection::Closest {
                    continue; // Lagrange edges have corners, and closest points sit on them: no derivative there
                }
                let setup = Pass {
                    degree,
                    lagrange,
                    element: 0.2,
                    sites: Some(sites),
                    projection: Some(projection),
                    integration: Some(Integration::Element),
                    ..Pass::default()
                };
                let model = pass(&setup);
                for (time, ripple) in [(0.40, 0.0), (0.45, 0.003), (0.52, 0.003)] {
                    let (start, trial) = touching(&model, time, ripple);
                    let (error, statuses) = error(&model, &start, &trial, degree);
                    for status in statuses {
                        met[status as usize] = true;
                    }
                    assert!(error < 1e-6, "{setup:?} at {time}: relative error {error:.1e}");
                }
            }
        }
    }
    assert_eq!(met, [true; 3], "open, stick and slip all occurred");
}

/// Segment ends move with the bodies, and the Gauss points with them. That motion is left out of the tangent: inside the
/// mortar edge the integrands are continuous, so that what is missing is the change of the quadrature error.
#[test]
fn segment_tangent_is_complete_up_to_the_quadrature_error() {
    let setup = Pass { element: 0.2, integration: Some(Integration::Segment), ..Pass::default() };
    let model = pass(&setup);
    for (time, ripple) in [(0.45, 0.0), (0.52, 0.0)] {
        let (start, trial) = touching(&model, time, ripple);
        let (error, statuses) = error(&model, &start, &trial, 3);
        assert!(statuses.len() > 3 * 10, "segments cut the elements");
        println!("at {time}: relative error {error:.1e}");
        assert!(error < 2e-3, "at {time}: relative error {error:.1e}");
    }
}

#[test]
fn frictionless_tangent_is_symmetric() {
    // (Ray projection gives up symmetry for forces that do not jump at mortar corners.)
    for projection in [Projection::Closest] {
        for sites in [Sites::Nodal, Sites::Quadrature] {
            let setup = Pass {
                friction: 0.0,
                element: 0.2,
                sites: Some(sites),
                projection: Some(projection),
                ..Pass::default()
            };
            let model = pass(&setup);
            let (start, trial) = touching(&model, 0.45, 0.003);
            let matrix = evaluate(&model, &start, &trial, Tangent::Exact)
                .expect("admissible")
                .system
                .expect("tangent")
                .assemble();
            let largest = matrix.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            for j in 0..matrix.pattern.n {
                for k in matrix.pattern.columns[j]..matrix.pattern.columns[j + 1] {
                    let i = matrix.pattern.rows[k];
                    let difference = (matrix.values[k] - matrix.entry(j, i)).abs();
                    assert!(difference < 1e-12 * largest, "{setup:?} ({i}, {j}): {difference:.1e}");
                }
            }
        }
    }
}
