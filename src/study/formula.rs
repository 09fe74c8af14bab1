//! Values of the scene that follow from the axes: `PATH=FORMULA`.

use crate::laws::dual::constant;
use crate::laws::expression::{Program, Symbol, Symbols, compile};
use crate::scene::{Issue, KeyPath};

use super::axis::{Axis, not_a_key, rounded};

/// A key of the scene that is computed.
#[derive(Clone, Debug)]
pub(super) struct Formula {
    /// Key of the scene.
    pub path: KeyPath,
    /// Where it stands in the study.
    pub origin: KeyPath,
    program: Program,
}

impl Formula {
    /// Compiles `PATH=FORMULA` that stands at `key`; axes of numbers are its symbols.
    pub fn new(text: &str, key: KeyPath, axes: &[Axis]) -> Result<Self, Issue> {
        let Some((path, formula)) = text.split_once('=') else {
            return Err(Issue::value(key, format!("{text:?} has no `=`")).allowed("PATH=FORMULA"));
        };
        let path = KeyPath::parse(path).ok_or_else(|| not_a_key(path, key.clone()))?;
        let mut symbols = Symbols::default();
        for (slot, axis) in axes.iter().enumerate().filter(|(_, axis)| axis.numbers().is_some()) {
            // a name that is no symbol is a dotted key: nothing a formula could mean
            let _ = symbols.add(&axis.name, Symbol::Slot(slot));
        }
        match compile(formula.trim(), &symbols) {
            Ok(program) => Ok(Self { path, origin: key, program }),
            Err(message) => Err(Issue::value(key, message).allowed("PATH=FORMULA in the names of axes of numbers")),
        }
    }

    /// Whether the axis of this number occurs.
    pub fn uses(&self, axis: usize) -> bool {
        self.program.uses(axis)
    }

    /// The value where the axes have these numbers (0 for axes of anything else).
    pub fn value(&self, numbers: &[f64]) -> f64 {
        let slots: Vec<_> = numbers.iter().map(|number| constant(*number)).collect();
        rounded(self.program.value(&slots).re)
    }
}
