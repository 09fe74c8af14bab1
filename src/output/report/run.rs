//! The report of a run.

use std::path::Path;

use serde_json::Value;

use super::html::{self, Cell};
use super::{figures, numbers, read_json, texts, toml_of};
use crate::model::Record;
use crate::output::figures::escape;
use crate::output::tables::read_history;
use crate::output::{OutputError, Quantity, UnitLabels};

/// The whole page.
pub fn page(folder: &Path) -> Result<String, OutputError> {
    let run = read_json(&folder.join("run.json"))?;
    let records = read_history(&folder.join("history.csv"))?;
    let units = units(&run["scene"]);
    let title = title(&run["scene"]);
    let mut body = head(&run, &title, &records, &units);
    body += &html::section("Warnings", &html::list(&texts(&run["warnings"])));
    body += &html::section("Figures", &figures::section(folder, &[])?);
    body += &html::section("What was computed", &model(&run));
    body += &html::section("History", &history(&records, &units));
    body += &html::section("Energy", &energy(&records, &units));
    body += &html::section("Audits", &audits(&run["result"]["audit"]));
    body += &html::section("How to compute it again", &again(&run));
    Ok(html::page(&title, &body))
}

/// Unit labels of a scene.
pub fn units(scene: &Value) -> UnitLabels {
    let label = |name: &str| scene["units"][name].as_str().unwrap_or_default().to_owned();
    UnitLabels { length: label("length"), stress: label("stress"), time: label("time") }
}

/// Title of a scene.
pub fn title(scene: &Value) -> String {
    scene["title"].as_str().filter(|title| !title.is_empty()).unwrap_or("run without title").to_owned()
}

/// Name, version and place of the program.
pub fn program(record: &Value) -> String {
    let part = |name: &str| record["program"][name].as_str().unwrap_or("?").to_owned();
    format!("{} {}", part("name"), part("version"))
}

fn head(run: &Value, title: &str, records: &[Record], units: &UnitLabels) -> String {
    let result = &run["result"];
    let status = result["status"].as_str().unwrap_or("unknown");
    let passed = result["audit"]["passed"].as_bool().unwrap_or(false);
    let (word, class) = match (status, passed) {
        ("done", true) => ("done, all audits passed", "good"),
        ("done", false) => ("done, but an audit failed: do not trust the result", "bad"),
        ("running", _) => ("still running, or killed", "warn"),
        ("interrupted", _) => ("interrupted", "warn"),
        _ => (status, "bad"),
    };
    let reason = result["reason"].as_str().map(|reason| format!("<p class=\"bad\">{}</p>\n", escape(reason)));
    let count = |name: &str| result["counters"][name].as_u64().map_or_else(|| "–".into(), |n| n.to_string());
    let wall = result["wall_s"].as_f64().map_or_else(|| "–".into(), |s| format!("{} s", numbers::short(s)));
    let largest = |column: fn(&Record) -> f64| records.iter().map(column).fold(f64::NAN, f64::max);
    let key = [
        (numbers::short(numbers::mean_friction(records)), "mean friction, mean Fx / mean Fy in contact"),
        (numbers::short(largest(|r| r.mu_global)), "largest mu_global = Fx/Fy"),
        (numbers::with_unit(largest(|r| r.force[0]), units, Quantity::Force), "largest resistance Fx per depth"),
        (numbers::with_unit(largest(|r| r.force[1]), units, Quantity::Force), "largest support Fy per depth"),
        (format!("{} / {}", count("nominal_steps"), count("newton_iterations")), "nominal steps / Newton iterations"),
        (wall, "wall time"),
    ];
    format!(
        "<header>\n<h1>{}</h1>\n<p><span class=\"state {class}\">{word}</span> <span class=\"soft\">{}</span></p>\n{}{}</header>\n",
        escape(title),
        escape(&program(run)),
        reason.unwrap_or_default(),
        html::key_numbers(&key)
    )
}

fn model(run: &Value) -> String {
    let model = &run["model"];
    let value = |name: &str| match &model[name] {
        Value::Number(number) => number.as_f64().map_or_else(String::new, numbers::short),
        other => other.to_string(),
    };
    let sizes = [
        ("unknowns", "unknowns"),
        ("displacement_unknowns", "of these displacements"),
        ("contact_unknowns", "displacements that contact can reach"),
        ("control_points", "control points"),
        ("element_size", "shortest contact element"),
        ("stress_scale", "stress scale E"),
    ];
    let rows: Vec<Vec<Cell>> =
        sizes.iter().map(|(name, said)| vec![Cell::word(*said), Cell::number(value(name))]).collect();
    let part = |title: &str, name: &str| match texts(&run[name]) {
        lines if lines.is_empty() => String::new(),
        lines => format!("<h3>{title}</h3>\n{}", html::list(&lines)),
    };
    let sizes = html::table("sizes of the model", &["size", "value"], &rows);
    part("Modelled", "modelled") + &part("Left out, because", "left_out") + &sizes
}

fn history(records: &[Record], units: &UnitLabels) -> String {
    let extremes =
        html::table("extremes of the history", &["quantity", "value", "where"], &numbers::summary(records, units));
    let (heads, rows, stride) = numbers::history(records);
    let every = if stride > 1 { format!(" (every {stride}th)") } else { String::new() };
    let all = html::table("history by step", &heads, &rows);
    if records.is_empty() { extremes } else { extremes + &html::folded(&format!("Table of all steps{every}"), &all) }
}

fn energy(records: &[Record], units: &UnitLabels) -> String {
    let heads = ["energy", "value", "share of all work"];
    html::table("energies at the end", &heads, &numbers::energies(records, units))
}

fn audits(audit: &Value) -> String {
    let row = |check: &Value| {
        let (passed, failure) = (check["passed"].as_bool() == Some(true), check["severity"] == "failure");
        let (word, class) = match (passed, failure) {
            _ if check["judged"] == 0 => ("does not apply", "soft"),
            (true, _) => ("passed", "good"),
            (false, false) => ("warning", "warn"),
            (false, true) => ("failed", "bad"),
        };
        let number =
            |name: &str| check[name].as_f64().map_or_else(|| "–".into(), |v| format!("{v:.1e}").replace('-', "−"));
        vec![
            Cell::word(check["name"].as_str().unwrap_or("?").replace('_', " ")),
            Cell::state(word, class),
            Cell::words(check["meaning"].as_str().unwrap_or_default()),
            Cell::number(number("worst")),
            Cell::number(number("tolerance")),
            Cell::number(check["step"].as_u64().map_or_else(|| "–".into(), |step| step.to_string())),
        ]
    };
    let rows: Vec<Vec<Cell>> = audit["checks"].as_array().into_iter().flatten().map(row).collect();
    html::table("audits", &["audit", "result", "what is compared", "worst", "accepted", "at step"], &rows)
}

fn again(run: &Value) -> String {
    let scene = html::folded("scene.toml, with all defaults", &html::code(&toml_of(&run["scene"])));
    format!(
        "<p>With {}: save the scene below as <code>scene.toml</code>; profiles in csv files, where it names any, stand beside it.</p>\n{}{scene}",
        escape(&program(run)),
        html::code("asperity run scene.toml")
    )
}
