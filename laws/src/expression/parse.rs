//! From text to program by precedence climbing (V. R. Pratt, Top down operator precedence, POPL 1973).
//!
//! From weak to strong: `+ -`, `* /`, sign, `^` (or `**`, right to left): `-x^2` is `-(x^2)` and `2^3^2` is `2^9`.

use super::{
    Symbol, Symbols,
    functions::{UNARY, VARIADIC},
    program::{DEPTH, Instruction, Op, Program, pointed},
};
use crate::dual::{abs, constant};
use std::ops::Range;

/// Binding strength of a sign, and of what may follow it.
const SIGN: u8 = 5;
/// Most parentheses and signs within each other.
const NESTING: usize = 64;

/// Compiles a formula.
///
/// # Errors
/// What is wrong, with a caret below the character.
pub fn compile(text: &str, symbols: &Symbols) -> Result<Program, String> {
    let mut parser = Parser { text, end: 0, symbols, code: vec![], height: 0, nesting: 0 };
    let parsed = parser.expression(0).and_then(|_| match parser.peek() {
        None => Ok(()),
        Some(')') => parser.wrong("this `)` closes nothing", 1),
        Some(c) if c.is_alphanumeric() || "(._".contains(c) => parser.wrong("an operator is missing before this", 1),
        Some(c) => parser.wrong(&format!("unexpected `{c}`"), c.len_utf8()),
    });
    parsed.map_err(|Wrong { message, at }| format!("{message}, {}", pointed(text, &at)))?;
    Ok(Program::new(text, parser.code))
}

struct Wrong {
    message: String,
    at: Range<usize>,
}

struct Parser<'a> {
    text: &'a str,
    /// End of what has been read.
    end: usize,
    symbols: &'a Symbols,
    code: Vec<Instruction>,
    height: usize,
    nesting: usize,
}

impl<'a> Parser<'a> {
    /// Reads operators that bind at least as strongly as `least`; returns where the expression starts.
    fn expression(&mut self, least: u8) -> Result<usize, Wrong> {
        self.nesting += 1;
        if self.nesting > NESTING {
            return self.wrong("nested too deeply", 1);
        }
        let start = self.operand()?;
        while let Some((length, _, right, op)) = self.operator().filter(|found| found.1 >= least) {
            self.skip(length);
            self.expression(right)?;
            self.emit(op, start..self.end)?;
        }
        self.nesting -= 1;
        Ok(start)
    }

    /// Length, strength to the left, strength to the right, and meaning of the operator ahead.
    fn operator(&mut self) -> Option<(usize, u8, u8, Op)> {
        Some(match self.peek()? {
            '+' => (1, 1, 2, Op::Plus),
            '-' => (1, 1, 2, Op::Minus),
            '*' if self.rest().starts_with("**") => (2, 8, 7, Op::Power),
            '*' => (1, 3, 4, Op::Times),
            '/' => (1, 3, 4, Op::Over),
            '^' => (1, 8, 7, Op::Power),
            _ => return None,
        })
    }

    fn operand(&mut self) -> Result<usize, Wrong> {
        let first = self.peek();
        let start = self.start();
        match first {
            Some('0'..='9' | '.') => self.number(start)?,
            Some(c) if c.is_alphabetic() || c == '_' => self.name(start)?,
            Some('(') => self.parenthesis(start)?,
            Some('-') => {
                self.skip(1);
                self.expression(SIGN)?;
                self.emit(Op::Unary(|x| -x), start..self.end)?;
            }
            Some('+') => {
                self.skip(1);
                self.expression(SIGN)?;
            }
            _ => return self.wrong("a number, a symbol or `(` is expected here", 1),
        }
        Ok(start)
    }

    fn number(&mut self, start: usize) -> Result<(), Wrong> {
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let mut length = digits(self.rest());
        if self.rest()[length..].starts_with('.') {
            length += 1 + digits(&self.rest()[length + 1..]);
        }
        let tail = &self.rest()[length..];
        if let Some(exponent) = tail.strip_prefix(['e', 'E']) {
            let sign = usize::from(exponent.starts_with(['+', '-']));
            let count = digits(&exponent[sign..]);
            length += if count > 0 { 1 + sign + count } else { 0 };
        }
        let value = self.rest()[..length].parse::<f64>().ok().filter(|x| x.is_finite());
        let Some(value) = value else { return self.wrong("not a number", length) };
        self.skip(length);
        self.emit(Op::Constant(value), start..self.end)
    }

