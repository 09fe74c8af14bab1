//! A law tried at one contact point: the file of `asperity laws NAME --probe FILE.toml`, and what it computes.

use std::path::Path;

use asperity_laws::drive::Failure;
use asperity_laws::{FrictionLaw, LawInfo};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Value;

use super::fail_on;
use super::grammar::Grammar;
use super::issue::{Issue, KeyPath, SceneError};
use super::programme::Programme;
use super::source::Source;
use super::spec::Units;
use super::tree::{Item, Node};
use crate::output::figures::point::write_figures;
use crate::output::tables::write_point;
use crate::output::{OutputError, RunFolder, UnitLabels};

/// A law and the programmes it is driven through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "probe of a friction law")]
pub struct Probe {
    /// Labels of the unit system; they label axes and columns and convert nothing.
    #[serde(default)]
    pub units: Units,
    /// The law; its `type` may be left out, as the command names it.
    #[schemars(schema_with = "asperity_laws::schema")]
    pub law: toml::Table,
    /// What the point goes through, one after another, each from the start.
    #[schemars(length(min = 1))]
    pub programme: Vec<Programme>,
}

impl Probe {
    /// Reads and checks a file for a law of the given record.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load(file: &Path, info: &LawInfo) -> Result<(Self, Box<dyn FrictionLaw>), SceneError> {
        Self::parse(file, Source::text_of(file, "probe")?, info)
    }

    /// As [`Probe::load`] with the text at hand; `file` is for messages only.
    ///
    /// # Errors
    /// As [`Probe::load`].
    pub fn parse(file: &Path, text: String, info: &LawInfo) -> Result<(Self, Box<dyn FrictionLaw>), SceneError> {
        let mut source = Source::parse(file, text)?;
        name_law(&mut source.root, info.name);
        Self::read(&source, info).map_err(|error| source.locate(error))
    }

    /// The structure of the file as a JSON schema.
    pub fn grammar() -> Grammar {
        Grammar::new(schemars::schema_for!(Self).to_value())
    }

    fn read(source: &Source, info: &LawInfo) -> Result<(Self, Box<dyn FrictionLaw>), SceneError> {
        let probe: Self = source.read(&Self::grammar())?;
        let key = KeyPath::of("law");
        if let Some(other) = probe.law.get("type").and_then(Value::as_str).filter(|other| *other != info.name) {
            let message = format!("this file is for the law `{other}`, not for `{}`", info.name);
            let allowed = format!("`{}`, or no `type` at all", info.name);
            return Err(Issue::value(key.at("type"), message).allowed(allowed).into());
        }
        let issues = probe.programme.iter().enumerate();
        fail_on(issues.filter_map(|(k, one)| one.check(&KeyPath::of("programme").at(k))).collect())?;
        let law = asperity_laws::parse(probe.law.clone());
        let law = law.map_err(|error| Issue::value(key.at(error.key()), error.to_string()))?;
        Ok((probe, law))
    }

    /// Drives the law through all programmes and writes tables and figures; a programme that breaks off is written as far as it
    /// came, and the others still run. Returns one entry a programme: its name, and why it broke off.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn run(
        &self,
        law: &dyn FrictionLaw,
        folder: &RunFolder,
    ) -> Result<Vec<(String, Option<Failure>)>, OutputError> {
        let Units { length, stress, time } = self.units.clone();
        let (units, variables) = (UnitLabels { length, stress, time }, law.variables());
        folder.write_point_readme(law.typetag_name(), &units, &variables)?;
        let programmes = self.programme.iter().enumerate().map(|(k, programme)| {
            let name = format!("{}-{}", k + 1, programme.kind());
            let history = programme.run(law);
            write_point(&folder.root().join(format!("{name}.csv")), &history.records, &variables)?;
            write_figures(&folder.figures()?, &name, &history.records, &variables, &units)?;
            Ok((name, history.failure))
        });
        programmes.collect()
    }
}

/// Adds the `type` that the command line implies.
fn name_law(root: &mut Node, name: &str) {
    let Item::Table(document) = &mut root.item else { return };
    let Some(Node { at, item: Item::Table(law), .. }) = document.get_mut("law") else { return };
    let (at, item) = (at.clone(), Item::Leaf(Value::String(name.into())));
    law.entry("type".into()).or_insert(Node { key_at: at.clone(), at, item });
}
