//! `history.csv`: one row per nominal step.

use std::path::Path;

use super::{Row, Table, number, read_cells};
use crate::model::Record;
use crate::output::{OutputError, Quantity};

/// Columns of `history.csv` in order: name, kind of quantity, meaning. The names up to `wall_s` are fixed.
pub const HISTORY_COLUMNS: [(&str, Quantity, &str); 26] = [
    ("step", Quantity::Number, "nominal step, 1 = first"),
    ("time", Quantity::Time, "time at the end of the step"),
    ("drive_x", Quantity::Length, "displacement of the driven edge in x"),
    ("drive_y", Quantity::Length, "displacement of the driven edge in y"),
    ("fx", Quantity::Force, "horizontal resistance felt by the driven body, per unit of thickness"),
    ("fy", Quantity::Force, "normal support felt by the driven body, per unit of thickness"),
    ("mu_global", Quantity::Number, "fx / fy; nan where fy vanishes"),
    ("contact_angle", Quantity::Angle, "pressure-weighted mean angle of the interface to the sliding direction"),
    ("contact_length", Quantity::Length, "length of the interface that carries pressure"),
    ("pressure_max", Quantity::Stress, "largest contact pressure"),
    ("penetration_max", Quantity::Length, "largest penetration left"),
    ("strain_energy", Quantity::Energy, "elastic energy stored in the bodies"),
    ("dissipated", Quantity::Energy, "energy dissipated by friction since the start"),
    ("external_work", Quantity::Energy, "work of drives, supports and loads since the start"),
    ("newton_iterations", Quantity::Number, "Newton iterations spent on the step"),
    ("cuts", Quantity::Number, "how often the step was cut"),
    ("converged", Quantity::Number, "true or false"),
    ("wall_s", Quantity::WallClock, "wall-clock time spent on the step"),
    ("reaction_base_x", Quantity::Force, "reaction of the fixed base in x"),
    ("reaction_base_y", Quantity::Force, "reaction of the fixed base in y"),
    ("fully_slipping", Quantity::Number, "true if every point in contact slips"),
    ("force_imbalance", Quantity::Number, "resultant of the interface on both bodies, relative"),
    ("moment_imbalance", Quantity::Number, "moment of the interface on both bodies, relative"),
    (
        "weakening",
        Quantity::Number,
        "share of the bodies' tangential stiffness taken by friction that falls with the slip rate",
    ),
    ("snaps", Quantity::Number, "sudden changes to another equilibrium crossed in the step"),
    ("snap_loss", Quantity::Energy, "energy set free by them since the start"),
];

/// Further columns of runs with inertia or viscosity.
pub const RATE_COLUMNS: [(&str, Quantity, &str); 3] = [
    ("kinetic_energy", Quantity::Energy, "energy of motion"),
    ("numerical_loss", Quantity::Energy, "energy taken away by the time integration of inertia since the start"),
    ("viscous_loss", Quantity::Energy, "work of viscous stresses since the start"),
];

/// Columns of a run, with or without inertia or viscosity.
pub fn history_columns(rates: bool) -> impl Iterator<Item = &'static (&'static str, Quantity, &'static str)> {
    HISTORY_COLUMNS.iter().chain(RATE_COLUMNS.iter().filter(move |_| rates))
}

/// Appends to `history.csv`; a row is on disk when `append` returns.
#[derive(Debug)]
pub struct HistoryWriter {
    table: Table,
    rates: bool,
}

impl HistoryWriter {
    /// Starts a new table, with [`RATE_COLUMNS`] or without; an existing file is replaced.
    ///
    /// # Errors
    /// The path and the reason if it cannot be written.
    pub fn create(path: &Path, rates: bool) -> Result<Self, OutputError> {
        Ok(Self { table: Table::create(path, &header(rates))?, rates })
    }

    /// Continues an existing table after `last_step`: rows of later steps and a half-written last row are dropped.
    ///
    /// # Errors
    /// The path and the reason if it cannot be read or written, or if its columns are others.
    pub fn resume(path: &Path, rates: bool, last_step: usize) -> Result<Self, OutputError> {
        Ok(Self { table: Table::resume(path, &header(rates), last_step)?, rates })
    }

    /// Appends one row and flushes it.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn append(&mut self, record: &Record) -> Result<(), OutputError> {
        let mut row = cells(record);
        if self.rates {
            row.extend([record.kinetic_energy, record.numerical_loss, record.viscous_loss].map(number));
        }
        self.table.rows(std::iter::once(row))
    }

    /// Waits until all rows are on the disk itself.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn sync(&self) -> Result<(), OutputError> {
        self.table.sync()
    }
}

fn header(rates: bool) -> Vec<String> {
    history_columns(rates).map(|column| column.0.to_owned()).collect()
}

fn cells(record: &Record) -> Vec<String> {
    let mut row = vec![record.step.to_string()];
    row.extend(
        [
            record.time,
            record.drive[0],
            record.drive[1],
            record.force[0],
            record.force[1],
            record.mu_global,
            record.contact_angle,
            record.contact_length,
            record.pressure_max,
            record.penetration_max,
            record.strain_energy,
            record.dissipated,
            record.external_work,
        ]
        .map(number),
    );
    row.extend([record.newton_iterations.to_string(), record.cuts.to_string(), record.converged.to_string()]);
    row.extend([record.wall_s, record.reaction_base[0], record.reaction_base[1]].map(number));
    row.push(record.fully_slipping.to_string());
    row.extend([record.force_imbalance, record.moment_imbalance, record.weakening].map(number));
    row.extend([record.snaps.to_string(), number(record.snap_loss)]);
    row
}

/// Reads `history.csv` back, bit for bit what was written.
///
/// # Errors
/// File, line and column of the first cell that cannot be read, or the columns expected.
pub fn read_history(path: &Path) -> Result<Vec<Record>, OutputError> {
    let names: Vec<&str> = HISTORY_COLUMNS.iter().map(|column| column.0).collect();
    let (header, rows) = read_cells(path, &names)?;
    let rates = header.get(names.len()).is_some_and(|name| name == RATE_COLUMNS[0].0);
    rows.iter().map(|cells| record(Row::new(cells, &header, path), rates)).collect()
}

fn record(mut row: Row, rates: bool) -> Result<Record, OutputError> {
    // Fields are evaluated in the order written, which is the order of the columns.
    let mut record = Record {
        step: row.take()?,
        time: row.take()?,
        drive: row.pair()?,
        force: row.pair()?,
        mu_global: row.take()?,
        contact_angle: row.take()?,
        contact_length: row.take()?,
        pressure_max: row.take()?,
        penetration_max: row.take()?,
        strain_energy: row.take()?,
        dissipated: row.take()?,
        external_work: row.take()?,
        newton_iterations: row.take()?,
        cuts: row.take()?,
        converged: row.take()?,
        wall_s: row.take()?,
        reaction_base: row.pair()?,
        fully_slipping: row.take()?,
        force_imbalance: row.take()?,
        moment_imbalance: row.take()?,
        weakening: row.take()?,
        snaps: row.take()?,
        snap_loss: row.take()?,
        ..Record::default()
    };
    if rates {
        (record.kinetic_energy, record.numerical_loss, record.viscous_loss) = (row.take()?, row.take()?, row.take()?);
    }
    Ok(record)
}
