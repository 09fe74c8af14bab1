//! Recommended settings as a scene of its own.

use std::path::Path;

use toml::Value;

use super::{Measured, Trade};
use crate::output::OutputError;
use crate::output::run_json::write_atomic;

/// Writes the scene under the settings of a point to `path`, with `comment` in its head. Files that the scene names are named by
/// their full paths, so that the new scene may lie anywhere; comments of the old one are lost.
///
/// # Errors
/// The path and the operating system's reason.
pub fn write_scene(trade: &Trade, point: &Measured, comment: &str, path: &Path) -> Result<(), OutputError> {
    let source = trade.source(&point.setting).unwrap_or_else(|| Ok(trade.base.clone()));
    let source = source.map_err(|error| OutputError::content(path, error.to_string()))?;
    let mut scene = source.to_value();
    if let Some(bodies) = scene.get_mut("body") {
        absolute(bodies, &trade.base_dir);
    }
    let text = toml::to_string(&scene).map_err(|error| OutputError::content(path, error.to_string()))?;
    let comment: String = comment.lines().map(|line| format!("# {line}\n")).collect();
    write_atomic(path, format!("{comment}{text}").as_bytes())
}

/// Replaces everything named `file` by its full path.
fn absolute(value: &mut Value, base_dir: &Path) {
    match value {
        Value::Table(table) => {
            for (key, value) in table.iter_mut() {
                match value {
                    Value::String(file) if key == "file" => {
                        let full = base_dir.join(&*file);
                        *file = full.canonicalize().unwrap_or(full).to_string_lossy().into_owned();
                    }
                    other => absolute(other, base_dir),
                }
            }
        }
        Value::Array(values) => values.iter_mut().for_each(|value| absolute(value, base_dir)),
        _ => {}
    }
}
