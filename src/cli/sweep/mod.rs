//! `asperity sweep`.

mod progress;

use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use clap::Args;

use crate::study::{Collected, Jobs, Point, PointState, Study, StudyFolder, collect, listing, sweep};

use super::outcome::{Exit, Failure, say, warn};
use super::run::on_interrupt;
use progress::Progress;

/// Set by SLURM in the jobs of an array.
const ARRAY_INDEX: &str = "SLURM_ARRAY_TASK_ID";

#[derive(Debug, Args)]
pub struct SweepArguments {
    /// Study file (TOML, version = 1).
    study: PathBuf,
    /// Print index, values, status and folder of every point; compute nothing.
    #[arg(long, conflicts_with_all = ["index", "collect"])]
    list: bool,
    /// Compute this point only, counted from 0 as in --list, and write no table [default: SLURM_ARRAY_TASK_ID, if set].
    #[arg(long, value_name = "N", conflicts_with = "collect")]
    index: Option<usize>,
    /// Write the table and the figures from the points that are there; compute nothing.
    #[arg(long)]
    collect: bool,
    /// Folder of the results; made if it does not exist [default: out/<name of the study>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Points computed at the same time [default: number of cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Compute points again that failed.
    #[arg(long)]
    retry: bool,
    /// Replace one value of the scene of all points, as in `asperity run`. May be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    sets: Vec<String>,
    /// Print errors only.
    #[arg(long)]
    quiet: bool,
}

/// Computes, lists or collects the points of a study.
pub fn command(arguments: &SweepArguments) -> Result<Exit, Failure> {
    let study = Study::load(&arguments.study, &arguments.sets)?;
    let index = match arguments.index {
        _ if arguments.list || arguments.collect => None,
        None => array_index()?,
        given => given,
    };
    let points = match index {
        Some(index) if index >= study.count() => return Err(beyond(index, study.count())),
        Some(index) => vec![study.point(index)?],
        None => study.points()?,
    };
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study));
    let folder = StudyFolder::at(&out);
    if arguments.list {
        say(&listing(&study, &folder, &points))?;
        return Ok(Exit::Done);
    }
    if index.is_none() {
        let refused = |error| Failure::input(format!("{error}\n  = argument: --out {}", out.display()));
        folder.prepare(&study, &points).map_err(refused)?;
    }
    let mut interrupted = false;
    if !arguments.collect {
        interrupted = computed(&study, &folder, &points, arguments)?;
    }
    match index {
        Some(_) => conclude_point(&folder, &points[0]),
        None => {
            let collected = collect(&study, &folder, &points).map_err(Failure::internal)?;
            conclude(&collected, &folder, interrupted, arguments.quiet)
        }
    }
}

/// The point that a job array asks for.
fn array_index() -> Result<Option<usize>, Failure> {
    let Ok(text) = std::env::var(ARRAY_INDEX) else { return Ok(None) };
    let wrong = |_| Failure::input(format!("{ARRAY_INDEX} is {text:?}, not the number of a point"));
    text.parse().map(Some).map_err(wrong)
}

fn beyond(index: usize, count: usize) -> Failure {
    Failure::input(format!("there is no point {index}\n  = allowed: 0 to {}", count - 1))
}

fn default_folder(study: &Path) -> PathBuf {
    Path::new("out").join(study.file_stem().unwrap_or(study.as_os_str()))
}

/// Computes what is missing; true if it was stopped.
fn computed(
    study: &Study,
    folder: &StudyFolder,
    points: &[Point],
    arguments: &SweepArguments,
) -> Result<bool, Failure> {
    let interrupt = on_interrupt()?;
    let cores = || available_parallelism().map_or(1, usize::from);
    let workers = arguments.jobs.map_or_else(cores, usize::from);
    let jobs = Jobs { workers, retry: arguments.retry, interrupt: &interrupt };
    let pending = jobs.pending(folder, points);
    let mut progress = Progress::new(&pending, arguments.quiet);
    sweep(study, folder, &pending, &jobs, |event| progress.take(&event));
    progress.end();
    Ok(interrupt.load(std::sync::atomic::Ordering::Relaxed))
}

fn conclude_point(folder: &StudyFolder, point: &Point) -> Result<Exit, Failure> {
    let status = folder.status(point);
    let place = folder.point(point);
    let told = format!("point {}: {}: {}; see {}", point.index, status.status.name(), status.reason, place.display());
    match status.status {
        PointState::Done => Ok(Exit::Done),
        PointState::AuditFailed => Err(Failure::audit(told)),
        PointState::NotConverged | PointState::BadInput => Err(Failure::not_converged(told)),
        PointState::Interrupted | PointState::Pending | PointState::Running => Ok(Exit::Interrupted),
        PointState::Internal => Err(Failure::internal(told)),
    }
}

fn conclude(collected: &Collected, folder: &StudyFolder, interrupted: bool, quiet: bool) -> Result<Exit, Failure> {
    let out = folder.root().display();
    if !quiet {
        if collected.figures_left_out > 0 {
            let count = collected.figures_left_out;
            warn(format!("{count} figures were not drawn: a [[figure]] of the study may choose other axes"));
        }
        say(&format!("{}; results in {out}\n", collected.summary()))?;
    }
    let told = format!("{}\n  = help: reasons are in {}", collected.summary(), folder.table().display());
    let any = |states: &[PointState]| states.iter().any(|state| collected.count(*state) > 0);
    if interrupted {
        Ok(Exit::Interrupted)
    } else if any(&[PointState::Internal]) {
        Err(Failure::internal(told))
    } else if any(&[PointState::NotConverged, PointState::BadInput]) {
        Err(Failure::not_converged(told))
    } else if any(&[PointState::AuditFailed]) {
        Err(Failure::audit(told))
    } else {
        Ok(Exit::Done)
    }
}
