//! Every kind of bad input is refused with exit code 2 and a message that names file, line, key and what is allowed.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A scene that is fine; each case breaks it in one place.
const GOOD: &str = r#"version = 1
title = "two blocks"
[units]
length = "mm"
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-1.0, 1.0], y = [-1.0, 0.0] }
material = "rubber"
elements = [4, 4]
[body.upper]
shape = { type = "block", x = [-0.5, 0.5], y = [0.0, 1.0], bottom = { type = "cosine", height = 0.2, wavelength = 0.8, centers = [0.0] } }
material = "rubber"
basis = { type = "nurbs", degree = 2 }
elements = [4, 4]
position = [0.0, 0.1]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = 0.0 }
y = { displacement = { time = [0.0, 1.0], value = [0.0, -0.2] } }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "coulomb", friction = 0.3 }
[time]
end = 1.0
steps = 4
"#;

fn scene_file(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bad_input");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, text).unwrap();
    path
}

fn asperity(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).args(arguments).output().unwrap()
}

/// Asserts refusal and returns what was said.
fn refusal(output: &Output) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(!said.contains("panicked"), "{said}");
    assert!(output.stdout.is_empty());
    said
}

fn assert_says(said: &str, parts: &[&str]) {
    for part in parts {
        assert!(said.contains(part), "expected {part:?} in:\n{said}");
    }
}

/// Replaces `from` by `to` in the good scene; the message must point at the line that holds `at` and say all of `says`.
fn refuses(name: &str, from: &str, to: &str, at: &str, key: &str, says: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "{from:?} must occur once");
    let text = GOOD.replace(from, to);
    let path = scene_file(name, &text);
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    let offset = text.find(at).unwrap();
    let line = text[..offset].lines().count() + usize::from(text[..offset].ends_with('\n') || offset == 0);
    assert_says(&said, &[&format!("{}:{line}:", path.display()), &format!("key: {key}\n")]);
    assert_says(&said, says);
}

macro_rules! refuses {
    ($($name:ident: $from:expr => $to:expr, at $at:expr, key $key:expr, says $says:expr;)*) => {$(
        #[test]
        fn $name() {
            refuses(stringify!($name), $from, $to, $at, $key, &$says);
        }
    )*};
}

