//! What is known of a point: `point.json` in its folder, replaced as a whole.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::output::OutputError;
use crate::output::run_json::write_json;

/// How far a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PointState {
    /// Not begun.
    Pending,
    /// Begun; by this program or by another one, which may be gone by now.
    Running,
    /// Every step converged.
    Done,
    /// Every step converged, but the result breaks a property it must have.
    #[serde(rename = "audit failed")]
    AuditFailed,
    /// A step did not converge.
    #[serde(rename = "not converged")]
    NotConverged,
    /// The scene cannot be built.
    #[serde(rename = "bad input")]
    BadInput,
    /// Stopped from outside.
    Interrupted,
    /// The program is at fault, or the machine.
    #[serde(rename = "internal error")]
    Internal,
}

impl PointState {
    /// True where computing again would bring the same again.
    pub fn is_final(self) -> bool {
        matches!(self, Self::Done | Self::AuditFailed | Self::NotConverged | Self::BadInput)
    }

    /// True where it is over, and not as wished.
    pub fn failed(self) -> bool {
        matches!(self, Self::AuditFailed | Self::NotConverged | Self::BadInput | Self::Internal)
    }

    /// As it stands in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pending => "pending",
            Self::Running => "running",
            Self::Done => "done",
            Self::AuditFailed => "audit failed",
            Self::NotConverged => "not converged",
            Self::BadInput => "bad input",
            Self::Interrupted => "interrupted",
            Self::Internal => "internal error",
        }
    }
}

/// State of a point, why, and what it took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointStatus {
    /// How far it is.
    pub status: PointState,
    /// Why it is not done; empty where it is.
    pub reason: String,
    /// Wall time in seconds.
    pub wall_s: f64,
    /// CPU time of its thread in seconds; 0 in folders of earlier versions.
    #[serde(default)]
    pub cpu_s: f64,
    /// Peak memory of the process while it was computed, in megabytes, where it was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub memory_mb: Option<f64>,
}

impl PointStatus {
    /// A state that needs no reason.
    pub fn plain(status: PointState) -> Self {
        Self { status, reason: String::new(), wall_s: 0.0, cpu_s: 0.0, memory_mb: None }
    }

    /// Reads the status of a folder; a folder without one is pending, and so is one whose status cannot be read.
    pub fn read(folder: &Path) -> Self {
        let text = std::fs::read_to_string(folder.join("point.json")).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_else(|_| Self::plain(PointState::Pending))
    }

    /// Writes the status of a folder.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join("point.json");
        write_json(&path, &serde_json::to_value(self).map_err(|error| OutputError::content(&path, error.to_string()))?)
    }
}
