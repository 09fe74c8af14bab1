//! Readers under arbitrary input: they accept or refuse with words, and never panic or hang.
//!
//! A few thousand cases of each in the suite; `PROPTEST_CASES=1000000 cargo test --release --test fuzz` is the long form.

#[path = "fuzz/formulas.rs"]
mod formulas;
#[path = "fuzz/mutation.rs"]
mod mutation;

use asperity::geometry::shapes::{Block, Csv};
use asperity::geometry::{BasisSpec, Profile, ShapeSpec};
use asperity::laws::expression::{Curve, Symbol, Symbols, compile};
use asperity::laws::{self, dual};
use asperity::output::checkpoint::{decode, encode, sealed};
use asperity::output::{OutputError, RunFolder, checkpoint};
use asperity::scene::{Checkpoint, Probe, Scene, build};
use formulas::formula;
use mutation::{NUMBERS, broken, edits, text};
use proptest::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

/// Longest time that a reader may take for a few kilobytes, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

fn config() -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").is_ok();
    let default = ProptestConfig { failure_persistence: None, ..ProptestConfig::default() };
    if asked { default } else { ProptestConfig { cases: 3000, ..default } }
}

fn scenes() -> &'static [String] {
    static SCENES: LazyLock<Vec<String>> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
        let names = [
            "single_asperity",
            "expression_law",
            "multi_asperity",
            "hertz",
            "cattaneo_mindlin",
            "incline",
            "patch_test",
        ];
        names.iter().map(|name| std::fs::read_to_string(folder.join(name).with_extension("toml")).unwrap()).collect()
    });
    &SCENES
}

const SETS: [&str; 8] = [
    "time.steps=3",
    "contact.0.law.friction=0.1",
    "body.lower.elements=[4, 2]",
    "title=\"a\"",
    "contact.0.law={ type = \"tresca\", bound = 1 }",
    "support.0.displacement.x={ time = [0, 1], value = [0, 1] }",
    "material.rubber.poissons_ratio=0.49",
    "output.\"fields\"=2",
];

const FORMULAS: [&str; 6] = [
    "(mu + 0.2*exp(-s/0.5))*p",
    "min(p, 3)^0.5 - -2**3^2",
    "mu*p/(1 + abs(v)/T)",
    "table*tanh(v/1e-3)*p",
    "sqrt(p^2 + (v*dt)^2)",
    "max(1, 2, 3, p)*sign(s)*atan(v)\n + ln(1 + p)",
];

const PROFILES: [&str; 5] = [
    "x,height\n-1,0\n-0.2,0.1\n0.3,0.2\n1,0\n",
    "# a\n-1 0\n0 0.1\n\n1 0\n",
    "-1;0;\n1;0\n",
    "\u{feff}x height\n-1.5 0\n2 0.1\n",
    "-1,0\n-0.999999,0.1\n0,1e-3\n1,0.2\n",
];

const PROBES: [&str; 2] = [
    "[law]\nfriction = 0.4\n[[programme]]\ntype = \"velocity-steps\"\npressure = 2.0\nvelocity = [1.0, -10.0]\ndistance = 0.5\nsteps = 20\n\
     [[programme]]\ntype = \"spring-slider\"\npressure = 2.0\nstiffness = 3.0\nmass = 0.5\nvelocity = 0.1\nduration = 20.0\n",
    "law = { friction = 0.6, direct_effect = 0.01, evolution_effect = 0.015, distance = 1e-5, speed = 1e-6 }\n[units]\nlength = \"m\"\n\
     [[programme]]\ntype = \"slide-hold-slide\"\npressure = 1e6\nvelocity = 1e-6\ndistance = 1e-4\nhold = [30.0, 300.0]\n\
     [[programme]]\ntype = \"harmonic\"\npressure = 1e6\namplitude = 2e-5\nperiod = 100.0\ncycles = 2\n",
];

