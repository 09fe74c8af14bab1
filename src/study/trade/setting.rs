//! One setting of the numerical choices, and what it changes in the scene.

use std::collections::BTreeSet;

use toml::Value;

use super::Trade;
use crate::geometry::{BasisSpec, Edge};
use crate::output::tables::number;
use crate::scene::{BodySpec, Integration, KeyPath, MaterialSpec, Numerics, Projection, Scene, Sites, Solver};
use crate::solve::Strategy;
use crate::study::axis::plain;

/// Least nominal steps of a setting.
const FEWEST_STEPS: usize = 2;

/// Most integration points of a scene.
const MOST_POINTS: usize = 32;

/// Numerical choices relative to those of the scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// Basis of all deformable bodies; `None`: as in the scene.
    pub basis: Option<BasisSpec>,
    /// Factor on all `elements`, in half octaves: `2^(elements/2)`.
    pub elements: i32,
    /// Factor on the grading towards the contact edge, in octaves.
    pub grading: i32,
    /// Factor on the nominal steps, in octaves.
    pub steps: i32,
    /// Everything else that differs from the scene.
    pub choices: BTreeSet<Choice>,
}

/// A choice that is made otherwise than in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Choice {
    /// `nodal` instead of `quadrature`, or the reverse.
    Sites,
    /// Half the augmentation (`quadrature` sites only: others do not depend on it).
    SmallerR,
    /// Twice the augmentation.
    LargerR,
    /// Multipliers of another stable degree.
    Multiplier,
    /// `ray` instead of `closest`, or the reverse.
    Projection,
    /// `segment` instead of `element`, or the reverse.
    Integration,
    /// Two integration points on each element.
    TwoPoints,
    /// Twice as many integration points as by default.
    TwicePoints,
    /// `sparse-lu` instead of `condensed`, or the reverse: time only.
    Solver,
    /// `interface` instead of `monolithic`, or the reverse: time only.
    Strategy,
    /// Linear elasticity instead of neo-Hookean, or the reverse: another model.
    Material,
}

impl Choice {
    /// All of them, in the order in which they are tried.
    pub const ALL: [Self; 11] = [
        Self::Sites,
        Self::Integration,
        Self::Multiplier,
        Self::TwoPoints,
        Self::SmallerR,
        Self::LargerR,
        Self::Projection,
        Self::TwicePoints,
        Self::Solver,
        Self::Strategy,
        Self::Material,
    ];
}

/// A value that is put into the scene.
pub type Change = (KeyPath, Value);

impl Setting {
    /// What it changes in a scene; `None` where it cannot be had there or would change nothing that it names.
    pub fn changes(&self, trade: &Trade) -> Option<Vec<Change>> {
        let (scene, mut changes) = (&trade.scene, vec![]);
        for (name, body) in &scene.body {
            let key = KeyPath::of("body").at(name);
            if let Some(basis) = self.basis.filter(|_| !body.rigid) {
                changes.push((key.at("basis"), Value::try_from(basis).ok()?));
            }
            if self.elements != 0 {
                let counts = body.elements.map(|count| Value::Integer(scaled(count, self.elements) as i64));
                changes.push((key.at("elements"), Value::Array(counts.to_vec())));
            }
        }
        if self.grading != 0 {
            changes.extend(self.graded(scene)?);
        }
        if self.steps != 0 {
            changes.push((KeyPath::of("time").at("steps"), Value::Integer(self.step_count(scene)? as i64)));
        }
        for choice in &self.choices {
            changes.extend(self.chosen(*choice, trade)?);
        }
        Some(changes)
    }

    /// Nominal steps; `None` if too few.
    pub fn step_count(&self, scene: &Scene) -> Option<usize> {
        let steps = (scene.time.steps as f64 * f64::from(self.steps).exp2()).round() as usize;
        (steps >= FEWEST_STEPS.min(scene.time.steps)).then_some(steps)
    }

    /// Basis of the deformable bodies: the setting's, or that of the first nonmortar body.
    pub fn basis_in(&self, scene: &Scene) -> BasisSpec {
        let first = || scene.contact.first().and_then(|contact| scene.body.get(&contact.nonmortar.body));
        self.basis.or_else(|| first().map(|body| body.basis)).unwrap_or(BasisSpec::Nurbs { degree: 2 })
    }

