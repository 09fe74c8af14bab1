//! What each simplification saves: scenes of `examples/` with and without it. Every run has a process of its own, all in
//! turn; thread CPU time (least of the turns), peak memory, largest difference of the
//! forces and of the places of the drive over their peak.
//! `cargo bench --bench savings` prints the table of `papers/trade/savings.md`, with `-- WORD` the rows that hold it.

use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

use asperity::geometry::Point;
use asperity::model::{Record, State, Tangent, evaluate};
use asperity::output::RunFolder;
use asperity::scene::{self, MaterialSpec, Scene};
use asperity::solve::{Outcome, Recall, Status, Tools, Ways, proceed};
use cpu_time::ThreadTime;

/// Runs of each kind.
const TURNS: usize = 5;

/// A scene with and without a simplification.
struct Saving {
    what: &'static str,
    scene: &'static str,
    /// For both.
    set: &'static [&'static str],
    without: &'static [&'static str],
    with: &'static [&'static str],
    /// Whether both are the same problem, so that their results can be compared.
    same: bool,
}

const FRICTIONLESS: &str = "contact.0.law={type=\"frictionless\"}";
const BARE: &[&str] = &["output.figures=false", "output.fields=0", "output.interface=0"];

const SAVINGS: [Saving; 8] = [
    Saving {
        what: "frictionless instead of friction 0.3",
        scene: "single_asperity",
        set: &[],
        without: &[],
        with: &[FRICTIONLESS],
        same: false,
    },
    Saving {
        what: "no tangential unknowns, no slip history: frictionless instead of friction 1e-9, all steps solved",
        scene: "single_asperity",
        set: &["solved"],
        without: &["contact.0.law.friction=1e-9"],
        with: &[FRICTIONLESS],
        same: true,
    },
    Saving {
        what: "states recalled where nothing rubs, instead of all steps solved",
        scene: "single_asperity",
        set: &[FRICTIONLESS],
        without: &["solved"],
        with: &[],
        same: true,
    },
    Saving {
        what: "the same",
        scene: "multi_asperity",
        set: &[FRICTIONLESS],
        without: &["solved"],
        with: &[],
        same: true,
    },
    Saving {
        what: "rigid lower body instead of a deformable one",
        scene: "single_asperity",
        set: &[],
        without: &[],
        with: &["rigid"],
        same: false,
    },
    Saving {
        what: "rigid lower body instead of one of E = 1e5",
        scene: "single_asperity",
        set: &[],
        without: &["stiff"],
        with: &["rigid"],
        same: true,
    },
    Saving {
        what: "small strain: linear-elastic instead of neo-hookean",
        scene: "hertz",
        set: &[],
        without: &["material.linear.type=\"neo-hookean\""],
        with: &[],
        same: true,
    },
    Saving {
        what: "no output but the history, instead of all of it at every step",
        scene: "single_asperity",
        set: &["written"],
        without: &["output.figures=true", "output.fields=1", "output.interface=1"],
        with: BARE,
        same: true,
    },
];

/// What a run took and gave.
struct Run {
    cpu: f64,
    memory: f64,
    iterations: usize,
    /// Forces and places of the drive, step by step.
    rows: Vec<[f64; 4]>,
}

/// A run in a process of its own.
fn spawn(scene: &str, sets: &[&str]) -> Run {
    let output = Command::new(std::env::current_exe().unwrap()).arg("run").arg(scene).args(sets).output().unwrap();
    assert!(output.status.success(), "{scene} {sets:?}: {}", String::from_utf8_lossy(&output.stderr));
    let numbers: Vec<f64> =
        String::from_utf8_lossy(&output.stdout).split_whitespace().map(|n| n.parse().unwrap()).collect();
    let rows = numbers[3..].chunks(4).map(|row| [row[0], row[1], row[2], row[3]]).collect();
    Run { cpu: numbers[0], memory: numbers[1], iterations: numbers[2] as usize, rows }
}

