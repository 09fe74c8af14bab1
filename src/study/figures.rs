//! Figures of a study: a quantity over an axis, one line for each value of a second one, one figure for each of the others.

use std::collections::BTreeMap;

use super::axis::Axis;
use super::spec::FigureSpec;
use super::table::Row;
use super::{Point, Study, StudyFolder};
use crate::output::figures::lines::{Line, Lines};
use crate::output::tables::number;
use crate::output::{OutputError, RunFolder};

/// Figures of one quantity beyond this number are left out.
const MOST: usize = 24;
/// Longest value that stands in the name of a file.
const LONGEST_LABEL: usize = 24;

/// Draws the figures that the study asks for; returns how many there would have been beyond [`MOST`].
pub(super) fn write(study: &Study, folder: &StudyFolder, points: &[Point], rows: &[Row]) -> Result<usize, OutputError> {
    let Some(specs) = wanted(study) else { return Ok(0) };
    let target = RunFolder::create(folder.root())?.figures()?;
    let mut left_out = 0;
    for (quantity, over, lines) in specs {
        let panels = panels(study, points, [Some(over), lines]);
        left_out += panels.len().saturating_sub(MOST);
        for (others, members) in panels.iter().take(MOST) {
            let figure = figure(study, rows, (quantity, over, lines), others, members);
            figure.write(&target, &name(study, (quantity, over, lines), others))?;
        }
    }
    Ok(left_out)
}

/// Quantity, axis, axis of the lines.
type Numbers = (usize, usize, Option<usize>);

/// What is drawn: as declared, or every quantity over the first axis of numbers. Nothing without such an axis.
fn wanted(study: &Study) -> Option<Vec<Numbers>> {
    let axis = |name: &Option<String>| study.axes.iter().position(|axis| Some(&axis.name) == name.as_ref());
    let first = study.axes.iter().position(|axis| axis.numbers().is_some() && axis.values.len() > 1)?;
    let quantity = |name: &str| study.spec.quantity.iter().position(|quantity| quantity.name == name);
    let numbers = |spec: &FigureSpec| {
        let over = axis(&spec.over).unwrap_or(first);
        let second = || (0..study.axes.len()).find(|k| *k != over && study.axes[*k].values.len() > 1);
        Some((quantity(&spec.quantity)?, over, axis(&spec.lines).or_else(second)))
    };
    let default = |k: &super::QuantitySpec| FigureSpec { quantity: k.name.clone(), over: None, lines: None };
    let specs: Vec<FigureSpec> = match study.spec.figure.is_empty() {
        true => study.spec.quantity.iter().map(default).collect(),
        false => study.spec.figure.clone(),
    };
    Some(specs.iter().filter_map(numbers).collect())
}

/// Points that belong into one figure, by the places on all axes that are not drawn.
fn panels(study: &Study, points: &[Point], drawn: [Option<usize>; 2]) -> BTreeMap<Vec<usize>, Vec<usize>> {
    let mut panels: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
    for point in points {
        let mut places = study.places(point.index);
        drawn.into_iter().flatten().for_each(|axis| places[axis] = 0);
        panels.entry(places).or_default().push(point.index);
    }
    panels
}

fn figure(study: &Study, rows: &[Row], (quantity, over, lines): Numbers, others: &[usize], members: &[usize]) -> Lines {
    let numbers = study.axes[over].numbers().unwrap_or_default();
    let mut curves: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
    for index in members {
        let places = study.places(*index);
        let line = lines.map_or(0, |axis| places[axis]);
        curves.entry(line).or_default().push([numbers[places[over]], rows[*index].values[quantity]]);
    }
    let label = |place: usize| lines.map_or_else(String::new, |axis| said(&study.axes[axis], place));
    let apart: Vec<String> =
        apart(study, (quantity, over, lines)).map(|axis| said(&study.axes[axis], others[axis])).collect();
    let mut curves: Vec<Line> =
        curves.into_iter().map(|(place, points)| Line { label: label(place), points }).collect();
    curves.iter_mut().for_each(|line| line.points.sort_by(|a, b| a[0].total_cmp(&b[0])));
    Lines {
        x_label: study.axes[over].name.clone(),
        y_label: study.spec.quantity[quantity].name.clone(),
        note: apart.join(", "),
        lines: curves,
    }
}

/// Name and value of an axis for a figure: numbers with four digits.
fn said(axis: &Axis, place: usize) -> String {
    let short = axis.numbers().and_then(|numbers| format!("{:.3e}", numbers[place]).parse().ok());
    format!("{} = {}", axis.name, short.map_or_else(|| axis.label(place), number))
}

/// Axes that take more than one value and are not drawn.
fn apart(study: &Study, (_, over, lines): Numbers) -> impl Iterator<Item = usize> {
    (0..study.axes.len()).filter(move |k| *k != over && Some(*k) != lines && study.axes[*k].values.len() > 1)
}

/// Name of a file, plain letters only.
fn name(study: &Study, numbers: Numbers, others: &[usize]) -> String {
    let (quantity, over, _) = numbers;
    let mut name = format!("{}-over-{}", study.spec.quantity[quantity].name, study.axes[over].name);
    for axis in apart(study, numbers) {
        // values that are whole tables are told by their number
        let label = Some(study.axes[axis].label(others[axis])).filter(|label| label.len() <= LONGEST_LABEL);
        name += &format!("-{}-{}", study.axes[axis].name, label.unwrap_or_else(|| others[axis].to_string()));
    }
    name.chars().map(|c| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}
