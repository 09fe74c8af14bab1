//! What a law says about itself: dimensions, ranges and the record shown by `asperity laws`.

use std::{fmt, str::FromStr};

/// Documentation of a law, submitted beside it with `inventory::submit! { LawInfo { .. } }`; the parser, the range checks, the
/// unit check of the conformance kit and the JSON schema read it, so each range is written once.
#[derive(Clone, Copy, Debug)]
pub struct LawInfo {
    /// The `type` in a scene, same as the `name` given to `#[typetag::serde]`.
    pub name: &'static str,
    /// Set-valued or direct.
    pub kind: Kind,
    /// The law in one line, in the symbols of its parameters.
    pub equation: &'static str,
    /// All fields of the struct.
    pub parameters: &'static [Parameter],
    /// Where the law comes from, with equation number where there is one.
    pub reference: &'static str,
}

inventory::collect!(LawInfo);

/// How a law answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Bound on the traction, sharp stick ([`crate::Response::Threshold`]).
    SetValued,
    /// Traction as a function ([`crate::Response::Traction`]).
    Direct,
    /// One of the two by its parameters; [`crate::kind`] tells which.
    Either,
}

/// One parameter of a law.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Key in the scene.
    pub name: &'static str,
    /// Physical dimension.
    pub unit: Unit,
    /// Admissible values.
    pub range: Range,
    /// Value used if the key is left out, as shown to the user; `None`: must be given.
    pub default: Option<&'static str>,
    /// What it is, in words.
    pub meaning: &'static str,
}

impl Parameter {
    /// A parameter that must be given.
    pub const fn new(name: &'static str, unit: Unit, range: Range, meaning: &'static str) -> Self {
        Self { name, unit, range, default: None, meaning }
    }

    /// The same parameter with a default (mirror it with `#[serde(default)]`).
    pub const fn or(self, default: &'static str) -> Self {
        Self { default: Some(default), ..self }
    }
}

/// Admissible values of a parameter; numbers are always finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Number,
    /// `>= bound`.
    AtLeast(f64),
    /// `> bound`.
    Above(f64),
    /// Closed interval.
    Between(f64, f64),
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A text, described in words; checked by the law itself.
    Text(&'static str),
    /// Anything else, described in words; checked by the law itself.
    Other(&'static str),
}

impl Range {
    /// Whether the number is admissible; false for a range that is not one of numbers.
    pub fn contains(&self, x: f64) -> bool {
        x.is_finite()
            && match *self {
                Self::Number => true,
                Self::AtLeast(low) => x >= low,
                Self::Above(low) => x > low,
                Self::Between(low, high) => low <= x && x <= high,
                Self::Choice(_) | Self::Text(_) | Self::Other(_) => false,
            }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Number => write!(f, "a finite number"),
            Self::AtLeast(low) => write!(f, "a number >= {low}"),
            Self::Above(low) => write!(f, "a number > {low}"),
            Self::Between(low, high) => write!(f, "a number from {low} to {high}"),
            Self::Choice(words) => write!(f, "one of {}", words.join(", ")),
            Self::Text(words) | Self::Other(words) => write!(f, "{words}"),
        }
    }
}

/// Physical dimension as powers of stress, length, time and temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// Power of stress.
    pub stress: i8,
    /// Power of length.
    pub length: i8,
    /// Power of time.
    pub time: i8,
    /// Power of temperature.
    pub temperature: i8,
}

impl Unit {
    /// Dimensionless.
    pub const ONE: Self = Self { stress: 0, length: 0, time: 0, temperature: 0 };
    /// Stress.
    pub const STRESS: Self = Self { stress: 1, ..Self::ONE };
    /// Length.
    pub const LENGTH: Self = Self { length: 1, ..Self::ONE };
    /// Time.
    pub const TIME: Self = Self { time: 1, ..Self::ONE };
    /// Temperature.
    pub const TEMPERATURE: Self = Self { temperature: 1, ..Self::ONE };
    /// Length per time.
    pub const VELOCITY: Self = Self::LENGTH.per(Self::TIME);

    /// Product of two units.
    pub const fn times(self, other: Self) -> Self {
        Self {
            stress: self.stress + other.stress,
            length: self.length + other.length,
            time: self.time + other.time,
            temperature: self.temperature + other.temperature,
        }
    }

    /// Quotient of two units.
    pub const fn per(self, other: Self) -> Self {
        let inverse =
            Self { stress: -other.stress, length: -other.length, time: -other.time, temperature: -other.temperature };
        self.times(inverse)
    }

    /// Factor by which a value changes if the units of `[stress, length, time, temperature]` are divided by these factors.
    pub fn factor(&self, scales: [f64; 4]) -> f64 {
        let powers = [self.stress, self.length, self.time, self.temperature];
        scales.iter().zip(powers).map(|(scale, power)| scale.powi(power.into())).product()
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names =
            [("stress", self.stress), ("length", self.length), ("time", self.time), ("temperature", self.temperature)];
        let parts: Vec<_> = names
            .iter()
            .filter(|(_, power)| *power != 0)
            .map(|(name, power)| if *power == 1 { (*name).into() } else { format!("{name}^{power}") })
            .collect();
        write!(f, "{}", if parts.is_empty() { "1".into() } else { parts.join(" ") })
    }
}

/// A base unit with its power, `length^2`.
fn factor(text: &str) -> Option<Unit> {
    let (name, power) = text.split_once('^').unwrap_or((text, "1"));
    let power = power.parse::<i8>().ok().filter(|power| power.unsigned_abs() < 10)?;
    Some(match name {
        "1" => Unit::ONE,
        "stress" => Unit { stress: power, ..Unit::ONE },
        "length" => Unit { length: power, ..Unit::ONE },
        "time" => Unit { time: power, ..Unit::ONE },
        "temperature" => Unit { temperature: power, ..Unit::ONE },
        _ => return None,
    })
}

impl FromStr for Unit {
    type Err = String;

    /// Reads products and quotients of `stress`, `length`, `time`, `temperature` and `1`, with powers: `length/time`, `stress length^-2`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no unit: such as `1`, `stress`, `length/time`, `length^2`, of stress, length, time, temperature"
            )
        };
        let mut unit = Self::ONE;
        for (place, product) in text.split('/').enumerate() {
            for part in product.split('*') {
                let factors: Vec<Self> =
                    part.split_whitespace().map(factor).collect::<Option<_>>().ok_or_else(wrong)?;
                let product = factors.into_iter().reduce(Self::times).ok_or_else(wrong)?;
                unit = if place > 0 { unit.per(product) } else { unit.times(product) };
            }
        }
        Ok(unit)
    }
}

impl fmt::Display for LawInfo {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let kind = match self.kind {
            Kind::SetValued => "set-valued: bound on the traction, sharp stick",
            Kind::Direct => "direct: traction as a function",
            Kind::Either => "set-valued or direct, by its parameters",
        };
        writeln!(f, "{} ({kind})\n  {}", self.name, self.equation)?;
        for p in self.parameters {
            let default = p.default.map_or(String::new(), |d| format!(", default {d}"));
            writeln!(f, "  {} [{}]: {}; {}{default}", p.name, p.unit, p.meaning, p.range)?;
        }
        write!(f, "  {}", self.reference)
    }
}
