//! From the declaration to the model: shapes become patches or curves, laws and materials objects, courses tables.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::dynamics;
use super::issue::{Issue, KeyPath, SceneError, listed};
use super::motion::{Course, Motion};
use super::numerics::{Integration, Projection, Sites, Volumetric, stable_degrees};
use super::rules::law_issue;
use super::spec::{BodySpec, ContactSpec, MaterialSpec, Scene};
use crate::bulk::{LinearElastic, Material, NeoHookean, SaintVenantKirchhoff};
use crate::contact;
use crate::geometry::{self, BSpline, Basis, Edge, GeometryError, Point};
use crate::model::{self, Builder, Control, Model, ModelError, PairSpec, State, Table, Tangent, evaluate};

/// Builds the model of a scene. Files that the scene names (profiles) are looked for in `base_dir`.
///
/// # Errors
/// Rules that are broken and geometry that cannot be built, by key; [`super::Source::locate`] adds the lines.
pub fn build(scene: &Scene, base_dir: &Path) -> Result<Model, SceneError> {
    scene.check()?;
    let bodies = bodies(scene, base_dir)?;
    let mut builder = Builder::default();
    for (i, contact) in scene.contact.iter().enumerate() {
        builder.contact(pair(contact, &bodies, &KeyPath::of("contact").at(i))?);
    }
    for (name, spec) in bodies {
        let key = KeyPath::of("body").at(name).at("shape");
        let added = match scene.body[name].volumetric {
            Volumetric::Auto => builder.body(name, spec),
            Volumetric::Standard => builder.body_in(name, spec, None),
        };
        added.map_err(|error| model_issue(&error, &key))?;
    }
    motions(scene, &mut builder)?;
    let model = builder.build().map_err(|error| model_issue(&error, &KeyPath::of("contact")))?;
    let model = dynamics::with_rates(scene, model);
    initial_overlap(scene, &model)?;
    Ok(model)
}

/// Share of the smaller body that a first step can be asked to push out of the other one.
const LARGEST_OVERLAP: f64 = 0.25;

/// Bodies that start inside one another farther than any step could repair.
fn initial_overlap(scene: &Scene, model: &Model) -> Result<(), Issue> {
    let state = State::initial(model);
    let Some(found) = evaluate(model, &state, &state, Tangent::None) else { return Ok(()) };
    for (k, (pair, interface)) in model.pairs.iter().zip(&found.interfaces).enumerate() {
        let extent = |body: usize| {
            let points = &model.bodies[body].points;
            let range = |c: usize| {
                let values = || points.iter().map(move |x| x[c]);
                values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
            };
            if model.bodies[body].is_rigid() { range(0).max(range(1)) } else { range(0).min(range(1)) }
        };
        let limit = LARGEST_OVERLAP * extent(pair.nonmortar.body).min(extent(pair.mortar.body));
        if -interface.smallest_gap > limit {
            let contact = &scene.contact[k];
            let message = format!(
                "`{}` starts {:.3e} deep inside `{}`: more than a first step can repair",
                contact.nonmortar.body, -interface.smallest_gap, contact.mortar.body
            );
            let allowed = format!("an initial overlap below {limit:.3e}, a quarter of the smaller body");
            return Err(Issue::value(KeyPath::of("contact").at(k), message).allowed(&allowed));
        }
    }
    Ok(())
}

type Bodies<'a> = BTreeMap<&'a str, model::BodySpec>;

fn bodies<'a>(scene: &'a Scene, base_dir: &Path) -> Result<Bodies<'a>, SceneError> {
    let mut bodies = Bodies::new();
    let mut issues = vec![];
    for (name, body) in &scene.body {
        match body_of(scene, name, body, base_dir) {
            Ok(spec) => drop(bodies.insert(name, spec)),
            Err(error) => issues.push(geometry_issue(error, &KeyPath::of("body").at(name))),
        }
    }
    if issues.is_empty() { Ok(bodies) } else { Err(SceneError(issues)) }
}

