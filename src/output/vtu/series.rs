//! The collection `fields.pvd`: all field outputs of a run with their times, rewritten atomically after each.

use std::fs;
use std::path::{Path, PathBuf};

use super::{BodyField, write_vtu};
use crate::output::OutputError;
use crate::output::run_json::write_atomic;

/// Field outputs of one run, listed in `fields.pvd`, stored in `fields/`.
#[derive(Debug)]
pub struct FieldSeries {
    root: PathBuf,
    entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
struct Entry {
    step: usize,
    time: String,
}

impl FieldSeries {
    /// Opens the series of the run folder `root`: empty (field files of an earlier run are removed), or, with
    /// `resume_after`, with the outputs listed so far up to that step.
    ///
    /// # Errors
    /// The path and the reason if folder or collection cannot be created or read.
    pub fn open(root: &Path, resume_after: Option<usize>) -> Result<Self, OutputError> {
        let folder = root.join("fields");
        fs::create_dir_all(&folder).map_err(OutputError::io("create", &folder))?;
        let collection = root.join("fields.pvd");
        let listed = match resume_after {
            Some(_) if collection.exists() => {
                fs::read_to_string(&collection).map_err(OutputError::io("read", &collection))?
            }
            _ => String::new(),
        };
        let mut entries: Vec<Entry> = listed.lines().filter_map(Entry::parse).collect();
        entries.retain(|entry| resume_after.is_some_and(|step| entry.step <= step));
        let series = Self { root: root.to_path_buf(), entries };
        series.remove_unlisted(&folder)?;
        series.write_collection()?;
        Ok(series)
    }

    /// Writes `fields/step_<step>.vtu` and lists it; returns the path of the file.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn append(&mut self, step: usize, time: f64, bodies: &[BodyField]) -> Result<PathBuf, OutputError> {
        let entry = Entry { step, time: format!("{time:?}") };
        let path = self.root.join(entry.file());
        write_vtu(&path, time, bodies)?;
        self.entries.retain(|listed| listed.step != step);
        self.entries.push(entry);
        self.write_collection()?;
        Ok(path)
    }

    fn write_collection(&self) -> Result<(), OutputError> {
        let mut xml =
            String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
        for entry in &self.entries {
            let (time, file) = (&entry.time, entry.file());
            xml.push_str(&format!("<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>\n"));
        }
        xml.push_str("</Collection>\n</VTKFile>\n");
        write_atomic(&self.root.join("fields.pvd"), xml.as_bytes())
    }

    /// Removes field files that belong to no listed output: a viewer would mix them with the new ones.
    fn remove_unlisted(&self, folder: &Path) -> Result<(), OutputError> {
        let listed: Vec<String> = self.entries.iter().map(Entry::file).collect();
        for file in fs::read_dir(folder).map_err(OutputError::io("read", folder))? {
            let path = file.map_err(OutputError::io("read", folder))?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let ours = name.starts_with("step_") && name.ends_with(".vtu");
            if ours && !listed.contains(&format!("fields/{name}")) {
                fs::remove_file(&path).map_err(OutputError::io("remove", &path))?;
            }
        }
        Ok(())
    }
}

impl Entry {
    fn file(&self) -> String {
        format!("fields/step_{:06}.vtu", self.step)
    }

    /// Reads a line written by `write_collection`; other lines are none.
    fn parse(line: &str) -> Option<Self> {
        let after = |text: &str| line.split_once(text).map(|(_, rest)| rest.to_owned());
        let time = after("timestep=\"")?.split_once('"')?.0.to_owned();
        let step = after("fields/step_")?.split_once(".vtu")?.0.parse().ok()?;
        Some(Self { step, time })
    }
}
