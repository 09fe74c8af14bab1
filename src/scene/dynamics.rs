//! Forces that depend on rates, asked for by a scene: inertia (`[dynamics]`) and viscosity (`solution.viscosity`).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::issue::{Issue, KeyPath};
use super::spec::{BodySpec, MaterialSpec, Scene};
use crate::bulk::lame;
use crate::model::{Body, BodyKind, Matter, Model};

/// Inertia: every deformable body has the mass of its material's `density`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DynamicsSpec {
    /// Factor by which the amplitude of vibrations too fast for the steps shrinks in each: 1 conserves them (and lets contact
    /// chatter), 0 removes them at once. Slow motions are hardly damped by any.
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub spectral_radius: f64,
}

impl Default for DynamicsSpec {
    fn default() -> Self {
        Self { spectral_radius: 0.8 }
    }
}

impl MaterialSpec {
    /// Mass per volume, where given.
    pub fn density(&self) -> Option<f64> {
        match *self {
            Self::NeoHookean { density, .. }
            | Self::SaintVenantKirchhoff { density, .. }
            | Self::LinearElastic { density, .. } => density,
        }
    }
}

/// Everything that is wrong with the keys of inertia.
pub(super) fn check(scene: &Scene) -> Vec<Issue> {
    let velocities = scene.body.iter().filter_map(|(name, body)| velocity(scene, body, KeyPath::of("body").at(name)));
    velocities.chain(scene.material.iter().filter_map(|(name, material)| density(scene, name, material))).collect()
}

fn velocity(scene: &Scene, body: &BodySpec, key: KeyPath) -> Option<Issue> {
    body.velocity?;
    let key = key.at("velocity");
    if body.rigid {
        return Some(
            Issue::key(key, "a rigid body has no `velocity`").help("remove the key; a [[drive]] moves the body"),
        );
    }
    let issue = || Issue::key(key, "`velocity` means nothing without inertia");
    scene.dynamics.is_none().then(|| issue().help("add a table [dynamics], or remove the key"))
}

fn density(scene: &Scene, name: &String, material: &MaterialSpec) -> Option<Issue> {
    let used = scene.body.values().any(|body| !body.rigid && body.material.as_ref() == Some(name));
    let issue = || Issue::value(KeyPath::of("material").at(name), "missing key `density`: [dynamics] asks for inertia");
    (scene.dynamics.is_some() && used && material.density().is_none())
        .then(|| issue().allowed("a number > 0 (stress time^2/length^2)").help("or remove [dynamics]"))
}

/// The model with inertia and viscosity, where the scene asks for them.
pub(super) fn with_rates(scene: &Scene, model: Model) -> Model {
    let matter = |body: &Body| Matter {
        density: material(scene, body).and_then(MaterialSpec::density).unwrap_or_default(),
        velocity: scene.body[&body.name].velocity.unwrap_or_default(),
    };
    let model = match &scene.dynamics {
        Some(dynamics) => model.with_inertia(dynamics.spectral_radius, matter),
        None => model,
    };
    match scene.solution.viscosity {
        0.0 => model,
        share => model.with_viscosity(share * scene.time.end),
    }
}

fn material<'a>(scene: &'a Scene, body: &Body) -> Option<&'a MaterialSpec> {
    scene.material.get(scene.body.get(&body.name)?.material.as_ref()?)
}

/// What is modelled, one sentence a line.
pub(super) fn modelled(scene: &Scene, model: &Model) -> Vec<String> {
    let mut lines = vec![];
    if let Some(inertia) = &model.inertia {
        let radius = inertia.spectral_radius;
        lines.push(format!("inertia: consistent mass, generalised-alpha method, spectral radius {radius}"));
        lines.extend(model.bodies.iter().filter_map(|body| mass_line(scene, body)));
    }
    if let Some(viscosity) = &model.viscosity {
        lines.push(format!(
            "viscosity: Kelvin-Voigt, relaxation time {:e}, {} of the duration: a regularisation, its work is reported",
            viscosity.time, scene.solution.viscosity
        ));
    }
    lines
}

fn mass_line(scene: &Scene, body: &Body) -> Option<String> {
    let BodyKind::Deformable { elements, material: solid, .. } = &body.kind else { return None };
    let density = material(scene, body)?.density()?;
    let (lambda, mu) = lame(solid.youngs_modulus(), solid.poissons_ratio());
    let (wave, area) = (((lambda + 2.0 * mu) / density).sqrt(), elements.area());
    let (step, element) = (scene.time.end / scene.time.steps as f64, (area / elements.count() as f64).sqrt());
    let [vx, vy] = scene.body.get(&body.name)?.velocity.unwrap_or_default();
    Some(format!(
        "mass of body {}: {:.3e} per depth, velocity [{vx}, {vy}] at time 0; in a step a pressure wave runs through {:.2e} elements",
        body.name,
        density * area,
        wave * step / element
    ))
}

/// What is left out and why, one sentence a line.
pub(super) fn left_out(scene: &Scene) -> Vec<String> {
    let given = scene.material.values().any(|material| material.density().is_some());
    let why = if given { ": there is a `density`, but no [dynamics]" } else { "" };
    if scene.dynamics.is_some() { vec![] } else { vec![format!("inertia: the analysis is quasi-static{why}")] }
}
