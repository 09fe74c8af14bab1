//! What a run leaves on disk, step by step: tables at once, fields and figures as the scene asks.

use crate::contact::ContactDiscretization;
use crate::geometry::Point;
use crate::model::{InterfaceRow, Model, Record, State, interface_rows};
use crate::output::checkpoint::Displacements;
use crate::output::figures::{Data, choose, film};
use crate::output::tables::{HistoryWriter, InterfaceWriter, read_history, read_interface};
use crate::output::vtu::FieldSeries;
use crate::output::{OutputError, RunFolder, UnitLabels};
use crate::solve::StepReport;

use super::fields;
use super::spec::{OutputSpec, Scene, Units};

/// Displacements are kept for the figure of the bodies up to this number of values; beyond it the figure is left out.
const MAX_KEPT: usize = 1 << 26;

/// Writes the results of a run while it goes on.
pub(super) struct Recorder<'a> {
    model: &'a Model,
    output: &'a OutputSpec,
    folder: &'a RunFolder,
    history: HistoryWriter,
    interface: InterfaceWriter,
    fields: Option<FieldSeries>,
    columns: Columns,
    /// Everything the figures need.
    records: Vec<Record>,
    rows: Vec<InterfaceRow>,
    displacements: Vec<Vec<Point>>,
    /// The same on disk, for a run that goes on later.
    kept: Option<Displacements>,
}

impl<'a> Recorder<'a> {
    /// Opens all files: anew, so that an earlier run in the same folder is replaced, or, `after` some steps, cut back to these
    /// and read again.
    pub fn open(scene: &'a Scene, model: &'a Model, folder: &'a RunFolder, after: usize) -> Result<Self, OutputError> {
        let mut recorder = Self::over(scene, model, folder, (after > 0).then_some(after))?;
        let path = folder.checkpoint().join("displacements.bin");
        if after == 0 {
            recorder.kept = scene.output.figures.then(|| Displacements::create(&path)).transpose()?;
            recorder.write_fields(0, &State::initial(model))?;
            return Ok(recorder);
        }
        let records = read_history(&folder.history())?;
        if records.len() != after {
            let reason = format!("holds {} steps, the checkpoint stands at step {after}", records.len());
            return Err(OutputError::Content { path: folder.history(), reason });
        }
        if scene.output.figures {
            let kept = (MAX_KEPT / (2 * model.nodes().max(1))).min(after);
            let (file, displacements) = Displacements::resume(&path, model.nodes(), kept)?;
            (recorder.records, recorder.rows) = (records, read_interface(&folder.interface())?);
            (recorder.kept, recorder.displacements) = (Some(file), displacements);
        }
        Ok(recorder)
    }

    fn over(
        scene: &'a Scene,
        model: &'a Model,
        folder: &'a RunFolder,
        after: Option<usize>,
    ) -> Result<Self, OutputError> {
        let columns = Columns::new(model);
        let (history, interface) = folder.tables(&columns.names(), model.has_rates(), after)?;
        folder.write_readme(&scene.title, &labels(&scene.units), &columns.0, model.has_rates())?;
        let fields = match scene.output.fields {
            0 => None,
            _ => Some(folder.fields(after)?),
        };
        Ok(Self {
            model,
            output: &scene.output,
            folder,
            history,
            interface,
            fields,
            columns,
            records: vec![],
            rows: vec![],
            displacements: vec![],
            kept: None,
        })
    }

    /// Takes one nominal step.
    pub fn step(&mut self, report: &StepReport) -> Result<(), OutputError> {
        let step = report.record.step;
        self.history.append(&report.record)?;
        if due(step, self.output.interface) {
            let mut rows = interface_rows(self.model, report.evaluation, step);
            rows.iter_mut().for_each(|row| self.columns.align(row));
            self.interface.append(&rows)?;
            if self.output.figures {
                self.rows.extend(rows);
            }
        }
        if due(step, self.output.fields) {
            self.write_fields(step, report.state)?;
        }
        if self.output.figures {
            self.records.push(report.record.clone());
            if 2 * self.records.len() * self.model.nodes() <= MAX_KEPT {
                self.kept.iter_mut().try_for_each(|kept| kept.append(&report.state.u))?;
                self.displacements.push(report.state.u.clone());
            }
        }
        Ok(())
    }

