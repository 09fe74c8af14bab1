//! `asperity trade`: error norm, Pareto front, own error of the reference, and the command on a tiny scene.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use asperity::study::trade::{Cost, Curve, Estimate, best_within, cheapest, error, front};
use proptest::prelude::*;

/// A rounded block pressed on another and dragged: a few milliseconds a run.
const SCENE: &str = r#"
version = 1
title = "arc on block"
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-1.0, 1.0], y = [-0.5, 0.0] }
material = "rubber"
elements = [12, 3]
[body.upper]
shape = { type = "block", x = [-0.5, 0.5], y = [0.0, 0.5], bottom = { type = "arc", radius = 1.0 } }
material = "rubber"
elements = [7, 3]
position = [0.0, 0.14]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = { time = [0.5, 1.0], value = [0.0, 0.1] } }
y = { displacement = { time = [0.0, 0.5], value = [0.0, -0.04] } }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "coulomb", friction = 0.2 }
[time]
end = 1.0
steps = 8
"#;

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("trade").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    folder
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

/// Rows of a table as maps from columns to cells.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {}", row[column]))
}

fn curve(steps: usize, value: impl Fn(f64) -> f64, weight: impl Fn(f64) -> f64) -> Curve {
    let time: Vec<f64> = (1..=steps).map(|k| k as f64 / steps as f64).collect();
    Curve { value: time.iter().map(|t| value(*t)).collect(), weight: time.iter().map(|t| weight(*t)).collect(), time }
}

/// `v - r = c sin(2 pi n t)` has the root mean square `c/sqrt 2`; at equidistant points of whole periods exactly so.
#[test]
fn error_is_the_root_mean_square_of_the_difference_over_the_peak() {
    let wave = |t: f64| (std::f64::consts::TAU * 3.0 * t).sin();
    let reference = curve(4096, |t| 5.0 * t, |_| 1.0);
    let run = curve(4096, |t| 5.0 * t + 0.2 * wave(t), |_| 0.0);
    let expected = 0.2 / 2.0_f64.sqrt() / 5.0;
    assert!((error(&run, &reference) / expected - 1.0).abs() < 1e-3);
    assert_eq!(error(&reference, &reference), 0.0);
    // straight lines are read exactly between the nominal times, whichever has fewer of them
    let coarse = curve(64, |t| 5.0 * t + 0.1, |_| 1.0);
    assert!((error(&coarse, &reference) - 0.02).abs() < 1e-12);
    assert!((error(&reference, &coarse) - 0.1 / 5.1).abs() < 1e-12);
    // only what the reference weighs counts, and nothing found counts as zero
    let late = curve(4096, |t| 5.0 * t, |t| f64::from(u8::from(t > 0.5)));
    let early = curve(4096, |t| if t > 0.5 { 5.0 * t } else { 77.0 }, |_| 1.0);
    assert_eq!(error(&early, &late), 0.0);
    let nothing = curve(4096, |_| f64::NAN, |_| 1.0);
    assert!((error(&nothing, &reference) - 1.0 / 3.0_f64.sqrt()).abs() < 1e-3);
    assert!(error(&run, &curve(8, |_| 1.0, |_| 0.0)).is_nan());
}

/// Levels of a method of order q around a limit: the estimate is the true error of the finest, and never credits more than order 2.
#[test]
fn own_error_is_that_of_richardson_and_careful_otherwise() {
    let level = |order: i32, k: i32| 1.0 + 0.3 * 2.0_f64.powi(-order * k);
    for order in [1, 2] {
        let estimate = Estimate::new(level(order, 1) - level(order, 2), level(order, 0) - level(order, 1));
        assert!((estimate.error / (level(order, 2) - 1.0) - 1.0).abs() < 1e-12);
    }
    let third = Estimate::new(level(3, 1) - level(3, 2), level(3, 0) - level(3, 1));
    assert!(third.error > level(3, 2) - 1.0);
    // no order of convergence: all of the last difference
    assert_eq!(Estimate::new(0.1, 0.12).error, 0.1);
    assert_eq!(Estimate::new(0.1, f64::NAN).error, 0.1);
}

proptest! {
    /// What is in the front is dominated by nothing, what is not is by something in it; cheapest and best are what a search of all finds.
    #[test]
    fn front_is_what_nothing_dominates(numbers in prop::collection::vec((0_u32..20, 0_u32..22), 0..30), target in 0_u32..20) {
        let unknown = |error: u32| if error > 19 { f64::NAN } else { f64::from(error) };
        let costs: Vec<Cost> =
            numbers.iter().map(|(cpu, error)| Cost { cpu_s: f64::from(*cpu), error: unknown(*error) }).collect();
        let known: Vec<usize> = (0..costs.len()).filter(|k| !costs[*k].error.is_nan()).collect();
        let front = front(&costs);
        for k in &known {
            let dominated = known.iter().any(|other| costs[*other].dominates(&costs[*k]));
            let twin = front.iter().any(|other| costs[*other] == costs[*k]);
            prop_assert_eq!(!dominated, twin);
        }
        prop_assert!(front.windows(2).all(|pair| costs[pair[0]].cpu_s < costs[pair[1]].cpu_s));
        prop_assert!(front.windows(2).all(|pair| costs[pair[0]].error > costs[pair[1]].error));
        let target = f64::from(target);
        let least = known.iter().filter(|k| costs[**k].error <= target).map(|k| costs[*k].cpu_s).reduce(f64::min);
        prop_assert_eq!(cheapest(&costs, target).map(|k| costs[k].cpu_s), least);
        let best = known.iter().filter(|k| costs[**k].cpu_s <= target).map(|k| costs[*k].error).reduce(f64::min);
        prop_assert_eq!(best_within(&costs, target).map(|k| costs[k].error), best);
    }
}

