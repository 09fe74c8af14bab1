//! The scene: what the user writes in TOML, checked so that every complaint names file, line, key and what is allowed.
//!
//! ```text
//! text + --set  ->  tree with positions  ->  structure (JSON schema)  ->  Scene  ->  rules  ->  build  ->  Model
//! ```
//!
//! [`Scene`] is plain data with all defaults filled in; a program may as well make one itself, and `build` either kind.

mod build;
mod certify;
mod checkpoint;
mod describe;
mod dynamics;
mod fields;
mod grammar;
mod issue;
mod motion;
mod numerics;
mod probe;
mod programme;
mod recorder;
mod rules;
mod run;
mod schema;
mod set;
mod source;
mod spec;
mod tree;

use std::path::Path;

pub use build::build;
pub use checkpoint::{Checkpoint, ResumeError};
pub use describe::{left_out, modelled, size_lines};
pub use dynamics::DynamicsSpec;
pub use grammar::Grammar;
pub use issue::{Focus, Issue, KeyPath, Place, SceneError};
pub use motion::{Components, Course, DriveSpec, Motion, SupportSpec, TimeTable};
pub use numerics::{Integration, Numerics, Projection, Sites, Solution, Solver};
pub use probe::Probe;
pub use programme::Programme;
pub use run::{RunReport, resume, run, sizes, status_name, time_plan};
pub use source::Source;
pub use spec::{BodySpec, ContactSpec, MaterialSpec, OutputSpec, Scene, Side, TimeSpec, Units};

impl Scene {
    /// Reads and checks a scene file, with `--set` arguments (`PATH=VALUE`) applied first. The source is returned for
    /// [`Source::locate`], which gives later errors (of `build`) their lines.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load(file: &Path, sets: &[String]) -> Result<(Self, Source), SceneError> {
        Self::parse(file, Source::text_of(file, "scene")?, sets)
    }

    /// As [`Scene::load`] with the text at hand; `file` is for messages only.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn parse(file: &Path, text: String, sets: &[String]) -> Result<(Self, Source), SceneError> {
        let grammar = Scene::grammar();
        let mut source = Source::parse(file, text)?;
        for argument in sets {
            source.set(&grammar, argument)?;
        }
        Ok((Self::of(&grammar, &source)?, source))
    }

    /// Reads and checks the scene that a source holds; `grammar` is [`Scene::grammar`], made once for many scenes.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn of(grammar: &Grammar, source: &Source) -> Result<Self, SceneError> {
        read(grammar, source).map_err(|error| source.locate(error))
    }

    /// The structure of a scene as a JSON schema.
    pub fn grammar() -> Grammar {
        Grammar::new(schemars::schema_for!(Scene).to_value())
    }

    /// Rules that join several values; [`Scene::load`] has applied them already.
    ///
    /// # Errors
    /// Everything that is wrong, without lines.
    pub fn check(&self) -> Result<(), SceneError> {
        fail_on(rules::check(self))
    }
}

fn fail_on(issues: Vec<Issue>) -> Result<(), SceneError> {
    if issues.is_empty() { Ok(()) } else { Err(SceneError(issues)) }
}

fn read(grammar: &Grammar, source: &Source) -> Result<Scene, SceneError> {
    let mut scene: Scene = source.read(grammar)?;
    scene.check()?;
    scene.fill_in_defaults();
    Ok(scene)
}

impl Scene {
    /// Defaults that the structs do not know: the parameters of the laws.
    fn fill_in_defaults(&mut self) {
        for contact in &mut self.contact {
            let law = asperity_laws::parse(contact.law.clone()).ok();
            if let Some(table) = law.and_then(|law| toml::Table::try_from(&*law).ok()) {
                contact.law = table;
            }
        }
    }
}
