//! The model chosen for a scene, in words: what is modelled, what is left out and why, how large it is.

use super::dynamics;
use super::numerics::Solver;
use super::run::time_plan;
use super::spec::Scene;
use crate::contact::ContactDiscretization;
use crate::model::{Body, Control, Mirror, Model, Motion, Pair};
use crate::solve::Ways;

/// What is modelled: bodies, contacts, motions, one sentence a line.
pub fn modelled(scene: &Scene, model: &Model) -> Vec<String> {
    let mut lines: Vec<String> = model.bodies.iter().map(|body| body_line(scene, body)).collect();
    lines.extend(model.pairs.iter().enumerate().map(|(k, pair)| pair_line(scene, model, k, pair)));
    lines.extend(model.motions.iter().map(|motion| motion_line(model, motion)));
    lines.extend(dynamics::modelled(scene, model));
    lines.extend(whole(model));
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
    let variables = pair.contact.variable_names().join(", ");
    let friction = match (pair.contact.rubs(), variables.as_str()) {
        (false, _) => "pressures alone".to_string(),
        (true, "") => "pressures and tractions".to_string(),
        (true, variables) => format!("pressures, tractions and the variables {variables}"),
    };
    format!(
        "contact {k}: {} on {}, law {law}, {friction}; {:?} sites, {:?} projection, {:?}-wise integration with {} points, r = {r:.3e} at the shortest contact element",
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
            lines.push(format!(
                "tangential unknowns, slip history and state variables of contact {k}: its law is frictionless at all times"
            ));
        } else if pair.contact.variable_names().is_empty() {
            lines.push(format!("state variables of contact {k}: its law has no memory"));
        }
    }
    lines.extend(model.bodies.iter().filter_map(simplified));
    if model.pairs.is_empty() {
        lines.push("contact: the scene has no [[contact]]".to_string());
    }
    lines.extend(recalled(scene, model));
    let output = &scene.output;
    let every = [("fields", output.fields), ("interface", output.interface), ("figures", output.figures.into())];
    for (what, _) in every.iter().filter(|(_, every)| *every == 0) {
        let value = if *what == "figures" { "false" } else { "0" };
        lines.push(format!("output of {what}: `output.{what} = {value}`"));
    }
    lines
}

/// What a body does without.
fn simplified(body: &Body) -> Option<String> {
    let name = &body.name;
    match body.material() {
        None => Some(format!("deformation and unknowns of body {name}: declared rigid")),
        Some(material) if material.small_strain() => {
            Some(format!("finite strain of body {name}: its material is {}", material.name()))
        }
        Some(_) => None,
    }
}

/// Steps that need not be solved.
fn recalled(scene: &Scene, model: &Model) -> Option<String> {
    let steps = scene.time.steps;
    let count = Ways::new(model, &time_plan(scene)).recalled(steps);
    let why =
        "nothing rubs and the drives come by again, so the states before are tried first, mirrored where they must be";
    (count > 0).then(|| format!("solution of up to {count} of {steps} steps: {why}"))
}

/// That a scene is symmetric throughout, of which no use is made.
fn whole(model: &Model) -> Option<String> {
    let mirror = Mirror::of(model)?;
    let times = model.motions.iter().flat_map(|motion| &motion.control.table().time);
    let throughout = times.copied().all(|time| mirror.agrees(model, time, time));
    let axis = mirror.axis + 0.0;
    throughout.then(|| {
        format!("both halves, although everything is symmetric about x = {axis} at all times: no half model is made")
    })
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