fn model_issue(error: &ModelError, key: &KeyPath) -> Issue {
    Issue::value(key.clone(), error.to_string())
}

/// Errors of the geometry carry their key relative to the body, entries of lists as `points[3]` or `points.3`.
fn geometry_issue(error: GeometryError, body: &KeyPath) -> Issue {
    let path = error.path();
    let segments = path.split(['.', '[', ']']).filter(|segment| !segment.is_empty());
    let key = segments.fold(body.clone(), |key, segment| key.at(segment));
    match error {
        GeometryError::Invalid { message, .. } => {
            let name = path.rsplit('.').next().unwrap_or_default();
            Issue::value(key, format!("`{name}`: {message}"))
        }
        GeometryError::File { file, line: 0, message, .. } => {
            Issue::value(key, format!("{}: {message}", file.display()))
        }
        GeometryError::File { file, line, message, .. } => {
            Issue::value(key, format!("{}:{line}: {message}", file.display()))
        }
    }
}

fn body_of(scene: &Scene, name: &str, body: &BodySpec, base_dir: &Path) -> Result<model::BodySpec, GeometryError> {
    let (grading, centre) = (body.grading.as_ref(), Point::from(body.position));
    let material = body.material.as_ref().and_then(|name| scene.material.get(name));
    if let Some(material) = material.filter(|_| !body.rigid) {
        let mut patch = geometry::build(&body.shape, &body.basis, body.elements, grading, body.position, base_dir)?;
        turn(&mut patch.points, centre, body.rotation);
        return Ok(model::BodySpec::Deformable(patch, material_of(material)));
    }
    let edges = touching_edges(scene, name).into_iter().map(|edge| {
        let mut curve =
            geometry::build_edge(&body.shape, edge, &body.basis, body.elements, grading, body.position, base_dir)?;
        turn(&mut curve.points, centre, body.rotation);
        Ok((edge, curve))
    });
    Ok(model::BodySpec::Rigid(edges.collect::<Result<_, GeometryError>>()?))
}

/// Edges of a body that take part in contact, each once.
fn touching_edges(scene: &Scene, name: &str) -> Vec<Edge> {
    let sides = scene.contact.iter().flat_map(|contact| [&contact.nonmortar, &contact.mortar]);
    let mut edges: Vec<Edge> = vec![];
    for side in sides.filter(|side| side.body == name) {
        if !edges.contains(&side.edge) {
            edges.push(side.edge);
        }
    }
    edges
}

/// Rotates control points about `centre`; NURBS are invariant under such maps, weights stay.
fn turn(points: &mut [Point], centre: Point, degrees: f64) {
    if degrees != 0.0 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        for point in points {
            let d = *point - centre;
            *point = centre + Point::new(cos * d.x - sin * d.y, sin * d.x + cos * d.y);
        }
    }
}

fn material_of(spec: &MaterialSpec) -> Arc<dyn Material> {
    match *spec {
        MaterialSpec::NeoHookean { youngs_modulus, poissons_ratio, .. } => {
            Arc::new(NeoHookean { youngs_modulus, poissons_ratio })
        }
        MaterialSpec::LinearElastic { youngs_modulus, poissons_ratio, .. } => {
            Arc::new(LinearElastic { youngs_modulus, poissons_ratio })
        }
        MaterialSpec::SaintVenantKirchhoff { youngs_modulus, poissons_ratio, .. } => {
            Arc::new(SaintVenantKirchhoff { youngs_modulus, poissons_ratio })
        }
    }
}

