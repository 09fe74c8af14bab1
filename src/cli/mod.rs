//! Command line: commands, their help, and what the exit code of each outcome is.
//!
//! In the library, so that a program with laws of its own is three lines: see `examples/own_law`.

mod certify;
mod check;
mod laws;
mod outcome;
mod probe;
mod report;
mod resume;
mod run;
mod sweep;
mod trade;

use std::path::PathBuf;
use std::process::ExitCode;

use crate::scene::Scene;
use crate::study::Study;
use clap::{Args, Parser, Subcommand};

use outcome::{Exit, Failure, say};

const AFTER_HELP: &str = "\
Examples:
  asperity check examples/single_asperity.toml
  asperity run examples/single_asperity.toml --set 'contact.0.law.friction=0.1' --out out/mu-0.1
  asperity certify examples/single_asperity.toml
  asperity sweep examples/sweep/study.toml
  asperity trade examples/single_asperity.toml --error 0.01
  asperity laws coulomb
  asperity laws rate-and-state --probe examples/probe.toml

Exit codes:
  0  done
  1  internal error
  2  bad input: nothing was computed, the message names file, line, key and what is allowed
  3  did not converge: all steps before are kept
  4  converged, but an audit failed: do not trust the result
  5  interrupted: all steps before and a checkpoint are kept; the same command with --resume goes on";

/// Large-deformation frictional contact of soft asperities in plane strain.
///
/// A scene (TOML) says which bodies touch, how they are moved and which friction law holds between them; a run writes a
/// folder with tables, fields for ParaView and figures.
#[derive(Debug, Parser)]
#[command(version, after_help = AFTER_HELP, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute a scene and write a folder of results.
    ///
    /// The folder holds history.csv (one row per nominal step), interface.csv, fields/*.vtu with fields.pvd, figures
    /// and run.json. Ctrl-C stops at the next iteration and keeps everything computed so far (exit code 5); after that, or
    /// after a crash or a kill at any moment, --resume goes on behind the last step that was reached.
    Run(RunArguments),
    /// Compute a scene and check every step against a second, independent method.
    ///
    /// As `run --certify`: each accepted step is solved once more from its start by a sequence of conic programmes (Clarabel)
    /// and its contact forces are certified; certify.csv holds the differences, and a summary is printed. Exit code 4
    /// if the methods disagree.
    Certify(RunArguments),
    /// Compute a scene again and again with some of its values changed; one table and figures at the end.
    ///
    /// Points run in parallel over the cores, each into a folder of its own below the study's. A point that is there already is
    /// not computed again, so the same command continues after Ctrl-C, and computes only what is new after a change. A point that
    /// fails is recorded with its reason in study.csv, and the others are computed; the exit code is then 3 (no convergence, or a
    /// scene that cannot be built) or 4 (an audit failed).
    Sweep(sweep::SweepArguments),
    /// Measure error against CPU time over the numerical choices of a scene, and recommend settings.
    ///
    /// The scene is computed under many settings: basis and degree, element size, grading, steps, sites, augmentation, multiplier
    /// degree, projection, integration and its points, solver. A refined run is the reference, its own error is estimated. The folder
    /// holds trade.md (what is recommended, and how the error is measured), trade.csv (one row a setting), figures with the Pareto
    /// front, and recommended.toml, the scene with the recommended settings. Nothing is computed twice: the same command again
    /// prints the same, and after Ctrl-C it goes on.
    ///
    /// For example, the cheapest settings for forces within 1 % of their peak:
    /// asperity trade scene.toml --quantity fx,fy --error 0.01
    Trade(trade::TradeArguments),
    /// Validate a scene and print the model chosen: what is modelled, what is left out and why, sizes.
    ///
    /// Nothing is computed and nothing is written. Exit code 2 if the scene cannot be used.
    Check(SceneArguments),
    /// List the friction laws linked into this program, or explain one: equation, parameters, units, ranges, reference.
    ///
    /// With --probe the law is driven at one contact point, without any mesh, through the programmes of a file (velocity
    /// steps, slide-hold-slide, harmonic slip, spring slider), and a table and figures of each are written; see
    /// examples/probe.toml.
    Laws {
        /// Name of a law, as in `law = { type = "NAME" }`.
        name: Option<String>,
        /// Drive the law through the programmes of this file (TOML).
        #[arg(long, value_name = "FILE", requires = "name")]
        probe: Option<PathBuf>,
        /// Folder of the results of --probe; made if it does not exist [default: out/<name of the file>].
        #[arg(long, value_name = "DIR", requires = "probe")]
        out: Option<PathBuf>,
    },
    /// Write one self-contained HTML file about a run or a study.
    ///
    /// It says what was computed and how to compute it again, shows all figures, an animation of the pass, tables, audits and
    /// warnings, and needs neither network nor other files.
    Report {
        /// Folder of a run or a study.
        folder: PathBuf,
        /// The file to write [default: report.html in the folder].
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Print the JSON schema of a scene or of a study.
    ///
    /// Editors that know JSON schemas for TOML (for example taplo) complete and check a scene with it:
    /// asperity schema > scene.schema.json
    Schema {
        /// Whose schema.
        #[arg(value_enum, default_value_t = Kind::Scene)]
        of: Kind,
    },
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Kind {
    /// What `run` and `check` read.
    Scene,
    /// What `sweep` reads.
    Study,
}

/// A scene and what is changed in it.
#[derive(Debug, Args)]
struct SceneArguments {
    /// Scene file (TOML, version = 1).
    scene: PathBuf,
    /// Replace one value of the scene, before it is validated. May be repeated.
    ///
    /// PATH is a dotted key, entries of an array are numbered from 0; VALUE is TOML, so text needs quotes:
    /// --set 'contact.0.law.friction=0.1' --set 'body.lower.elements=[160, 40]' --set 'title="fine"'
    #[arg(long = "set", value_name = "PATH=VALUE")]
    sets: Vec<String>,
}

#[derive(Debug, Args)]
struct RunArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Folder of the results; made if it does not exist [default: out/<name of the scene>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Check every step against the conic method, see `asperity certify`; takes several times as long.
    #[arg(long)]
    certify: bool,
    /// Go on with the run in the folder of the results, bit for bit as if it had not been interrupted.
    ///
    /// The scene must be the same; only a later `time.end` with steps of the same length is accepted, and, for a run that did not
    /// converge, more `time.max_cuts` from its last step on. Where no step was reached yet the run starts from the beginning; a finished one is left as it is.
    #[arg(long)]
    resume: bool,
    /// Print errors only.
    #[arg(long)]
    quiet: bool,
}

/// Runs the command of the command line and turns its outcome into an exit code; errors go to stderr.
pub fn main() -> ExitCode {
    let outcome = match &Cli::parse().command {
        Command::Run(arguments) => run::run(arguments, arguments.certify),
        Command::Certify(arguments) => run::run(arguments, true),
        Command::Sweep(arguments) => sweep::command(arguments),
        Command::Trade(arguments) => trade::command(arguments),
        Command::Check(arguments) => check::check(arguments),
        Command::Laws { name, probe, out } => laws::laws(name.as_deref(), probe.as_deref(), out.as_deref()),
        Command::Report { folder, out } => report::report(folder, out.as_deref()),
        Command::Schema { of } => schema(*of),
    };
    outcome::report(outcome)
}

fn schema(of: Kind) -> Result<Exit, Failure> {
    let grammar = match of {
        Kind::Scene => Scene::grammar(),
        Kind::Study => Study::grammar(),
    };
    say(&format!("{:#}\n", grammar.root()))?;
    Ok(Exit::Done)
}