/// The run itself: CPU seconds, megabytes, iterations, forces. `solved`, `rigid`, `stiff` and `written` stand
/// among the sets for what is no key of a scene.
fn child(scene: &str, sets: &[String]) {
    let has = |word: &str| sets.iter().any(|set| set == word);
    let sets: Vec<String> = sets.iter().filter(|set| set.contains('=')).cloned().collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(scene).with_extension("toml");
    let (mut scene, _) = Scene::load(&path, &sets).unwrap();
    if has("rigid") {
        let lower = scene.body.get_mut("lower").unwrap();
        (lower.rigid, lower.material) = (true, None);
        scene.support.retain(|support| support.body != "lower");
    }
    if has("stiff") {
        let stiff = MaterialSpec::LinearElastic { youngs_modulus: 1e5, poissons_ratio: 0.3, density: None };
        scene.material.insert("stiff".into(), stiff);
        scene.body.get_mut("lower").unwrap().material = Some("stiff".into());
    }
    let model = scene::build(&scene, path.parent().unwrap()).unwrap();
    let (clock, quiet, mut rows) = (ThreadTime::now(), AtomicBool::new(false), vec![]);
    let outcome = if has("written") {
        let folder = std::env::temp_dir().join(format!("asperity-savings-{}", std::process::id()));
        let out = RunFolder::create(&folder).unwrap();
        let report = scene::run(&scene, &model, &out, &quiet, |record| rows.push(row(record))).unwrap();
        std::fs::remove_dir_all(folder).unwrap();
        report.outcome
    } else {
        let plan = scene::time_plan(&scene);
        let ways = Ways::new(&model, &plan);
        let (mut recall, mut solver) = (Recall::new(&ways, (), vec![]), scene.solution.solver.create());
        let witness: &mut dyn asperity::solve::Witness = if has("solved") { &mut () } else { &mut recall };
        let tools = Tools { solver: solver.as_mut(), witness };
        let from = Outcome::at(State::initial(&model));
        let report = |report: asperity::solve::StepReport| {
            rows.push(row(&report.record));
            Ok::<(), std::convert::Infallible>(())
        };
        proceed(&model, from, &plan, tools, &quiet, report).unwrap_or_else(|e| match e {})
    };
    assert_eq!(outcome.status, Status::Done);
    println!("{} {} {}", clock.elapsed().as_secs_f64(), memory(), outcome.iterations);
    rows.iter().flatten().for_each(|value| println!("{value:e}"));
}

fn row(record: &Record) -> [f64; 4] {
    [record.force[0], record.force[1], record.drive[0], record.drive[1]]
}

/// Peak resident memory of this process in megabytes.
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0
}

/// Largest difference of forces over the peak force, of places of the drive over its way.
fn difference(a: &Run, b: &Run) -> f64 {
    let of = |columns: [usize; 2]| {
        let peak = a.rows.iter().flat_map(|row| columns.map(|c| row[c].abs())).fold(f64::MIN_POSITIVE, f64::max);
        let apart = a.rows.iter().zip(&b.rows).flat_map(|(a, b)| columns.map(|c| (a[c] - b[c]).abs()));
        apart.fold(0.0, f64::max) / peak
    };
    of([0, 1]).max(of([2, 3]))
}

fn measure(saving: &Saving) {
    let side = |sets: &[&'static str]| [saving.set, sets].concat();
    let (without, with) = (side(saving.without), side(saving.with));
    let turns: Vec<[Run; 2]> =
        (0..TURNS).map(|_| [spawn(saving.scene, &without), spawn(saving.scene, &with)]).collect();
    let cpu = |k: usize| turns.iter().map(|turn| turn[k].cpu).fold(f64::INFINITY, f64::min);
    let [a, b] = &turns[0];
    let apart = if saving.same { format!("{:.1e}", difference(a, b)) } else { "another problem".into() };
    println!(
        "| {} | {} | {}, {} | {:.2}, {:.2} | {:.0} % | {:.0}, {:.0} | {apart} |",
        saving.scene,
        saving.what,
        a.iterations,
        b.iterations,
        cpu(0),
        cpu(1),
        100.0 * cpu(1) / cpu(0),
        a.memory,
        b.memory
    );
}

/// Evaluations of the two asperities apart, in microseconds: bodies at rest, and hardly deformed.
fn apart() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/single_asperity.toml");
    let (scene, _) = Scene::load(&path, &[]).unwrap();
    let model = scene::build(&scene, Path::new("examples")).unwrap();
    let rest = State::initial(&model);
    let mut strained = rest.clone();
    model.bodies.iter().for_each(|body| strained.u[body.offset + body.points.len() / 2] += Point::new(1e-12, 0.0));
    let micros = |state: &State| {
        let clock = ThreadTime::now();
        (0..200).for_each(|_| drop(std::hint::black_box(evaluate(&model, state, state, Tangent::None))));
        clock.elapsed().as_secs_f64() * 5e3
    };
    let least = |state: &State| (0..TURNS).map(|_| micros(state)).fold(f64::INFINITY, f64::min);
    println!("\nbodies apart: an evaluation takes {:.0} us at rest, {:.0} us deformed", least(&rest), least(&strained));
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.first().is_some_and(|first| first == "run") {
        return child(&arguments[1], &arguments[2..]);
    }
    println!(
        "| scene | simplification | iterations without, with | CPU s | ratio | memory MB | difference of the results |"
    );
    println!("|---|---|---|---|---|---|---|");
    let wanted = |saving: &&Saving| arguments.iter().all(|word| word.starts_with('-') || saving.what.contains(word));
    SAVINGS.iter().filter(wanted).for_each(measure);
    apart();
}
