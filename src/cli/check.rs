//! `asperity check`: what is modelled, what is left out, why, and how large it is.

use std::path::Path;

use crate::model::Model;
use crate::scene::{Scene, build, left_out, modelled, size_lines, time_plan};
use crate::verify;

use super::SceneArguments;
use super::outcome::{Exit, Failure, say};

/// Reads and builds a scene, with the lines of all that is wrong.
pub fn load(arguments: &SceneArguments) -> Result<(Scene, Model), Failure> {
    let (scene, source) = Scene::load(&arguments.scene, &arguments.sets)?;
    let base_dir = arguments.scene.parent().unwrap_or(Path::new("."));
    let model = build(&scene, base_dir).map_err(|error| source.locate(error))?;
    Ok((scene, model))
}

/// Validates a scene and prints the model chosen.
pub fn check(arguments: &SceneArguments) -> Result<Exit, Failure> {
    let (scene, model) = load(arguments)?;
    say(&describe(&scene, &model))?;
    Ok(Exit::Done)
}

fn describe(scene: &Scene, model: &Model) -> String {
    let warnings = verify::warnings(model, &time_plan(scene));
    let section = |title: &str, lines: &[String]| -> String {
        let lines: String = lines.iter().map(|line| format!("  - {line}\n")).collect();
        format!("{title}\n{lines}")
    };
    format!(
        "{}\n{}{}{}{}",
        if scene.title.is_empty() { "(no title)" } else { &scene.title },
        section("modelled:", &modelled(scene, model)),
        section("left out, because:", &left_out(scene, model)),
        section("sizes:", &size_lines(scene, model)),
        if warnings.is_empty() { String::new() } else { section("warnings:", &warnings) },
    )
}
