//! `asperity report`: one well-formed page of a run and of a study, with every figure, and nothing from elsewhere.
//! What needs eyes and a browser is in `report/browser.py`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(folder).env_remove("SLURM_ARRAY_TASK_ID").args(arguments).output().unwrap()
}

fn succeeds(folder: &Path, arguments: &[&str]) {
    let output = asperity(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn example(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name).to_str().unwrap().to_owned()
}

/// A page that is checked to stand alone and to be well-formed.
fn page(path: &Path) -> String {
    let page = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    well_formed(&page);
    for stranger in
        ["http://", "https://", "src=", "@import", "url(", "<link rel=\"stylesheet\"", "fetch(", "NaN", "inf<"]
    {
        // the name of the SVG vocabulary is no address, and a clip path is in the page
        let text = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "").replace("url(#", "");
        let found = text.find(stranger).map(|at| text[at..].chars().take(60).collect::<String>());
        assert!(found.is_none(), "{stranger}: {found:?}");
    }
    assert!(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">") && page.contains("name=\"viewport\""));
    assert!(page.contains("prefers-color-scheme: dark"));
    page
}

/// Every element is closed where it was opened, ids are unique, and attributes are quoted.
fn well_formed(page: &str) {
    const EMPTY: [&str; 4] = ["meta", "link", "input", "br"];
    let (mut open, mut ids) = (vec![], std::collections::BTreeSet::new());
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a doctype");
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let end = rest.find('>').expect("a tag ends");
        let (tag, after) = (&rest[..end], &rest[end + 1..]);
        assert_eq!(tag.matches('"').count() % 2, 0, "<{tag}>");
        let name: &str = tag.trim_start_matches('/').split([' ', '/', '\n']).next().unwrap();
        if let Some(id) = tag.split(" id=\"").nth(1) {
            assert!(ids.insert(id.split('"').next().unwrap()), "twice: <{tag}>");
        }
        rest = after;
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "</{name}>");
        } else if !tag.ends_with('/') && !EMPTY.contains(&name) {
            open.push(name);
            if ["style", "script"].contains(&name) {
                rest = &rest[rest.find(&format!("</{name}>")).expect("its end")..];
            }
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

/// Figures of a page, and that each of them has an alternative text and a caption.
fn figures(page: &str) -> usize {
    let count = page.matches("<figure").count();
    assert_eq!(page.matches("<svg role=\"img\" aria-label=\"").count(), count);
    assert_eq!(page.matches("<figcaption>").count(), count);
    assert!(!page.contains("aria-label=\"\"") && !page.contains("<figcaption></"));
    count
}

fn svgs(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder.join("figures")).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| path.extension().is_some_and(|e| e == "svg")).count()
}

#[test]
fn a_run_is_told_whole() {
    let folder = folder("run");
    let coarse = [
        "body.lower.elements=[40, 10]",
        "body.upper.elements=[22, 11]",
        "time.steps=38",
        "title=\"a <steep> pass & more\"",
    ];
    let scene = example("single_asperity.toml");
    let sets = coarse.iter().flat_map(|set| ["--set", set]);
    succeeds(&folder, &["run", &scene, "--quiet", "--out", "out"].into_iter().chain(sets).collect::<Vec<_>>());
    succeeds(&folder, &["report", "out"]);
    let page = page(&folder.join("out/report.html"));
    assert!(page.contains("<title>a &lt;steep&gt; pass &amp; more</title>"));
    assert_eq!(figures(&page), svgs(&folder.join("out")));
    for part in [
        "done, all audits passed",
        "body lower: neo-hookean",
        "law coulomb",
        "inertia: the analysis is quasi-static",
        "largest resistance Fx",
        "friction identity",
        "left open by finite steps",
        "youngs_modulus = 1.0",
        "asperity run scene.toml",
        env!("CARGO_PKG_VERSION"),
    ] {
        assert!(page.contains(part), "no {part:?}");
    }
    // one picture a step while the bodies touch, and some around; one of them for those who want no motion
    let touching = touching(&folder.join("out/history.csv"));
    let pictures = page.matches("class=\"asperity-frame").count();
    assert!(touching > 8 && (touching..2 * touching).contains(&pictures), "{pictures} pictures of {touching} steps");
    assert_eq!(page.matches("asperity-frame asperity-still\"").count(), 1);
    let size = std::fs::metadata(folder.join("out/figures/animation.svg")).unwrap().len();
    assert!(size < 2_000_000, "{size}");
    the_scene_of_the_page_is_the_scene(&folder, &page);
}

/// Number of steps in contact.
fn touching(history: &Path) -> usize {
    let text = std::fs::read_to_string(history).unwrap();
    let at = text.lines().next().unwrap().split(',').position(|name| name == "contact_length").unwrap();
    text.lines().skip(1).filter(|line| line.split(',').nth(at).unwrap().parse::<f64>().unwrap() > 0.0).count()
}

/// What the page says about computing it again is true: the scene in it gives the same history.
fn the_scene_of_the_page_is_the_scene(folder: &Path, page: &str) {
    let scene =
        page.split("scene.toml, with all defaults</summary>").nth(1).and_then(|rest| rest.split("<code>").nth(1));
    let scene = scene.and_then(|rest| rest.split("</code>").next()).expect("the scene");
    let scene = scene.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&");
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    succeeds(folder, &["run", "scene.toml", "--quiet", "--out", "again", "--set", "output.figures=false"]);
    let force = |out: &str| -> Vec<String> {
        let text = std::fs::read_to_string(folder.join(out).join("history.csv")).unwrap();
        text.lines().map(|line| line.split(',').skip(4).take(2).collect()).collect()
    };
    assert_eq!(force("out"), force("again"), "bit for bit");
}

#[test]
fn a_study_is_told_with_its_failed_points() {
    let folder = folder("study");
    let study = std::fs::read_to_string(example("sweep/study.toml")).unwrap();
    let study = study.replace("../single_asperity.toml", &example("single_asperity.toml"));
    // a local coefficient far beyond what a pass can carry on ten-degree flanks is fine; an asperity inside its counterpart is not
    let study = study.replace("count = 3", "count = 2").replace("1.5*1.6/pi", "(1.5 - angle/20)*1.6/pi");
    std::fs::write(folder.join("study.toml"), study).unwrap();
    assert_eq!(asperity(&folder, &["sweep", "study.toml", "--quiet", "--out", "out"]).status.code(), Some(3));
    succeeds(&folder, &["report", "out", "--out", "page.html"]);
    let page = page(&folder.join("page.html"));
    assert_eq!(figures(&page), svgs(&folder.join("out")));
    for part in [
        "points failed",
        "bad input",
        "deep inside",
        "mu_mean",
        "weighted by fy",
        "2 from 10 to 38, equal differences",
        "asperity sweep study.toml",
        "values = ",
    ] {
        assert!(page.contains(part), "no {part:?}");
    }
}

#[test]
fn folders_of_nothing_and_of_unfinished_runs() {
    let folder = folder("odd");
    let output = asperity(&folder, &["report", "."]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("neither run.json nor study.json"));
    let scene = example("incline.toml");
    let code = asperity(&folder, &["run", &scene, "--quiet", "--out", "out", "--set", "contact.0.law.friction=0.36"]);
    assert_eq!(code.status.code(), Some(3));
    succeeds(&folder, &["report", "out"]);
    let page = page(&folder.join("out/report.html"));
    assert!(page.contains("not converged") && page.contains("class=\"bad\""));
}
