//! Rules that join several values of a scene. Ranges of single values are in `spec`.

use std::collections::BTreeMap;

use asperity_laws::LawError;

use super::dynamics;
use super::issue::{Issue, KeyPath};
use super::motion::{Course, DriveSpec, Motion, SupportSpec};
use super::numerics::Volumetric;
use super::spec::{BodySpec, ContactSpec, Scene};
use crate::geometry::Edge;

/// More elements than this in one scene are taken for a slip of the pen.
const MAX_ELEMENTS: usize = 4_000_000;

/// Everything that is wrong with the scene as a whole.
pub(super) fn check(scene: &Scene) -> Vec<Issue> {
    let mut issues = vec![];
    bodies(scene, &mut issues);
    for (i, support) in scene.support.iter().enumerate() {
        let key = KeyPath::of("support").at(i);
        known_body(scene, &support.body, key.at("body"), &mut issues);
        support_rules(scene, support, &key.at("displacement"), &mut issues);
    }
    for (i, drive) in scene.drive.iter().enumerate() {
        let key = KeyPath::of("drive").at(i);
        known_body(scene, &drive.body, key.at("body"), &mut issues);
        drive_rules(drive, &key, &mut issues);
    }
    prescribed_twice(scene, &mut issues);
    issues.extend(dynamics::check(scene));
    for (i, contact) in scene.contact.iter().enumerate() {
        contact_rules(scene, contact, &KeyPath::of("contact").at(i), &mut issues);
    }
    issues
}

fn bodies(scene: &Scene, issues: &mut Vec<Issue>) {
    if scene.body.is_empty() {
        issues.push(Issue::value(KeyPath::of("body"), "no body").allowed("at least one table [body.NAME]"));
    }
    let mut elements = 0usize;
    for (name, body) in &scene.body {
        let key = KeyPath::of("body").at(name);
        material_of(scene, body, &key, issues);
        let [nx, ny] = body.elements;
        elements = elements.saturating_add(nx.saturating_mul(ny));
        if elements > MAX_ELEMENTS {
            let message = format!("{nx} x {ny} elements are too many: {elements} so far");
            issues.push(Issue::value(key.at("elements"), message).allowed(format!("at most {MAX_ELEMENTS} in all")));
        }
        held(scene, name, body, &key, issues);
    }
}

fn material_of(scene: &Scene, body: &BodySpec, key: &KeyPath, issues: &mut Vec<Issue>) {
    let names: Vec<&String> = scene.material.keys().collect();
    match (&body.material, body.rigid) {
        (Some(name), false) if !scene.material.contains_key(name) => {
            let issue = Issue::value(key.at("material"), format!("there is no material \"{name}\""));
            issues.push(issue.known(name, &names));
        }
        (None, false) => {
            let issue = Issue::value(key.at("material"), "missing key `material`: what is the body made of?");
            issues.push(issue.known("", &names).help("or `rigid = true` for a body without unknowns"));
        }
        (Some(_), true) => {
            let issue = Issue::key(key.at("material"), "a rigid body has no `material`");
            issues.push(issue.help("remove the key, or remove `rigid = true`"));
        }
        _ => {}
    }
    if body.rigid && body.volumetric != Volumetric::Auto {
        issues.push(Issue::key(key.at("volumetric"), "a rigid body has no `volumetric`").help("remove the key"));
    }
}

/// A body without any support, drive or contact is free to fly: without mass Newton's matrix would be singular.
fn held(scene: &Scene, name: &str, body: &BodySpec, key: &KeyPath, issues: &mut Vec<Issue>) {
    let supported = scene.support.iter().any(|support| support.body == name);
    let driven = scene.drive.iter().any(|drive| drive.body == name);
    // a support of a misspelt body is reported as such
    let mut named = scene.support.iter().map(|s| &s.body).chain(scene.drive.iter().map(|d| &d.body));
    let misspelt = named.any(|name| !scene.body.contains_key(name));
    // one contact can push a body away but not hold it
    let touches = |c: &&ContactSpec| c.nonmortar.body == name || c.mortar.body == name;
    let clamped = scene.contact.iter().filter(touches).count() > 1;
    let flies = scene.dynamics.is_some();
    if !flies && !body.rigid && !supported && !driven && !clamped && !misspelt {
        let issue = Issue::value(key.clone(), format!("nothing holds the body `{name}`"));
        issues.push(
            issue
                .allowed("a [[support]], a [[drive]] or two contacts for each deformable body")
                .help("or inertia: [dynamics] and a density"),
        );
    }
    if body.rigid && !scene.contact.iter().any(|contact| contact.mortar.body == name) {
        let issue = Issue::value(key.clone(), format!("the rigid body `{name}` is the mortar side of no contact"));
        issues.push(issue.help("a rigid body acts through its contacts only: add one, or remove the body"));
    }
}

fn known_body(scene: &Scene, name: &str, key: KeyPath, issues: &mut Vec<Issue>) {
    if !scene.body.contains_key(name) {
        let names: Vec<&String> = scene.body.keys().collect();
        issues.push(Issue::value(key, format!("there is no body \"{name}\"")).known(name, &names));
    }
}

