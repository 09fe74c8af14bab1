//! The scene: defaults, `--set`, round trips and what becomes of it in the model.

use std::path::Path;

use asperity::geometry::Point;
use asperity::model::{Control, Model};
use asperity::scene::{Course, Motion, Numerics, Place, Scene, SceneError, build};

const SCENE: &str = r#"
version = 1
[material.rubber]
type = "neo-hookean"
youngs_modulus = 2
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-1.0, 1.0], y = [-1.0, 0.0] }
material = "rubber"
elements = [4, 2]
[body.upper]
shape = { type = "block", x = [-0.5, 0.5], y = [0.0, 1.0] }
rigid = true
elements = [4, 1]
position = [0.0, 0.1]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = { time = [0.0, 1.0], value = [0.0, 0.5] } }
y = { force = -0.05 }
[[contact]]
nonmortar = { body = "lower", edge = "top" }
mortar = { body = "upper", edge = "bottom" }
law = { type = "coulomb", friction = 0.3 }
[time]
end = 1.0
steps = 4
"#;

fn read(sets: &[&str]) -> Result<Scene, SceneError> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Scene::parse(Path::new("scene.toml"), SCENE.into(), &sets).map(|(scene, _)| scene)
}

fn model(sets: &[&str]) -> Model {
    build(&read(sets).unwrap(), Path::new(".")).unwrap()
}

#[test]
fn what_is_left_out_has_its_default() {
    let scene = read(&[]).unwrap();
    assert_eq!(scene.contact[0].numerics, Numerics::default());
    assert_eq!(scene.body["lower"].basis.degree(), 2);
    assert_eq!((scene.output.fields, scene.output.interface, scene.output.figures), (10, 1, true));
}

#[test]
fn json_of_a_scene_is_complete_and_reads_back() {
    let scene = read(&["body.upper.rotation=7.25", "contact.0.numerics.points=5"]).unwrap();
    let json = serde_json::to_string(&scene).unwrap();
    assert_eq!(serde_json::from_str::<Scene>(&json).unwrap(), scene);
    for key in ["\"sites\":\"quadrature\"", "\"position\":[0.0,0.0]", "\"friction\":0.3", "\"max_cuts\":"] {
        assert!(json.contains(key), "{key} missing in {json}");
    }
}

#[test]
fn set_replaces_values_tables_and_absent_keys() {
    let scene = read(&[
        "contact.0.law={ type = \"tresca\", strength = 0.25 }",
        "contact.0.law.strength=0.5",
        "drive.0.y.force={ time = [0, 1], value = [0, -1] }",
        "title=\"a = b\"",
        "contact.0.numerics.sites=\"nodal\"",
        "body.lower.grading={ toward = \"top\", ratio = 2.0 }",
    ])
    .unwrap();
    assert_eq!(scene.contact[0].law["strength"].as_float(), Some(0.5));
    assert!(matches!(&scene.drive[0].y, Some(Motion::Force(Course::Table(table))) if table.value == [0.0, -1.0]));
    assert_eq!(scene.title, "a = b");
    assert!(scene.body["lower"].grading.is_some());
}

#[test]
fn place_of_an_error_is_exact() {
    let text = SCENE.replace("friction = 0.3", "friction = -0.3");
    let error = Scene::parse(Path::new("scene.toml"), text.clone(), &[]).unwrap_err();
    let [issue] = error.0.as_slice() else { panic!("{error}") };
    let Some(Place::File { line, column, text: shown, width, .. }) = issue.place.as_deref() else { panic!("{error}") };
    assert_eq!(shown, text.lines().nth(line - 1).unwrap());
    let marked: String = shown.chars().skip(column - 1).take(*width).collect();
    assert_eq!(marked, "-0.3");
}

/// Also in lines with characters of several bytes, and at the very end of a file without a newline.
#[test]
fn place_counts_characters() {
    let text = "version = 1\ntitle = \"µ → ∞\"; x";
    let error = Scene::parse(Path::new("scene.toml"), text.into(), &[]).unwrap_err();
    let Some(Place::File { line: 2, column, .. }) = error.0[0].place.as_deref() else { panic!("{error}") };
    assert!((16..=18).contains(column), "{column}");
}

