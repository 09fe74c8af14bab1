//! `run.json` and every other file that is replaced as a whole: readers see the old or the new content, never a part.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;

/// Writes a JSON value, indented, atomically (see [`write_atomic`]).
///
/// # Errors
/// The path and the operating system's reason if the file cannot be written.
pub fn write_json(path: &Path, value: &serde_json::Value) -> Result<(), OutputError> {
    write_atomic(path, format!("{value:#}\n").as_bytes())
}

/// Writes `bytes` to a hidden file in the same folder, syncs it and renames it over `path`.
///
/// The same folder, because a rename across file systems is a copy and no longer atomic.
///
/// # Errors
/// The path and the operating system's reason; the hidden file is removed and an existing `path` stays as it was.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    replace(path, bytes, true)
}

/// As [`write_atomic`]; without `sync` a killed program leaves the old or the new content, a power failure perhaps neither.
///
/// # Errors
/// As [`write_atomic`].
pub fn replace(path: &Path, bytes: &[u8], sync: bool) -> Result<(), OutputError> {
    let hidden = hidden_beside(path);
    let written = write_hidden(&hidden, bytes, sync)
        .map_err(OutputError::io("write", path))
        .and_then(|()| fs::rename(&hidden, path).map_err(OutputError::io("replace", path)));
    if written.is_err() {
        // Nothing more can be done if even this fails: the first error is the one to report.
        let _ = fs::remove_file(&hidden);
    }
    written
}

/// Removes hidden files that a killed program left in a folder, if there is one.
///
/// # Errors
/// The path and the operating system's reason.
pub fn remove_hidden(folder: &Path) -> Result<(), OutputError> {
    let Ok(entries) = fs::read_dir(folder) else { return Ok(()) };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let process = name.strip_suffix(".tmp").and_then(|name| name.rsplit('.').next()?.parse::<u32>().ok());
        if name.starts_with('.') && process.is_some() {
            fs::remove_file(&path).map_err(OutputError::io("remove", &path))?;
        }
    }
    Ok(())
}

fn write_hidden(path: &Path, bytes: &[u8], sync: bool) -> std::io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    if sync { file.sync_all() } else { Ok(()) }
}

fn hidden_beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.tmp", std::process::id()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_behind() {
        let folder = std::env::temp_dir().join(format!("asperity-json-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("run.json");
        for value in [serde_json::json!({"a": 1e-300}), serde_json::json!({"b": [1, 2]})] {
            write_json(&path, &value).unwrap();
            let back: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            assert_eq!(back, value);
        }
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::write(hidden_beside(&path), "half").unwrap();
        remove_hidden(&folder).unwrap();
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn error_names_the_path() {
        let path = Path::new("/nonexistent-folder/run.json");
        let message = write_json(path, &serde_json::Value::Null).unwrap_err().to_string();
        assert!(message.contains("/nonexistent-folder/run.json"), "{message}");
    }
}
