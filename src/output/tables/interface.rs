//! `interface.csv`: one row per site of the interface and nominal step.

use std::path::Path;

use super::{Row, Table, number, read_cells};
use crate::model::{ContactStatus, InterfaceRow};
use crate::output::{OutputError, Quantity};

/// Columns of `interface.csv` in order: name, kind of quantity, meaning; the variables of the law follow.
pub const INTERFACE_COLUMNS: [(&str, Quantity, &str); 14] = [
    ("step", Quantity::Number, "nominal step"),
    ("pair", Quantity::Number, "contact pair, 0 = first in the scene"),
    ("index", Quantity::Number, "site on the nonmortar edge"),
    ("x", Quantity::Length, "position in the deformed state"),
    ("y", Quantity::Length, "position in the deformed state"),
    ("arc", Quantity::Length, "reference arc length along the nonmortar edge"),
    ("normal_x", Quantity::Number, "unit normal; pressure on the driven body acts along it"),
    ("normal_y", Quantity::Number, "unit normal; pressure on the driven body acts along it"),
    ("pressure", Quantity::Stress, "contact pressure, >= 0 in compression"),
    ("traction", Quantity::Stress, "tangential traction, acts against the slip"),
    ("gap", Quantity::Length, "gap, >= 0 when open"),
    ("slip", Quantity::Length, "slip of the step"),
    ("status", Quantity::Number, "open, stick or slip"),
    ("weight", Quantity::Length, "share of the nonmortar edge that the row stands for"),
];

/// Appends to `interface.csv`; the rows of a step are on disk when `append` returns.
#[derive(Debug)]
pub struct InterfaceWriter {
    table: Table,
    variables: usize,
}

impl InterfaceWriter {
    /// Starts a new table; `variables` are the columns of the law state (`name`, or `pair0.name` where laws differ).
    ///
    /// # Errors
    /// The path and the reason if it cannot be written.
    pub fn create(path: &Path, variables: &[String]) -> Result<Self, OutputError> {
        let table = Table::create(path, &header(variables))?;
        Ok(Self { table, variables: variables.len() })
    }

    /// Continues an existing table after `last_step`: rows of later steps and a half-written last row are dropped.
    ///
    /// # Errors
    /// The path and the reason if it cannot be read or written, or if its columns are others.
    pub fn resume(path: &Path, variables: &[String], last_step: usize) -> Result<Self, OutputError> {
        let table = Table::resume(path, &header(variables), last_step)?;
        Ok(Self { table, variables: variables.len() })
    }

    /// Appends the rows of one step and flushes them. Missing law variables (another pair's law) are left empty.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn append(&mut self, rows: &[InterfaceRow]) -> Result<(), OutputError> {
        let variables = self.variables;
        self.table.rows(rows.iter().map(|row| cells(row, variables)))
    }

    /// Waits until all rows are on the disk itself.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn sync(&self) -> Result<(), OutputError> {
        self.table.sync()
    }
}

fn header(variables: &[String]) -> Vec<String> {
    let fixed = INTERFACE_COLUMNS.iter().map(|column| column.0.to_owned());
    fixed.chain(variables.iter().cloned()).collect()
}

fn cells(row: &InterfaceRow, variables: usize) -> Vec<String> {
    let mut cells = vec![row.step.to_string(), row.pair.to_string(), row.index.to_string()];
    cells.extend([row.x, row.y, row.arc, row.normal[0], row.normal[1]].map(number));
    cells.extend([row.pressure, row.traction, row.gap, row.slip].map(number));
    cells.extend([row.status.to_string(), number(row.weight)]);
    cells.extend((0..variables).map(|i| row.variables.get(i).copied().map(number).unwrap_or_default()));
    cells
}

/// Reads `interface.csv` back. The tangent, not a column, is the normal turned clockwise.
///
/// # Errors
/// File, line and column of the first cell that cannot be read, or the columns expected.
pub fn read_interface(path: &Path) -> Result<Vec<InterfaceRow>, OutputError> {
    let names: Vec<&str> = INTERFACE_COLUMNS.iter().map(|column| column.0).collect();
    let (header, rows) = read_cells(path, &names)?;
    rows.iter().map(|cells| interface_row(Row::new(cells, &header, path))).collect()
}

fn interface_row(mut row: Row) -> Result<InterfaceRow, OutputError> {
    let (step, pair, index) = (row.take()?, row.take()?, row.take()?);
    let ([x, y], arc, normal) = (row.pair()?, row.take()?, row.pair()?);
    Ok(InterfaceRow {
        step,
        pair,
        index,
        x,
        y,
        arc,
        normal,
        tangent: [normal[1], -normal[0]],
        pressure: row.take()?,
        traction: row.take()?,
        gap: row.take()?,
        slip: row.take()?,
        status: status(row.take::<String>()?.as_str(), row.path)?,
        weight: row.take()?,
        variables: variables(&row)?,
    })
}

fn status(text: &str, path: &Path) -> Result<ContactStatus, OutputError> {
    [ContactStatus::Open, ContactStatus::Stick, ContactStatus::Slip]
        .into_iter()
        .find(|status| status.to_string() == text)
        .ok_or_else(|| OutputError::content(path, format!("unknown contact status \"{text}\"")))
}

fn variables(row: &Row) -> Result<Vec<f64>, OutputError> {
    let cells = row.cells.iter().skip(INTERFACE_COLUMNS.len()).filter(|cell| !cell.is_empty());
    let parse =
        |cell: &str| cell.parse().map_err(|_| OutputError::content(row.path, format!("cannot read \"{cell}\"")));
    cells.map(parse).collect()
}
