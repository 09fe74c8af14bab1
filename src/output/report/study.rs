//! The report of a study.

use std::path::Path;

use serde_json::Value;

use super::html::{self, Cell};
use super::run::program;
use super::{figures, numbers, read_json, toml_of};
use crate::output::OutputError;
use crate::output::figures::escape;

/// Rows of the table that a page can hold.
const MOST: usize = 500;

/// `study.csv` as text.
struct Table {
    heads: Vec<String>,
    rows: Vec<csv::StringRecord>,
}

/// The whole page.
pub fn page(folder: &Path) -> Result<String, OutputError> {
    let study = read_json(&folder.join("study.json"))?;
    let table = Table::read(&folder.join("study.csv"))?;
    let title = study["study"]["title"].as_str().filter(|title| !title.is_empty()).unwrap_or("study").to_owned();
    let mut body = head(&study, &title, &table);
    body += &html::section("Points that failed", &table.failed());
    let quantities = study["study"]["quantity"].as_array().into_iter().flatten();
    let order: Vec<&str> = quantities.filter_map(|quantity| quantity["name"].as_str()).collect();
    body += &html::section("Figures", &(film(folder, &table)? + &figures::section(folder, &order)?));
    body += &html::section("What was computed", &axes(&study["study"]));
    body += &html::section("Table", &table.html());
    body += &html::section("How to compute it again", &again(&study));
    Ok(html::page(&title, &body))
}

impl Table {
    fn read(path: &Path) -> Result<Self, OutputError> {
        let bad = |error: csv::Error| OutputError::content(path, error.to_string());
        let mut reader = csv::Reader::from_path(path).map_err(bad)?;
        let heads = reader.headers().map_err(bad)?.iter().map(str::to_owned).collect();
        let rows = reader.records().collect::<Result<_, _>>().map_err(bad)?;
        Ok(Self { heads, rows })
    }

    fn cell<'a>(&self, row: &'a csv::StringRecord, name: &str) -> &'a str {
        let column = self.heads.iter().position(|head| head == name);
        column.and_then(|k| row.get(k)).unwrap_or_default()
    }

    fn count(&self, status: &str) -> usize {
        self.rows.iter().filter(|row| self.cell(row, "status") == status).count()
    }

    /// Points with a reason.
    fn failed(&self) -> String {
        let failed = self.rows.iter().filter(|row| !self.cell(row, "reason").is_empty()).take(MOST);
        let row = |row: &csv::StringRecord| {
            vec![
                Cell::number(self.cell(row, "index")),
                Cell::state(self.cell(row, "status"), "bad"),
                Cell::words(self.cell(row, "reason")),
                Cell::word(self.cell(row, "folder")),
            ]
        };
        html::table(
            "points that failed",
            &["index", "status", "reason", "folder"],
            &failed.map(row).collect::<Vec<_>>(),
        )
    }

    /// All points without their reasons and folders.
    fn html(&self) -> String {
        let shown: Vec<usize> =
            (0..self.heads.len()).filter(|k| !["reason", "folder"].contains(&self.heads[*k].as_str())).collect();
        let heads: Vec<&str> = shown.iter().map(|k| self.heads[*k].as_str()).collect();
        let cell = |text: &str| match text.parse::<f64>() {
            Ok(number) => Cell::number(numbers::short(number)),
            Err(_) if text == "done" => Cell::state(text, "good"),
            Err(_) => Cell::word(text),
        };
        let row = |row: &csv::StringRecord| shown.iter().map(|k| cell(row.get(*k).unwrap_or_default())).collect();
        let rows: Vec<Vec<Cell>> = self.rows.iter().take(MOST).map(row).collect();
        let rest = self.rows.len().saturating_sub(MOST);
        let note =
            if rest > 0 { format!("<p class=\"soft\">{rest} more points in study.csv.</p>\n") } else { String::new() };
        html::table("all points", &heads, &rows) + &note
    }
}