    /// In words: basis, size, steps, and what else differs from the scene.
    pub fn words(&self, trade: &Trade) -> String {
        let scene = &trade.scene;
        let factor = |octaves: f64| number((100.0 * octaves.exp2()).round() / 100.0);
        let elements = format!("elements x {}", factor(0.5 * f64::from(self.elements)));
        let mut said = vec![self.basis_words(scene), elements];
        said.extend(self.step_count(scene).map(|steps| format!("{steps} steps")));
        if self.grading != 0 {
            said.push(format!("grading x {}", factor(f64::from(self.grading))));
        }
        said.extend(self.choice_words(trade));
        said.join(", ")
    }

    /// The basis in words.
    pub fn basis_words(&self, scene: &Scene) -> String {
        match self.basis_in(scene) {
            BasisSpec::Nurbs { degree } => format!("nurbs {degree}"),
            BasisSpec::Lagrange { degree } => format!("lagrange {degree}"),
        }
    }

    /// What is chosen otherwise than in the scene: keys with their values, each once.
    pub fn choice_words(&self, trade: &Trade) -> Vec<String> {
        let changes = self.choices.iter().filter_map(|choice| self.chosen(*choice, trade)).flatten();
        let mut said: Vec<String> = vec![];
        for (path, value) in changes {
            let text = format!("{} {}", path.segments().last().map_or("", String::as_str), plain(&value));
            if !said.contains(&text) {
                said.push(text);
            }
        }
        said
    }

    /// About the number of displacement unknowns.
    pub fn unknowns(&self, scene: &Scene) -> f64 {
        let bodies = scene.body.values().filter(|body| !body.rigid);
        let functions = |count: usize, basis: BasisSpec| match basis {
            BasisSpec::Nurbs { degree } => scaled(count, self.elements) + degree,
            BasisSpec::Lagrange { degree } => degree * scaled(count, self.elements) + 1,
        };
        let points = |body: &BodySpec| {
            let [x, y] = body.elements.map(|count| functions(count, self.basis.unwrap_or(body.basis)));
            x * y
        };
        2.0 * bodies.map(points).sum::<usize>() as f64
    }

    /// Grading towards the contact edge of each deformable body that has one such edge and no grading towards another.
    fn graded(&self, scene: &Scene) -> Option<Vec<Change>> {
        let mut changes = vec![];
        for (name, body) in scene.body.iter().filter(|(_, body)| !body.rigid) {
            let sides = scene.contact.iter().flat_map(|contact| [&contact.nonmortar, &contact.mortar]);
            let edges: Vec<Edge> = sides.filter(|side| side.body == *name).map(|side| side.edge).collect();
            let grading = body.grading.clone().unwrap_or_default();
            let free = match grading.toward {
                Some(toward) => edges.iter().all(|edge| *edge == toward),
                None => grading.along.is_none() && edges.windows(2).all(|pair| pair[0] == pair[1]),
            };
            let Some(edge) = edges.first().filter(|_| free) else { continue };
            let ratio = grading.ratio.unwrap_or(1.0) * f64::from(self.grading).exp2();
            if ratio < 1.0 {
                continue;
            }
            let key = KeyPath::of("body").at(name).at("grading");
            changes.push((key.at("toward"), Value::try_from(edge).ok()?));
            changes.push((key.at("ratio"), Value::Float(ratio)));
        }
        Some(changes).filter(|changes| !changes.is_empty())
    }

