//! First guess of a step: driven bodies move as rigid bodies, everything else as in the last step.

use crate::geometry::Point;
use crate::model::{ContactStatus, Control, Evaluation, Model, State, Tangent, Trend, evaluate};

/// Overlap with which a landing body is set down, in element lengths.
const LANDING: f64 = 0.02;
/// Moves towards the counterpart at most.
const MAX_APPROACHES: usize = 100;

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

/// [`predict`] with deformation and multipliers continued as lately: along the last rate, or along a parabola.
fn extrapolate(model: &Model, start: &State, time: f64, trend: &Trend, parabola: bool) -> State {
    let mut trial = predict(model, start, time);
    let dt = time - start.time;
    trial.flat_mut().zip(&trend.rate).for_each(|(value, rate)| *value += rate * dt);
    if parabola {
        let factor = 0.5 * dt * (dt + trend.dt);
        trial.flat_mut().zip(&trend.change).for_each(|(value, change)| *value += change * factor);
    }
    trial.prescribe(model, time);
    trial
}

/// Moves bodies under given forces that touch nothing along their load until they touch, and evaluates the result; `None`
/// where a body is turned inside out.
///
/// The smallest gap is never more than the way to go, so moving by it cannot pass through the counterpart.
fn land(model: &Model, start: &State, trial: &mut State) -> Option<Evaluation> {
    let mut found = evaluate(model, start, trial, Tangent::None)?;
    for (k, body) in model.bodies.iter().enumerate() {
        let falls = load(model, k, trial.time).try_normalize(0.0).filter(|_| !model.has_mass(k));
        let Some(direction) = falls else { continue };
        for _ in 0..MAX_APPROACHES {
            let touches = found.statuses_of(model, k).any(|status| status != ContactStatus::Open);
            let gap = found.interfaces_of(model, k).fold(f64::INFINITY, |m, i| m.min(i.smallest_gap));
            if touches || !gap.is_finite() {
                break;
            }
            let shift = direction * (gap.max(0.0) + LANDING * model.element_size);
            trial.u[body.nodes()].iter_mut().for_each(|u| *u += shift);
            trial.prescribe(model, trial.time);
            found = evaluate(model, start, trial, Tangent::None)?;
        }
    }
    Some(found)
}

/// Resultant of the given forces on a body.
fn load(model: &Model, body: usize, time: f64) -> Point {
    let mut load = Point::zeros();
    for motion in model.motions.iter().filter(|m| m.body == body) {
        if let Control::Force(table) = &motion.control {
            load[motion.component] += table.at(time);
        }
    }
    load
}

/// First guess of a step: bodies with mass fly on, others as in [`predict`].
fn ahead(model: &Model, start: &State, time: f64) -> State {
    match model.ballistic(start, time) {
        Some(u) => {
            let mut trial = State { u, ..start.clone() };
            trial.prescribe(model, time);
            trial
        }
        None => predict(model, start, time),
    }
}

/// Guesses for the end of a step with their forces, the one with the smallest residual first; those that turn a body inside
/// out are left out. One that is good enough as it is comes alone: nothing touches, or nothing moves.
pub fn guesses(
    model: &Model,
    start: &State,
    time: f64,
    enough: impl Fn(&Evaluation) -> bool,
) -> Vec<(State, Evaluation)> {
    let judge = |mut trial: State| land(model, start, &mut trial).map(|found| (trial, found));
    let rigid = judge(ahead(model, start, time));
    if rigid.as_ref().is_some_and(|(_, found)| enough(found)) {
        return rigid.into_iter().collect();
    }
    let mut guesses = vec![];
    if let Some(trend) = &start.trend {
        guesses.push(extrapolate(model, start, time, trend, false));
        if !trend.change.is_empty() {
            guesses.push(extrapolate(model, start, time, trend, true));
        }
    }
    let mut judged: Vec<(State, Evaluation)> = rigid.into_iter().chain(guesses.into_iter().filter_map(judge)).collect();
    judged.sort_by(|(_, a), (_, b)| a.norm().total_cmp(&b.norm()));
    judged
}

/// The trend after a converged step, for the next one.
pub fn trend(model: &Model, start: &State, end: &State) -> Trend {
    let dt = end.time - start.time;
    let moved = predict(model, start, end.time);
    let rate: Vec<f64> = end.flat().zip(moved.flat()).map(|(a, b)| (a - b) / dt).collect();
    let change = match &start.trend {
        Some(before) => {
            let per_time = 2.0 / (dt + before.dt);
            rate.iter().zip(&before.rate).map(|(a, b)| (a - b) * per_time).collect()
        }
        None => vec![],
    };
    Trend { dt, rate, change }
}