fn support_rules(scene: &Scene, support: &SupportSpec, key: &KeyPath, issues: &mut Vec<Issue>) {
    let at = &support.displacement;
    for (name, course) in [("x", &at.x), ("y", &at.y)] {
        issues.extend(course.as_ref().and_then(|course| course_rule(course, &key.at(name))));
    }
    if at.x.is_none() && at.y.is_none() {
        issues.push(Issue::value(key.clone(), "neither `x` nor `y` is given").allowed("`x`, `y` or both"));
    }
    if scene.body.get(&support.body).is_some_and(|body| body.rigid) {
        let issue = Issue::value(key.clone(), format!("`{}` is rigid: it stays where it is", support.body));
        issues.push(issue.help("remove the support, or move the body by a [[drive]]"));
    }
}

fn drive_rules(drive: &DriveSpec, key: &KeyPath, issues: &mut Vec<Issue>) {
    for (name, motion) in [("x", &drive.x), ("y", &drive.y)] {
        let (kind, course) = match motion {
            Some(Motion::Displacement(course)) => ("displacement", course),
            Some(Motion::Force(course)) => ("force", course),
            None => continue,
        };
        issues.extend(course_rule(course, &key.at(name).at(kind)));
    }
    if drive.x.is_none() && drive.y.is_none() {
        issues.push(Issue::value(key.clone(), "neither `x` nor `y` is given").allowed("`x`, `y` or both"));
    }
}

/// Times strictly increase, and each has a value.
fn course_rule(course: &Course, key: &KeyPath) -> Option<Issue> {
    let Course::Table(table) = course else { return None };
    if table.time.len() != table.value.len() {
        let message = format!("{} times but {} values", table.time.len(), table.value.len());
        return Some(Issue::value(key.at("value"), message).allowed("as many values as times"));
    }
    let k = table.time.windows(2).position(|pair| pair[1] <= pair[0])?;
    let message = format!("time {} follows {}", table.time[k + 1], table.time[k]);
    Some(Issue::value(key.at("time").at(k + 1), message).allowed("strictly increasing times"))
}

/// A component of an edge is prescribed once, by one support or one drive.
fn prescribed_twice(scene: &Scene, issues: &mut Vec<Issue>) {
    let mut seen: BTreeMap<(&str, &str, &str), KeyPath> = BTreeMap::new();
    let mut claim = |body, edge: Edge, component, key: KeyPath| {
        let place = (body, edge_name(edge), component);
        if let Some(first) = seen.get(&place) {
            let message =
                format!("`{component}` of the {} edge of `{body}` is already given by {first}", edge_name(edge));
            issues.push(Issue::value(key, message).allowed("each component of an edge supported or driven once"));
        } else {
            seen.insert(place, key);
        }
    };
    for (i, support) in scene.support.iter().enumerate() {
        let (key, at) = (KeyPath::of("support").at(i).at("displacement"), &support.displacement);
        for (name, _) in [("x", &at.x), ("y", &at.y)].into_iter().filter(|(_, course)| course.is_some()) {
            claim(&support.body, support.edge, name, key.at(name));
        }
    }
    for (i, drive) in scene.drive.iter().enumerate() {
        let key = KeyPath::of("drive").at(i);
        for (name, _) in [("x", &drive.x), ("y", &drive.y)].into_iter().filter(|(_, motion)| motion.is_some()) {
            claim(&drive.body, drive.edge, name, key.at(name));
        }
    }
}

/// Name of an edge as written in a scene.
pub(super) fn edge_name(edge: Edge) -> &'static str {
    match edge {
        Edge::Bottom => "bottom",
        Edge::Right => "right",
        Edge::Top => "top",
        Edge::Left => "left",
    }
}

fn contact_rules(scene: &Scene, contact: &ContactSpec, key: &KeyPath, issues: &mut Vec<Issue>) {
    let sides = [("nonmortar", &contact.nonmortar), ("mortar", &contact.mortar)];
    for (name, side) in sides {
        known_body(scene, &side.body, key.at(name).at("body"), issues);
    }
    let rigid = |name: &str| scene.body.get(name).is_some_and(|body| body.rigid);
    let (nonmortar, mortar) = (&contact.nonmortar.body, &contact.mortar.body);
    if nonmortar == mortar {
        let issue = Issue::value(key.at("mortar").at("body"), format!("`{mortar}` is in contact with itself"));
        issues.push(issue.allowed("two different bodies"));
    } else if rigid(nonmortar) {
        let both = if rigid(mortar) { "both sides are rigid" } else { "the nonmortar side is rigid" };
        let issue = Issue::value(key.at("nonmortar").at("body"), format!("`{nonmortar}`: {both}"));
        issues.push(issue.allowed("a deformable body: the nonmortar side carries the multipliers").help(
            if rigid(mortar) {
                "contact forces between two rigid bodies are undetermined: give one of them a material"
            } else {
                "exchange nonmortar and mortar"
            },
        ));
    }
    if let Err(error) = asperity_laws::parse(contact.law.clone()) {
        issues.push(law_issue(&error, key));
    }
}

/// What is wrong with the law of a contact; the keys of laws are dotted.
pub(super) fn law_issue(error: &LawError, contact: &KeyPath) -> Issue {
    let key = error.key().split('.').fold(contact.at("law"), |path, key| path.at(key));
    Issue::value(key, error.to_string())
}
