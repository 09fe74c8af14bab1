//! A run or a study as one HTML file that needs nothing else: no network, no other file.
//!
//! Everything in it is read from the folder: `run.json`, `history.csv` and the figures of a run, `study.json`, `study.csv` and the
//! figures of a study.

mod figures;
mod html;
mod numbers;
mod run;
mod study;

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::OutputError;
use super::run_json::write_atomic;

/// Writes the report of a folder to `target`, by default `report.html` in it, and returns the path.
///
/// # Errors
/// A folder that holds neither a run nor a study, a file of it that cannot be read, or a target that cannot be written.
pub fn write_report(folder: &Path, target: Option<&Path>) -> Result<PathBuf, OutputError> {
    let page = if folder.join("study.json").is_file() {
        study::page(folder)?
    } else if folder.join("run.json").is_file() {
        run::page(folder)?
    } else {
        return Err(OutputError::content(folder, "neither run.json nor study.json: no folder of a run or a study"));
    };
    let path = target.map_or_else(|| folder.join("report.html"), Path::to_path_buf);
    write_atomic(&path, page.as_bytes())?;
    Ok(path)
}

fn read_json(path: &Path) -> Result<Value, OutputError> {
    let text = fs::read_to_string(path).map_err(OutputError::io("read", path))?;
    serde_json::from_str(&text).map_err(|error| OutputError::content(path, error.to_string()))
}

/// Texts of a list; nothing where there is none.
fn texts(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect()
}

/// JSON as TOML; what TOML cannot hold is left out.
fn toml_of(value: &Value) -> String {
    fn known(value: &Value) -> Option<Value> {
        match value {
            Value::Null => None,
            Value::Object(map) => {
                Some(Value::Object(map.iter().filter_map(|(key, v)| Some((key.clone(), known(v)?))).collect()))
            }
            Value::Array(values) => Some(Value::Array(values.iter().filter_map(known).collect())),
            other => Some(other.clone()),
        }
    }
    known(value).and_then(|value| toml::to_string(&value).ok()).unwrap_or_default()
}
