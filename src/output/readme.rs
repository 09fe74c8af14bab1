//! `README.txt` of an output folder: every file and every column with its unit.
//!
//! The csv headers stay plain column names so that any reader takes them as they are; the units stand here.

use std::fmt::Write;

use asperity_laws::{Unit, Variable};

use super::tables::{CERTIFY_COLUMNS, EVENT_COLUMNS, INTERFACE_COLUMNS, POINT_COLUMNS, history_columns};
use super::units::{Quantity, UnitLabels};

const HEAD: &str = "\
Files of this folder
====================
run.json        the input with all defaults, versions, counters, audit results and status
history.csv     one row per nominal step
interface.csv   one row per interface site and nominal step
certify.csv     one row per accepted step, where the run was certified
events.csv      one row per way to a step that was given up, and why; only where there was trouble
fields.pvd      opens all fields in ParaView (time series of fields/*.vtu)
figures/        every figure as SVG (vector) and PNG; animation.svg moves in a browser
checkpoint/     what `asperity run --resume` goes on from; not needed to read the results
README.txt      this file

Plane strain: forces and energies are per unit of thickness. Numbers read back bit for bit; nan = undefined.
Fields are rational Bezier cells in the reference position: apply Warp By Vector with `displacement`, and
set Nonlinear Subdivision Level > 1 to see the curved edges. Stresses are Cauchy stresses.
";

/// Text of `README.txt`; `variables` are the extra columns of `interface.csv` as (name, unit), `rates` says whether those of the
/// history are there.
pub fn text(title: &str, units: &UnitLabels, variables: &[(String, String)], rates: bool) -> String {
    let mut text = String::new();
    if !title.is_empty() {
        let _ = writeln!(text, "{title}\n");
    }
    let _ = writeln!(text, "{HEAD}\nUnits: {}", unit_line(units));
    section(&mut text, "history.csv", history_columns(rates), units);
    section(&mut text, "interface.csv", &INTERFACE_COLUMNS, units);
    for (name, unit) in variables {
        let _ = writeln!(text, "{name:<18} {unit:<12} state variable of the friction law");
    }
    section(&mut text, "certify.csv", &CERTIFY_COLUMNS, units);
    section(&mut text, "events.csv", &EVENT_COLUMNS, units);
    text
}

/// Text of `README.txt` of a law that was driven at one point.
pub fn point_text(law: &str, units: &UnitLabels, variables: &[Variable]) -> String {
    let mut text = format!("Friction law {law} at one contact point. Units: {}\n\n", unit_line(units));
    text.push_str("One csv for each programme, one row per step; the figures of each as SVG and PNG in figures/.\n");
    text.push_str(
        "Forces, masses and stiffnesses are per unit of area. Numbers read back bit for bit; nan = undefined.\n",
    );
    text.push_str("\nColumns: name, unit, meaning\n");
    let mut line = |name: &str, unit: Unit, meaning: &str| {
        let label = Some(units.of(unit)).filter(|label| !label.is_empty()).unwrap_or_else(|| unit.to_string());
        let _ = writeln!(text, "{name:<18} {:<12} {meaning}", if unit == Unit::ONE { "-" } else { &label });
    };
    POINT_COLUMNS.iter().for_each(|(name, unit, meaning)| line(name, *unit, meaning));
    variables.iter().for_each(|variable| line(&variable.name, variable.unit, "state variable of the friction law"));
    text
}

fn unit_line(units: &UnitLabels) -> String {
    let name = |label: &str| if label.is_empty() { "any consistent".to_owned() } else { label.to_owned() };
    format!("length = {}, stress = {}, time = {}", name(&units.length), name(&units.stress), name(&units.time))
}

fn section<'a>(
    text: &mut String,
    file: &str,
    columns: impl IntoIterator<Item = &'a (&'a str, Quantity, &'a str)>,
    units: &UnitLabels,
) {
    let _ = writeln!(text, "\nColumns of {file}: name, unit, meaning");
    for (name, quantity, meaning) in columns {
        let _ = writeln!(text, "{name:<18} {:<12} {meaning}", unit(units, *quantity));
    }
}

/// The label, or what the unit is made of where the scene names none.
fn unit(units: &UnitLabels, quantity: Quantity) -> String {
    let generic = match quantity {
        Quantity::Length => "length",
        Quantity::Stress => "stress",
        Quantity::Time => "time",
        Quantity::Force => "stress*length",
        Quantity::Energy => "stress*length^2",
        Quantity::Angle | Quantity::WallClock | Quantity::Number => "-",
    };
    match units.label(quantity) {
        label if label.is_empty() => generic.to_owned(),
        label => label,
    }
}
