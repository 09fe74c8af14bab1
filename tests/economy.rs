//! A model no larger than the scene: what is left out changes nothing, and `check` and `run.json` say it.

mod support;

use std::path::Path;
use std::sync::Arc;

use asperity::laws::builtin::{Coulomb, Frictionless};
use asperity::model::{Model, Tangent, evaluate};
use asperity::scene::{self, MaterialSpec, Scene};
use support::{Pass, Run, pass, run};

/// Largest difference of the forces of two runs over the peak.
fn difference(a: &Run, b: &Run) -> f64 {
    let peak = a.peak(0).max(a.peak(1));
    let apart = a.records.iter().zip(&b.records).flat_map(|(a, b)| [0, 1].map(|c| (a.force[c] - b.force[c]).abs()));
    apart.fold(0.0, f64::max) / peak
}

/// A climb into contact, coarse.
fn climb() -> Pass {
    Pass { friction: 0.0, ..support::climb() }
}

#[test]
fn without_friction_there_are_no_tangential_unknowns_and_nothing_else_is_missing() {
    let by = |law| run(pass(&Pass { law: Some(law), ..climb() }), 8);
    let none = by(Arc::new(Frictionless {}));
    let zero = by(Arc::new(Coulomb { friction: 0.0 }));
    let tiny = by(Arc::new(Coulomb { friction: 1e-11 }));
    assert!(none.peak(1) > 0.0 && difference(&none, &zero) == 0.0);
    assert!(difference(&none, &tiny) < 1e-9, "{:.1e}", difference(&none, &tiny));
    let multipliers = |run: &Run| run.model.unknowns() - run.model.equations.count;
    assert_eq!(2 * multipliers(&none), multipliers(&tiny));
}

/// A body at rest or moved as a whole is not integrated: as if it were.
#[test]
fn bodies_at_rest_exert_no_force() {
    let model = pass(&Pass { from: -1.9, ..climb() });
    let rest = asperity::model::State::initial(&model);
    let at = |state: &asperity::model::State, tangent| evaluate(&model, &rest, state, tangent).expect("not inverted");
    let mut moved = rest.clone();
    let upper = model.bodies[1].nodes();
    moved.u[upper].iter_mut().for_each(|u| u.x += 0.1);
    for state in [&rest, &moved] {
        let (skipped, integrated) = (at(state, Tangent::None), at(state, Tangent::Exact));
        let worst = integrated.forces.iter().fold(0.0_f64, |m, f| m.max(f.amax()));
        assert!(skipped.forces.iter().all(|f| f.amax() == 0.0) && skipped.strain_energy == 0.0);
        assert!(worst < 1e-14 && integrated.strain_energy.abs() < 1e-14, "{worst:.1e}");
    }
}

fn example(change: impl Fn(&mut Scene)) -> (Scene, Model) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/single_asperity.toml");
    let sets = ["time.steps=19", "body.lower.elements=[24,6]", "body.upper.elements=[13,6]"].map(String::from);
    let (mut scene, _) = Scene::load(&path, &sets).expect("a scene");
    change(&mut scene);
    let model = scene::build(&scene, path.parent().expect("a folder")).expect("a model");
    (scene, model)
}

fn rigid(scene: &mut Scene) {
    let lower = scene.body.get_mut("lower").expect("it is there");
    (lower.rigid, lower.material) = (true, None);
    scene.support.clear();
}

/// The stiffer the lower body the closer to a rigid one: the difference falls with 1/E.
#[test]
fn a_rigid_body_is_the_limit_of_stiff_ones() {
    let forces = |change: &dyn Fn(&mut Scene)| run(example(change).1, 19);
    let stiff = |youngs_modulus: f64| {
        forces(&|scene: &mut Scene| {
            let material = MaterialSpec::LinearElastic { youngs_modulus, poissons_ratio: 0.3, density: None };
            scene.material.insert("stiff".into(), material);
            scene.body.get_mut("lower").expect("it is there").material = Some("stiff".into());
        })
    };
    let limit = forces(&rigid);
    let [near, nearer] = [1e3, 1e4].map(|modulus| difference(&limit, &stiff(modulus)));
    println!("E = 1e3: {near:.2e}, 1e4: {nearer:.2e}");
    assert!(nearer < 1e-3 && (5.0..20.0).contains(&(near / nearer)));
}

#[test]
fn check_tells_a_lean_scene_from_a_full_one() {
    let (full, full_model) = example(|_| {});
    let (lean, lean_model) = example(|scene| {
        rigid(scene);
        scene.contact[0].law = toml::toml! { type = "frictionless" };
        scene.output.figures = false;
    });
    let said = |scene: &Scene, model: &Model| {
        (scene::modelled(scene, model).join("\n"), scene::left_out(scene, model).join("\n"))
    };
    let (full, full_left) = said(&full, &full_model);
    let (lean, lean_left) = said(&lean, &lean_model);
    assert!(full.contains("pressures and tractions") && lean.contains("pressures alone"));
    assert!(full.contains("body lower: neo-hookean") && lean.contains("body lower: rigid"));
    for part in
        ["tangential unknowns, slip history", "unknowns of body lower", "up to 9 of 19 steps", "output of figures"]
    {
        assert!(lean_left.contains(part) && !full_left.contains(part), "{part}:\n{lean_left}\n---\n{full_left}");
    }
    assert!(full_left.contains("state variables of contact 0: its law has no memory"));
    assert!(lean_model.unknowns() < full_model.unknowns() / 2);
}