/// Supports first: where a drive and a support share a corner, the drive moves it.
fn motions(scene: &Scene, builder: &mut Builder) -> Result<(), SceneError> {
    for (i, support) in scene.support.iter().enumerate() {
        let at = &support.displacement;
        for (component, course) in [&at.x, &at.y].into_iter().enumerate() {
            if let Some(course) = course {
                let control = Control::Displacement(table(course));
                let added = builder.motion(&support.body, support.edge, component, control, false);
                added.map_err(|error| model_issue(&error, &KeyPath::of("support").at(i)))?;
            }
        }
    }
    for (i, drive) in scene.drive.iter().enumerate() {
        for (component, motion) in [&drive.x, &drive.y].into_iter().enumerate() {
            let control = match motion {
                Some(Motion::Displacement(course)) => Control::Displacement(table(course)),
                Some(Motion::Force(course)) => Control::Force(table(course)),
                None => continue,
            };
            let added = builder.motion(&drive.body, drive.edge, component, control, true);
            added.map_err(|error| model_issue(&error, &KeyPath::of("drive").at(i)))?;
        }
    }
    Ok(())
}

fn table(course: &Course) -> Table {
    match course {
        Course::Constant(value) => Table::constant(*value),
        Course::Table(table) => Table { time: table.time.clone(), value: table.value.clone() },
    }
}

fn pair(contact: &ContactSpec, bodies: &Bodies, key: &KeyPath) -> Result<PairSpec, SceneError> {
    let law = asperity_laws::parse(contact.law.clone());
    let law = law.map_err(|error| law_issue(&error, key))?;
    let numerics = &contact.numerics;
    Ok(PairSpec {
        nonmortar: (contact.nonmortar.body.clone(), contact.nonmortar.edge),
        mortar: (contact.mortar.body.clone(), contact.mortar.edge),
        law: Arc::from(law),
        sites: Some(match numerics.sites {
            Sites::Quadrature => contact::Sites::Quadrature,
            Sites::Nodal => contact::Sites::Nodal,
        }),
        projection: match numerics.projection {
            Projection::Closest => Some(contact::Projection::Closest),
            Projection::Ray => Some(contact::Projection::Ray),
            Projection::Auto => None,
        },
        integration: match numerics.integration {
            Integration::Element => Some(contact::Integration::Element),
            Integration::Segment => Some(contact::Integration::Segment),
            Integration::Auto => None,
        },
        points: numerics.points,
        r: Some(numerics.r),
        r_tangential: numerics.r_tangential,
        multiplier: multiplier(contact, bodies, key.at("numerics").at("multiplier_degree"))?,
    })
}

/// The multipliers asked for: smooth splines of a lower degree on the elements of the nonmortar edge, or its own functions.
fn multiplier(contact: &ContactSpec, bodies: &Bodies, key: KeyPath) -> Result<Option<Arc<dyn Basis>>, Issue> {
    let Some(degree) = contact.numerics.multiplier_degree else { return Ok(None) };
    let body = bodies.get(contact.nonmortar.body.as_str());
    let Some(model::BodySpec::Deformable(patch, _)) = body else { return Ok(None) };
    let edge = patch.boundary(contact.nonmortar.edge).basis;
    let highest = edge.degree();
    if degree == highest {
        // said by the user, so not left to the model; rational functions are those of the edge itself
        return Ok((edge.name() == "lagrange").then_some(edge));
    }
    let stable = stable_degrees(&*edge);
    let allowed = listed(&stable.iter().map(usize::to_string).collect::<Vec<_>>());
    let issue = |message| Issue::value(key.clone(), message).allowed(&allowed);
    if degree > highest {
        return Err(issue(format!("multipliers of degree {degree}: the edge can carry degrees 0 to {highest}")));
    }
    if !stable.contains(&degree) {
        return Err(issue(format!(
            "multipliers of degree {degree} on an edge of degree {highest}: the pressure of this pair oscillates, their \
             degrees must differ by an even number"
        )));
    }
    let spline = BSpline::from_breaks(degree, edge.breaks(), |_| 1);
    Ok(Some(Arc::new(spline.map_err(|error| issue(error.to_string()))?)))
}
