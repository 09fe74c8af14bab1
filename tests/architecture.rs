//! The layout of the sources: rooms, direction of imports, names, sizes, and who may name which library.

use std::fs;
use std::path::{Path, PathBuf};

const LONGEST: usize = 300;
const EMPTY_NAMES: [&str; 8] = ["utils", "util", "helpers", "helper", "common", "misc", "types", "stuff"];

/// Files ending in `.rs` below a folder of the package, with their text.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
    let mut files = vec![];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = fs::read_to_string(&path).expect("UTF-8");
                files.push((path, text));
            }
        }
    }
    assert!(!files.is_empty(), "no sources in {folder}");
    files.sort();
    files
}

/// Text without comments, so that only code is judged.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// Rooms in the order of `lib.rs`.
fn rooms() -> Vec<String> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).expect("src/lib.rs");
    let room = |line: &str| Some(line.strip_prefix("pub mod ")?.strip_suffix(';')?.to_owned());
    text.lines().filter_map(room).collect()
}

/// The room of a file: the first folder (or file) below `src`.
fn room_of(path: &Path) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let first = path.strip_prefix(root).expect("below src").components().next().expect("a name");
    Path::new(first.as_os_str()).file_stem().expect("a name").to_string_lossy().into_owned()
}

/// True where `word` stands alone in the text.
fn names(text: &str, word: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| !text[..at].ends_with(part) && !text[at + word.len()..].starts_with(part))
}

/// Names that follow `crate::`, the members of `crate::{...}` at its first level included.
fn imports(text: &str) -> Vec<String> {
    let mut found = vec![];
    for (at, key) in text.match_indices("crate::") {
        let rest = &text[at + key.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            found.push(rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect());
            continue;
        };
        let (mut depth, mut name) = (0, String::new());
        for c in group.chars() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => found.push(std::mem::take(&mut name)),
                c if depth == 0 && !c.is_whitespace() => name.push(c),
                _ => {}
            }
        }
        found.push(name);
    }
    found.into_iter().map(|path| path.split("::").next().unwrap_or("").to_owned()).collect()
}

#[test]
fn rooms_import_only_rooms_to_their_left() {
    let rooms = rooms();
    let expected =
        ["math", "geometry", "bulk", "contact", "model", "solve", "verify", "output", "scene", "study", "cli"];
    let mut order = expected.iter();
    assert!(rooms.len() > 5 && rooms.iter().all(|room| order.any(|e| e == room)), "{rooms:?} against {expected:?}");
    for (path, text) in sources("src") {
        let Some(own) = rooms.iter().position(|room| *room == room_of(&path)) else { continue };
        for import in imports(&code(&text)) {
            if let Some(other) = rooms.iter().position(|room| *room == import) {
                assert!(other <= own, "{}: room `{}` imports `{import}`", path.display(), rooms[own]);
            }
        }
    }
}

#[test]
fn libraries_stay_in_their_rooms() {
    for (library, home) in [("faer", "math"), ("clarabel", "verify")] {
        for (path, text) in sources("src") {
            assert!(room_of(&path) == home || !names(&code(&text), library), "{} names {library}", path.display());
        }
    }
    for (path, text) in sources("laws") {
        for stranger in ["asperity", "faer", "clarabel"] {
            assert!(!names(&code(&text), stranger), "{} names {stranger}", path.display());
        }
    }
}

#[test]
fn files_are_short_and_their_names_say_something() {
    for (path, text) in sources("src").into_iter().chain(sources("laws")) {
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        assert!(!EMPTY_NAMES.contains(&stem.as_str()), "{}: the name says nothing", path.display());
        let lines = text.lines().count();
        assert!(lines <= LONGEST, "{}: {lines} lines, at most {LONGEST}", path.display());
    }
}

#[test]
fn the_parser_of_this_test_finds_imports() {
    let text = "use crate::model::{State, Model};\nuse crate::{bulk::Material, math::{gauss, Vec2}, solve};";
    assert_eq!(imports(text), ["model", "bulk", "math", "solve"]);
    assert!(names("use faer::Par;", "faer") && !names("let faerie = 1;", "faer"));
}
