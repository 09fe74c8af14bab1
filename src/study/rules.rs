//! Rules that join several values of a study. Ranges of single values are in `spec`.

use std::collections::BTreeMap;

use super::axis::Axis;
use super::formula::Formula;
use super::spec::{FigureSpec, StudySpec, Take};
use crate::scene::{Focus, Issue, KeyPath, SceneError};

/// More points than this are taken for a slip of the pen.
const MOST_POINTS: usize = 1_000_000;
/// Columns of the table that every study has.
pub(super) const FIXED: [&str; 5] = ["index", "status", "reason", "folder", "wall_s"];

/// The axes and formulas of a study, or everything that is wrong with it as a whole.
pub(super) fn check(spec: &StudySpec) -> Result<(Vec<Axis>, Vec<Formula>), SceneError> {
    let mut issues = vec![];
    let mut axes = vec![];
    for (k, axis) in spec.axis.iter().enumerate() {
        match Axis::new(axis, &KeyPath::of("axis").at(k)) {
            Ok(axis) => axes.push(axis),
            Err(more) => issues.extend(more),
        }
    }
    if !issues.is_empty() {
        return Err(SceneError(issues));
    }
    let mut formulas = vec![];
    for (k, text) in spec.formula.iter().enumerate() {
        match Formula::new(text, KeyPath::of("formula").at(k), &axes) {
            Ok(formula) => formulas.push(formula),
            Err(issue) => issues.push(issue),
        }
    }
    if issues.is_empty() {
        idle(&axes, &formulas, &mut issues);
    }
    size(&axes, &mut issues);
    names(spec, &axes, &mut issues);
    set_twice(&axes, &formulas, &mut issues);
    quantities(spec, &mut issues);
    for (k, figure) in spec.figure.iter().enumerate() {
        figure_names(spec, figure, &axes, &KeyPath::of("figure").at(k), &mut issues);
    }
    if issues.is_empty() { Ok((axes, formulas)) } else { Err(SceneError(issues)) }
}

/// The same issues, all of them with a value of the study.
pub(super) fn at_key(error: SceneError, key: &KeyPath) -> SceneError {
    let moved = |issue: Issue| Issue { key: key.clone(), focus: Focus::Value, place: None, ..issue };
    SceneError(error.0.into_iter().map(moved).collect())
}

fn idle(axes: &[Axis], formulas: &[Formula], issues: &mut Vec<Issue>) {
    let used = |k: usize| !axes[k].effects.is_empty() || formulas.iter().any(|formula| formula.uses(k));
    for k in (0..axes.len()).filter(|k| !used(*k)) {
        let message = format!("the axis `{}` changes nothing", axes[k].name);
        let issue = Issue::value(KeyPath::of("axis").at(k), message);
        issues.push(issue.allowed("a `path` or a `zip`, or a [formula] that uses its name"));
    }
}

fn size(axes: &[Axis], issues: &mut Vec<Issue>) {
    let count = axes.iter().fold(1usize, |count, axis| count.saturating_mul(axis.values.len()));
    if count > MOST_POINTS {
        let issue = Issue::value(KeyPath::of("axis"), format!("{count} points are too many"));
        issues.push(issue.allowed(format!("at most {MOST_POINTS}")));
    }
}

/// Columns of the table have names of their own.
fn names(spec: &StudySpec, axes: &[Axis], issues: &mut Vec<Issue>) {
    let mut seen: BTreeMap<&str, String> = FIXED.iter().map(|name| (*name, "the table itself".to_owned())).collect();
    let axes = axes.iter().enumerate().map(|(k, axis)| (axis.name.as_str(), KeyPath::of("axis").at(k)));
    let quantities = spec.quantity.iter().enumerate().map(|(k, q)| (q.name.as_str(), KeyPath::of("quantity").at(k)));
    for (name, key) in axes.chain(quantities) {
        let broken = name.is_empty() || name.contains(|c: char| c.is_control() || c == ',' || c == '"');
        if let Some(first) = seen.get(name) {
            let message = format!("the name `{name}` is taken by {first}");
            issues.push(Issue::value(key.at("name"), message).allowed("a name of its own for each axis and quantity"));
        } else if broken {
            let issue = Issue::value(key.at("name"), format!("{name:?} cannot head a column"));
            issues.push(issue.allowed("text without commas, quotes and line ends"));
        } else {
            seen.insert(name, key.to_string());
        }
    }
}

/// A key of the scene is set once.
fn set_twice(axes: &[Axis], formulas: &[Formula], issues: &mut Vec<Issue>) {
    let mut seen: BTreeMap<&KeyPath, &KeyPath> = BTreeMap::new();
    let effects = axes.iter().flat_map(|axis| &axis.effects).map(|effect| (&effect.path, &effect.origin));
    for (path, origin) in effects.chain(formulas.iter().map(|formula| (&formula.path, &formula.origin))) {
        if let Some(first) = seen.insert(path, origin) {
            let message = format!("`{path}` is already given by {first}");
            issues.push(Issue::value(origin.clone(), message).allowed("each key of the scene once"));
        }
    }
}

fn quantities(spec: &StudySpec, issues: &mut Vec<Issue>) {
    for (k, quantity) in spec.quantity.iter().enumerate() {
        let key = KeyPath::of("quantity").at(k);
        if quantity.weight.is_some() && quantity.take != Take::Mean {
            let issue = Issue::key(key.at("weight"), "only a mean has a `weight`");
            issues.push(issue.help("remove the key, or take = \"mean\""));
        }
        for (column, [low, high]) in &quantity.within {
            if low > high {
                let issue = Issue::value(key.at("within").at(column), format!("{low} is above {high}"));
                issues.push(issue.allowed("[low, high]"));
            }
        }
    }
}

fn figure_names(spec: &StudySpec, figure: &FigureSpec, axes: &[Axis], key: &KeyPath, issues: &mut Vec<Issue>) {
    let quantities: Vec<&String> = spec.quantity.iter().map(|quantity| &quantity.name).collect();
    let names: Vec<&String> = axes.iter().map(|axis| &axis.name).collect();
    if !quantities.contains(&&figure.quantity) {
        let issue = Issue::value(key.at("quantity"), format!("there is no quantity \"{}\"", figure.quantity));
        issues.push(issue.known(&figure.quantity, &quantities));
    }
    for (field, name) in [("over", &figure.over), ("lines", &figure.lines)] {
        let Some(name) = name else { continue };
        if !names.contains(&name) {
            issues.push(Issue::value(key.at(field), format!("there is no axis \"{name}\"")).known(name, &names));
        }
    }
    let of = |name: &Option<String>| name.as_ref().and_then(|name| axes.iter().find(|axis| axis.name == *name));
    if of(&figure.over).is_some_and(|axis| axis.numbers().is_none()) {
        let issue = Issue::value(key.at("over"), "the values of this axis are no numbers");
        issues.push(issue.allowed("an axis of numbers"));
    }
    if figure.over.is_some() && figure.over == figure.lines {
        issues.push(Issue::value(key.at("lines"), "the figure is drawn over this axis").allowed("another axis"));
    }
}