refuses! {
    version_missing: "version = 1\n" => "", at "title", key "version", says ["missing key `version`", "allowed: 1"];
    version_of_the_future: "version = 1" => "version = 2", at "version = 2", key "version", says ["integer 2", "allowed: 1"];
    unknown_key: "steps = 4" => "stpes = 4", at "stpes", key "time.stpes", says ["did you mean `steps`?", "`end`"];
    missing_key: "steps = 4" => "", at "[time]", key "time.steps", says ["missing key `steps`", "an integer >= 1"];
    wrong_type: "end = 1.0" => "end = \"long\"", at "end = ", key "time.end", says ["the string \"long\"", "a number > 0"];
    key_of_a_law: "friction = 0.3" => "frcition = 0.3", at "law = ", key "contact.0.law.frcition",
        says ["did you mean `friction`?", "missing key `friction`"];
    unknown_law: "\"coulomb\"" => "\"colomb\"", at "law = ", key "contact.0.law.type",
        says ["unknown type \"colomb\"", "`frictionless`", "did you mean `coulomb`?", "use that_crate as _;"];
    law_parameter_out_of_range: "friction = 0.3" => "friction = -0.3", at "law = ", key "contact.0.law.friction",
        says ["-0.3", "a number >= 0"];
    law_parameter_not_a_number: "friction = 0.3" => "friction = nan", at "law = ", key "contact.0.law.friction",
        says ["NaN", "a finite number"];
    law_formula: "type = \"coulomb\", friction = 0.3" => "type = \"expression\", threshold = \"0.3*q\"", at "law = ",
        key "contact.0.law.threshold", says ["unknown symbol `q`", "character 5:\n    0.3*q\n        ^"];
    law_state: "type = \"coulomb\", friction = 0.3" => "type = \"expression\", threshold = \"p\", states = {\nz = { rate = \"v*\" } }",
        at "z = ", key "contact.0.law.states.z.rate", says ["expected here", "character 3:\n    v*\n      ^"];
    law_missing: "law = { type = \"coulomb\", friction = 0.3 }" => "", at "[[contact]]", key "contact.0.law",
        says ["missing key `law`", "type = \"coulomb\""];
    law_without_type: "type = \"coulomb\", friction" => "friction", at "law = ", key "contact.0.law.type",
        says ["missing key `type`", "`coulomb`"];
    incompressible: "poissons_ratio = 0.3" => "poissons_ratio = 0.5", at "poissons_ratio",
        key "material.rubber.poissons_ratio", says ["the number 0.5", "a number > -1 and < 0.5"];
    poissons_ratio_below: "poissons_ratio = 0.3" => "poissons_ratio = -1", at "poissons_ratio",
        key "material.rubber.poissons_ratio", says ["a number > -1 and < 0.5"];
    no_stiffness: "youngs_modulus = 1.0" => "youngs_modulus = 0.0", at "youngs_modulus",
        key "material.rubber.youngs_modulus", says ["a number > 0"];
    infinite_stiffness: "youngs_modulus = 1.0" => "youngs_modulus = inf", at "youngs_modulus",
        key "material.rubber.youngs_modulus", says ["a finite number"];
    unknown_material: "[material.rubber]" => "[material.robber]", at "material = \"rubber\"", key "body.lower.material",
        says ["no material \"rubber\"", "did you mean `robber`?"];
    unknown_material_type: "\"neo-hookean\"" => "\"neohooke\"", at "type = \"neohooke", key "material.rubber.type",
        says ["`neo-hookean`, `saint-venant-kirchhoff`, `linear-elastic`"];
    no_material: "material = \"rubber\"\nbasis" => "basis", at "[body.upper]", key "body.upper.material",
        says ["missing key `material`", "`rubber`", "rigid = true"];
    rigid_nonmortar: "material = \"rubber\"\nbasis" => "rigid = true\nbasis", at "nonmortar = ",
        key "contact.0.nonmortar.body", says ["the nonmortar side is rigid", "exchange nonmortar and mortar"];
    rigid_and_material: "material = \"rubber\"\nbasis" => "rigid = true\nmaterial = \"rubber\"\nbasis",
        at "material = \"rubber\"\nbasis", key "body.upper.material", says ["a rigid body has no `material`"];
    negative_size: "x = [-0.5, 0.5]" => "x = [0.5, -0.5]", at "x = [0.5, -0.5]", key "body.upper.shape.x",
        says ["low < high"];
    zero_wavelength: "wavelength = 0.8" => "wavelength = 0.0", at "wavelength", key "body.upper.shape.bottom.wavelength",
        says ["above 0"];
    unknown_profile: "\"cosine\"" => "\"sine\"", at "\"sine\"", key "body.upper.shape.bottom.type",
        says ["`cosine`", "did you mean `cosine`?"];
    unknown_shape_key: "height = 0.2" => "heigth = 0.2", at "heigth", key "body.upper.shape.bottom.heigth",
        says ["did you mean `height`?"];
    knots_not_monotone: "shape = { type = \"block\", x = [-1.0, 1.0], y = [-1.0, 0.0] }"
        => "shape = { type = \"nurbs\", degrees = [1, 1], knots = [[0.0, 0.0, 0.7, 0.3, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0]], points = [[0.0, 0.0], [0.3, 0.0], [0.7, 0.0], [1.0, 0.0], [0.0, 1.0], [0.3, 1.0], [0.7, 1.0], [1.0, 1.0]] }",
        at "knots", key "body.lower.shape.knots", says ["must not decrease", "0.3 follows 0.7"];
    degree_too_high: "degree = 2" => "degree = 9", at "degree = 9", key "body.upper.basis.degree", says ["1 to 8"];
    no_elements: "basis = { type = \"nurbs\", degree = 2 }\nelements = [4, 4]" => "elements = [0, 4]", at "elements = [0",
        key "body.upper.elements.0", says ["an integer >= 1"];
    absurdly_many_elements: "basis = { type = \"nurbs\", degree = 2 }\nelements = [4, 4]" => "elements = [90000, 90000]",
        at "elements = [9", key "body.upper.elements", says ["too many", "at most"];
    half_an_element: "basis = { type = \"nurbs\", degree = 2 }\nelements = [4, 4]" => "elements = [4.5, 4]",
        at "elements = [4.5", key "body.upper.elements.0", says ["the number 4.5", "an integer"];
    position_not_a_number: "position = [0.0, 0.1]" => "position = [nan, 0.1]", at "position", key "body.upper.position.0",
        says ["a finite number"];
    time_runs_backwards: "time = [0.0, 1.0]" => "time = [1.0, 0.0]", at "time = [1", key "drive.0.y.displacement.time.1",
        says ["time 0 follows 1", "strictly increasing"];
    time_stands_still: "time = [0.0, 1.0]" => "time = [0.5, 0.5]", at "time = [0.5", key "drive.0.y.displacement.time.1",
        says ["strictly increasing"];
    lengths_differ: "value = [0.0, -0.2]" => "value = [0.0]", at "value = [0.0]", key "drive.0.y.displacement.value",
        says ["2 times but 1 values", "as many values as times"];
    empty_time_table: "time = [0.0, 1.0], value = [0.0, -0.2]" => "time = [], value = []", at "time = []",
        key "drive.0.y.displacement.time", says ["a list of at least 1"];
    no_duration: "end = 1.0" => "end = 0.0", at "end = 0", key "time.end", says ["a number > 0"];
    endless: "end = 1.0" => "end = inf", at "end = inf", key "time.end", says ["a finite number"];
    no_steps: "steps = 4" => "steps = 0", at "steps", key "time.steps", says ["an integer >= 1 and <= 1000000"];
    absurdly_many_steps: "steps = 4" => "steps = 4_000_000_000_000", at "steps", key "time.steps",
        says ["<= 1000000"];
    integer_beyond_64_bits: "steps = 4" => "steps = 99999999999999999999", at "steps", key "time.steps",
        says ["does not fit into 64 bits"];
    contact_names_unknown_body: "mortar = { body = \"lower\", edge = \"top\" }" => "mortar = { body = \"lover\", edge = \"top\" }",
        at "\"lover\"", key "contact.0.mortar.body", says ["no body \"lover\"", "did you mean `lower`?", "`upper`"];
    contact_names_unknown_edge: "mortar = { body = \"lower\", edge = \"top\" }" => "mortar = { body = \"lower\", edge = \"tip\" }",
        at "\"tip\"", key "contact.0.mortar.edge", says ["`bottom`, `right`, `top`, `left`", "did you mean `top`?"];
    contact_without_edge: "mortar = { body = \"lower\", edge = \"top\" }" => "mortar = { body = \"lower\" }",
        at "mortar = { body = \"lower\"", key "contact.0.mortar.edge", says ["missing key `edge`"];
    contact_with_itself: "mortar = { body = \"lower\", edge = \"top\" }" => "mortar = { body = \"upper\", edge = \"top\" }",
        at "mortar = { body = \"upper\", edge = \"top\"", key "contact.0.mortar.body", says ["in contact with itself", "two different bodies"];
    drive_of_unknown_body: "[[drive]]\nbody = \"upper\"" => "[[drive]]\nbody = \"uper\"", at "\"uper\"", key "drive.0.body",
        says ["did you mean `upper`?"];
    driven_and_supported: "[[drive]]" => "[[support]]\nbody = \"upper\"\nedge = \"top\"\ndisplacement = { x = 0.0 }\n[[drive]]",
        at "x = { displacement = 0.0 }", key "drive.0.x",
        says ["`x` of the top edge of `upper` is already given by support.1.displacement.x", "once"];
    displacement_and_force: "x = { displacement = 0.0 }" => "x = { displacement = 0.0, force = 1.0 }", at "force = 1",
        key "drive.0.x.force", says ["`force` does not go together with `displacement`"];
    drive_of_nothing: "x = { displacement = 0.0 }\ny = { displacement = { time = [0.0, 1.0], value = [0.0, -0.2] } }" => "",
        at "[[drive]]", key "drive.0", says ["neither `x` nor `y`"];
    free_to_fly: "body = \"lower\"\nedge = \"bottom\"" => "body = \"upper\"\nedge = \"left\"", at "[body.lower]",
        key "body.lower", says ["nothing holds the body", "[[support]]"];
    multipliers_of_too_high_degree: "friction = 0.3 }" => "friction = 0.3 }\nnumerics = { multiplier_degree = 3 }",
        at "multiplier_degree", key "contact.0.numerics.multiplier_degree", says ["degree 3", "0 to 2"];
    unknown_numerics: "friction = 0.3 }" => "friction = 0.3 }\nnumerics = { sites = \"nodel\" }", at "\"nodel\"",
        key "contact.0.numerics.sites", says ["`quadrature`, `nodal`", "did you mean `nodal`?"];
}