fn symbols() -> &'static Symbols {
    static SYMBOLS: LazyLock<Symbols> = LazyLock::new(|| {
        let mut symbols = Symbols::default();
        for (slot, name) in ["p", "v", "s", "dt", "T"].into_iter().enumerate() {
            symbols.add(name, Symbol::Slot(slot)).unwrap();
        }
        symbols.add("mu", Symbol::Number(0.3)).unwrap();
        let curve = Arc::new(Curve::new(vec![0.0, 1.0, 2.0], vec![0.1, 0.3, 0.2]).unwrap());
        symbols.add("table", Symbol::Curve { slot: 1, magnitude: true, curve }).unwrap();
        symbols
    });
    &SYMBOLS
}

/// Values and faults of a compiled formula at points of all sizes.
fn evaluate(text: &str) -> Result<(), String> {
    let program = compile(text, symbols())?;
    for (p, v) in [(0.0, 0.0), (1.0, -1.0), (1e-300, 1e300), (1e12, 1e-12), (f64::MAX, f64::MIN)] {
        let slots = [p, v, v, 1e-6, 300.0].map(dual::constant);
        let value = program.value(&slots);
        if value.re.is_nan() {
            assert!(program.fault(&slots).is_some(), "{text}: NaN without a fault");
        }
    }
    Ok(())
}

/// A profile read from a file as a block; `Err` is a refusal.
fn block(name: &str, text: &[u8]) -> Result<Vec<f64>, String> {
    let folder = scratch();
    let file = PathBuf::from(format!("{name}.csv"));
    std::fs::write(folder.join(&file), text).unwrap();
    let block = Block { x: [-1.0, 1.0], y: [-1.0, 0.0], top: Profile::Csv(Csv { file }), bottom: Profile::default() };
    let basis = BasisSpec::Nurbs { degree: 2 };
    let patch = asperity::geometry::build(&ShapeSpec::Block(block), &basis, [3, 1], None, [0.0; 2], &folder);
    patch.map(|patch| patch.points.iter().flat_map(|p| [p.x, p.y]).collect()).map_err(|error| error.to_string())
}

