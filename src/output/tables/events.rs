//! `events.csv`: one row for every way to a step that was left.

use std::path::Path;

use super::{Table, number};
use crate::output::{OutputError, Quantity};
use crate::solve::{Event, Tried};

/// Columns of `events.csv` in order: name, kind of quantity, meaning.
pub const EVENT_COLUMNS: [(&str, Quantity, &str); 6] = [
    ("time", Quantity::Time, "start of the step"),
    ("until", Quantity::Time, "end of the step"),
    ("rung", Quantity::Number, "way to the end of the step that was left"),
    ("attempts", Quantity::Number, "how often it was tried"),
    ("reason", Quantity::Number, "why it was left the first time"),
    ("reached", Quantity::Number, "way that went on; empty where the run ended"),
];

/// Writes the events of a run; an existing table is replaced, and removed where there are none.
///
/// # Errors
/// The path and the operating system's reason.
pub fn write_events(path: &Path, events: &[Event]) -> Result<(), OutputError> {
    if events.is_empty() {
        return if path.exists() {
            std::fs::remove_file(path).map_err(OutputError::io("remove", path))
        } else {
            Ok(())
        };
    }
    let header: Vec<String> = EVENT_COLUMNS.iter().map(|column| column.0.to_owned()).collect();
    let rows = events.iter().flat_map(|event| event.tried.iter().map(|tried| cells(event, tried)));
    Table::create(path, &header)?.rows(rows)
}

fn cells(event: &Event, tried: &Tried) -> Vec<String> {
    let reached = event.reached.map_or("", |rung| rung.name());
    let [time, until] = [event.time, event.until].map(number);
    vec![time, until, tried.rung.name().into(), tried.attempts.to_string(), tried.reason.clone(), reached.into()]
}