    /// A symbol, or a function with its arguments.
    fn name(&mut self, start: usize) -> Result<(), Wrong> {
        let rest = self.rest();
        let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let name = &rest[..length];
        let called = rest[length..].trim_start().starts_with('(');
        let unary = UNARY.iter().find(|f| f.0 == name).map(|f| Op::Unary(f.1));
        let variadic = VARIADIC.iter().find(|f| f.0 == name).map(|f| Op::Binary(f.1));
        match (unary.or(variadic), self.symbols.find(name)) {
            (Some(_), _) if !called => self.wrong(&format!("`{name}` is a function, `{name}(...)`"), length),
            (Some(op), _) => {
                self.skip(length);
                self.call(name, op, start)
            }
            (None, Some(_)) if called => {
                self.wrong(&format!("`{name}` is no function; a product is written `{name}*(...)`"), length)
            }
            (None, Some(symbol)) => {
                self.skip(length);
                self.symbol(symbol, start..self.end)
            }
            (None, None) => self.wrong(&self.symbols.unknown(name), length),
        }
    }

    fn symbol(&mut self, symbol: Symbol, span: Range<usize>) -> Result<(), Wrong> {
        match symbol {
            Symbol::Number(value) => self.emit(Op::Constant(value), span),
            Symbol::Slot(slot) => self.emit(Op::Load(slot), span),
            Symbol::Curve { slot, magnitude, curve } => {
                self.emit(Op::Load(slot), span.clone())?;
                if magnitude {
                    self.emit(Op::Unary(abs), span.clone())?;
                }
                self.emit(Op::Curve(curve), span)
            }
        }
    }

    fn call(&mut self, name: &str, op: Op, start: usize) -> Result<(), Wrong> {
        self.peek();
        let open = self.start();
        self.skip(1);
        let mut count = 1;
        self.expression(0)?;
        while self.peek() == Some(',') {
            if matches!(op, Op::Unary(_)) {
                return self.wrong(&format!("`{name}` takes one argument"), 1);
            }
            self.skip(1);
            self.expression(0)?;
            count += 1;
        }
        self.close(open)?;
        let uses = match op {
            Op::Unary(_) => 1,
            _ if count > 1 => count - 1,
            _ => return Err(Wrong { message: format!("`{name}` takes two or more arguments"), at: start..self.end }),
        };
        (0..uses).try_for_each(|_| self.emit(op.clone(), start..self.end))
    }

    fn parenthesis(&mut self, open: usize) -> Result<(), Wrong> {
        self.skip(1);
        self.expression(0)?;
        self.close(open)
    }

    fn close(&mut self, open: usize) -> Result<(), Wrong> {
        match self.peek() {
            Some(')') => self.skip(1),
            None => return Err(Wrong { message: "this `(` is not closed".into(), at: open..open + 1 }),
            Some(_) => return self.wrong("an operator or `)` is expected here", 1),
        }
        Ok(())
    }

    /// Adds an instruction; what has a value now is computed now.
    fn emit(&mut self, op: Op, span: Range<usize>) -> Result<(), Wrong> {
        let number = |i: &Instruction| if let Op::Constant(x) = i.op { Some(constant(x)) } else { None };
        let operands = &self.code[self.code.len() - op.operands()..];
        let (operands, op) = match (operands.iter().map(number).collect::<Option<Vec<_>>>(), op, operands.last()) {
            (Some(numbers), op, Some(_)) => (numbers.len(), Op::Constant(op.apply(&numbers, &[]).re)),
            (None, Op::Power, Some(Instruction { op: Op::Constant(n), .. })) => (1, Op::PowerBy(*n)),
            (_, op, _) => (0, op),
        };
        self.code.truncate(self.code.len() - operands);
        self.height = self.height - operands - op.operands() + 1;
        self.code.push(Instruction { op, span });
        if self.height > DEPTH { self.wrong("too many unfinished operations before this", 1) } else { Ok(()) }
    }

    fn rest(&self) -> &'a str {
        self.text[self.end..].trim_start()
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Where the next token starts.
    fn start(&self) -> usize {
        self.text.len() - self.rest().len()
    }

    fn skip(&mut self, length: usize) {
        self.end = self.start() + length;
    }

    /// An error with the next characters.
    fn wrong<T>(&self, message: &str, length: usize) -> Result<T, Wrong> {
        let start = self.start();
        let end = (start + length..self.text.len()).find(|end| self.text.is_char_boundary(*end));
        Err(Wrong { message: message.into(), at: start..end.unwrap_or(self.text.len()) })
    }
}
