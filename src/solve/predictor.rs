//! First guess of a step: driven bodies move as rigid bodies, everything else as in the last step.

use crate::geometry::Point;
use crate::model::{Control, Evaluation, Model, State, Trend, evaluate};

/// Translation of every body between two times: the mean increment of its prescribed components.
fn rigid_shifts(model: &Model, from: f64, to: f64) -> Vec<Point> {
    let mut sums = vec![[(0.0, 0usize); 2]; model.bodies.len()];
    for motion in &model.motions {
        if let Control::Displacement(table) = &motion.control {
            let (sum, count) = &mut sums[motion.body][motion.component];
            *sum += table.at(to) - table.at(from);
            *count += 1;
        }
    }
    sums.iter().map(|pair| Point::from(pair.map(|(sum, count)| sum / count.max(1) as f64))).collect()
}

/// Prescribed displacements at the new time, and every body translated with its prescribed edges, so that a driven body
/// is not torn there.
pub fn predict(model: &Model, start: &State, time: f64) -> State {
    let mut trial = start.clone();
    for (body, shift) in model.bodies.iter().zip(rigid_shifts(model, start.time, time)) {
        trial.u[body.nodes()].iter_mut().for_each(|u| *u += shift);
    }
    trial.prescribe(model, time);
    trial
}

/// [`predict`] with deformation and multipliers continued as in the last step.
fn extrapolate(model: &Model, start: &State, time: f64, trend: &Trend) -> State {
    let mut trial = predict(model, start, time);
    let dt = time - start.time;
    trial.u.iter_mut().zip(&trend.u).for_each(|(u, rate)| *u += rate * dt);
    for (pair, [pressure, traction]) in trial.pairs.iter_mut().zip(&trend.multipliers) {
        let values = pair.pressure.iter_mut().chain(&mut pair.traction);
        values.zip(pressure.iter().chain(traction)).for_each(|(value, rate)| *value += rate * dt);
    }
    trial.prescribe(model, time);
    trial
}

/// The better of the two guesses, judged by the residual; `None` where both turn a body inside out.
pub fn first_guess(model: &Model, start: &State, time: f64) -> Option<State> {
    let size = |evaluation: Evaluation| evaluation.residual.iter().map(|v| v * v).sum::<f64>();
    let rigid = predict(model, start, time);
    let Some(trend) = &start.trend else { return Some(rigid) };
    let extrapolated = extrapolate(model, start, time, trend);
    let [a, b] = [&rigid, &extrapolated].map(|trial| evaluate(model, start, trial, false).map(size));
    match (a, b) {
        (None, None) => None,
        (Some(a), Some(b)) if a <= b => Some(rigid),
        (Some(_), None) => Some(rigid),
        _ => Some(extrapolated),
    }
}

/// Rates of a converged step, for the next one.
pub fn trend(model: &Model, start: &State, end: &State) -> Trend {
    let per_time = 1.0 / (end.time - start.time);
    let mut u: Vec<Point> = end.u.iter().zip(&start.u).map(|(a, b)| a - b).collect();
    for (body, shift) in model.bodies.iter().zip(rigid_shifts(model, start.time, end.time)) {
        u[body.nodes()].iter_mut().for_each(|u| *u = (*u - shift) * per_time);
    }
    let rate = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * per_time).collect();
    let pairs = end.pairs.iter().zip(&start.pairs);
    let multipliers = pairs.map(|(a, b)| [rate(&a.pressure, &b.pressure), rate(&a.traction, &b.traction)]).collect();
    Trend { u, multipliers }
}
