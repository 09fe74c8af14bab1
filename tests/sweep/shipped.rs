//! Studies that are shipped: the example, and the one in the README.

use std::path::Path;
use std::process::Command;

use super::{folder, number, sweep, table, told};

/// Statements about all nine passes of the example.
#[test]
fn the_shipped_study_shows_what_its_comments_say() {
    let folder = folder("shipped");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/sweep/study.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(&folder).env_remove("SLURM_ARRAY_TASK_ID").arg("sweep").arg(&file);
    told(command.output().unwrap(), 0);
    let rows = table(&folder.join("out/study/study.csv"));
    assert_eq!(rows.len(), 9);
    for row in &rows {
        let (angle, mu, mean) = (number(row, "angle").to_radians(), number(row, "mu"), number(row, "mu_mean"));
        assert!(number(row, "mu_first") < (angle + mu.atan()).tan() + 1e-9, "no flank is steeper: {row:?}");
        assert!(number(row, "mu_first") > mu - 1e-9);
        if mu == 0.0 {
            assert!(
                mean.abs() < 1e-8 && number(row, "work").abs() < 1e-10,
                "a frictionless pass costs nothing: {row:?}"
            );
        } else {
            assert!(
                mean > 0.99 * mu && mean < 1.5 * mu,
                "friction of the pass is that of the law, and a little more: {row:?}"
            );
        }
    }
    for figure in ["mu_mean", "mu_first", "work", "iterations"] {
        assert!(folder.join(format!("out/study/figures/{figure}-over-angle.svg")).is_file(), "{figure}");
    }
}

/// The study that the README explains can be used as it stands there.
#[test]
fn the_study_of_the_readme_is_a_study() {
    let folder = folder("readme");
    let readme = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let study = readme.split("## Studies").nth(1).and_then(|rest| rest.split("```toml\n").nth(1)).unwrap();
    let study = study.split("```").next().unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/single_asperity.toml");
    std::fs::write(folder.join("study.toml"), study.replace("../single_asperity.toml", scene.to_str().unwrap()))
        .unwrap();
    let [list, _] = sweep(&folder, &["--list"], 0);
    assert!(list.contains("4 points: 4 pending"), "{list}");
}
