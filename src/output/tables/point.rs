//! The table of one contact point that was driven by itself: one row per step, cut ones included.

use std::path::Path;

use asperity_laws::drive::Record;
use asperity_laws::{Unit, Variable};

use super::{Table, number};
use crate::output::OutputError;

/// Columns in order: name, dimension, meaning; the variables of the law follow.
pub const POINT_COLUMNS: [(&str, Unit, &str); 9] = [
    ("time", Unit::TIME, "time at the end of the step"),
    ("slip", Unit::LENGTH, "slip since the start"),
    ("velocity", Unit::VELOCITY, "slip velocity: mean of the step; of a mass that at its end"),
    ("pressure", Unit::STRESS, "contact pressure"),
    ("traction", Unit::STRESS, "tangential traction, acts against the slip"),
    ("friction", Unit::ONE, "traction / pressure; nan where there is no pressure"),
    ("force", Unit::STRESS, "force of the spring; without spring the traction"),
    (
        "work",
        Unit::STRESS.times(Unit::LENGTH),
        "work done against friction since the start, in part stored by a direct law",
    ),
    ("slipping", Unit::ONE, "true or false"),
];

/// Writes all records of a driver; `variables` are those of the law.
///
/// # Errors
/// The path and the operating system's reason.
pub fn write_point(path: &Path, records: &[Record], variables: &[Variable]) -> Result<(), OutputError> {
    let names = POINT_COLUMNS.iter().map(|column| column.0.to_owned());
    let header: Vec<String> = names.chain(variables.iter().map(|variable| variable.name.to_string())).collect();
    Table::create(path, &header)?.rows(records.iter().map(cells))
}

fn cells(record: &Record) -> Vec<String> {
    let Record { time, slip, velocity, pressure, traction, force, work, .. } = *record;
    let friction = if pressure == 0.0 { f64::NAN } else { traction / pressure };
    let mut row: Vec<String> = [time, slip, velocity, pressure, traction, friction, force, work].map(number).into();
    row.push(record.slipping.to_string());
    row.extend(record.states.iter().copied().map(number));
    row
}