fn scratch() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("asperity-fuzz-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A scene, its model and a checkpoint of it after two steps.
static RUN: LazyLock<(Scene, asperity::model::Model, RunFolder, Vec<u8>)> = LazyLock::new(|| {
    let sets =
        ["time.steps=2", "time.end=0.2", "body.lower.elements=[4, 1]", "body.upper.elements=[3, 1]", "output.fields=0"];
    let sets: Vec<String> = sets.map(str::to_string).into();
    let (scene, _) = Scene::parse(Path::new("seed.toml"), scenes()[0].clone(), &sets).unwrap();
    let model = build(&scene, Path::new(".")).unwrap();
    let folder = RunFolder::create(&scratch().join("run")).unwrap();
    asperity::scene::run(&scene, &model, &folder, &Default::default(), |_| ()).unwrap();
    let bytes = std::fs::read(folder.checkpoint().join("state.bin")).unwrap();
    (scene, model, folder, bytes)
});

/// What becomes of a checkpoint with these bytes.
fn load(bytes: &[u8]) -> Result<usize, String> {
    let (scene, model, folder, _) = &*RUN;
    std::fs::write(folder.checkpoint().join("state.bin"), bytes).unwrap();
    let found = Checkpoint::load(folder, scene, model).map_err(|error| error.to_string())?.expect("a file");
    Ok(found.findings().len())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn scenes_and_sets(
        seed in 0..7usize, edits in edits(),
        sets in prop::collection::vec((0..SETS.len(), mutation::edits()), 0..3),
    ) {
        let clock = Instant::now();
        let text = text(&scenes()[seed], &edits);
        let sets: Vec<String> = sets.iter().map(|(k, edits)| mutation::text(SETS[*k], edits)).collect();
        match Scene::parse(Path::new("fuzz.toml"), text, &sets) {
            Ok((scene, _)) => {
                let json = serde_json::to_string(&scene).unwrap();
                prop_assert_eq!(&serde_json::from_str::<Scene>(&json).unwrap(), &scene);
            }
            Err(error) => prop_assert!(error.to_string().starts_with("error: ")),
        }
        prop_assert!(clock.elapsed() < PATIENCE);
    }

    #[test]
    fn broken_formulas(seed in 0..FORMULAS.len(), edits in edits()) {
        let clock = Instant::now();
        let text = text(FORMULAS[seed], &edits);
        if let Err(message) = evaluate(&text) {
            prop_assert!(message.contains('^'), "{} has no caret", message);
        }
        let table = toml::Table::from_iter([("type", "expression"), ("threshold", &text)].map(|(k, v)| (k.to_string(), v.into())));
        if let Err(error) = laws::parse(table) {
            prop_assert!(!error.to_string().is_empty());
        }
        prop_assert!(clock.elapsed() < PATIENCE);
    }

    #[test]
    fn right_formulas(text in formula()) {
        if let Err(message) = evaluate(&text) {
            prop_assert!(message.contains("too many unfinished") || message.contains("too deeply"), "{}: {}", text, message);
        }
    }

    #[test]
    fn csv_profiles(seed in 0..PROFILES.len(), edits in edits()) {
        let clock = Instant::now();
        match block("bytes", &broken(PROFILES[seed].as_bytes(), &edits)) {
            Ok(points) => prop_assert!(points.iter().all(|x| x.is_finite())),
            Err(message) => prop_assert!(message.contains("top.file") || message.contains('y'), "{}", message),
        }
        prop_assert!(clock.elapsed() < PATIENCE);
    }

    #[test]
    fn csv_profiles_of_extreme_numbers(rows in prop::collection::vec((0..NUMBERS.len(), 0..NUMBERS.len(), -1.5..1.5f64, any::<bool>()), 0..8)) {
        let mut rows: Vec<(f64, String)> = rows.into_iter().map(|(a, b, x, plain)| {
            let x = if plain { x } else { NUMBERS[a].parse().unwrap_or(0.5) };
            (x, format!("{x:e},{}\n", NUMBERS[b]))
        }).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let text: String = rows.into_iter().map(|row| row.1).collect();
        if let Ok(points) = block("numbers", text.as_bytes()) {
            prop_assert!(points.iter().all(|x| x.is_finite()), "{}", text);
        }
    }

    #[test]
    fn probes(seed in 0..PROBES.len(), edits in edits(), law in any::<prop::sample::Index>()) {
        let clock = Instant::now();
        let all = laws::linked();
        let info = if seed == 0 { laws::find("coulomb") } else { laws::find("rate-and-state") };
        let info = if edits.len() > 3 { all[law.index(all.len())] } else { info.unwrap() };
        if let Err(error) = Probe::parse(Path::new("fuzz.toml"), text(PROBES[seed], &edits), info) {
            prop_assert!(error.to_string().starts_with("error: "));
        }
        prop_assert!(clock.elapsed() < PATIENCE);
    }

    #[test]
    fn checkpoints(edits in edits(), resealed in any::<bool>()) {
        let clock = Instant::now();
        let seed = &RUN.3;
        let head = seed.iter().position(|b| *b == b'\n').unwrap() + 1;
        let bytes = if resealed { sealed(&broken(&seed[head..], &edits)) } else { broken(seed, &edits) };
        match load(&bytes) {
            Ok(_) => prop_assert!(resealed || bytes == *seed, "damage that was not noticed"),
            Err(message) => prop_assert!(message.contains("state.bin"), "{}", message),
        }
        prop_assert!(clock.elapsed() < PATIENCE);
    }
}

/// Numbers that JSON could not hold.
#[test]
fn checkpoints_hold_every_number() {
    let numbers = vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, f64::MIN_POSITIVE / 8.0, f64::MAX, 0.1];
    let back: Vec<f64> = decode(&encode(&numbers)).unwrap();
    assert!(back.iter().zip(&numbers).all(|(a, b)| a.to_bits() == b.to_bits()), "{back:?}");
    let missing: Result<Option<Vec<f64>>, OutputError> = checkpoint::read(Path::new("/no/such/checkpoint"));
    assert!(missing.unwrap().is_none());
}
