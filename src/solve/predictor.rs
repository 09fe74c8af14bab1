//! First guess of a step: bodies move with their drives as rigid bodies.

use crate::geometry::Point;
use crate::model::{Control, Model, State};

/// State from which Newton starts: prescribed displacements at the new time, and every body translated by the mean
/// increment of its prescribed components, so that a driven body is not torn at its edge.
pub fn predict(model: &Model, start: &State, time: f64) -> State {
    let mut trial = start.clone();
    for (k, body) in model.bodies.iter().enumerate() {
        let mut shift = Point::zeros();
        for (c, component) in [0, 1].into_iter().zip(shift.iter_mut()) {
            let increments: Vec<f64> = model
                .motions
                .iter()
                .filter(|m| m.body == k && m.component == c)
                .filter_map(|m| match &m.control {
                    Control::Displacement(table) => Some(table.at(time) - table.at(start.time)),
                    Control::Force(_) => None,
                })
                .collect();
            if !increments.is_empty() {
                *component = increments.iter().sum::<f64>() / increments.len() as f64;
            }
        }
        trial.u[body.nodes()].iter_mut().for_each(|u| *u += shift);
    }
    trial.prescribe(model, time);
    trial
}
