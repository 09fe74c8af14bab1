//! The folder of one run: paths of everything in it, and an early refusal where nothing could be written.

use std::fs;
use std::path::{Path, PathBuf};

use asperity_laws::Variable;

use super::run_json::{remove_hidden, write_atomic, write_json};
use super::tables::{HistoryWriter, InterfaceWriter};
use super::vtu::FieldSeries;
use super::{OutputError, UnitLabels, readme};

/// The output folder of a run, known to be writable.
#[derive(Clone, Debug)]
pub struct RunFolder {
    root: PathBuf,
}

impl RunFolder {
    /// Creates the folder with its parents, or takes an existing one, and proves by a probe file that it can be written.
    ///
    /// # Errors
    /// The path and the reason, before any time is spent on a computation.
    pub fn create(root: &Path) -> Result<Self, OutputError> {
        fs::create_dir_all(root).map_err(OutputError::io("create the output folder", root))?;
        let probe = root.join(format!(".writable.{}.tmp", std::process::id()));
        fs::write(&probe, b"").map_err(OutputError::io("write into the output folder", root))?;
        fs::remove_file(&probe).map_err(OutputError::io("write into the output folder", root))?;
        Ok(Self { root: root.to_path_buf() })
    }

    /// Removes what a program that was killed in the middle of writing left behind.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn tidy(&self) -> Result<(), OutputError> {
        let folders = ["", "checkpoint", "fields", "figures"];
        folders.iter().try_for_each(|folder| remove_hidden(&self.root.join(folder)))
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// True if the folder already holds a `run.json` or a `history.csv`.
    pub fn holds_results(&self) -> bool {
        [self.run_json(), self.history()].iter().any(|path| path.exists())
    }

    /// Path of `history.csv`.
    pub fn history(&self) -> PathBuf {
        self.root.join("history.csv")
    }

    /// Path of `interface.csv`.
    pub fn interface(&self) -> PathBuf {
        self.root.join("interface.csv")
    }

    /// Path of `certify.csv`.
    pub fn certify(&self) -> PathBuf {
        self.root.join("certify.csv")
    }

    /// Path of `events.csv`.
    pub fn events(&self) -> PathBuf {
        self.root.join("events.csv")
    }

    /// Path of `run.json`.
    pub fn run_json(&self) -> PathBuf {
        self.root.join("run.json")
    }

    /// Folder of the checkpoint.
    pub fn checkpoint(&self) -> PathBuf {
        self.root.join("checkpoint")
    }

    /// True if `history.csv` holds at least one row.
    pub fn holds_rows(&self) -> bool {
        fs::read_to_string(self.history()).is_ok_and(|text| text.lines().nth(1).is_some())
    }

    /// Folder of the figures, created on first use.
    ///
    /// # Errors
    /// The path and the reason if it cannot be created.
    pub fn figures(&self) -> Result<PathBuf, OutputError> {
        let path = self.root.join("figures");
        fs::create_dir_all(&path).map_err(OutputError::io("create", &path))?;
        Ok(path)
    }

    /// Opens both tables (that of the history with `rates` or without, see [`super::tables::RATE_COLUMNS`]): anew, or, with `resume_after`, continued behind that step.
    ///
    /// # Errors
    /// The path and the reason if one of them cannot be opened.
    pub fn tables(
        &self,
        variables: &[String],
        rates: bool,
        resume_after: Option<usize>,
    ) -> Result<(HistoryWriter, InterfaceWriter), OutputError> {
        let (history, interface) = (self.history(), self.interface());
        match resume_after {
            None => Ok((HistoryWriter::create(&history, rates)?, InterfaceWriter::create(&interface, variables)?)),
            Some(step) => Ok((
                HistoryWriter::resume(&history, rates, step)?,
                InterfaceWriter::resume(&interface, variables, step)?,
            )),
        }
    }

    /// Opens the series of field files: empty, or, with `resume_after`, the listed outputs up to that step.
    ///
    /// # Errors
    /// The path and the reason if the folder cannot be created or the collection not be read.
    pub fn fields(&self, resume_after: Option<usize>) -> Result<FieldSeries, OutputError> {
        FieldSeries::open(&self.root, resume_after)
    }

    /// Writes `run.json` atomically.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn write_run(&self, value: &serde_json::Value) -> Result<(), OutputError> {
        write_json(&self.run_json(), value)
    }

    /// Writes `README.txt` of a law that was driven at one point: every column with its unit.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn write_point_readme(&self, law: &str, units: &UnitLabels, variables: &[Variable]) -> Result<(), OutputError> {
        let text = readme::point_text(law, units, variables);
        write_atomic(&self.root.join("README.txt"), text.as_bytes())
    }

    /// Writes `README.txt`: every file and column with its unit.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn write_readme(
        &self,
        title: &str,
        units: &UnitLabels,
        variables: &[(String, String)],
        rates: bool,
    ) -> Result<(), OutputError> {
        let text = readme::text(title, units, variables, rates);
        write_atomic(&self.root.join("README.txt"), text.as_bytes())
    }
}
