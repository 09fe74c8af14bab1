//! What is said of studies that cannot be used.

use super::{STUDY, folder, sweep};

/// What is said of a changed study, which must be refused as bad input.
fn refused(found: &str, replaced: &str) -> String {
    assert!(STUDY.contains(found), "{found}");
    let folder = folder("refused");
    std::fs::write(folder.join("study.toml"), STUDY.replacen(found, replaced, 1)).unwrap();
    let [_, error] = sweep(&folder, &[], 2);
    assert!(!folder.join("out").exists(), "nothing is written");
    error
}

#[test]
fn bad_studies_are_named_with_file_line_key_and_what_is_meant() {
    let cases = [
        ("scene = ", "scenes = ", "study.toml:4:1", "scenes", "`scene`"),
        ("scene.toml", "scen.toml", "study.toml:4:9", "scene", "cannot read the scene"),
        ("version = 1", "version = 2", "study.toml:2:11", "version", ""),
        ("friction\"", "frction\"", "study.toml:11:8", "axis.1.path", "`friction`"),
        ("values = [0.1, 0.2]", "values = [0.1, -0.2]", "study.toml:12:16", "axis.1.values.1", ">= 0"),
        ("values = [0.1, 0.2]", "values = [0.1, 0.2, 0.3]", "study.toml:13:49", "axis.1.zip.0.values", "as many"),
        ("[6, 3]]", "[6]]", "study.toml:13:58", "axis.1.zip.0.values.1", "a list of 2"),
        ("-depth", "-deph", "study.toml:5:12", "formula.0", "did you mean `depth`"),
        ("-depth", "-0.05", "study.toml:6:1", "axis.0", "changes nothing"),
        ("count = 2", "count = 1", "study.toml:8:55", "axis.0.values.linear.count", ">= 2"),
        ("name = \"mu\"", "name = \"status\"", "study.toml:10:8", "axis.1.name", "taken by the table"),
        ("\"mu_global\"", "\"mu_globl\"", "study.toml:16:10", "quantity.0.column", "`mu_global`"),
        ("take = \"last\"", "take = \"lst\"", "study.toml:17:8", "quantity.0.take", "`last`"),
        ("take = \"last\"", "take = \"last\"\nweight = \"fy\"", "study.toml:18:1", "quantity.0.weight", "mean"),
        ("contact.0.law.friction\"", "drive.0.y.displacement.value.1\"", "study.toml:5:12", "formula.0", "already"),
    ];
    let mut wrong = String::new();
    for (found, replaced, place, key, meant) in cases {
        let said = refused(found, replaced);
        for part in [place, &format!("= key: {key}\n"), meant].into_iter().filter(|part| !said.contains(*part)) {
            wrong += &format!("{replaced}: no {part:?} in\n{said}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    let figure = "\n[[figure]]\nquantity = \"wrk\"\nover = \"my\"\n[[quantity]]\nname = \"mu_end\"";
    let said = refused("\n[[quantity]]\nname = \"mu_end\"", figure);
    assert!(said.contains("did you mean `work`?") && said.contains("did you mean `mu`?"), "{said}");
}
