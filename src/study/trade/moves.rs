//! From one setting to its neighbours: one choice changed at a time.

use super::setting::{Choice, Setting};
use crate::geometry::BasisSpec;

/// Bases that are compared.
pub const BASES: [BasisSpec; 6] = [
    BasisSpec::Nurbs { degree: 1 },
    BasisSpec::Nurbs { degree: 2 },
    BasisSpec::Nurbs { degree: 3 },
    BasisSpec::Nurbs { degree: 4 },
    BasisSpec::Lagrange { degree: 1 },
    BasisSpec::Lagrange { degree: 2 },
];

/// Largest factor on the nominal steps of a scene, in octaves.
pub(super) const MOST_STEPS: i32 = 1;
/// Factors on the nominal steps of a scene, in octaves.
const STEPS: [i32; 2] = [-1, MOST_STEPS];
/// Factors on the grading of a scene, in octaves.
const GRADING: [i32; 2] = [-2, 3];
/// Failures after which a kind of change is not tried any more.
const STRIKES: u32 = 2;

/// One kind of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Move {
    /// More or fewer elements, in half octaves.
    Elements(i32),
    /// More or fewer steps, in octaves.
    Steps(i32),
    /// Steeper or flatter grading, in octaves.
    Grading(i32),
    /// Another basis.
    Basis(BasisSpec),
    /// Something else chosen otherwise, or again as in the scene.
    Toggle(Choice),
}

impl Move {
    /// All moves, in the order in which they are tried.
    pub fn all() -> Vec<Self> {
        let mut moves =
            vec![Self::Elements(-1), Self::Elements(1), Self::Steps(-1), Self::Grading(1), Self::Grading(-1)];
        moves.extend(Choice::ALL.into_iter().filter(|choice| *choice != Choice::Material).map(Self::Toggle));
        moves.push(Self::Steps(1));
        moves.extend(BASES.map(Self::Basis));
        moves
    }

    /// The neighbour of a setting, with `elements` within the range that can be measured.
    pub fn from(self, setting: &Setting, elements: [i32; 2]) -> Option<Setting> {
        let mut next = setting.clone();
        match self {
            Self::Elements(change) => next.elements += change,
            Self::Steps(change) => next.steps += change,
            Self::Grading(change) => next.grading += change,
            Self::Basis(basis) => next.basis = Some(basis),
            Self::Toggle(choice) => {
                let there = next.choices.remove(&choice);
                let rival = match choice {
                    Choice::SmallerR => Some(Choice::LargerR),
                    Choice::LargerR => Some(Choice::SmallerR),
                    Choice::TwoPoints => Some(Choice::TwicePoints),
                    Choice::TwicePoints => Some(Choice::TwoPoints),
                    _ => None,
                };
                if !there {
                    next.choices.insert(choice);
                    rival.map(|rival| next.choices.remove(&rival));
                }
            }
        }
        let inside = |value: i32, [low, high]: [i32; 2]| (low..=high).contains(&value);
        let known = inside(next.elements, elements) && inside(next.steps, STEPS) && inside(next.grading, GRADING);
        (known && next != *setting).then_some(next)
    }
}

/// Which moves have been of use so far, apart for each half decade of the error they started from: one that failed twice in a row is
/// given up there, and tried once in each of the others. Sizes and steps are always tried.
pub(super) struct Experience {
    moves: Vec<Tried>,
    /// Half decades with the CPU time in seconds that moves from there took.
    spent: Vec<(i32, f64)>,
}

/// How often a move failed since it was last of use.
struct Tried {
    step: Move,
    strikes: u32,
    /// Half decades in which it failed, with the number of failures.
    local: Vec<(i32, u32)>,
}

impl Experience {
    /// Nothing tried yet.
    pub fn new() -> Self {
        let tried = |step| Tried { step, strikes: 0, local: vec![] };
        Self { moves: Move::all().into_iter().map(tried).collect(), spent: vec![] }
    }

    /// Moves that are still worth trying from a setting of this error.
    pub fn hopeful(&self, error: f64) -> impl Iterator<Item = Move> {
        let here = half_decade(error);
        let hopeful = move |tried: &&Tried| {
            let local = tried.local.iter().find(|(place, _)| *place == here).map_or(0, |(_, strikes)| *strikes);
            let allowed = if tried.strikes < STRIKES { STRIKES } else { 1 };
            matches!(tried.step, Move::Elements(_) | Move::Steps(_)) || local < allowed
        };
        self.moves.iter().filter(hopeful).map(|tried| tried.step)
    }

    /// CPU time in seconds that moves from settings of about this error took so far.
    pub fn spent(&self, error: f64) -> f64 {
        let here = half_decade(error);
        self.spent.iter().filter(|(place, _)| *place == here).map(|(_, spent)| spent).sum()
    }

    /// Notes how a move from a setting of this error went, and what it took.
    pub fn learn(&mut self, tried: Move, error: f64, useful: bool, cpu_s: f64) {
        let here = half_decade(error);
        self.spent.push((here, cpu_s));
        for tried in self.moves.iter_mut().filter(|known| known.step == tried) {
            tried.strikes = if useful { 0 } else { tried.strikes + 1 };
            match tried.local.iter_mut().find(|(place, _)| *place == here) {
                Some((_, strikes)) => *strikes = if useful { 0 } else { *strikes + 1 },
                None => tried.local.push((here, u32::from(!useful))),
            }
        }
    }
}

fn half_decade(error: f64) -> i32 {
    (2.0 * error.log10()).floor() as i32
}
