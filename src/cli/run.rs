//! `asperity run`.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::model::Record;
use crate::output::RunFolder;
use crate::scene::{self, RunReport, Scene};
use crate::solve::Status;
use crate::verify::{self, Finding};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::RunArguments;
use super::certify::table;
use super::check::load;
use super::outcome::{Exit, Failure, note, say, warn};
use super::resume::{begin, command};

/// Computes a scene into a folder; `certify`: and checks every step by the conic method.
pub fn run(arguments: &RunArguments, certify: bool) -> Result<Exit, Failure> {
    let (mut scene, model) = load(&arguments.scene)?;
    scene.solution.certify |= certify;
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.scene.scene));
    let folder = RunFolder::create(&out)
        .map_err(|error| Failure::input(format!("{error}\n  = argument: --out {}", out.display())))?;
    let start = begin(arguments, &scene, &model, &folder)?;
    if start.finished(&scene) {
        if !arguments.quiet {
            say(&format!("already done: {} steps; results in {}\n", start.step(), out.display()))?;
        }
        return conclude(&Status::Done, &start.findings(), &out);
    }
    let interrupt = on_interrupt()?;
    if !arguments.quiet {
        verify::warnings(&model, &scene::time_plan(&scene)).iter().for_each(warn);
    }
    let mut progress = Progress::new(&scene, arguments.quiet);
    let report = scene::resume(&scene, &model, &folder, start, &interrupt, |record| progress.step(record));
    progress.end();
    let again = command(arguments, &out);
    let RunReport { outcome, findings, certified, estimate } = report.map_err(|error| {
        Failure::internal(format!(
            "{error}\n  = help: the steps before are kept; once this is put right, go on by\n    {again}"
        ))
    })?;
    if !arguments.quiet {
        findings.iter().filter(|finding| finding.warns()).for_each(warn);
        if scene.solution.certify {
            say(&table(&certified))?;
        }
        let state = scene::status_name(&outcome.status);
        let (steps, iterations, cuts) = (outcome.steps, outcome.iterations, outcome.cuts);
        say(&format!("{state}: {steps} steps, {iterations} iterations, {cuts} cuts; results in {}\n", out.display()))?;
        say(&format!("{estimate}\n"))?;
        estimate.warning(&model).iter().for_each(warn);
        estimate.advice(&model).iter().for_each(note);
        if let Status::Interrupted { .. } = outcome.status {
            note(format!("the checkpoint is kept; go on by\n  {again}"));
        }
    }
    conclude(&outcome.status, &findings, &out)
}

fn conclude(status: &Status, findings: &[Finding], out: &Path) -> Result<Exit, Failure> {
    let failed: String = findings.iter().filter(|f| f.failed()).map(|f| format!("\n  - {f}")).collect();
    match status {
        Status::Done if !failed.is_empty() => Err(Failure::audit(format!(
            "every step converged, but the result must not be trusted:{failed}\n  = help: results are kept in {}, all \
             audits in its run.json; please report this with the scene",
            out.display()
        ))),
        Status::Done => Ok(Exit::Done),
        Status::Interrupted { .. } => Ok(Exit::Interrupted),
        Status::NotConverged { time, reason } => Err(Failure::not_converged(format!(
            "no convergence after time {time}: {reason}\n  = help: all steps before are kept in {}; a larger `time.max_cuts` may be \
             tried from there with --resume",
            out.display()
        ))),
    }
}

/// `out/<name of the scene>`.
pub fn default_folder(scene: &Path) -> PathBuf {
    Path::new("out").join(scene.file_stem().unwrap_or(scene.as_os_str()))
}

/// The first Ctrl-C asks the march to stop, the second stops the program at once.
pub fn on_interrupt() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let raised = flag.clone();
    let handler = move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(Exit::Interrupted as u8));
        }
    };
    ctrlc::set_handler(handler).map_err(|error| Failure::internal(format!("Ctrl-C handler: {error}")))?;
    Ok(flag)
}

/// A bar on a terminal, one line a step elsewhere, nothing when quiet. On stderr: stdout stays for results.
enum Progress {
    Bar(ProgressBar),
    Lines,
    Silent,
}

impl Progress {
    fn new(scene: &Scene, quiet: bool) -> Self {
        match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => Self::Silent,
            (false, false) => Self::Lines,
            (false, true) => {
                let bar = ProgressBar::with_draw_target(Some(scene.time.steps as u64), ProgressDrawTarget::stderr());
                let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {elapsed} (left {eta})  {msg}");
                Self::Bar(bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
            }
        }
    }

    fn step(&mut self, record: &Record) {
        let [fx, fy] = record.force;
        let (iterations, cuts) = (record.newton_iterations, record.cuts);
        let forces = match record.contact_length > 0.0 {
            true => format!("Fx {fx:.4e}  Fy {fy:.4e}  Fx/Fy {:.4}", record.mu_global),
            false => "no contact".into(),
        };
        let message = format!("{forces}  {iterations} it {cuts} cuts");
        match self {
            Self::Bar(bar) => {
                bar.set_position(record.step as u64);
                bar.set_message(message);
            }
            Self::Lines => {
                // a closed stderr must not stop a computation
                let line = format!("step {}  t {:.6}  {message}", record.step, record.time);
                let _ = writeln!(std::io::stderr(), "{line}");
            }
            Self::Silent => {}
        }
    }

    fn end(&self) {
        if let Self::Bar(bar) = self {
            bar.abandon();
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::verify::{Audit, Expectations};

    use super::*;

    const EXPECTED: Expectations = Expectations {
        friction: None,
        dissipative: true,
        single_drive: true,
        inertia: false,
        viscosity: false,
        element_size: 1.0,
        negligible_force: 1e-9,
    };

    /// No built-in law breaks an audit, so the way to exit code 4 is tested on a planted record.
    #[test]
    fn failed_audit_is_exit_code_4_unless_the_run_ended_early() {
        let mut audit = Audit::new(EXPECTED);
        audit.take(&Record { step: 1, force_imbalance: 0.5, ..Record::default() });
        let (findings, out) = (audit.findings(), Path::new("out/here"));
        let failure = conclude(&Status::Done, &findings, out).unwrap_err();
        assert_eq!(failure.exit(), Exit::AuditFailed);
        let said = failure.to_string();
        for part in ["interface_force: 5.00e-1 at step 1", "must not be trusted", "kept in out/here"] {
            assert!(said.contains(part), "{said}");
        }
        let early = Status::NotConverged { time: 0.5, reason: "planted".into() };
        assert_eq!(conclude(&early, &findings, out).unwrap_err().exit(), Exit::NotConverged);
        assert_eq!(conclude(&Status::Interrupted { time: 0.5 }, &findings, out).unwrap(), Exit::Interrupted);
        assert_eq!(conclude(&Status::Done, &[], out).unwrap(), Exit::Done);
    }
}
