//! The certified steps of a run: table, figure, findings, and their part of `run.json`.

use serde_json::{Value, json};

use crate::output::figures;
use crate::output::tables::{CertifyRow, CertifyWriter};
use crate::output::{OutputError, RunFolder};
use crate::verify::Finding;
use crate::verify::conic::{Certified, Tally, Way};

use super::recorder::labels;
use super::spec::Scene;

/// Collects the certified steps of a run; does nothing where none was asked for.
pub(super) struct Certifier<'a> {
    folder: &'a RunFolder,
    table: Option<CertifyWriter>,
    tally: Tally,
    /// All rows of this run, without those before it was interrupted.
    pub rows: Vec<CertifyRow>,
}

impl<'a> Certifier<'a> {
    /// Opens the table where the scene is to be certified; that of an interrupted run goes on behind nominal step `reached`.
    pub fn new(scene: &Scene, folder: &'a RunFolder, reached: usize) -> Result<Self, OutputError> {
        let path = folder.certify();
        let open = || if reached > 0 { CertifyWriter::resume(&path, reached) } else { CertifyWriter::create(&path) };
        let table = scene.solution.certify.then(open).transpose()?;
        Ok(Self { folder, table, tally: Tally::default(), rows: vec![] })
    }

    /// Takes the accepted steps of a nominal one.
    pub fn take(&mut self, step: usize, found: Vec<Certified>) -> Result<(), OutputError> {
        let rows: Vec<CertifyRow> = found.into_iter().map(|found| CertifyRow { step, found }).collect();
        rows.iter().for_each(|row| self.tally.take(step, &row.found.check));
        if let Some(table) = &mut self.table {
            table.append(&rows)?;
        }
        self.rows.extend(rows);
        Ok(())
    }

    /// Draws the differences.
    pub fn draw(&self, scene: &Scene) -> Result<(), OutputError> {
        if self.table.is_some() && scene.output.figures {
            figures::certify::write(&self.folder.figures()?, &self.rows, &labels(&scene.units))?;
        }
        Ok(())
    }

    /// What it comes to; nothing where nothing was certified.
    pub fn findings(&self) -> Vec<Finding> {
        if self.table.is_some() { self.tally.findings().into() } else { vec![] }
    }
}

/// Counts and largest differences for `run.json`; null where nothing was certified.
pub(super) fn summary(rows: &[CertifyRow]) -> Value {
    if rows.is_empty() {
        return Value::Null;
    }
    let count = |name: &str| rows.iter().filter(|row| row.found.check.verdict.name() == name).count();
    let solved = || rows.iter().filter_map(|row| row.found.check.solved.as_ref().ok());
    let worst = |value: fn(&crate::verify::conic::Difference) -> f64| {
        rows.iter().filter_map(|row| row.found.check.difference.as_ref()).map(value).fold(0.0, f64::max)
    };
    json!({
        "steps": rows.len(),
        "agrees": count("agrees"), "inconclusive": count("inconclusive"), "disagrees": count("disagrees"),
        "de_saxce": solved().filter(|solved| solved.way == Way::DeSaxce).count(),
        "programmes": solved().map(|solved| solved.programmes).sum::<usize>(),
        "interior_point_iterations": solved().map(|solved| solved.iterations).sum::<usize>(),
        "newton_iterations": rows.iter().map(|row| row.found.newton.iterations).sum::<usize>(),
        "newton_s": rows.iter().map(|row| row.found.newton.wall_s).sum::<f64>(),
        "conic_s": rows.iter().map(|row| row.found.check.wall_s).sum::<f64>(),
        "largest": {
            "du": worst(|d| d.u), "dp": worst(|d| d.p), "dq": worst(|d| d.q),
            "dfx": worst(|d| d.force[0]), "dfy": worst(|d| d.force[1]),
        },
        "direct_law": rows.iter().any(|row| row.found.check.certificate.direct > 0),
    })
}
