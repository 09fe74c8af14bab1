//! Studies: one scene computed again and again with some of its values changed, and what comes out in one table.
//!
//! ```text
//! study.toml  ->  axes, formulas, quantities  ->  point (index)  ->  scene  ->  run in points/<hash>  ->  study.csv, figures
//! ```
//!
//! The folder of a point is named after its scene with all defaults, the files that scene reads, and the version of the program:
//! a point that is there already is not computed again, whatever else changed in the study.

mod axis;
mod compute;
mod figures;
mod folder;
mod formula;
mod point;
mod quantity;
mod rules;
mod spec;
mod status;
mod sweep;
mod table;
pub mod trade;

use std::path::{Path, PathBuf};

use crate::scene::{Grammar, KeyPath, OutputSpec, Scene, SceneError, Source};

use axis::Axis;
use formula::Formula;

pub use folder::StudyFolder;
pub use point::Point;
pub use spec::{AxisSpec, FigureSpec, Paths, QuantitySpec, Steps, StudySpec, Take, Values, ZipSpec};
pub use status::{PointState, PointStatus};
pub use sweep::{Event, Jobs, compute, sweep};
pub use table::{Collected, collect, listing};

/// A study, ready to make scenes.
#[derive(Debug)]
pub struct Study {
    spec: StudySpec,
    /// The study as written, for the lines of messages.
    source: Source,
    /// The scene with the changes common to all points.
    base: Source,
    /// Folder of the scene, for the files that it names.
    base_dir: PathBuf,
    grammar: Grammar,
    axes: Vec<Axis>,
    formulas: Vec<Formula>,
}

impl Study {
    /// Reads and checks a study file and its scene; `sets` (`PATH=VALUE`) change the scene of all points, after the study.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load(file: &Path, sets: &[String]) -> Result<Self, SceneError> {
        let source = Source::parse(file, Source::text_of(file, "study")?)?;
        let spec: StudySpec = source.read(&Self::grammar()).map_err(|error| source.locate(error))?;
        let (axes, formulas) = rules::check(&spec).map_err(|error| source.locate(error))?;
        let scene = file.parent().unwrap_or(Path::new(".")).join(&spec.scene);
        let unread = |error: SceneError| source.locate(rules::at_key(error, &KeyPath::of("scene")));
        let mut base = Source::parse(&scene, Source::text_of(&scene, "scene").map_err(unread)?)?;
        let grammar = Scene::grammar();
        for (k, argument) in spec.set.iter().enumerate() {
            let blamed = |error| source.locate(rules::at_key(error, &KeyPath::of("set").at(k)));
            base.set(&grammar, argument).map_err(blamed)?;
        }
        for argument in sets {
            base.set(&grammar, argument)?;
        }
        let base_dir = scene.parent().unwrap_or(Path::new(".")).to_path_buf();
        Ok(Self { spec, source, base, base_dir, grammar, axes, formulas })
    }

    /// The structure of the file as a JSON schema.
    pub fn grammar() -> Grammar {
        Grammar::new(schemars::schema_for!(StudySpec).to_value())
    }

    /// The study as written.
    pub fn spec(&self) -> &StudySpec {
        &self.spec
    }

    /// Folder in which the files are that its scene names.
    pub fn base_dir(&self) -> &Path {
        &self.base_dir
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// What a point writes.
    fn output(&self) -> OutputSpec {
        let history_only = OutputSpec { fields: 0, interface: 0, figures: false };
        self.spec.output.clone().unwrap_or(history_only)
    }

    /// Which value of each axis a point takes; the last axis runs fastest.
    fn places(&self, index: usize) -> Vec<usize> {
        let mut rest = index;
        let mut places: Vec<usize> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let place = rest % axis.values.len();
                rest /= axis.values.len();
                place
            })
            .collect();
        places.reverse();
        places
    }

    /// Values of all axes at a point, as text.
    pub fn coordinates(&self, index: usize) -> Vec<String> {
        self.places(index).into_iter().zip(&self.axes).map(|(place, axis)| axis.label(place)).collect()
    }

    /// Names of the axes.
    pub fn axis_names(&self) -> Vec<&str> {
        self.axes.iter().map(|axis| axis.name.as_str()).collect()
    }
}