/// Largest error of a run over the quantities asked for, by the norm on the histories themselves.
fn measured(run: &Path, reference: &Path) -> f64 {
    let read = |path: &Path| table(&path.join("history.csv"));
    let of = |rows: &[BTreeMap<String, String>], name: &str| Curve {
        time: rows.iter().map(|row| number(row, "time")).collect(),
        value: rows.iter().map(|row| number(row, name)).collect(),
        weight: rows.iter().map(|row| f64::from(u8::from(number(row, "contact_length") > 0.0))).collect(),
    };
    let (run, reference) = (read(run), read(reference));
    ["fx", "fy"].into_iter().map(|name| error(&of(&run, name), &of(&reference, name))).fold(0.0, f64::max)
}

#[test]
fn recommended_settings_meet_the_target_and_nothing_is_computed_twice() {
    let folder = folder("whole");
    let trade = ["trade", "scene.toml", "--quantity", "fx,fy", "--error", "0.02", "--effort", "5", "--out", "out"];
    let first = asperity(&folder, &trade);
    assert!(first.status.success(), "{}", String::from_utf8_lossy(&first.stderr));
    let said = String::from_utf8(first.stdout).unwrap();
    for part in ["Its own error", "| 10 % |", "| 2 % |", "The scene as it is", "What wastes most", "Another model"] {
        assert!(said.contains(part), "no {part:?} in\n{said}");
    }
    let rows = table(&folder.join("out/trade.csv"));
    let good = |row: &&BTreeMap<String, String>| row["role"] == "candidate" && number(row, "bound") <= 0.02;
    let cheapest = rows.iter().filter(good).map(|row| number(row, "cpu_s")).fold(f64::INFINITY, f64::min);
    let row = rows.iter().filter(good).find(|row| number(row, "cpu_s") == cheapest).expect("2 % is reached");
    assert_eq!(row["front"], "true");

    // the recommended scene is that row: computed on its own it has the error that was reported
    let run = asperity(&folder, &["run", "out/recommended.toml", "--out", "again", "--quiet"]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let reference = rows.iter().find(|row| row["role"] == "reference").expect("a reference");
    let found = measured(&folder.join("again"), &folder.join("out").join(&reference["folder"]));
    assert!((found / number(row, "error") - 1.0).abs() < 1e-9, "{found} against {}", row["error"]);

    // every basis, both integrations and another model are in the table
    for (column, value) in [("basis", "nurbs 4"), ("basis", "lagrange 2"), ("role", "other model")] {
        assert!(rows.iter().any(|row| row[column] == value), "no {value}");
    }
    assert!(rows.iter().any(|row| row["choices"].contains("integration segment")));
    for file in
        ["trade.md", "figures/work-precision.svg", "figures/work-precision.png", "figures/work-precision-fx.svg"]
    {
        assert!(folder.join("out").join(file).is_file(), "no {file}");
    }

    // the same command again
    let before = stamps(&folder.join("out/points"));
    let table_before = std::fs::read(folder.join("out/trade.csv")).unwrap();
    let second = asperity(&folder, &trade);
    assert_eq!(String::from_utf8(second.stdout).unwrap(), said);
    assert_eq!(stamps(&folder.join("out/points")), before);
    assert_eq!(std::fs::read(folder.join("out/trade.csv")).unwrap(), table_before);
}

/// When each point was computed.
fn stamps(points: &Path) -> BTreeMap<PathBuf, std::time::SystemTime> {
    let stamp = |folder: PathBuf| (folder.join("point.json").metadata().unwrap().modified().unwrap(), folder);
    let entries = std::fs::read_dir(points).unwrap().map(|entry| stamp(entry.unwrap().path()));
    entries.map(|(time, folder)| (folder, time)).collect()
}

#[test]
fn what_cannot_be_done_is_said() {
    let folder = folder("refused");
    let cases: [(&[&str], i32, &str); 7] = [
        (&["--quantity", "fz"], 2, "mu_global"),
        (&["--error", "0"], 2, "above 0"),
        (&["--error", "0.1", "--budget", "1"], 2, "cannot be used with"),
        (&["--effort", "nan"], 2, "above 0"),
        (&["--set", "time.steps=0"], 2, "time.steps"),
        (&["--effort", "0.001"], 2, "a larger --effort"),
        (&["--set", "drive.0.y.displacement=0.3", "--set", "drive.0.x.displacement=0.0"], 3, "never touch"),
    ];
    for (arguments, exit, part) in cases {
        let all: Vec<&str> =
            ["trade", "scene.toml", "--out", "out"].into_iter().chain(arguments.iter().copied()).collect();
        let output = asperity(&folder, &all);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(exit), "{arguments:?}: {said}");
        assert!(said.contains(part), "{arguments:?}: no {part:?} in\n{said}");
    }
}
