//! Labels of the consistent unit system a scene is written in. Labels only: nothing is ever converted.

use asperity_laws::Unit;

/// Names of the three base units; an empty string means "not given".
///
/// Plane strain: forces are per unit of thickness (stress * length), energies per unit of thickness (stress * length^2).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UnitLabels {
    /// Unit of length, e.g. `mm`.
    pub length: String,
    /// Unit of stress, e.g. `MPa`.
    pub stress: String,
    /// Unit of time, e.g. `s`.
    pub time: String,
}

/// The kinds of quantity that appear in the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length.
    Length,
    /// A stress or pressure.
    Stress,
    /// A time of the analysis.
    Time,
    /// A force per unit of thickness: stress * length.
    Force,
    /// An energy per unit of thickness: stress * length^2.
    Energy,
    /// An angle in radians.
    Angle,
    /// Seconds on the wall clock.
    WallClock,
    /// A pure number.
    Number,
}

impl UnitLabels {
    /// Label of a quantity, empty if the base units it is made of were not given (or if it is a pure number).
    pub fn label(&self, quantity: Quantity) -> String {
        match quantity {
            Quantity::Length => self.length.clone(),
            Quantity::Stress => self.stress.clone(),
            Quantity::Time => self.time.clone(),
            Quantity::Force => self.product(""),
            Quantity::Energy => self.product("^2"),
            Quantity::Angle => "rad".into(),
            Quantity::WallClock => "s".into(),
            Quantity::Number => String::new(),
        }
    }

    /// Label of a dimension, empty if one of the base units it is made of was not given.
    pub fn of(&self, unit: Unit) -> String {
        let powers = [(&self.stress, unit.stress), (&self.length, unit.length), (&self.time, unit.time)];
        let known = unit.temperature == 0 && powers.iter().all(|(label, power)| *power == 0 || !label.is_empty());
        let part = |(label, power): (&String, i8)| match power {
            0 => None,
            1 => Some(label.clone()),
            power => Some(format!("{label}^{power}")),
        };
        if known { powers.into_iter().filter_map(part).collect::<Vec<_>>().join(" ") } else { String::new() }
    }

    /// As [`Self::axis`] for any dimension, with the powers in the markup of figures.
    pub fn axis_of(&self, name: &str, unit: Unit) -> String {
        let label = self.of(unit);
        let raised = |part: &str| match part.split_once('^') {
            Some((base, power)) => format!("{base}^{{{}}}", power.replace('-', "−")),
            None => part.to_owned(),
        };
        named(name, label.split(' ').map(raised).collect::<Vec<_>>().join(" "))
    }

    fn product(&self, power: &str) -> String {
        if self.stress.is_empty() || self.length.is_empty() {
            return String::new();
        }
        format!("{} {}{power}", self.stress, self.length)
    }

    /// Axis of a variable of a law from its dimension in words (`length`, `stress length^-1`, `1`): units where they are
    /// known, else the words in parentheses. An underscore in the name would be a subscript; it becomes a space.
    pub fn variable(&self, name: &str, dimension: &str) -> String {
        let word = |word: &str| {
            let (base, power) = word.split_once('^').map_or((word, String::new()), |(b, p)| (b, format!("^{{{p}}}")));
            let known = match base {
                "length" => &self.length,
                "stress" => &self.stress,
                "time" => &self.time,
                _ => "",
            };
            (if known.is_empty() { base } else { known }.to_owned() + &power, !known.is_empty())
        };
        let words: Vec<(String, bool)> = dimension.split(' ').map(word).collect();
        let unit = words.iter().map(|(text, _)| text.as_str()).collect::<Vec<_>>().join(" ");
        let name = format!("*{}*", name.replace('_', " "));
        match (dimension, words.iter().all(|(_, known)| *known)) {
            (words, _) if words == "1" || name == format!("*{words}*") => name,
            (_, true) if words.len() == 1 => format!("{name} / {unit}"),
            _ => format!("{name} ({unit})"),
        }
    }

    /// `name / unit` (the form of ISO 80000), or the bare name where no unit is known.
    pub fn axis(&self, name: &str, quantity: Quantity) -> String {
        named(name, self.label(quantity))
    }
}

fn named(name: &str, unit: String) -> String {
    match unit {
        unit if unit.is_empty() => name.to_owned(),
        unit if unit.contains(' ') => format!("{name} / ({unit})"),
        unit => format!("{name} / {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_compose_only_from_known_units() {
        let units = UnitLabels { length: "mm".into(), stress: "MPa".into(), time: String::new() };
        assert_eq!(units.axis("W", Quantity::Energy), "W / (MPa mm^2)");
        assert_eq!(units.axis("t", Quantity::Time), "t");
        assert_eq!(UnitLabels::default().axis("F", Quantity::Force), "F");
        assert_eq!(units.of(Unit::VELOCITY), "");
        let units = UnitLabels { time: "s".into(), ..units };
        assert_eq!(units.of(Unit::VELOCITY), "mm s^-1");
        assert_eq!(units.axis_of("v", Unit::VELOCITY), "v / (mm s^{−1})");
        assert_eq!(units.axis_of("z", Unit::ONE), "z");
    }
}
