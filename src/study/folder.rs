//! The folder of a study: where its points, its table and its figures are.

use std::path::{Path, PathBuf};

use super::{Point, PointStatus, Study};
use crate::output::run_json::{write_atomic, write_json};
use crate::output::{OutputError, RunFolder};

/// The folder of a study.
#[derive(Clone, Debug)]
pub struct StudyFolder {
    root: PathBuf,
}

impl StudyFolder {
    /// The folder at a path, which need not exist.
    pub fn at(root: &Path) -> Self {
        Self { root: root.to_path_buf() }
    }

    /// Creates the folder, proves that it can be written, and leaves the index of the points in it.
    ///
    /// # Errors
    /// The path and the reason.
    pub fn prepare(&self, study: &Study, points: &[Point]) -> Result<(), OutputError> {
        RunFolder::create(&self.root)?;
        let first = points.first().and_then(|point| Some(study.scene(point.index).ok()?.0));
        let record = serde_json::json!({
            "program": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
            "study": study.spec(),
            "first_scene": first,
            "points": points.len(),
        });
        write_json(&self.root.join("study.json"), &record)?;
        let mut index = csv::Writer::from_writer(vec![]);
        let line = |name: &str, axes: Vec<&str>, folder: &str| -> Vec<String> {
            [name].into_iter().chain(axes).chain([folder]).map(str::to_owned).collect()
        };
        let path = self.root.join("index.csv");
        let bad = |error: csv::Error| OutputError::content(&path, error.to_string());
        index.write_record(line("index", study.axis_names(), "folder")).map_err(bad)?;
        for point in points {
            let values = study.coordinates(point.index);
            let values = values.iter().map(String::as_str).collect();
            let name = format!("points/{}", point.folder);
            index.write_record(line(&point.index.to_string(), values, &name)).map_err(bad)?;
        }
        let text = index.into_inner().map_err(|error| OutputError::content(&path, error.to_string()))?;
        write_atomic(&path, &text)
    }

    /// The folder itself.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Folder of a point.
    pub fn point(&self, point: &Point) -> PathBuf {
        self.root.join("points").join(&point.folder)
    }

    /// What is known of a point.
    pub fn status(&self, point: &Point) -> PointStatus {
        PointStatus::read(&self.point(point))
    }

    /// Path of the table.
    pub fn table(&self) -> PathBuf {
        self.root.join("study.csv")
    }
}
