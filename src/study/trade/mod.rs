//! The trade of speed for accuracy: one scene under many numerical choices, each with its error and its cost.
//!
//! ```text
//! scene  ->  basis x size x integration  ->  reference and its own error  ->  one choice at a time, from the Pareto front  ->  advice
//! ```
//!
//! 1. Every basis at several element sizes, with element- and segment-wise integration, at the steps of the scene.
//! 2. The reference: the basis whose two finest sizes differ least, refined once more in space and in time. Its own error is estimated
//!    from its last levels ([`Estimate`]); smaller errors than that cannot be told apart, so the `bound` of a setting is
//!    `max(error, own) + own`, the largest over the quantities asked for.
//! 3. Coordinate search: from each setting that no other one dominates, one choice is changed at a time ([`Setting`]); a kind of change
//!    that failed twice in a row is given up. It ends when nothing new is left, or the effort is spent.
//!
//! Runs go one after the other, each in a folder of its own as in a sweep; cost is the CPU time of the thread that computes. The first run
//! of a program pays for cold caches and is computed twice. What is there already is not computed again, and as the search depends
//! on stored figures only, the same command again computes nothing.

mod advice;
mod explore;
mod figures;
mod found;
mod front;
mod levels;
mod measure;
mod memory;
mod moves;
mod norm;
mod recommended;
mod reference;
mod search;
mod setting;
mod table;
mod telling;
mod waste;

use std::path::{Path, PathBuf};

use crate::contact;
use crate::geometry::BasisSpec;
use crate::model::{Model, Pair};
use crate::scene::{ContactSpec, Grammar, Projection, Scene, SceneError, Source, build};

pub use advice::{Advice, TARGETS};
pub use figures::write_figures;
pub use found::{Ending, Found, Stop};
pub use front::{Cost, best_within, cheapest, front};
pub use measure::{Event, Measured, Role};
pub use moves::BASES;
pub use norm::{Curve, QUANTITIES, error};
pub use recommended::write_scene;
pub use reference::Estimate;
pub use search::search;
pub use setting::{Change, Choice, Setting};
pub use table::write_table;

/// A scene whose numerical choices are to be compared.
#[derive(Debug)]
pub struct Trade {
    base: Source,
    scene: Scene,
    base_dir: PathBuf,
    grammar: Grammar,
    /// Whether the mortar edge has corners of its own, whatever its basis.
    cornered: bool,
}

/// What is wanted of the search.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// Quantities whose errors count, as numbers into [`QUANTITIES`]; empty: `fx`, `fy`, `mu_global` where they say something.
    pub quantities: Vec<usize>,
    /// Where the search looks first.
    pub aim: Aim,
    /// CPU time in seconds that the whole search may take.
    pub effort: f64,
}

/// What the recommended settings are for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// The whole front.
    Front,
    /// The cheapest settings for this error.
    Error(f64),
    /// The smallest error for this CPU time in seconds.
    Budget(f64),
}

impl Trade {
    /// Reads and checks a scene, with `--set` arguments (`PATH=VALUE`) applied first.
    ///
    /// # Errors
    /// Everything that is wrong with the scene, each with its place.
    pub fn load(file: &Path, sets: &[String]) -> Result<Self, SceneError> {
        let (scene, base) = Scene::load(file, sets)?;
        let base_dir = file.parent().unwrap_or(Path::new(".")).to_path_buf();
        let model = build(&scene, &base_dir).map_err(|error| base.locate(error))?;
        let cornered = cornered(&scene, &model);
        Ok(Self { base, scene, base_dir, grammar: Scene::grammar(), cornered })
    }

    /// The scene as it was given.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene under a setting, as a source; `None` where the setting cannot be had.
    ///
    /// # Errors
    /// A key that the scene does not have.
    fn source(&self, setting: &Setting) -> Option<Result<Source, SceneError>> {
        let changes = setting.changes(self)?;
        let mut source = self.base.clone();
        let mut put = |(path, value): &Change| source.put(&self.grammar, path, value, &format!("{path} of the trade"));
        Some(changes.iter().try_for_each(&mut put).map(|()| source))
    }
}

/// Whether the mortar edge of the first pair has corners although its basis is smooth, as the program itself found.
fn cornered(scene: &Scene, model: &Model) -> bool {
    let smooth = |contact: &ContactSpec| {
        let body = scene.body.get(&contact.mortar.body);
        let auto = contact.numerics.projection == Projection::Auto;
        auto && body.is_some_and(|body| matches!(body.basis, BasisSpec::Nurbs { degree: 2.. }))
    };
    let ray = |pair: &Pair| pair.contact.numerics().projection == contact::Projection::Ray;
    scene.contact.first().is_some_and(smooth) && model.pairs.first().is_some_and(ray)
}
