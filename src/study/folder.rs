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
        self.write_index(study, points)
    }

    /// `index.csv`: number, values of the axes and folder of every point.
    fn write_index(&self, study: &Study, points: &[Point]) -> Result<(), OutputError> {
        let path = self.root.join("index.csv");
        let bad = |error: csv::Error| OutputError::content(&path, error.to_string());
        let mut index = csv::Writer::from_writer(vec![]);
        index.write_record(["index"].into_iter().chain(study.axis_names()).chain(["folder"])).map_err(bad)?;
        for point in points {
            let mut cells = vec![point.index.to_string()];
            cells.extend(study.coordinates(point.index));
            cells.push(format!("points/{}", point.folder));
            index.write_record(cells).map_err(bad)?;
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
