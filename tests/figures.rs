//! Figures are drawn from a synthetic pass of two bumps; what can be checked without eyes is checked here.
//! `ASPERITY_FIGURES_OUT=DIR cargo test --test figures` keeps them for those who have eyes.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::geometry::{BSpline, Basis, Patch, Point};
use asperity::model;
use asperity::output::UnitLabels;
use asperity::output::figures::{Data, choose};
use asperity::output::vtu::{BodyField, CauchySample};

#[path = "../src/output/figures/synthetic.rs"]
mod synthetic;
use synthetic::{history, interface, pass, surfaces};

/// Block between two heights over `x`, quadratic, in the deformed state of a pass at the driven position.
fn block(x: [f64; 2], elements: [usize; 2], height: impl Fn(f64) -> [f64; 2]) -> Patch {
    let basis = elements.map(|n| {
        let breaks: Vec<f64> = (0..=n).map(|k| k as f64 / n as f64).collect();
        Arc::new(BSpline::from_breaks(2, &breaks, |_| 1).unwrap()) as Arc<dyn Basis>
    });
    let (u, v) = (basis[0].nodes(), basis[1].nodes());
    let point = |u: f64, v: f64| {
        let x = x[0] + u * (x[1] - x[0]);
        let [low, high] = height(x);
        Point::new(x, low + v * (high - low))
    };
    let points: Vec<Point> = v.iter().flat_map(|v| u.iter().map(|u| point(*u, *v))).collect();
    Patch { weights: vec![1.0; points.len()], points, basis }
}

fn stress(patch: &Patch, centre: [f64; 2], size: f64) -> impl Fn([usize; 2], [f64; 2]) -> CauchySample {
    move |element, uv| {
        let (x, _) = patch.map(element, uv);
        let distance = (x.x - centre[0]).hypot(x.y - centre[1]);
        let level = size * (0.25 / (0.25 + distance * distance));
        CauchySample { stress: [-0.2 * level, -level, -0.3 * level, 0.1 * level], det_f: 1.0 }
    }
}

fn units() -> UnitLabels {
    UnitLabels { length: "mm".into(), stress: "MPa".into(), time: "s".into() }
}

fn folder(name: &str) -> PathBuf {
    let root = std::env::var("ASPERITY_FIGURES_OUT").map_or_else(|_| std::env::temp_dir(), PathBuf::from);
    let folder = root.join(format!("asperity-figures-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Width and height of a PNG from its header.
fn png_size(path: &Path) -> [u32; 2] {
    let bytes = fs::read(path).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

fn names(paths: &[PathBuf]) -> Vec<String> {
    paths.iter().map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect()
}

#[test]
fn a_pass_is_drawn_whole() {
    let (records, units, folder) = (pass(76, 0.3), units(), folder("pass"));
    let rows = interface(&records, 0.3);
    let data = Data { records: &records, interface: &rows, local_friction: Some(0.3), variables: &[], units: &units };
    let mut written = data.write_charts(&folder).unwrap();
    let frames: Vec<_> = choose(&records)
        .iter()
        .map(|instant| {
            let drive = records[instant.index].drive[0];
            let size = 4.0 * records[instant.index].force[1].max(0.0);
            let middle = |x: f64| surfaces(x, drive).iter().sum::<f64>() / 2.0;
            let lower = block([-2.0, 2.0], [80, 20], |x| {
                let [low, high] = surfaces(x, drive);
                [-1.0, if low > high && (x - drive + 1.9).abs() < 1.0 { middle(x) } else { low }]
            });
            let upper = block([drive - 2.9, drive - 0.9], [40, 20], |x| {
                let [low, high] = surfaces(x, drive);
                [if low > high { middle(x) } else { high }, 1.5]
            });
            let still = [vec![Point::zeros(); lower.points.len()], vec![Point::zeros(); upper.points.len()]];
            let centre = [0.5 * (drive - 1.9), 0.3];
            let field = |name, patch, displacement| BodyField::Deformable {
                name,
                patch,
                displacement,
                stress: Box::new(stress(patch, centre, size)),
            };
            data.frame(instant, &[field("lower", &lower, &still[0]), field("upper", &upper, &still[1])])
        })
        .collect();
    written.extend(data.write_bodies(&folder, &frames).unwrap());
    let expected = ["forces", "mu_global", "energy", "interface", "bodies"];
    let expected: Vec<String> =
        expected.iter().flat_map(|name| ["svg", "png"].map(|kind| format!("{name}.{kind}"))).collect();
    assert_eq!(names(&written), expected);
    // 84 mm and 174 mm at 400 dpi.
    assert_eq!(png_size(&folder.join("forces.png"))[0], 1323);
    assert_eq!(png_size(&folder.join("bodies.png"))[0], 2741);
    let forces = fs::read_to_string(folder.join("forces.svg")).unwrap();
    assert!(forces.contains("sliding distance / mm") && forces.contains("(MPa mm)"));
    assert!(fs::metadata(folder.join("bodies.svg")).unwrap().len() < 4_000_000);
}

#[test]
fn text_is_in_the_png_without_fonts_of_the_machine() {
    // The same chart with and without text must differ in ink; the renderer is given no system font.
    let (records, folder) = (pass(40, 0.1), folder("ink"));
    let bare = UnitLabels::default();
    let data = Data { records: &records, interface: &[], local_friction: None, variables: &[], units: &bare };
    data.write_charts(&folder).unwrap();
    let with_units = units();
    let named = Data { units: &with_units, ..data };
    let before = fs::read(folder.join("forces.png")).unwrap();
    named.write_charts(&folder).unwrap();
    assert_ne!(before, fs::read(folder.join("forces.png")).unwrap());
}

#[test]
fn odd_histories_are_drawn_too() {
    let units = UnitLabels::default();
    let mut failed = pass(30, 0.3);
    failed[20].converged = false;
    failed[20].force = [f64::NAN; 2];
    let mut spike = pass(76, 0.3);
    spike[10].mu_global = 500.0;
    let mut tiny = pass(76, 0.1);
    for record in &mut tiny {
        record.force = record.force.map(|f| 1e-9 * f);
        record.drive[0] *= 1e-6;
    }
    let mut still = history(20, |t| [0.0, t]);
    still.iter_mut().for_each(|record| record.drive = [0.0, 0.0]);
    let cases = [
        ("failed", failed),
        ("spike", spike),
        ("tiny", tiny),
        ("still", still),
        ("no-contact", history(10, |_| [0.0, 0.0])),
        ("three", pass(3, 0.3)),
    ];
    for (name, records) in cases {
        let rows = interface(&records, 0.3);
        let data =
            Data { records: &records, interface: &rows, local_friction: Some(0.3), variables: &[], units: &units };
        for path in data.write_charts(&folder(name)).unwrap() {
            let text = fs::read(&path).unwrap();
            assert!(!String::from_utf8_lossy(&text).contains("NaN"), "{name}: {}", path.display());
        }
    }
    let data = Data { records: &[], interface: &[], local_friction: None, variables: &[], units: &units };
    assert!(data.write_charts(&folder("empty")).unwrap().is_empty());
    assert!(data.write_bodies(&folder("empty"), &[]).unwrap().is_empty());
}
