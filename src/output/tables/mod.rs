//! `history.csv` and `interface.csv`: plain column names in the first line, one flushed row per record.

mod certify;
mod events;
mod history;
mod interface;
mod point;

pub use certify::{CERTIFY_COLUMNS, CertifyRow, CertifyWriter};
pub use events::{EVENT_COLUMNS, write_events};
pub use history::{HISTORY_COLUMNS, HistoryWriter, RATE_COLUMNS, history_columns, read_history};
pub use interface::{INTERFACE_COLUMNS, InterfaceWriter, read_interface};
pub use point::{POINT_COLUMNS, write_point};

use std::fs::{self, File, OpenOptions};
use std::path::Path;

use super::OutputError;
use super::run_json::write_atomic;

/// Shortest decimal text that reads back as the same `f64`; `nan`, `inf`, `-inf` in lower case.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value.is_nan() {
        "nan".into()
    } else if value.is_infinite() || magnitude == 0.0 || (1e-4..1e12).contains(&magnitude) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A table opened for appending; every row is in the file before `row` returns.
#[derive(Debug)]
struct Table {
    writer: csv::Writer<File>,
    path: std::path::PathBuf,
}

impl Table {
    /// Starts an empty table with its header line; an existing file is replaced.
    fn create(path: &Path, header: &[String]) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io("create", path))?;
        let mut table = Self::over(file, path);
        table.rows(std::iter::once(header.to_vec()))?;
        Ok(table)
    }

    /// Opens an existing table, drops rows of later steps and a last line cut by a kill, and appends from there.
    fn resume(path: &Path, header: &[String], last_step: usize) -> Result<Self, OutputError> {
        let text = fs::read_to_string(path).map_err(OutputError::io("read", path))?;
        write_atomic(path, kept_lines(&text, path, header, last_step)?.as_bytes())?;
        let file = OpenOptions::new().append(true).open(path).map_err(OutputError::io("append to", path))?;
        Ok(Self::over(file, path))
    }

    fn over(file: File, path: &Path) -> Self {
        Self { writer: csv::WriterBuilder::new().from_writer(file), path: path.to_path_buf() }
    }

    /// Writes whole rows and flushes them in one go.
    fn rows(&mut self, rows: impl Iterator<Item = Vec<String>>) -> Result<(), OutputError> {
        for row in rows {
            self.writer.write_record(&row).map_err(|error| OutputError::io("append to", &self.path)(error.into()))?;
        }
        self.writer.flush().map_err(OutputError::io("append to", &self.path))
    }

    /// Waits until all rows are on the disk itself.
    fn sync(&self) -> Result<(), OutputError> {
        self.writer.get_ref().sync_data().map_err(OutputError::io("write", &self.path))
    }
}

/// The header and the complete rows up to and including `last_step` (first column of every table).
fn kept_lines(text: &str, path: &Path, header: &[String], last_step: usize) -> Result<String, OutputError> {
    let expected = header.join(",");
    let mut kept = String::new();
    for (index, line) in text.split_inclusive('\n').enumerate() {
        if index == 0 && line.trim_end() != expected {
            return Err(OutputError::content(path, format!("expected the columns {expected}")));
        }
        let step = line.split(',').next().and_then(|cell| cell.parse::<usize>().ok());
        if line.ends_with('\n') && (index == 0 || step.is_some_and(|step| step <= last_step)) {
            kept.push_str(line);
        }
    }
    Ok(kept)
}

/// A table read back: the header and the rows as text.
type Cells = (Vec<String>, Vec<csv::StringRecord>);

/// Reads a table whose header must begin with `columns`.
fn read_cells(path: &Path, columns: &[&str]) -> Result<Cells, OutputError> {
    let bad = |error: csv::Error| OutputError::content(path, error.to_string());
    let mut reader = csv::ReaderBuilder::new().from_path(path).map_err(bad)?;
    let header: Vec<String> = reader.headers().map_err(bad)?.iter().map(str::to_owned).collect();
    if header.len() < columns.len() || header.iter().zip(columns).any(|(found, name)| found != name) {
        return Err(OutputError::content(path, format!("expected the columns {}", columns.join(","))));
    }
    let rows = reader.records().collect::<Result<_, _>>().map_err(bad)?;
    Ok((header, rows))
}

/// Columns of numbers, by name; `true` and `false` are 1 and 0. A last line cut by a kill is left out.
///
/// # Errors
/// A table without such a column, or file, line and column of a cell that is no number.
pub fn read_columns(path: &Path, names: &[&str]) -> Result<Vec<Vec<f64>>, OutputError> {
    let text = fs::read_to_string(path).map_err(OutputError::io("read", path))?;
    let mut lines = text.split_inclusive('\n').filter(|line| line.ends_with('\n')).map(str::trim_end);
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let place = |name: &&str| header.iter().position(|column| column == name);
    let missing = |name: &str| OutputError::content(path, format!("there is no column {name}"));
    let places: Vec<usize> = names.iter().map(|n| place(n).ok_or_else(|| missing(n))).collect::<Result<_, _>>()?;
    let mut columns = vec![vec![]; names.len()];
    for (k, line) in lines.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        for (column, (name, at)) in columns.iter_mut().zip(names.iter().zip(&places)) {
            let cell = cells.get(*at).copied().unwrap_or_default();
            let value = match cell {
                "true" => Some(1.0),
                "false" => Some(0.0),
                number => number.parse().ok(),
            };
            let bad = || OutputError::content(path, format!("line {}, column {name}: cannot read \"{cell}\"", k + 2));
            column.push(value.ok_or_else(bad)?);
        }
    }
    Ok(columns)
}

