//! Scenes that are right by construction but full of extreme numbers: they run or are refused with words, and never panic, hang, or
//! write what is no number into a table.
//!
//! `PROPTEST_CASES=5000 cargo test --release --test random_scenes` is the long form.

use asperity::output::RunFolder;
use asperity::scene::{self, Scene, build};
use asperity::solve::Status;
use cpu_time::ProcessTime;
use proptest::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Longest CPU time for a few steps of a few elements; then it counts as hanging.
const PATIENCE: Duration = Duration::from_secs(60);

/// Numbers of any size, most of them of the order of the scene.
fn extreme() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -1.0..1.0f64,
        1 => Just(0.0),
        2 => (-12..12i32, any::<bool>()).prop_map(|(k, minus)| if minus { -(10f64.powi(k)) } else { 10f64.powi(k) }),
        1 => prop::sample::select(vec![1e-300, 1e300, -1e300, 1e150, f64::MIN_POSITIVE]),
    ]
}

/// The same, above zero.
fn positive() -> impl Strategy<Value = f64> {
    extreme().prop_map(|x| if x == 0.0 { 1.0 } else { x.abs() })
}

fn material() -> impl Strategy<Value = String> {
    let kind = prop::sample::select(vec!["neo-hookean", "saint-venant-kirchhoff", "linear-elastic"]);
    let ratio = prop_oneof![3 => 0.0..0.49f64, 1 => prop::sample::select(vec![-0.99, -0.5, 0.0, 0.4999, 0.499999])];
    let modulus = prop_oneof![3 => Just(1.0), 1 => positive()];
    (kind, ratio, modulus)
        .prop_map(|(kind, nu, e)| format!("type = \"{kind}\"\nyoungs_modulus = {e:e}\npoissons_ratio = {nu:e}\n"))
}

fn profile() -> impl Strategy<Value = String> {
    prop_oneof![
        2 => Just("{ type = \"flat\" }".to_string()),
        4 => (-0.4..0.4f64, 0.2..3.0f64).prop_map(|(h, l)| format!("{{ type = \"cosine\", height = {h:e}, wavelength = {l:e} }}")),
        1 => (extreme(), positive()).prop_map(|(h, l)| format!("{{ type = \"cosine\", height = {h:e}, wavelength = {l:e} }}")),
        2 => (0.05..0.4f64, 0.3..2.0f64).prop_map(|(h, r)| format!("{{ type = \"arc\", height = {h:e}, radius = {r:e} }}")),
        2 => (0.1..0.5f64, 10.0..80.0f64, 0.01..0.3f64)
            .prop_map(|(h, a, r)| format!("{{ type = \"wedge\", height = {h:e}, angle = {a:e}, tip_radius = {r:e} }}")),
        1 => prop::collection::vec(-0.3..0.3f64, 3).prop_map(|h| format!(
            "{{ type = \"polyline\", points = [[-1.0, {:e}], [0.1, {:e}], [1.0, {:e}]] }}", h[0], h[1], h[2]
        )),
    ]
}

fn law() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => prop_oneof![Just(0.0), Just(1e-12), Just(0.3), Just(1.0), Just(10.0), positive()]
            .prop_map(|mu| format!("{{ type = \"coulomb\", friction = {mu:e} }}")),
        1 => Just("{ type = \"frictionless\" }".to_string()),
        1 => positive().prop_map(|s| format!("{{ type = \"dahl\", friction = 0.3, stiffness = {s:e} }}")),
        1 => (positive(), positive()).prop_map(|(k, v)| format!(
            "{{ type = \"lugre\", rest = 0.4, kinetic = 0.2, speed = {v:e}, stiffness = {k:e}, damping = 0.01, viscosity = 0.01 }}"
        )),
        1 => (positive(), positive()).prop_map(|(d, v)| format!(
            "{{ type = \"rate-and-state\", friction = 0.3, direct_effect = 0.03, evolution_effect = 0.04, distance = {d:e}, speed = {v:e} }}"
        )),
        1 => positive().prop_map(|v| format!(
            "{{ type = \"stribeck\", static_friction = 0.3, kinetic_friction = 0.2, speed = {v:e}, exponent = 2.0, viscous = 0.01 }}"
        )),
        1 => extreme().prop_map(|a| format!("{{ type = \"expression\", threshold = \"0.3*p/(1 + a*abs(v))\", parameters = {{ a = {a:e} }} }}")),
    ]
}

fn course() -> impl Strategy<Value = String> {
    let near = || prop_oneof![4 => -0.5..0.5f64, 1 => extreme()];
    prop_oneof![
        1 => near().prop_map(|v| format!("{v:e}")),
        3 => (near(), near(), 0.1..0.9f64).prop_map(|(a, b, t)| format!("{{ time = [0.0, {t:e}, 1.0], value = [0.0, {a:e}, {b:e}] }}")),
    ]
}

fn motion() -> impl Strategy<Value = String> {
    (prop_oneof![4 => Just("displacement"), 1 => Just("force")], course())
        .prop_map(|(kind, course)| format!("{{ {kind} = {course} }}"))
}

fn body() -> impl Strategy<Value = String> {
    let basis = prop::sample::select(vec![
        ("nurbs", 1),
        ("nurbs", 2),
        ("nurbs", 3),
        ("nurbs", 5),
        ("lagrange", 1),
        ("lagrange", 2),
    ]);
    (basis, 1..7usize, 1..3usize).prop_map(|((name, degree), nx, ny)| {
        format!("basis = {{ type = \"{name}\", degree = {degree} }}\nelements = [{nx}, {ny}]\n")
    })
}

