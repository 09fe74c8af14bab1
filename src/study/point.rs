//! One point of a study: its scene, and the name of its folder.

use std::path::Path;

use serde_json::Value as Json;
use toml::Value;

use super::Study;
use super::axis::{number, plain, whole};
use super::rules::at_key;
use crate::output::fingerprint;
use crate::scene::{Issue, KeyPath, Place, Scene, SceneError, Source};

/// A point of a study that can be computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Number of the point, from 0; the last axis runs fastest.
    pub index: usize,
    /// Name of its folder: 16 hexadecimal digits.
    pub folder: String,
    /// Nominal steps of its scene.
    pub steps: usize,
}

impl Study {
    /// The point of a number.
    ///
    /// # Errors
    /// A scene that breaks a rule, with the line of the study that makes it so.
    pub fn point(&self, index: usize) -> Result<Point, SceneError> {
        let (scene, _) = self.scene(index)?;
        let folder = folder_name(&scene, &self.base_dir);
        Ok(Point { index, folder, steps: scene.time.steps })
    }

    /// All points, in order.
    ///
    /// # Errors
    /// As [`Study::point`], of the first point that fails.
    pub fn points(&self) -> Result<Vec<Point>, SceneError> {
        (0..self.count()).map(|index| self.point(index)).collect()
    }

    /// The scene of a point, and the source that gives later errors their places.
    ///
    /// # Errors
    /// As [`Study::point`].
    pub(super) fn scene(&self, index: usize) -> Result<(Scene, Source), SceneError> {
        let mut source = self.base.clone();
        let mut said: Vec<(KeyPath, KeyPath)> = vec![];
        let read = self.put_all(index, &mut source, &mut said).and_then(|()| Scene::of(&self.grammar, &source));
        let mut scene = read.map_err(|error| self.blamed(error, index, &said))?;
        scene.output = self.output();
        scene.title = self.title(&scene.title, index);
        Ok((scene, source))
    }

    /// Puts the values of the axes and formulas into the scene; notes where each of them came from.
    fn put_all(&self, index: usize, source: &mut Source, said: &mut Vec<(KeyPath, KeyPath)>) -> Result<(), SceneError> {
        let places = self.places(index);
        let mut put = |path: &KeyPath, path_at: &KeyPath, value: &Value, origin: KeyPath| {
            let put = source.put(&self.grammar, path, value, &origin.to_string());
            said.push((path.clone(), origin));
            put.map_err(|error| self.source.locate(at_key(error, path_at)))
        };
        for (axis, place) in self.axes.iter().zip(&places) {
            for effect in &axis.effects {
                put(&effect.path, &effect.path_at, &effect.values[*place], effect.origin.at(place))?;
            }
        }
        let value = |(axis, place): (&super::Axis, &usize)| number(&axis.values[*place]).unwrap_or(0.0);
        let numbers: Vec<f64> = self.axes.iter().zip(&places).map(value).collect();
        for formula in &self.formulas {
            put(&formula.path, &formula.origin, &whole(formula.value(&numbers)), formula.origin.clone())?;
        }
        Ok(())
    }

    /// Issues with values that the study put in, moved to the lines of the study.
    fn blamed(&self, error: SceneError, index: usize, said: &[(KeyPath, KeyPath)]) -> SceneError {
        let moved = |issue: Issue| {
            let Some(Place::Argument(text)) = issue.place.as_deref() else { return issue };
            let Some((path, origin)) = said.iter().find(|(_, origin)| origin.to_string() == *text) else {
                return issue;
            };
            let help = format!("this is `{path}` of the scene at point {index}: {}", self.said(index));
            Issue { key: origin.clone(), place: None, ..issue }.help(help)
        };
        self.source.locate(SceneError(error.0.into_iter().map(moved).collect()))
    }

    /// The values of the axes in one line.
    pub(super) fn said(&self, index: usize) -> String {
        let places = self.places(index);
        let one = |(axis, place): (&super::Axis, &usize)| format!("{} = {}", axis.name, plain(&axis.values[*place]));
        self.axes.iter().zip(&places).map(one).collect::<Vec<_>>().join(", ")
    }

    fn title(&self, scene: &str, index: usize) -> String {
        let own = if self.spec.title.is_empty() { scene } else { &self.spec.title };
        format!("{own}: {}", self.said(index))
    }
}

/// Hash of the scene with all defaults, of the files that it reads, and of the version of the program. What is only said
/// about a scene (its title) does not count.
pub(super) fn folder_name(scene: &Scene, base_dir: &Path) -> String {
    let mut json = serde_json::to_value(scene).unwrap_or_default();
    if let Some(scene) = json.as_object_mut() {
        scene.remove("title");
    }
    let mut text = format!("{} {json}", env!("CARGO_PKG_VERSION"));
    for file in files(&json["body"]) {
        // a file that cannot be read is reported when the scene is built
        text += &std::fs::read_to_string(base_dir.join(file)).unwrap_or_default();
    }
    format!("{:016x}", fingerprint(&text))
}

/// Everything named `file` in the shapes of bodies.
fn files(json: &Json) -> Vec<&str> {
    match json {
        Json::Object(map) => {
            let own = map.get("file").and_then(Json::as_str);
            own.into_iter().chain(map.values().flat_map(files)).collect()
        }
        Json::Array(values) => values.iter().flat_map(files).collect(),
        _ => vec![],
    }
}
