//! One setting computed, or read back where it is there already.

use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use cpu_time::ThreadTime;
use serde_json::Value as Json;

use super::found::Stop;
use super::norm::{self, Curve, QUANTITIES};
use super::setting::{Change, Setting};
use super::{Trade, memory};
use crate::output::{OutputError, fingerprint};
use crate::scene::{OutputSpec, Scene, SceneError};
use crate::study::compute::{Start, compute_scene};
use crate::study::point::folder_name;
use crate::study::{PointState, PointStatus};

/// Growth of the cost with the number of unknowns (`papers/cost`: 1.27).
const GROWTH: f64 = 1.27;

/// What a setting is measured for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It may be recommended.
    Candidate,
    /// The others are measured against it.
    Reference,
    /// Another model of the bulk: its error is one of the model.
    OtherModel,
}

/// A setting with what is known of it.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The setting.
    pub setting: Setting,
    /// What it changes in the scene.
    pub changes: Vec<Change>,
    /// The setting in words.
    pub words: String,
    /// What it is measured for.
    pub role: Role,
    /// Name of its folder.
    pub folder: String,
    /// State, reason, cost.
    pub status: PointStatus,
    /// Unknowns, Newton iterations, factorisations; 0 where it failed.
    pub counts: [u64; 3],
    /// Curves of all quantities; empty where it failed.
    pub curves: Vec<Curve>,
    /// Error of each of [`QUANTITIES`]; `nan` where it is not known.
    pub errors: Vec<f64>,
}

impl Measured {
    /// True where every step converged.
    pub fn done(&self) -> bool {
        !self.curves.is_empty()
    }
}

/// What is told of a search while it goes on.
#[derive(Debug)]
pub enum Event<'a> {
    /// A run begins: what is changed in the scene, and the number of its nominal steps.
    Started(&'a str, usize),
    /// A run reached its next nominal step.
    Step,
    /// A run is over; CPU time of all runs so far.
    Finished(&'a Measured, f64),
}

/// Where settings are measured.
pub(super) struct Laboratory<'a> {
    pub trade: &'a Trade,
    pub points: Vec<Measured>,
    /// CPU time of all runs.
    pub spent: f64,
    root: PathBuf,
    interrupt: &'a AtomicBool,
    watch: &'a mut dyn FnMut(Event),
    /// False before the first run of this program.
    warm: bool,
}

impl<'a> Laboratory<'a> {
    /// A laboratory with the results below a folder.
    pub fn new(trade: &'a Trade, root: &Path, interrupt: &'a AtomicBool, watch: &'a mut dyn FnMut(Event)) -> Self {
        let root = root.join("points");
        Self { trade, points: vec![], spent: 0.0, root, interrupt, watch, warm: false }
    }

    /// Measures a setting; the number of its point, which may be an earlier one that is the same scene. `None` where the
    /// setting cannot be had. A run that takes more than `limit` seconds of CPU time is given up.
    pub fn measure(&mut self, setting: &Setting, role: Role, limit: f64) -> Result<Option<usize>, Stop> {
        let (scene, changes) = (&self.trade.scene, setting.changes(self.trade));
        let (Some(changes), Some(steps)) = (changes, setting.step_count(scene)) else { return Ok(None) };
        let scene = self.scene(setting);
        let folder = match &scene {
            Ok(scene) => folder_name(scene, &self.trade.base_dir),
            Err(_) => format!("{:016x}", fingerprint(&format!("{changes:?}"))),
        };
        if let Some(known) = self.points.iter().position(|point| point.folder == folder) {
            return Ok(Some(known));
        }
        let path = self.root.join(&folder);
        let mut status = PointStatus::read(&path);
        let given_up = |status: &PointStatus| status.status == PointState::Interrupted && status.cpu_s > limit;
        if !(status.status.is_final() || given_up(&status)) {
            (self.watch)(Event::Started(&setting.words(self.trade), steps));
            status = self.compute(&scene, &path, limit)?;
        }
        let mut point = Measured {
            setting: setting.clone(),
            changes,
            words: setting.words(self.trade),
            role,
            folder,
            status,
            counts: [0; 3],
            curves: vec![],
            errors: vec![f64::NAN; QUANTITIES.len()],
        };
        if matches!(point.status.status, PointState::Done | PointState::AuditFailed) {
            point.curves = norm::read(&path.join("history.csv"))?;
            point.counts = counts(&path.join("run.json"))?;
        }
        self.spent += point.status.cpu_s;
        (self.watch)(Event::Finished(&point, self.spent));
        self.points.push(point);
        Ok(Some(self.points.len() - 1))
    }

    /// The scene of a setting; it writes its history only.
    fn scene(&self, setting: &Setting) -> Result<Scene, SceneError> {
        let source = self.trade.source(setting).unwrap_or_else(|| Ok(self.trade.base.clone()))?;
        let mut scene = Scene::of(&self.trade.grammar, &source)?;
        scene.output = OutputSpec { fields: 0, interface: 0, figures: false };
        Ok(scene)
    }

    fn compute(&mut self, scene: &Result<Scene, SceneError>, path: &Path, limit: f64) -> Result<PointStatus, Stop> {
        if !self.warm {
            // the first run pays for cold caches: its figures are thrown away
            compute_scene(|| scene.clone(), &self.trade.base_dir, path, Start::Anew, self.interrupt, |_| ());
            self.warm = true;
        }
        let (clock, exceeded) = (ThreadTime::now(), Cell::new(false));
        let before = memory::Before::run();
        let mut status = compute_scene(
            || scene.clone(),
            &self.trade.base_dir,
            path,
            Start::Anew,
            self.interrupt,
            |_| {
                (self.watch)(Event::Step);
                if clock.elapsed().as_secs_f64() > limit {
                    exceeded.set(true);
                    self.interrupt.store(true, Ordering::Relaxed);
                }
            },
        );
        if exceeded.get() && status.status == PointState::Interrupted {
            self.interrupt.store(false, Ordering::Relaxed);
            status.reason = format!("given up: more than {limit:.1} s of CPU time");
        } else if status.status == PointState::Interrupted {
            return Err(Stop::Interrupted);
        }
        status.memory_mb = before.peak_mb();
        status.write(path)?;
        Ok(status)
    }

    /// Expected CPU time of a setting, from the run of the same basis (else of any) that is nearest in size.
    pub fn expected(&self, setting: &Setting) -> Option<f64> {
        let scene = &self.trade.scene;
        let load = |setting: &Setting| Some(setting.step_count(scene)? as f64 * setting.unknowns(scene).powf(GROWTH));
        let basis = setting.basis_in(scene);
        let away = |point: &&Measured| {
            let foreign = point.setting.basis_in(scene) != basis;
            let apart = (point.setting.elements - setting.elements).abs() + (point.setting.steps - setting.steps).abs();
            (foreign, apart, point.setting.choices.len())
        };
        let known = self.points.iter().filter(|point| point.done()).min_by_key(away)?;
        Some(known.status.cpu_s * load(setting)? / load(&known.setting)?)
    }
}

/// Unknowns, Newton iterations and factorisations of a finished run.
fn counts(run: &Path) -> Result<[u64; 3], OutputError> {
    let text = std::fs::read_to_string(run).map_err(OutputError::io("read", run))?;
    let json: Json = serde_json::from_str(&text).map_err(|error| OutputError::content(run, error.to_string()))?;
    let number = |pointer: &str| json.pointer(pointer).and_then(Json::as_u64).unwrap_or(0);
    let counters = ["/model/unknowns", "/result/counters/newton_iterations", "/result/counters/factorisations"];
    Ok(counters.map(number))
}