fn numerics() -> impl Strategy<Value = String> {
    let sites = prop::sample::select(vec!["quadrature", "nodal"]);
    let projection = prop::sample::select(vec!["auto", "closest", "ray"]);
    let integration = prop::sample::select(vec!["auto", "element", "segment"]);
    let r = prop_oneof![4 => Just(1.0), 1 => positive()];
    (sites, projection, integration, r).prop_map(|(s, p, i, r)| {
        format!("{{ sites = \"{s}\", projection = \"{p}\", integration = \"{i}\", r = {r:e} }}")
    })
}

fn time() -> impl Strategy<Value = String> {
    let end = prop_oneof![4 => Just(1.0), 1 => prop::sample::select(vec![1e-12, 1e-3, 1e6, 1e300, 1e-300])];
    (end, 1..5usize, 0..4u32)
        .prop_map(|(end, steps, cuts)| format!("end = {end:e}\nsteps = {steps}\nmax_cuts = {cuts}\n"))
}

/// Two blocks, one above the other.
fn scene() -> impl Strategy<Value = String> {
    let place = || prop_oneof![4 => -0.3..0.3f64, 1 => extreme()];
    let bodies = (body(), body(), profile(), profile(), place(), place());
    let contact = (material(), material(), law(), numerics());
    let solver = prop::sample::select(vec!["condensed", "sparse-lu"]);
    (bodies, contact, (motion(), motion()), time(), solver).prop_map(
        |((lower, upper, top, bottom, dx, dy), (soft, hard, law, numerics), (x, y), time, solver)| {
            format!(
                "version = 1\n[material.a]\n{soft}[material.b]\n{hard}\
                 [body.lower]\nshape = {{ type = \"block\", x = [-1.5, 1.5], y = [-1.0, 0.0], top = {top} }}\nmaterial = \"a\"\n{lower}\
                 [body.upper]\nshape = {{ type = \"block\", x = [-1.0, 1.0], y = [0.4, 1.4], bottom = {bottom} }}\nmaterial = \"b\"\n{upper}\
                 position = [{dx:e}, {dy:e}]\n\
                 [[support]]\nbody = \"lower\"\nedge = \"bottom\"\ndisplacement = {{ x = 0.0, y = 0.0 }}\n\
                 [[drive]]\nbody = \"upper\"\nedge = \"top\"\nx = {x}\ny = {y}\n\
                 [[contact]]\nnonmortar = {{ body = \"upper\", edge = \"bottom\" }}\nmortar = {{ body = \"lower\", edge = \"top\" }}\n\
                 law = {law}\nnumerics = {numerics}\n[time]\n{time}[solution]\nsolver = \"{solver}\"\n[output]\nfields = 0\nfigures = false\n"
            )
        },
    )
}

/// Cells of a table that are no finite numbers, but for columns that may hold none; with line and column.
fn strange(path: &Path, may: impl Fn(&str, &[&str]) -> bool) -> Vec<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let mut found = vec![];
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        for (name, cell) in header.iter().zip(&cells) {
            if cell.parse::<f64>().is_ok_and(|x| !x.is_finite()) && !may(name, &cells) {
                found.push(format!("{name} = {cell} in {line}"));
            }
        }
    }
    found
}

fn folder() -> PathBuf {
    std::env::temp_dir().join(format!("asperity-random-{}", std::process::id()))
}

/// Raises the flag once the process has worked for [`PATIENCE`] before the returned sender says that all is done.
fn alarm(flag: Arc<AtomicBool>) -> std::sync::mpsc::Sender<()> {
    let (done, wait) = std::sync::mpsc::channel();
    let clock = ProcessTime::now();
    std::thread::spawn(move || {
        while wait.recv_timeout(PATIENCE / 100) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
            flag.store(clock.elapsed() > PATIENCE, Ordering::Relaxed);
        }
    });
    done
}

fn config() -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").is_ok();
    let default = ProptestConfig { failure_persistence: None, max_shrink_iters: 20, ..ProptestConfig::default() };
    if asked { default } else { ProptestConfig { cases: 300, ..default } }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn they_run_or_are_refused(text in scene()) {
        let parsed = Scene::parse(Path::new("random.toml"), text.clone(), &[]);
        let Ok((scene, source)) = parsed else {
            let said = parsed.unwrap_err().to_string();
            prop_assert!(said.starts_with("error: ") && said.contains("random.toml:"), "{}", said);
            return Ok(());
        };
        let model = match build(&scene, Path::new(".")) {
            Ok(model) => model,
            Err(error) => {
                let said = source.locate(error).to_string();
                prop_assert!(said.starts_with("error: ") && said.contains("random.toml:"), "{}", said);
                return Ok(());
            }
        };
        let folder = RunFolder::create(&folder()).unwrap();
        std::fs::write(folder.root().join("scene.toml"), &text).unwrap();
        let flag = Arc::new(AtomicBool::new(false));
        let alarm = alarm(flag.clone());
        let report = scene::run(&scene, &model, &folder, &flag, |_| ()).unwrap();
        let _ = alarm.send(());
        match &report.outcome.status {
            Status::Done => {}
            Status::NotConverged { reason, .. } => prop_assert!(!reason.is_empty()),
            Status::Interrupted { .. } => prop_assert!(false, "hangs:\n{}", text),
        }
        // no coefficient and no angle without contact; no place, gap and slip without a partner
        let history = strange(&folder.history(), |name, _| ["mu_global", "contact_angle"].contains(&name));
        prop_assert!(history.is_empty(), "{:?}\n{}", history, text);
        let undefined = |name: &str, cells: &[&str]| cells.contains(&"open") && ["x", "y", "gap", "slip"].contains(&name);
        let interface = strange(&folder.interface(), undefined);
        prop_assert!(interface.is_empty(), "{:?}\n{}", interface, text);
    }
}