fn head(study: &Value, title: &str, table: &Table) -> String {
    let (points, done) = (table.rows.len(), table.count("done"));
    let open = table.count("pending") + table.count("running") + table.count("interrupted");
    let failed = points - done - open;
    let (word, class) = match (failed, open) {
        (0, 0) => ("all points done".to_owned(), "good"),
        (0, open) => (format!("{open} points not computed yet"), "warn"),
        (failed, _) => (format!("{failed} points failed"), "bad"),
    };
    let wall: f64 = table.rows.iter().filter_map(|row| table.cell(row, "wall_s").parse::<f64>().ok()).sum();
    let key = [
        (points.to_string(), "points"),
        (done.to_string(), "done"),
        (failed.to_string(), "failed"),
        (format!("{} s", numbers::short(wall)), "time of all runs together"),
    ];
    format!(
        "<header>\n<h1>{}</h1>\n<p><span class=\"state {class}\">{word}</span> <span class=\"soft\">{}</span></p>\n{}</header>\n",
        escape(title),
        escape(&program(study)),
        html::key_numbers(&key)
    )
}

/// What is varied and what is collected, in words.
fn axes(study: &Value) -> String {
    let list = |name: &str| study[name].as_array().cloned().unwrap_or_default();
    let axes: Vec<Vec<Cell>> = list("axis").iter().flat_map(axis_rows).collect();
    let quantities: Vec<Vec<Cell>> = list("quantity").iter().map(quantity_row).collect();
    let formulas: Vec<String> = list("formula").iter().map(word).collect();
    html::table("axes", &["axis", "key of the scene", "values"], &axes)
        + &html::list(&formulas)
        + &html::table("quantities", &["quantity", "how it is taken from the history"], &quantities)
}

/// A text as it is, a list by its entries.
fn word(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(values) => values.iter().map(word).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}

/// The axis, and what changes along with it.
fn axis_rows(axis: &Value) -> Vec<Vec<Cell>> {
    let name = word(if axis["name"].is_null() { &axis["path"] } else { &axis["name"] });
    let path = |spec: &Value| if spec["path"].is_null() { "(see below)".to_owned() } else { word(&spec["path"]) };
    let row = |name: &str, spec: &Value| {
        vec![Cell::word(name), Cell::words(path(spec)), Cell::words(values(&spec["values"]))]
    };
    let zipped = axis["zip"].as_array().into_iter().flatten().map(|spec| row("", spec));
    std::iter::once(row(&name, axis)).chain(zipped).collect()
}

fn values(values: &Value) -> String {
    let range = |kind: &str, words: &str| {
        let range = &values[kind];
        let [from, to] = ["from", "to"].map(|end| range[end].as_f64().map_or_else(String::new, numbers::short));
        (!range.is_null()).then(|| format!("{} from {from} to {to}, {words}", range["count"]))
    };
    let told = range("linear", "equal differences").or_else(|| range("logarithmic", "equal ratios"));
    told.unwrap_or_else(|| word(values))
}

fn quantity_row(quantity: &Value) -> Vec<Cell> {
    let of = |name: &str| word(&quantity[name]);
    let mut said = format!("{} of {} over steps: {}", of("take"), of("column"), of("over"));
    if ["mean", "integral"].contains(&of("take").as_str()) {
        said += &format!(", along {}", of("along"));
    }
    if !quantity["weight"].is_null() {
        said += &format!(", weighted by {}", of("weight"));
    }
    if quantity["within"].as_object().is_some_and(|windows| !windows.is_empty()) {
        said += &format!(", within {}", quantity["within"]);
    }
    vec![Cell::word(of("name")), Cell::words(said)]
}

/// The animation of the first point that has one.
fn film(folder: &Path, table: &Table) -> Result<String, OutputError> {
    let path = |row: &csv::StringRecord| folder.join(table.cell(row, "folder")).join("figures/animation.svg");
    let Some(row) = table.rows.iter().find(|row| path(row).is_file()) else { return Ok(String::new()) };
    let svg = std::fs::read_to_string(path(row)).map_err(OutputError::io("read", &path(row)))?;
    Ok(html::figure(&svg, &format!("The pass of point {}.", table.cell(row, "index")), true))
}

fn again(study: &Value) -> String {
    let scene = study["study"]["scene"].as_str().unwrap_or("scene.toml");
    format!(
        "<p>With {}: save the study below as <code>study.toml</code>, and its scene where the study says (<code>{}</code>).</p>\n{}{}{}",
        escape(&program(study)),
        escape(scene),
        html::code("asperity sweep study.toml"),
        html::folded("study.toml", &html::code(&toml_of(&study["study"]))),
        html::folded("scene of the first point, with all defaults", &html::code(&toml_of(&study["first_scene"])))
    )
}