    /// Waits until all steps so far are on the disk itself.
    pub fn sync(&self) -> Result<(), OutputError> {
        self.history.sync()?;
        self.interface.sync()?;
        self.kept.iter().try_for_each(Displacements::sync)
    }

    fn write_fields(&mut self, step: usize, state: &State) -> Result<(), OutputError> {
        if let Some(series) = &mut self.fields {
            series.append(step, state.time, &fields::bodies(self.model, &state.u))?;
        }
        Ok(())
    }

    /// Draws the figures of all steps so far.
    pub fn finish(&self, scene: &Scene) -> Result<(), OutputError> {
        if !self.output.figures {
            return Ok(());
        }
        let units = labels(&scene.units);
        let data = Data {
            records: &self.records,
            interface: &self.rows,
            local_friction: local_friction(scene),
            variables: &self.columns.0,
            units: &units,
        };
        let target = self.folder.figures()?;
        data.write_charts(&target)?;
        let instants = choose(&self.records);
        let kept = instants.iter().filter_map(|instant| Some((instant, self.displacements.get(instant.index)?)));
        let frames: Vec<_> = kept.map(|(instant, u)| data.frame(instant, &fields::bodies(self.model, u))).collect();
        if frames.len() == instants.len() {
            data.write_bodies(&target, &frames)?;
        }
        let film = film(&self.records).into_iter().filter_map(|k| Some((k, self.displacements.get(k)?)));
        let film: Vec<_> = film.map(|(k, u)| data.brief_frame(k, &fields::bodies(self.model, u))).collect();
        data.write_animation(&target, &film)?;
        Ok(())
    }
}

fn due(step: usize, every: usize) -> bool {
    every > 0 && step.is_multiple_of(every)
}

pub(super) fn labels(units: &Units) -> UnitLabels {
    UnitLabels { length: units.length.clone(), stress: units.stress.clone(), time: units.time.clone() }
}

/// The coefficient of Coulomb's law, where all contacts share one.
fn local_friction(scene: &Scene) -> Option<f64> {
    let of = |law: &toml::Table| {
        let coulomb = law.get("type").and_then(toml::Value::as_str) == Some("coulomb");
        law.get("friction").and_then(toml::Value::as_float).filter(|_| coulomb)
    };
    let first = of(&scene.contact.first()?.law)?;
    scene.contact.iter().all(|contact| of(&contact.law) == Some(first)).then_some(first)
}

/// State variables of the laws as columns of `interface.csv`: name and unit.
struct Columns(Vec<(String, String)>, Vec<usize>);

impl Columns {
    /// One set of columns where all laws have the same variables, else one set for each pair.
    fn new(model: &Model) -> Self {
        let of_pair: Vec<Vec<(String, String)>> = model
            .pairs
            .iter()
            .map(|pair| {
                let units = pair.contact.law().map(|law| law.variables()).unwrap_or_default();
                let names = pair.contact.variable_names().into_iter();
                names.zip(units).map(|(name, v)| (name, v.unit.to_string())).collect()
            })
            .collect();
        if of_pair.windows(2).all(|pair| pair[0] == pair[1]) {
            return Self(of_pair.first().cloned().unwrap_or_default(), vec![0; of_pair.len()]);
        }
        let (mut columns, mut first) = (vec![], vec![]);
        for (k, variables) in of_pair.into_iter().enumerate() {
            first.push(columns.len());
            columns.extend(variables.into_iter().map(|(name, unit)| (format!("pair{k}.{name}"), unit)));
        }
        Self(columns, first)
    }

    fn names(&self) -> Vec<String> {
        self.0.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Moves the variables of a row to the columns of its pair.
    fn align(&self, row: &mut InterfaceRow) {
        let first = self.1.get(row.pair).copied().unwrap_or(0);
        row.variables.splice(0..0, std::iter::repeat_n(f64::NAN, first));
    }
}