/// Reads the cells of one row from left to right, naming file, row and column in errors.
struct Row<'a> {
    cells: &'a csv::StringRecord,
    header: &'a [String],
    next: usize,
    path: &'a Path,
}

impl<'a> Row<'a> {
    fn new(cells: &'a csv::StringRecord, header: &'a [String], path: &'a Path) -> Self {
        Self { cells, header, next: 0, path }
    }

    fn take<T: std::str::FromStr>(&mut self) -> Result<T, OutputError> {
        let column = self.next;
        self.next += 1;
        let cell = self.cells.get(column).unwrap_or_default();
        cell.parse().map_err(|_| {
            let name = self.header.get(column).map_or("?", String::as_str);
            let line = self.cells.position().map_or(0, csv::Position::line);
            OutputError::content(self.path, format!("line {line}, column {name}: cannot read \"{cell}\""))
        })
    }

    fn pair(&mut self) -> Result<[f64; 2], OutputError> {
        Ok([self.take()?, self.take()?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::RunFolder;
    use crate::output::figures::synthetic;

    fn folder(name: &str) -> RunFolder {
        let root = std::env::temp_dir().join(format!("asperity-tables-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&root);
        RunFolder::create(&root).unwrap()
    }

    #[test]
    fn tables_read_back_bit_for_bit() {
        let folder = folder("round-trip");
        let mut records = synthetic::pass(5, 0.3);
        records[1].strain_energy = 1.0 / 3.0 * 1e-200;
        let mut rows = synthetic::interface(&records, 0.3);
        rows.iter_mut().for_each(|row| row.variables = vec![row.x / 3.0]);
        let (mut history, mut interface) = folder.tables(&["z".into()], false, None).unwrap();
        for record in &records {
            history.append(record).unwrap();
        }
        interface.append(&rows).unwrap();
        let back = read_history(&folder.history()).unwrap();
        assert_eq!(format!("{back:?}"), format!("{records:?}"));
        let back = read_interface(&folder.interface()).unwrap();
        assert_eq!(format!("{back:?}"), format!("{rows:?}"));
    }

    #[test]
    fn rows_are_on_disk_before_the_writer_is_gone() {
        let folder = folder("kill");
        let (mut history, _interface) = folder.tables(&[], false, None).unwrap();
        history.append(&synthetic::pass(5, 0.3)[0]).unwrap();
        let text = fs::read_to_string(folder.history()).unwrap();
        assert_eq!(text.lines().count(), 2);
        assert!(
            text.starts_with("step,time,drive_x,drive_y,fx,fy,mu_global,contact_angle,contact_length,pressure_max,")
        );
        assert!(text.contains(",nan,"), "mu_global without support: {text}");
    }

    #[test]
    fn resume_drops_later_and_half_written_rows() {
        let folder = folder("resume");
        let records = synthetic::pass(6, 0.3);
        let (mut history, _interface) = folder.tables(&[], false, None).unwrap();
        records[..4].iter().for_each(|record| history.append(record).unwrap());
        let whole = fs::read_to_string(folder.history()).unwrap();
        fs::write(folder.history(), &whole[..whole.len() - 9]).unwrap();
        let (mut history, _interface) = folder.tables(&[], false, Some(2)).unwrap();
        history.append(&records[2]).unwrap();
        let steps: Vec<_> = read_history(&folder.history()).unwrap().iter().map(|record| record.step).collect();
        assert_eq!(steps, [1, 2, 3]);
    }

    #[test]
    fn errors_name_file_line_and_column() {
        let folder = folder("errors");
        let (mut history, _interface) = folder.tables(&[], false, None).unwrap();
        history.append(&synthetic::pass(5, 0.3)[0]).unwrap();
        let text = fs::read_to_string(folder.history()).unwrap().replace(",true,0.1,", ",maybe,0.1,");
        fs::write(folder.history(), text).unwrap();
        let message = read_history(&folder.history()).unwrap_err().to_string();
        assert!(message.contains("history.csv: line 2, column converged") && message.contains("maybe"), "{message}");
        let message = RunFolder::create(Path::new("/dev/null/run")).unwrap_err().to_string();
        assert!(message.contains("/dev/null/run"), "{message}");
    }

    #[test]
    fn numbers_are_short_and_exact() {
        for (value, text) in
            [(0.1, "0.1"), (-0.0, "-0"), (1e-9, "1e-9"), (3.0, "3"), (f64::NAN, "nan"), (1e300, "1e300")]
        {
            assert_eq!(number(value), text);
        }
        for value in [std::f64::consts::PI * 1e-7, 2.0_f64.sqrt() * 1e13, f64::MIN_POSITIVE] {
            assert_eq!(number(value).parse::<f64>().unwrap(), value);
        }
    }
}
