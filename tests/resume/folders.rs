//! Folders of runs: how they are made, killed and compared.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// Part of the two-asperity pass, coarse, under a law with memory.
pub const SCENE: &str = r#"
version = 1
[material.rubber]
type = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[material.hard]
type = "linear-elastic"
youngs_modulus = 5.0
poissons_ratio = 0.3
[body.lower]
shape = { type = "block", x = [-2.0, 2.0], y = [-1.0, 0.0], top = { type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] } }
material = "hard"
elements = [24, 4]
[body.upper]
shape = { type = "block", x = [-1.0, 1.0], y = [0.0, 1.0], bottom = { type = "cosine", height = 0.4, wavelength = 1.6, centers = [0.0] } }
material = "rubber"
elements = [13, 4]
position = [-0.8, 0.6]
[[support]]
body = "lower"
edge = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[drive]]
body = "upper"
edge = "top"
x = { displacement = { time = [0.0, 1.0], value = [0.0, 1.6] } }
y = { displacement = 0.0 }
[[contact]]
nonmortar = { body = "upper", edge = "bottom" }
mortar = { body = "lower", edge = "top" }
law = { type = "dahl", friction = 0.3, stiffness = 0.3 }
[time]
end = 1.0
steps = 20
[output]
fields = 3
"#;

/// A folder of this test alone that holds nothing but the scene.
pub fn folder(name: &str, scene: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("resume").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    folder
}

pub fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

/// Complete rows of `history.csv`.
pub fn rows(out: &Path) -> usize {
    let text = std::fs::read_to_string(out.join("history.csv")).unwrap_or_default();
    text.matches('\n').count().saturating_sub(1)
}

/// All files below a folder.
pub fn contents(root: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut folders, mut files) = (vec![root.to_path_buf()], BTreeMap::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(root).unwrap().to_string_lossy().into_owned();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// Names of the files that differ in anything but wall times. The state itself holds a wall time and is left out.
pub fn differences(a: &Path, b: &Path) -> Vec<String> {
    let [a, b] = [a, b].map(contents);
    assert!(a.len() > 10, "{:?}", a.keys());
    let names: std::collections::BTreeSet<_> =
        a.keys().chain(b.keys()).filter(|name| !name.ends_with("state.bin")).collect();
    let differs = |name: &&&String| match (a.get(**name), b.get(**name)) {
        (Some(a), Some(b)) => timeless(name, a) != timeless(name, b),
        _ => true,
    };
    names.iter().filter(differs).map(|name| name.to_string()).collect()
}

fn timeless(name: &str, bytes: &[u8]) -> Vec<u8> {
    let text = || String::from_utf8(bytes.to_vec()).unwrap();
    match name {
        "history.csv" => {
            let text = text();
            let column = text.lines().next().unwrap().split(',').position(|cell| cell == "wall_s").unwrap();
            let others = |line: &str| {
                let cells = line.split(',').enumerate().filter(|(k, _)| *k != column).map(|(_, cell)| cell);
                cells.collect::<Vec<_>>().join(",")
            };
            text.split('\n').map(others).collect::<Vec<_>>().join("\n").into_bytes()
        }
        "run.json" => {
            let mut json: serde_json::Value = serde_json::from_str(&text()).unwrap();
            assert!(json["result"]["wall_s"].take().is_f64(), "{json}");
            json.to_string().into_bytes()
        }
        _ => bytes.to_vec(),
    }
}

/// A run under way.
pub struct Run(Child);

impl Run {
    pub fn start(folder: &Path, out: &str, more: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
        command.current_dir(folder).args(["run", "scene.toml", "--out", out]).args(more);
        Self(command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap())
    }

    /// Kills it (signal 9); whether it was still there.
    pub fn kill(&mut self) -> bool {
        let alive = self.0.try_wait().unwrap().is_none();
        let _ = self.0.kill();
        self.0.wait().unwrap();
        alive
    }

    /// As Ctrl-C.
    pub fn interrupt(&mut self) -> (Option<i32>, String) {
        assert!(Command::new("kill").args(["-INT", &self.0.id().to_string()]).status().unwrap().success());
        self.wait()
    }

    /// Exit code, and what it said.
    pub fn wait(&mut self) -> (Option<i32>, String) {
        let mut told = String::new();
        self.0.stderr.take().unwrap().read_to_string(&mut told).unwrap();
        (self.0.wait().unwrap().code(), told)
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        self.kill();
    }
}
