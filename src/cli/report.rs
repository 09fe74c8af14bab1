//! `asperity report`.

use std::path::Path;

use crate::output::{OutputError, write_report};

use super::outcome::{Exit, Failure, say};

/// Writes the report of a folder.
pub fn report(folder: &Path, out: Option<&Path>) -> Result<Exit, Failure> {
    let written = write_report(folder, out).map_err(|error| match error {
        OutputError::Figure { .. } => Failure::internal(error),
        error => Failure::input(format!("{error}\n  = argument: {}", folder.display())),
    })?;
    say(&format!("{}\n", written.display()))?;
    Ok(Exit::Done)
}
