//! What came out of a study: one tidy table, its figures, and the list of points on the terminal.

use super::rules::FIXED;
use super::{Point, PointState, PointStatus, Study, StudyFolder, figures, quantity};
use crate::output::OutputError;
use crate::output::run_json::write_atomic;
use crate::output::tables::number;

/// All points of a study with what is known of them.
#[derive(Debug)]
pub struct Collected {
    /// One row for each point, in order.
    pub(super) rows: Vec<Row>,
    /// Figures that were not drawn because there would be too many of them.
    pub figures_left_out: usize,
}

/// A row of the table.
#[derive(Debug)]
pub(super) struct Row {
    pub status: PointStatus,
    /// One value for each quantity; `nan` where it is not known.
    pub values: Vec<f64>,
}

impl Collected {
    /// Number of points in a state.
    pub fn count(&self, state: PointState) -> usize {
        self.rows.iter().filter(|row| row.status.status == state).count()
    }

    /// States that occur with their numbers, in words.
    pub fn summary(&self) -> String {
        summary(self.rows.iter().map(|row| row.status.status))
    }
}

fn summary(states: impl Iterator<Item = PointState>) -> String {
    let mut counts: Vec<(PointState, usize)> = vec![];
    for state in states {
        match counts.iter_mut().find(|(known, _)| *known == state) {
            Some((_, count)) => *count += 1,
            None => counts.push((state, 1)),
        }
    }
    let total: usize = counts.iter().map(|(_, count)| count).sum();
    let parts: Vec<String> = counts.iter().map(|(state, count)| format!("{count} {}", state.name())).collect();
    format!("{total} points: {}", parts.join(", "))
}

/// Writes `study.csv` and the figures from what the folders of the points hold.
///
/// # Errors
/// A history that cannot be read back, or a file that cannot be written.
pub fn collect(study: &Study, folder: &StudyFolder, points: &[Point]) -> Result<Collected, OutputError> {
    let rows = points.iter().map(|point| row(study, folder, point)).collect::<Result<Vec<_>, _>>()?;
    write(study, folder, points, &rows)?;
    let figures_left_out = figures::write(study, folder, points, &rows)?;
    Ok(Collected { rows, figures_left_out })
}

/// Quantities of a run that ended early would be those of another run: only complete ones count.
fn row(study: &Study, folder: &StudyFolder, point: &Point) -> Result<Row, OutputError> {
    let status = folder.status(point);
    let specs = &study.spec().quantity;
    let complete = matches!(status.status, PointState::Done | PointState::AuditFailed);
    let values = match complete {
        true => quantity::collect(&folder.point(point).join("history.csv"), specs)?,
        false => vec![f64::NAN; specs.len()],
    };
    Ok(Row { status, values })
}

fn write(study: &Study, folder: &StudyFolder, points: &[Point], rows: &[Row]) -> Result<(), OutputError> {
    let path = folder.table();
    let bad = |error: csv::Error| OutputError::content(&path, error.to_string());
    let mut table = csv::Writer::from_writer(vec![]);
    let [index, status, reason, place, wall] = FIXED;
    let quantities = study.spec().quantity.iter().map(|quantity| quantity.name.as_str());
    let names = [index].into_iter().chain(study.axis_names()).chain(quantities);
    table.write_record(names.chain([status, reason, place, wall])).map_err(bad)?;
    for (point, row) in points.iter().zip(rows) {
        let mut cells = vec![point.index.to_string()];
        cells.extend(study.coordinates(point.index));
        cells.extend(row.values.iter().map(|value| number(*value)));
        cells.extend([row.status.status.name().to_owned(), row.status.reason.clone()]);
        cells.extend([format!("points/{}", point.folder), number(row.status.wall_s)]);
        table.write_record(cells).map_err(bad)?;
    }
    let text = table.into_inner().map_err(|error| OutputError::content(&path, error.to_string()))?;
    write_atomic(&path, &text)
}

/// Index, values of the axes, state and folder of every point, in aligned columns, and their numbers in the last line.
pub fn listing(study: &Study, folder: &StudyFolder, points: &[Point]) -> String {
    let states: Vec<PointState> = points.iter().map(|point| folder.status(point).status).collect();
    let mut lines: Vec<Vec<String>> = Vec::with_capacity(points.len() + 1);
    let heads = ["index"].into_iter().chain(study.axis_names()).chain(["status", "folder"]);
    lines.push(heads.map(str::to_owned).collect());
    for (point, state) in points.iter().zip(&states) {
        let mut cells = vec![point.index.to_string()];
        cells.extend(study.coordinates(point.index));
        cells.extend([state.name().to_owned(), format!("points/{}", point.folder)]);
        lines.push(cells);
    }
    let widths: Vec<usize> =
        (0..lines[0].len()).map(|k| lines.iter().map(|cells| cells[k].chars().count()).max().unwrap_or(0)).collect();
    let mut text = String::new();
    for cells in &lines {
        let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}"));
        text += padded.collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    text + &format!("{}; folder {}\n", summary(states.into_iter()), folder.root().display())
}