/// Whatever is cut off or overwritten in a scene, reading it is an answer, not a panic.
#[test]
fn damaged_text_never_panics() {
    for end in (0..SCENE.len()).step_by(3) {
        for text in [SCENE[..end].to_string(), format!("{}\u{221e}{}", &SCENE[..end], &SCENE[end..])] {
            if let Err(error) = Scene::parse(Path::new("scene.toml"), text, &[]) {
                assert!(error.to_string().starts_with("error: "));
            }
        }
    }
}

#[test]
fn built_model_follows_the_scene() {
    let model = model(&["body.lower.position=[3.0, 1.0]", "body.upper.position=[3.0, 1.1]"]);
    let (lower, upper) = (&model.bodies[0], &model.bodies[1]);
    assert_eq!((lower.name.as_str(), upper.is_rigid()), ("lower", true));
    // degree 2: elements + 2 functions in each direction
    assert_eq!(lower.points.len(), 6 * 4);
    assert_eq!(lower.points[0], Point::new(2.0, 0.0));
    assert!(upper.points.iter().all(|x| (x.y - 1.1).abs() < 1e-15));
    assert_eq!(model.modulus, 2.0);
    let drives: Vec<_> = model.motions.iter().filter(|motion| motion.drive).collect();
    assert!(matches!(&drives[0].control, Control::Displacement(table) if (table.at(0.5) - 0.25).abs() < 1e-15));
    assert!(matches!(&drives[1].control, Control::Force(table) if table.at(0.7) == -0.05));
    assert_eq!(drives[1].nodes.len(), upper.points.len());
    let numerics = model.pairs[0].contact.numerics();
    assert_eq!((numerics.r, numerics.r_tangential), (1.0, 1.0));
}

#[test]
fn rotation_turns_a_body_about_its_position() {
    let turned = model(&["body.lower.rotation=90", "body.lower.position=[3.0, 1.0]", "body.upper.position=[3.0, 9.0]"]);
    // (-1, -1) turned by 90 degrees is (1, -1)
    let corner = turned.bodies[0].points[0];
    assert!((corner - Point::new(4.0, 0.0)).norm() < 1e-14, "{corner}");
}

#[test]
fn multipliers_of_a_lower_degree_are_fewer() {
    let multipliers = |sets: &[&str]| model(sets).pairs[0].unknowns();
    // two per function: pressure and traction; 4 elements of degree 2, 0
    assert_eq!(multipliers(&[]), 2 * 6);
    assert_eq!(multipliers(&["contact.0.numerics.multiplier_degree=0"]), 2 * 4);
    assert_eq!(multipliers(&["contact.0.law={ type = \"frictionless\" }"]), 6);
}

/// The schema that is printed is the one that is enforced: it must know every key of the structs.
#[test]
fn schema_describes_what_is_read() {
    let grammar = Scene::grammar();
    let schema = grammar.root();
    let mut value = serde_json::to_value(read(&[]).unwrap()).unwrap();
    let keys = value.as_object_mut().unwrap().keys().cloned().collect::<Vec<_>>();
    for key in keys {
        assert!(schema["properties"].get(&key).is_some(), "{key}");
    }
    assert_eq!(schema["additionalProperties"], false);
    let laws = schema["$defs"]["ContactSpec"]["properties"]["law"]["oneOf"].as_array().unwrap();
    assert_eq!(laws.len(), asperity::laws::linked().len());
}

/// Every scene of the examples and papers can be used.
#[test]
fn example_scenes_load_and_build() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let papers = std::fs::read_dir(root.join("papers")).into_iter().flatten().flatten().map(|entry| entry.path());
    for folder in std::iter::once(root.join("examples")).chain(papers) {
        for file in std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
            let text = if file.extension().is_some_and(|e| e == "toml") {
                std::fs::read_to_string(&file).unwrap()
            } else {
                continue;
            };
            // studies are TOML, too
            if text.contains("version = 1") && text.contains("[body.") {
                let (scene, source) = Scene::load(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
                build(&scene, &folder).map_err(|error| source.locate(error)).unwrap_or_else(|error| panic!("{error}"));
            }
        }
    }
}
