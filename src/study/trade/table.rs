//! `trade.csv`: one row a setting.

use std::path::Path;

use super::found::Found;
use super::measure::{Measured, Role};
use super::norm::QUANTITIES;
use super::{Trade, front};
use crate::output::OutputError;
use crate::output::run_json::write_atomic;
use crate::output::tables::number;

/// Columns before and after those of the errors.
const BEFORE: [&str; 7] = ["index", "role", "basis", "elements", "grading", "steps", "choices"];
const AFTER: [&str; 11] = [
    "error",
    "bound",
    "front",
    "cpu_s",
    "unknowns",
    "newton_iterations",
    "factorisations",
    "memory_mb",
    "status",
    "reason",
    "folder",
];

/// Writes `trade.csv` into a folder: settings, error of each quantity (as a share of the peak), cost, state.
///
/// # Errors
/// The path and the operating system's reason.
pub fn write_table(trade: &Trade, found: &Found, folder: &Path) -> Result<(), OutputError> {
    let path = folder.join("trade.csv");
    let bad = |error: csv::Error| OutputError::content(&path, error.to_string());
    let mut table = csv::Writer::from_writer(vec![]);
    let errors = QUANTITIES.map(|name| format!("error_{name}"));
    table.write_record(BEFORE.into_iter().chain(errors.iter().map(String::as_str)).chain(AFTER)).map_err(bad)?;
    let front = front(&found.costs());
    for (index, point) in found.points.iter().enumerate() {
        let mut cells = vec![index.to_string()];
        cells.extend(setting(trade, point));
        cells.extend(point.errors.iter().map(|error| number(*error)));
        cells.extend([found.error(point), found.bound(point)].map(number));
        cells.push(front.contains(&index).to_string());
        cells.push(number(point.status.cpu_s));
        cells.extend(point.counts.map(|count| count.to_string()));
        cells.push(point.status.memory_mb.map_or_else(|| "nan".into(), number));
        cells.extend([point.status.status.name().to_owned(), point.status.reason.clone()]);
        cells.push(format!("points/{}", point.folder));
        table.write_record(cells).map_err(bad)?;
    }
    let text = table.into_inner().map_err(|error| OutputError::content(&path, error.to_string()))?;
    write_atomic(&path, &text)
}

fn setting(trade: &Trade, point: &Measured) -> [String; 6] {
    let (setting, scene) = (&point.setting, trade.scene());
    let role = match point.role {
        Role::Candidate => "candidate",
        Role::Reference => "reference",
        Role::OtherModel => "other model",
    };
    [
        role.to_owned(),
        setting.basis_words(scene),
        number((0.5 * f64::from(setting.elements)).exp2()),
        number(f64::from(setting.grading).exp2()),
        setting.step_count(scene).unwrap_or_default().to_string(),
        setting.choice_words(trade).join("; "),
    ]
}
