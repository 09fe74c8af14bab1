//! The Newton solution against the conic one over time: differences, and what both cost.

use std::path::{Path, PathBuf};

use super::axis::range;
use super::chart::{Chart, Column, Series};
use super::palette::{BLUE, GREEN, INK, VERMILLION};
use super::save;
use crate::output::tables::CertifyRow;
use crate::output::{OutputError, Quantity, UnitLabels};
use crate::verify::conic::Difference;

/// Differences below this are not drawn: the same to round-off, or nothing touches.
const ROUND_OFF: f64 = 1e-16;

/// Writes `certify` as SVG and PNG and returns the paths; nothing for fewer than two rows.
///
/// # Errors
/// The path and the reason if a file cannot be written.
pub fn write(folder: &Path, rows: &[CertifyRow], units: &UnitLabels) -> Result<Vec<PathBuf>, OutputError> {
    if rows.len() < 2 {
        return Ok(vec![]);
    }
    Ok(save(folder, "certify", &svg(rows, units))?.into())
}

fn svg(rows: &[CertifyRow], units: &UnitLabels) -> String {
    let curve = |value: &dyn Fn(&CertifyRow) -> f64| -> Vec<[f64; 2]> {
        let seen = |value: f64| if value > ROUND_OFF { value.log10() } else { f64::NAN };
        rows.iter().map(|row| [row.found.check.time, seen(value(row))]).collect()
    };
    let of = |value: &'static dyn Fn(&Difference) -> f64| {
        curve(&move |row| row.found.check.difference.as_ref().map_or(f64::NAN, value))
    };
    let differences = vec![
        Series::new("pressure", BLUE, of(&|d| d.p)),
        Series::new("traction", VERMILLION, of(&|d| d.q)).dashed("5 1.6"),
        Series::new("force", GREEN, of(&|d| d.force[0].max(d.force[1]))).dashed("1.6 1.6"),
    ];
    let cost = vec![
        Series::new("Newton", INK, curve(&|row| row.found.newton.wall_s)),
        Series::new("conic", BLUE, curve(&|row| row.found.check.wall_s)).dashed("5 1.6"),
    ];
    let end = rows.last().map_or(1.0, |row| row.found.check.time);
    Column {
        x_label: units.axis("time", Quantity::Time),
        x_range: [0.0, end],
        charts: vec![chart("log_{10} difference", 104.0, differences), chart("log_{10} wall time (s)", 60.0, cost)],
        ..Column::default()
    }
    .draw()
}

fn chart(y_label: &str, height: f64, series: Vec<Series>) -> Chart {
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]).filter(|v| v.is_finite());
    Chart { y_label: y_label.into(), y_range: range(values, 0.08), height, series, ..Chart::default() }
}
