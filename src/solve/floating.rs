//! Bodies that nothing holds: springs that carry a Newton iteration over, and words where that is the end.

use crate::math::Triplets;
use crate::model::{ContactStatus, Control, Evaluation, Model};

/// Smallest spring of a floating body in units of `E`.
const FAINTEST_SPRING: f64 = 1e-10;

/// Springs for bodies that nothing holds at this iterate: those without a prescribed displacement while they touch nothing
/// or nothing sticks (no stiffness against rigid motion), and load equations of guided bodies that touch nothing. A spring
/// lets the body travel by about one element length per iteration until it is held. It acts on the increment alone, never
/// on the solution, and fades with the residual, so that convergence stays quadratic.
pub fn support_floating(model: &Model, evaluation: &Evaluation, entries: &mut Triplets) {
    for k in 0..model.bodies.len() {
        let motions = || model.motions.iter().zip(&model.equations.of_motion).filter(|(m, _)| m.body == k);
        let guided = motions().any(|(m, _)| matches!(m.control, Control::Displacement(_)));
        let loaded: Vec<usize> = motions().filter_map(|(_, equation)| *equation).collect();
        if model.has_mass(k) || (guided && loaded.is_empty()) || model.bodies[k].is_rigid() && loaded.is_empty() {
            continue;
        }
        let holds = |status: ContactStatus| match status {
            ContactStatus::Open => false,
            ContactStatus::Stick => true,
            ContactStatus::Slip => guided,
        };
        let held = evaluation.statuses_of(model, k).any(holds);
        if held {
            continue;
        }
        let equations = if guided { loaded } else { equations_of(model, k) };
        let load = equations.iter().fold(0.0_f64, |m, &e| m.max(evaluation.residual[e].abs()));
        let stiffness = load / (model.element_size * equations.len() as f64);
        let spring = stiffness.max(FAINTEST_SPRING * model.modulus);
        entries.extend(equations.into_iter().map(|e| (e, e, spring)));
    }
}

/// Names a body that only forces and contact hold and that slips wherever it touches: its load may exceed what friction
/// can carry.
pub fn hint(model: &Model, evaluation: &Evaluation) -> String {
    let free = |k: usize| {
        let mut motions = model.motions.iter().filter(|m| m.body == k).peekable();
        motions.peek().is_some() && motions.all(|m| matches!(m.control, Control::Force(_)))
    };
    let sticks = |k: usize| evaluation.statuses_of(model, k).any(|status| status == ContactStatus::Stick);
    match (0..model.bodies.len()).find(|&k| !model.has_mass(k) && free(k) && !sticks(k)) {
        Some(k) => format!(
            "; body `{}` is held by forces and contact alone and sticks nowhere: friction may be too weak for an equilibrium",
            model.bodies[k].name
        ),
        None => String::new(),
    }
}

/// Displacement unknowns of a body, each once.
fn equations_of(model: &Model, body: usize) -> Vec<usize> {
    let nodes = model.bodies[body].nodes();
    let mut equations: Vec<usize> =
        nodes.flat_map(|i| (0..2).filter_map(move |c| model.equations.unknown(i, c))).collect();
    equations.sort_unstable();
    equations.dedup();
    equations
}