#[test]
fn both_sides_rigid() {
    let text = GOOD
        .replace("material = \"rubber\"", "rigid = true")
        .replace("[[support]]\nbody = \"lower\"", "[[support]]\nbody = \"upper\"");
    let path = scene_file("both_sides_rigid", &text);
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    assert_says(&said, &["both sides are rigid", "key: contact.0.nonmortar.body", "give one of them a material"]);
}

#[test]
fn no_body_at_all() {
    let path = scene_file("no_body_at_all", "version = 1\n[body]\n[time]\nend = 1.0\nsteps = 1\n");
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    assert_says(&said, &[":2:", "key: body\n", "allowed: at least one table [body.NAME]"]);
}

#[test]
fn not_toml() {
    let path = scene_file("not_toml", &GOOD.replace("steps = 4", "steps = = 4"));
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    assert_says(&said, &["not valid TOML", &format!("{}:34:", path.display()), "steps = = 4"]);
}

#[test]
fn scene_that_does_not_exist() {
    assert_says(&refusal(&asperity(&["check", "no/such/scene.toml"])), &["no/such/scene.toml", "allowed: a TOML file"]);
}

#[test]
fn csv_profile_with_a_broken_line() {
    let path = scene_file(
        "csv_profile",
        &GOOD.replace(
            "{ type = \"cosine\", height = 0.2, wavelength = 0.8, centers = [0.0] }",
            "{ type = \"csv\", file = \"profile.csv\" }",
        ),
    );
    let profile = path.with_file_name("profile.csv");
    std::fs::write(&profile, "x,y\n-0.5,0.0\n-0.1,0.1\n0.1,oops\n0.5,0.0\n").unwrap();
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    assert_says(&said, &["csv_profile.toml:14:", "profile.csv:4:", "key: body.upper.shape.bottom.file"]);
    std::fs::remove_file(profile).unwrap();
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    assert_says(&said, &["csv_profile.toml:14:", "profile.csv"]);
}

