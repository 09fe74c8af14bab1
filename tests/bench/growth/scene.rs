//! The scenes: rows of asperities over rows of asperities, and the two asperities of the design at any size.

use std::path::Path;

use asperity::model::Model;
use asperity::scene::{Scene, build, time_plan};
use asperity::solve::Control;

/// A model, its plan, and how many of the planned steps are taken.
pub struct Case {
    pub model: Model,
    pub control: Control,
    pub steps: usize,
}

/// What the scenes have in common.
const COMMON: &str = r#"
version = 1
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "coulomb", friction = 0.3 }
"#;

fn case(text: &str, steps: usize) -> Case {
    let (scene, _) = Scene::parse(Path::new("growth.toml"), format!("{COMMON}{text}"), &[]).expect("a scene");
    Case { model: build(&scene, Path::new(".")).expect("a model"), control: time_plan(&scene), steps }
}

/// `count` asperities, 1.6 apart, under four fifths as many, 2.0 apart: pressed together, then dragged a little.
pub fn many(count: usize) -> Case {
    let above = (0.8 * count as f64).round().max(1.0);
    let (lower, upper) = (0.8 * count as f64 + 0.2, above);
    let elements = [2.0 * lower / 0.1, 2.0 * upper / 0.09375].map(f64::round);
    let text = format!(
        r#"
[body.lower]
shape = {{ type = "block", x = [-{lower}, {lower}], y = [-1.0, 0.0], top = {{ type = "cosine", height = 0.4, wavelength = 1.6, count = {count}, spacing = 1.6 }} }}
material = "rubber"
elements = [{}, 9]
grading = {{ toward = "top", ratio = 2.0 }}
[body.upper]
shape = {{ type = "block", x = [-{upper}.0, {upper}.0], y = [0.0, 1.0], bottom = {{ type = "cosine", height = 0.4, wavelength = 1.6, count = {above}, spacing = 2.0 }} }}
material = "rubber"
elements = [{}, 9]
grading = {{ toward = "bottom", ratio = 2.0 }}
position = [-0.4, 0.9]
[[drive]]
body = "upper"
edge = "top"
x = {{ displacement = {{ time = [1.0, 5.0], value = [0.0, 3.2] }} }}
y = {{ displacement = {{ time = [0.0, 1.0], value = [0.0, -0.3] }} }}
[time]
end = 5.0
steps = 80
"#,
        elements[0], elements[1]
    );
    case(&text, 20)
}

/// Two asperities with about `size` unknowns in their first two steps of contact, each of the length of an element.
pub fn two(lagrange: bool, size: usize) -> Case {
    let h = (12.6 / size as f64).sqrt();
    let count = |length: f64, h: f64| (length / h).round();
    let basis = if lagrange { "lagrange" } else { "nurbs" };
    let basis = format!(r#"basis = {{ type = "{basis}", degree = {} }}"#, if lagrange { 1 } else { 2 });
    let bump = r#"{ type = "cosine", height = 0.4, wavelength = 1.6 }"#;
    let text = format!(
        r#"
[body.lower]
shape = {{ type = "block", x = [-2.0, 2.0], y = [-1.0, 0.0], top = {bump} }}
material = "rubber"
elements = [{}, {}]
{basis}
[body.upper]
shape = {{ type = "block", x = [-1.0, 1.0], y = [0.0, 1.0], bottom = {bump} }}
material = "rubber"
elements = [{}, {}]
{basis}
position = [-0.55, 0.6]
[[drive]]
body = "upper"
edge = "top"
x = {{ displacement = {{ time = [0.0, 1.0], value = [0.0, 0.4] }} }}
y = {{ displacement = 0.0 }}
[time]
end = 1.0
steps = {}
"#,
        count(4.0, h),
        count(1.0, h),
        count(2.0, 0.93 * h),
        count(1.0, 0.93 * h),
        count(0.4, h),
    );
    case(&text, (0.02 / h).ceil() as usize + 2)
}