    /// What one choice changes: a key of all contacts, of the solution, or of all materials.
    fn chosen(&self, choice: Choice, trade: &Trade) -> Option<Vec<Change>> {
        let scene = &trade.scene;
        let everywhere = |key: &str, value: Value| {
            let path = |k: usize| KeyPath::of("contact").at(k).at("numerics").at(key);
            Some((0..scene.contact.len()).map(|k| (path(k), value.clone())).collect::<Vec<_>>())
        };
        let solution = |key: &str, value: &str| Some(vec![(KeyPath::of("solution").at(key), Value::from(value))]);
        let numerics = &scene.contact.first()?.numerics;
        match choice {
            Choice::Sites => everywhere("sites", Value::from(other_sites(numerics))),
            Choice::SmallerR | Choice::LargerR => {
                let factor = if choice == Choice::SmallerR { 0.5 } else { 2.0 };
                (self.quadrature(numerics)).then(|| everywhere("r", Value::Float(factor * numerics.r)))?
            }
            Choice::Multiplier => {
                everywhere("multiplier_degree", Value::Integer(self.other_multiplier(numerics, scene)? as i64))
            }
            Choice::Projection => everywhere("projection", Value::from(self.other_projection(numerics, trade))),
            Choice::Integration => everywhere("integration", Value::from(other_integration(numerics))),
            Choice::TwoPoints => everywhere("points", Value::Integer(2)),
            Choice::TwicePoints => {
                let quadratic = self.basis_in(scene) == BasisSpec::Lagrange { degree: 2 };
                let chosen = (self.basis_in(scene).degree() + 1).max(3) * if quadratic { 2 } else { 1 };
                let usual = numerics.points.unwrap_or(chosen);
                everywhere("points", Value::Integer((2 * usual).min(MOST_POINTS) as i64))
            }
            Choice::Solver if scene.solution.solver == Solver::Condensed => solution("solver", "sparse-lu"),
            Choice::Solver => solution("solver", "condensed"),
            Choice::Strategy if scene.solution.strategy == Strategy::Monolithic => solution("strategy", "interface"),
            Choice::Strategy => solution("strategy", "monolithic"),
            Choice::Material => Some(scene.material.iter().map(other_material).collect()),
        }
    }

    fn quadrature(&self, numerics: &Numerics) -> bool {
        (numerics.sites == Sites::Quadrature) != self.choices.contains(&Choice::Sites)
    }

    /// Whether the curves of the mortar side have corners.
    fn cornered(&self, trade: &Trade) -> bool {
        let scene = &trade.scene;
        let body = scene.contact.first().and_then(|contact| scene.body.get(&contact.mortar.body));
        let basis = match body {
            Some(body) if body.rigid => body.basis,
            _ => self.basis_in(scene),
        };
        trade.cornered || !matches!(basis, BasisSpec::Nurbs { degree: 2.. })
    }

    fn other_projection(&self, numerics: &Numerics, trade: &Trade) -> &'static str {
        match numerics.projection {
            Projection::Ray => "closest",
            Projection::Auto if self.cornered(trade) => "closest",
            Projection::Closest | Projection::Auto => "ray",
        }
    }

    /// A stable degree of multipliers that the program would not choose: the next lower one; of quadratic Lagrange elements, which
    /// choose 1 unless they are cut into segments, the other of 1 and 2.
    fn other_multiplier(&self, numerics: &Numerics, scene: &Scene) -> Option<usize> {
        let segments = (numerics.integration == Integration::Segment) != self.choices.contains(&Choice::Integration);
        match self.basis_in(scene) {
            _ if numerics.multiplier_degree.is_some() => None,
            BasisSpec::Lagrange { degree: 2 } => Some(if segments { 1 } else { 2 }),
            basis => basis.degree().checked_sub(2),
        }
    }
}

fn other_integration(numerics: &Numerics) -> &'static str {
    if numerics.integration == Integration::Segment { "element" } else { "segment" }
}

/// A number of elements under a factor of so many half octaves, at least 1.
fn scaled(count: usize, half_octaves: i32) -> usize {
    ((count as f64 * (0.5 * f64::from(half_octaves)).exp2()).round() as usize).max(1)
}

fn other_sites(numerics: &Numerics) -> &'static str {
    if numerics.sites == Sites::Quadrature { "nodal" } else { "quadrature" }
}

fn other_material((name, material): (&String, &MaterialSpec)) -> Change {
    let other = match material {
        MaterialSpec::NeoHookean { .. } => "linear-elastic",
        MaterialSpec::LinearElastic { .. } | MaterialSpec::SaintVenantKirchhoff { .. } => "neo-hookean",
    };
    (KeyPath::of("material").at(name).at("type"), Value::from(other))
}
