//! The model chosen for a scene, in words: what is modelled, what is left out and why, how large it is.

use super::dynamics;
use super::numerics::Solver;
use super::spec::Scene;
use crate::contact::ContactDiscretization;
use crate::model::{Body, Control, Model, Motion, Pair};

/// What is modelled: bodies, contacts, motions, one sentence a line.
pub fn modelled(scene: &Scene, model: &Model) -> Vec<String> {
    let mut lines: Vec<String> = model.bodies.iter().map(|body| body_line(scene, body)).collect();
    lines.extend(model.pairs.iter().enumerate().map(|(k, pair)| pair_line(scene, model, k, pair)));
    lines.extend(model.motions.iter().map(|motion| motion_line(model, motion)));
    lines.extend(dynamics::modelled(scene, model));
    lines
}

fn body_line(scene: &Scene, body: &Body) -> String {
    let elements = scene.body.get(&body.name).map_or([0, 0], |spec| spec.elements);
    match (body.patch(), body.material()) {
        (Some(patch), Some(material)) => format!(
            "body {}: {}, {} of degree {}, {} x {} elements, {} control points; {}",
            body.name,
            material.name(),
            patch.basis[0].name(),
            patch.basis[0].degree(),
            patch.elements()[0],
            patch.elements()[1],
            body.points.len(),
            body.volumetric().unwrap_or_default()
        ),
        _ => {
            format!("body {}: rigid, a curve of {} elements without unknowns", body.name, elements[0].max(elements[1]))
        }
    }
}

fn pair_line(scene: &Scene, model: &Model, k: usize, pair: &Pair) -> String {
    let numerics = pair.contact.numerics();
    let law = scene.contact.get(k).and_then(|contact| contact.law.get("type")?.as_str()).unwrap_or("?");
    let r = numerics.r * pair.contact.augmentation();
    format!(
        "contact {k}: {} on {}, law {law}; {:?} sites, {:?} projection, {:?}-wise integration with {} points, r = {r:.3e} at the shortest contact element",
        model.bodies[pair.nonmortar.body].name,
        model.bodies[pair.mortar.body].name,
        numerics.sites,
        numerics.projection,
        numerics.integration,
        numerics.points
    )
    .to_lowercase()
}

fn motion_line(model: &Model, motion: &Motion) -> String {
    let kind = if motion.drive { "drive" } else { "support" };
    let (control, table) = match &motion.control {
        Control::Displacement(table) => ("displacement", table),
        Control::Force(table) => ("force", table),
    };
    let course = if table.is_constant() {
        format!("held at {}", table.at(0.0))
    } else {
        let course = table.value.iter().map(f64::to_string).collect::<Vec<_>>();
        let until = table.time.last().copied().unwrap_or_default();
        match course.len() {
            0..=6 => format!("{} until time {until}", course.join(" to ")),
            n => format!("from {} through {n} values to {} at time {until}", course[0], course[n - 1]),
        }
    };
    let component = ["x", "y"][motion.component];
    format!("{kind} of body {}: {control} {component} {course}", model.bodies[motion.body].name)
}

/// What is left out, and why, one sentence a line.
pub fn left_out(scene: &Scene, model: &Model) -> Vec<String> {
    let mut lines = dynamics::left_out(scene);
    for (k, pair) in model.pairs.iter().enumerate() {
        if !pair.contact.rubs() {
            lines.push(format!("tangential unknowns of contact {k}: its law is frictionless at all times"));
        } else if pair.contact.variable_names().is_empty() {
            lines.push(format!("state variables of contact {k}: its law has no memory"));
        }
    }
    for body in model.bodies.iter().filter(|body| body.is_rigid()) {
        lines.push(format!("deformation of body {}: declared rigid", body.name));
    }
    if model.pairs.is_empty() {
        lines.push("contact: the scene has no [[contact]]".to_string());
    }
    for (what, every) in [("fields", scene.output.fields), ("interface", scene.output.interface)] {
        if every == 0 {
            lines.push(format!("output of {what}: `output.{what} = 0`"));
        }
    }
    lines
}

/// How large the model is and what solves it, one sentence a line.
pub fn size_lines(scene: &Scene, model: &Model) -> Vec<String> {
    let multipliers = model.unknowns() - model.equations.count;
    let element = if model.pairs.is_empty() { "mean element" } else { "shortest contact element" };
    let solver = match scene.solution.solver {
        Solver::Condensed => {
            let dense = model.boundary.len() + multipliers;
            format!("condensed, {} unknowns inside the bodies, {dense} in the dense block", model.unknowns() - dense)
        }
        Solver::SparseLu => "sparse LU of the whole".to_string(),
    };
    vec![
        format!("{} unknowns: {} displacements, {multipliers} multipliers", model.unknowns(), model.equations.count),
        format!("linear solver: {solver}"),
        format!("{} nominal steps of {:e}", scene.time.steps, scene.time.end / scene.time.steps as f64),
        format!("stress scale E = {:e}, {element} h = {:.3e}", model.modulus, model.element_size),
    ]
}