#[test]
fn output_folder_that_cannot_be_written() {
    let path = scene_file("output_folder", GOOD);
    let out = path.join("inside-a-file");
    let said = refusal(&asperity(&["run", path.to_str().unwrap(), "--out", out.to_str().unwrap(), "--quiet"]));
    assert_says(&said, &["--out", "inside-a-file"]);
}

/// An error inside a value that was set names the argument, not a line of the file.
#[test]
fn set_values_are_checked_like_the_file() {
    let path = scene_file("set_values", GOOD);
    let cases = [
        ("contact.0.law.friction=-1", "a number >= 0"),
        ("contact.0.law.frction=1", "did you mean `friction`?"),
        ("contact.1.law.friction=1", "allowed: 0 to 0"),
        ("contact.zero.law.friction=1", "allowed: 0 to 0"),
        ("time.stps=3", "allowed: `end`, `max_cuts`, `steps`"),
        ("body.upperr.rotation=3", "did you mean `upper`?"),
        ("titel=\"x\"", "did you mean `title`?"),
        ("title.x=3", "has no keys"),
        ("title=hello", "text needs quotes"),
        ("material.rubber={ type = \"neo-hookean\", youngs_modulus = 1, poissons_ratio = 0.5 }", "< 0.5"),
        ("time.steps", "PATH=VALUE"),
        ("time..steps=1", "not a dotted key"),
        ("time.steps=", "time.steps"),
        ("time.steps=1\ntime.end=2", "time.steps"),
    ];
    for (argument, says) in cases {
        let said = refusal(&asperity(&["check", path.to_str().unwrap(), "--set", argument]));
        assert_says(&said, &[&format!("--> --set '{argument}'"), says]);
        assert!(!said.contains("set_values.toml:"), "{said}");
    }
}

/// All structural errors are reported at once, in the order of the file.
#[test]
fn errors_are_collected() {
    let text =
        GOOD.replace("steps = 4", "steps = 0").replace("friction = 0.3", "friction = -1").replace("title", "titel");
    let path = scene_file("collected", &text);
    let said = refusal(&asperity(&["check", path.to_str().unwrap()]));
    let places: Vec<usize> = ["key: titel", "key: contact.0.law.friction", "key: time.steps"]
        .iter()
        .map(|key| said.find(key).unwrap_or_else(|| panic!("{key} missing in {said}")))
        .collect();
    assert!(places.is_sorted(), "{said}");
}

#[test]
fn a_law_that_gives_no_number_ends_the_run_with_what_it_had() {
    let law = "type = \"expression\", threshold = \"0.3*p*sqrt(0.2 - z)\", states = { z = { rate = \"4*p\" } }";
    let broken = GOOD.replace("type = \"coulomb\", friction = 0.3", law);
    let path = scene_file("no-number", &broken);
    let out = path.with_extension("out");
    let output = asperity(&["run", path.to_str().unwrap(), "--quiet", "--out", out.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert_says(
        &said,
        &["gives no number at the point (", "`sqrt(0.2 - z)` is NaN", "p = 0.", "z = 0.2", "steps before are kept"],
    );
    let rows = std::fs::read_to_string(out.join("history.csv")).expect("history.csv").lines().count();
    assert_eq!(rows, 2, "header and the step before it");
}

#[test]
fn wrong_command_line() {
    for arguments in [&["run"][..], &["rum"], &["laws", "colomb"], &[]] {
        refusal_of_usage(&asperity(arguments));
    }
}

fn refusal_of_usage(output: &Output) {
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_scene_that_is_broken_here_is_fine() {
    let path = scene_file("good", GOOD);
    let output = asperity(&["check", path.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
