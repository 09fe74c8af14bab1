//! Quantities of a study over one of its axes: a line with dots for each value of another axis.

use std::path::{Path, PathBuf};

use super::axis::range;
use super::chart::{Chart, Column, Key, Series};
use super::{palette, save};
use crate::output::OutputError;

/// Positive values that span at least this ratio are drawn on a logarithmic axis.
const WIDE: f64 = 100.0;
/// Most entries of the legend; of more lines only some are named, their colours run from the first to the last.
const MOST_KEYS: usize = 12;
/// Most points that are marked on a line.
const MOST_DOTS: usize = 30;
/// Dash patterns that tell neighbouring lines apart in grey print.
const DASHES: [&str; 4] = ["", "5 1.6", "2 1.4", "6 1.6 1.5 1.6"];

/// A figure of one quantity.
#[derive(Clone, Debug)]
pub struct Lines {
    /// What the horizontal axis shows.
    pub x_label: String,
    /// What the vertical axis shows.
    pub y_label: String,
    /// What is the same everywhere in the figure; empty for nothing.
    pub note: String,
    /// The lines.
    pub lines: Vec<Line>,
}

/// A line of a figure.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its name, empty if there is only one.
    pub label: String,
    /// Points by ascending abscissa; `NaN` where a point of the study failed.
    pub points: Vec<[f64; 2]>,
}

impl Lines {
    /// Writes the figure as SVG and PNG and returns the paths.
    ///
    /// # Errors
    /// The path and the reason if a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str) -> Result<[PathBuf; 2], OutputError> {
        save(folder, name, &self.svg())
    }

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        let x = || self.lines.iter().flat_map(|line| &line.points).map(|point| point[0]);
        let (low, high) = x().fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        let x_logarithmic = low > 0.0 && high >= WIDE * low;
        let place = |x: f64| if x_logarithmic { x.log10() } else { x };
        let placed = |line: &Line| line.points.iter().map(|[x, y]| [place(*x), *y]).collect::<Vec<_>>();
        let series: Vec<Series> = self
            .lines
            .iter()
            .enumerate()
            .map(|(k, line)| {
                let colour = palette::time(k, self.lines.len());
                Series { dots: line.points.len() <= MOST_DOTS, ..Series::new("", &colour, placed(line)) }
                    .dashed(DASHES[k % DASHES.len()])
            })
            .collect();
        let named = self.lines.iter().zip(&series).filter(|(line, _)| !line.label.is_empty());
        let keys = named.step_by(self.lines.len().div_ceil(MOST_KEYS).max(1)).map(|(line, series)| Key {
            label: plain(&line.label),
            colour: series.colour.clone(),
            dash: series.dash,
            width: 1.6,
        });
        let y_range = range(series.iter().flat_map(|series| &series.points).map(|point| point[1]), 0.08);
        let note = if self.note.is_empty() { String::new() } else { format!("   ({})", plain(&self.note)) };
        Column {
            x_label: plain(&self.x_label) + &note,
            x_range: range(x().map(place), 0.04),
            x_logarithmic,
            keys: keys.collect(),
            charts: vec![Chart { y_label: plain(&self.y_label), y_range, height: 128.0, series, ..Chart::default() }],
            ..Column::default()
        }
        .draw()
    }
}

/// Names of users hold no markup.
fn plain(name: &str) -> String {
    name.replace(['_', '*', '^'], " ")
}
