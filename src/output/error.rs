//! What can go wrong while results are written: always an operation on a path.

use std::io;
use std::path::{Path, PathBuf};

/// A result that could not be written or read back, with the path it concerns.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The operating system refused an operation.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was attempted, as a verb: "create", "append to", "rename" ...
        action: &'static str,
        /// The file or folder concerned.
        path: PathBuf,
        /// The reason given by the operating system.
        source: io::Error,
    },
    /// A file that was read back is not what this program writes.
    #[error("{}: {reason}", path.display())]
    Content {
        /// The file concerned.
        path: PathBuf,
        /// What was expected and what was found.
        reason: String,
    },
    /// A figure could not be rasterised.
    #[error("cannot draw {}: {reason}", path.display())]
    Figure {
        /// The picture that was to be written.
        path: PathBuf,
        /// What the renderer said.
        reason: String,
    },
}

impl OutputError {
    /// Closure for `map_err` that attaches the attempted action and the path to an i/o error.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { action, path, source }
    }

    /// A file whose content is not as expected.
    pub(crate) fn content(path: &Path, reason: impl Into<String>) -> Self {
        Self::Content { path: path.to_path_buf(), reason: reason.into() }
    }
}
