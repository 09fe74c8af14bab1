//! Everything a run leaves on disk: tables, fields for ParaView, figures and the run record.
//!
//! | file | written by | when |
//! |---|---|---|
//! | `history.csv`, `interface.csv` | [`tables`] | after every nominal step, flushed row by row |
//! | `fields/step_*.vtu`, `fields.pvd` | [`vtu`] | after every field output |
//! | `figures/*.svg`, `figures/*.png` | [`figures`] | at the end, or from the tables of an interrupted run |
//! | `run.json` | [`run_json`] | whenever the caller says so, atomically |
//! | `checkpoint/` | [`checkpoint`] | after every nominal step: what `--resume` goes on from |
//! | `report.html` | [`write_report`] | when asked for |
//! | `README.txt` | [`readme`] | at the start: every file and column with its unit |
//!
//! This room formats numbers that others computed; it computes no mechanics of its own.

pub mod checkpoint;
mod error;
pub mod figures;
mod fingerprint;
mod folder;
pub mod readme;
mod report;
pub mod run_json;
pub mod tables;
mod units;
pub mod vtu;

pub use error::OutputError;
pub(crate) use fingerprint::fingerprint;
pub use folder::RunFolder;
pub use report::write_report;
pub use units::{Quantity, UnitLabels};
