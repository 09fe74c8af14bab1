//! `certify.csv`: one row per accepted step, the Newton solution against the conic one.

use std::path::Path;

use super::{Table, number};
use crate::output::{OutputError, Quantity};
use crate::verify::conic::{Certified, Way};

/// Columns of `certify.csv` in order: name, kind of quantity, meaning.
pub const CERTIFY_COLUMNS: [(&str, Quantity, &str); 20] = [
    ("step", Quantity::Number, "nominal step that the accepted step belongs to"),
    ("time", Quantity::Time, "time at the end of the accepted step"),
    ("verdict", Quantity::Number, "agrees, inconclusive or disagrees"),
    ("du", Quantity::Number, "largest difference of a displacement over an element length"),
    ("dp", Quantity::Number, "largest difference of a site pressure over the peak pressure"),
    ("dq", Quantity::Number, "largest difference of a site traction over the peak pressure"),
    ("dfx", Quantity::Number, "difference of fx over the force"),
    ("dfy", Quantity::Number, "difference of fy over the force"),
    ("newton_iterations", Quantity::Number, "linear solves of Newton's method"),
    ("programmes", Quantity::Number, "convex programmes of the conic method"),
    ("interior_point_iterations", Quantity::Number, "iterations of the interior-point method in all of them"),
    ("newton_s", Quantity::WallClock, "wall-clock time of Newton's method"),
    ("conic_s", Quantity::WallClock, "wall-clock time of certificate and conic method"),
    ("way", Quantity::Number, "how the conic method came to the law: tresca or de-saxce"),
    ("equilibrium", Quantity::Number, "certificate: residual of the Newton solution over the largest nodal force"),
    (
        "violation",
        Quantity::Number,
        "certificate: largest violation of gap, cone, complementarity, multipliers or status",
    ),
    ("stationarity", Quantity::Number, "certificate: increment and change of forces of a programme at the solution"),
    ("duality_gap", Quantity::Number, "certificate: relative duality gap of that programme"),
    (
        "coupling",
        Quantity::Number,
        "friction against the stiffness it meets; from 1 on the solution need not be unique",
    ),
    ("reason", Quantity::Number, "why, where the verdict is not agrees"),
];

/// A certified step and the nominal step it belongs to.
#[derive(Clone, Debug)]
pub struct CertifyRow {
    /// Nominal step.
    pub step: usize,
    /// What was found.
    pub found: Certified,
}

/// Appends to `certify.csv`; rows are on disk when `append` returns.
#[derive(Debug)]
pub struct CertifyWriter {
    table: Table,
}

impl CertifyWriter {
    /// Starts a new table; an existing file is replaced.
    ///
    /// # Errors
    /// The path and the reason if it cannot be written.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        Ok(Self { table: Table::create(path, &header())? })
    }

    /// Continues an existing table after `last_step`, see [`super::HistoryWriter::resume`].
    ///
    /// # Errors
    /// The path and the reason if it cannot be read or written, or if its columns are others.
    pub fn resume(path: &Path, last_step: usize) -> Result<Self, OutputError> {
        Ok(Self { table: Table::resume(path, &header(), last_step)? })
    }

    /// Appends rows and flushes them.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn append(&mut self, rows: &[CertifyRow]) -> Result<(), OutputError> {
        self.table.rows(rows.iter().map(cells))
    }
}

fn header() -> Vec<String> {
    CERTIFY_COLUMNS.iter().map(|column| column.0.to_owned()).collect()
}

fn cells(row: &CertifyRow) -> Vec<String> {
    let Certified { check, newton } = &row.found;
    let certificate = &check.certificate;
    let v = &certificate.violation;
    let difference = check.difference.map_or([f64::NAN; 5], |d| [d.u, d.p, d.q, d.force[0], d.force[1]]);
    let solved = check.solved.as_ref().ok();
    let way = solved.map_or("", |solved| match solved.way {
        Way::Tresca => "tresca",
        Way::DeSaxce => "de-saxce",
    });
    let mut cells = vec![row.step.to_string(), number(check.time), check.verdict.name().to_owned()];
    cells.extend(difference.map(number));
    cells.push(newton.iterations.to_string());
    cells.push(solved.map_or(0, |solved| solved.programmes).to_string());
    cells.push(solved.map_or(0, |solved| solved.iterations).to_string());
    cells.extend([newton.wall_s, check.wall_s].map(number));
    cells.push(way.to_owned());
    let missed = v.sign.max(v.complementarity).max(v.cone).max(v.projection).max(certificate.status);
    let stationarity = certificate.increment.max(certificate.forces);
    cells.extend([v.equilibrium, missed, stationarity, certificate.duality_gap, certificate.coupling].map(number));
    cells.push(check.verdict.reason().to_owned());
    cells
}
