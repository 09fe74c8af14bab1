//! What is wrong with a shape, named by the key of the scene that says so.

use std::path::PathBuf;

/// A geometry that cannot be built. Keys are relative to the table of the body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// A value that is not allowed; the message says what is.
    #[error("{}: {message}", join(table, key))]
    Invalid {
        /// Table or value beside the shape: `shape`, `basis`, `elements`, `grading`, `position`.
        table: &'static str,
        /// Dotted key inside the table, for example `top.wavelength`; empty if the table itself is meant.
        key: String,
        /// What is wrong and what is allowed.
        message: String,
    },
    /// A profile file that cannot be used.
    #[error("shape.{key}: {}:{line}: {message}", file.display())]
    File {
        /// Dotted key inside the shape table, for example `top.file`.
        key: String,
        /// The file as it was looked for.
        file: PathBuf,
        /// Line number, counted from 1; 0 if the file as a whole is meant.
        line: usize,
        /// What is wrong and what is allowed.
        message: String,
    },
}

impl GeometryError {
    /// Error of a key inside the `shape` table.
    pub fn shape(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self::outside("shape", key, message)
    }

    /// Error of a key in another table of the body (`basis`, `elements`, `grading`, `position`).
    pub fn outside(table: &'static str, key: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Invalid { table, key: key.into(), message: message.into() }
    }

    /// Key inside its table, for example `top.wavelength`.
    pub fn key(&self) -> &str {
        match self {
            Self::Invalid { key, .. } | Self::File { key, .. } => key,
        }
    }

    /// Key relative to the body, for example `shape.top.wavelength` or `elements`.
    pub fn path(&self) -> String {
        match self {
            Self::Invalid { table, key, .. } => join(table, key),
            Self::File { key, .. } => join("shape", key),
        }
    }
}

fn join(table: &str, key: &str) -> String {
    if key.is_empty() { table.to_owned() } else { format!("{table}.{key}") }
}
