//! A compiled formula: a flat list of instructions on a stack of fixed size.

use super::{
    curve::Curve,
    functions::{Binary, Unary, power_by, power_of},
};
use crate::dual::{Dual, constant, derivatives};
use std::{ops::Range, sync::Arc};

/// Most operands that may wait at a time; `a + b*(c + d*e)` has five.
pub(super) const DEPTH: usize = 16;

/// One step of a program: takes its operands off the stack and puts its result there.
#[derive(Clone, Debug)]
pub(super) enum Op {
    Constant(f64),
    Load(usize),
    Unary(Unary),
    Binary(Binary),
    Plus,
    Minus,
    Times,
    Over,
    /// A power whose exponent is no number.
    Power,
    PowerBy(f64),
    Curve(Arc<Curve>),
}

impl Op {
    /// The result for operands at the end of `stack`.
    #[inline]
    pub(super) fn apply(&self, stack: &[Dual], slots: &[Dual]) -> Dual {
        let right = || stack[stack.len() - 1];
        let left = || stack[stack.len() - 2];
        match self {
            Self::Constant(x) => constant(*x),
            Self::Load(slot) => slots[*slot],
            Self::Unary(f) => f(right()),
            Self::PowerBy(n) => power_by(right(), *n),
            Self::Curve(curve) => curve.value(right()),
            Self::Plus => left() + right(),
            Self::Minus => left() - right(),
            Self::Times => left() * right(),
            Self::Over => left() / right(),
            Self::Binary(f) => f(left(), right()),
            Self::Power => power_of(left(), right()),
        }
    }

    /// Number of values taken off the stack.
    pub(super) fn operands(&self) -> usize {
        match self {
            Self::Constant(_) | Self::Load(_) => 0,
            Self::Unary(_) | Self::PowerBy(_) | Self::Curve(_) => 1,
            Self::Binary(_) | Self::Plus | Self::Minus | Self::Times | Self::Over | Self::Power => 2,
        }
    }
}

/// A step and the part of the text that it computes.
#[derive(Clone, Debug)]
pub(super) struct Instruction {
    pub(super) op: Op,
    pub(super) span: Range<usize>,
}

/// A formula ready for evaluation. Evaluation takes no memory.
#[derive(Clone, Debug)]
pub struct Program {
    text: String,
    code: Vec<Instruction>,
}

impl Program {
    pub(super) fn new(text: &str, code: Vec<Instruction>) -> Self {
        Self { text: text.into(), code }
    }

    /// Value and derivatives; `slots` holds the symbols by number.
    pub fn value(&self, slots: &[Dual]) -> Dual {
        self.run(slots, |_, _| ())
    }

    /// Whether the symbol of this number occurs.
    pub fn uses(&self, slot: usize) -> bool {
        self.code.iter().any(|instruction| matches!(instruction.op, Op::Load(k) if k == slot))
    }

    /// The first sub-expression that is not finite, or whose derivative is not, with a caret below it.
    pub fn fault(&self, slots: &[Dual]) -> Option<String> {
        let mut found = None;
        self.run(slots, |instruction, result| {
            let (value, slopes) = derivatives(result);
            let wrong = match value.is_finite() {
                false => format!("is {value}"),
                true if slopes.iter().any(|slope| !slope.is_finite()) => format!("is {value} with an infinite slope"),
                true => return,
            };
            found.get_or_insert_with(|| {
                let part = &self.text[instruction.span.clone()];
                format!("`{part}` {wrong}, {}", pointed(&self.text, &instruction.span))
            });
        });
        found
    }

    fn run(&self, slots: &[Dual], mut see: impl FnMut(&Instruction, &Dual)) -> Dual {
        let mut stack = [constant(0.0); DEPTH];
        let mut top = 0;
        for instruction in &self.code {
            let result = instruction.op.apply(&stack[..top], slots);
            see(instruction, &result);
            top -= instruction.op.operands();
            stack[top] = result;
            top += 1;
        }
        stack[0]
    }
}

/// `character 5:`, the line and carets below the part of it, each on a line of its own.
pub(super) fn pointed(text: &str, part: &Range<usize>) -> String {
    let begin = text[..part.start].rfind('\n').map_or(0, |k| k + 1);
    let end = text[part.start..].find('\n').map_or(text.len(), |k| part.start + k);
    let column = text[begin..part.start].chars().count() + 1;
    let width = text[part.start..part.end.clamp(part.start, end)].chars().count().max(1);
    let line = text[..begin].matches('\n').count() + 1;
    let place =
        if text.contains('\n') { format!("line {line}, character {column}") } else { format!("character {column}") };
    let shown = text[begin..end].replace('\t', " ");
    format!("{place}:\n    {shown}\n    {:>pad$}{}", "", "^".repeat(width), pad = column - 1)
}
