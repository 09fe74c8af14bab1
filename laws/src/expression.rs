//! Formulas in text, evaluated on dual numbers: the language of the law `type = "expression"`.
//!
//! Numbers, symbols, `pi`, `+ - * / ^` (also `**`), parentheses, and the functions `exp ln log10 sqrt abs sign tanh sinh cosh asinh atan
//! sin cos min max`. Every operation is one of [`crate::dual`], so the derivative of a formula is exact, with the same ties.
//!
//! Why no library: `exmex` 0.21 evaluates custom scalars, but its errors are texts without a position, and its evaluation can not be
//! watched, so that neither a misprint nor the part of a formula that divided by zero could be shown to the user.

mod curve;
mod functions;
mod parse;
mod program;

pub use curve::Curve;
pub use parse::compile;
pub use program::Program;

use crate::registry::nearest;
use std::{collections::BTreeMap, f64::consts::PI, sync::Arc};

/// What a name in a formula stands for.
#[derive(Clone, Debug)]
pub enum Symbol {
    /// A number that is fixed before evaluation.
    Number(f64),
    /// Entry of the argument of [`Program::value`].
    Slot(usize),
    /// A curve over such an entry, or over its magnitude.
    Curve {
        /// Number of the entry.
        slot: usize,
        /// Whether its sign is dropped.
        magnitude: bool,
        /// The curve.
        curve: Arc<Curve>,
    },
}

/// All names that a formula may use, besides the functions.
#[derive(Clone, Debug)]
pub struct Symbols(BTreeMap<String, Symbol>);

impl Default for Symbols {
    /// The number `pi`.
    fn default() -> Self {
        Self(BTreeMap::from([("pi".into(), Symbol::Number(PI))]))
    }
}

impl Symbols {
    /// Adds a name.
    ///
    /// # Errors
    /// If it is no identifier, or taken.
    pub fn add(&mut self, name: &str, symbol: Symbol) -> Result<(), String> {
        let letter = |c: char| c.is_alphabetic() || c == '_';
        if !name.starts_with(letter) || !name.chars().all(|c| letter(c) || c.is_alphanumeric()) {
            return Err(format!("`{name}` is no name: letters, digits and `_`, a letter first"));
        }
        if self.0.contains_key(name) || functions::names().any(|function| function == name) {
            return Err(format!("the name `{name}` is taken"));
        }
        self.0.insert(name.into(), symbol);
        Ok(())
    }

    fn find(&self, name: &str) -> Option<Symbol> {
        self.0.get(name).cloned()
    }

    /// Message for a name that stands for nothing.
    fn unknown(&self, name: &str) -> String {
        let symbols: Vec<&str> = self.0.keys().map(String::as_str).collect();
        let functions: Vec<&str> = functions::names().collect();
        let words: Vec<&str> = symbols.iter().chain(&functions).copied().filter(|word| word.len() > 1).collect();
        let hint = nearest(name, &words);
        let hint = hint.map_or(String::new(), |n| format!(" (did you mean `{n}`?)"));
        format!("unknown symbol `{name}`{hint}; known: {}; functions: {}", symbols.join(", "), functions.join(", "))
    }
}
