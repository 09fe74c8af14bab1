//! Work and precision: error over CPU time on logarithmic axes, one colour for each family of settings, with the Pareto front.

use std::path::{Path, PathBuf};

use super::axis::range;
use super::chart::{Chart, Column, Key, Series};
use super::palette::GREY;
use super::{palette, save};
use crate::output::OutputError;

/// Dash patterns that tell neighbouring families apart in grey print.
const DASHES: [&str; 3] = ["", "4 1.4", "1.6 1.2"];

/// Settings that belong together, e.g. by their basis.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// Its name.
    pub label: String,
    /// CPU time in seconds and error of those that no other one of the family dominates, cheap ones first: joined by a line.
    pub line: Vec<[f64; 2]>,
    /// CPU time and error of all others: dots.
    pub dots: Vec<[f64; 2]>,
}

/// A figure of work and precision; all numbers are above 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Precision {
    /// What the vertical axis shows.
    pub y_label: String,
    /// Families of settings.
    pub families: Vec<Family>,
    /// CPU time and error of the settings that no other one dominates, cheap ones first.
    pub front: Vec<[f64; 2]>,
    /// The smallest error that can be told.
    pub floor: f64,
}

impl Precision {
    /// Writes the figure as SVG and PNG and returns the paths.
    ///
    /// # Errors
    /// The path and the reason if a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str) -> Result<[PathBuf; 2], OutputError> {
        save(folder, name, &self.svg())
    }

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        let placed = |points: &[[f64; 2]]| -> Vec<[f64; 2]> { points.iter().map(|p| p.map(f64::log10)).collect() };
        let all = || self.families.iter().flat_map(|family| family.line.iter().chain(&family.dots)).copied();
        let x_range = range(all().map(|[cpu, _]| cpu.log10()), 0.06);
        let y_range = range(all().map(|[_, error]| error.log10()).chain([self.floor.log10()]), 0.06);
        let mut series = vec![Series { width: 3.6, ..Series::new("", palette::PALE_BLUE, placed(&self.front)) }];
        let floor = x_range.map(|x| [x, self.floor.log10()]);
        series.push(Series { width: 0.8, ..Series::new("", GREY, floor.to_vec()) }.dashed("3 2"));
        let mut keys = vec![key("Pareto front", palette::PALE_BLUE, "", 3.6), key("reference's own", GREY, "3 2", 0.8)];
        for (k, family) in self.families.iter().enumerate() {
            let (colour, dash) = (palette::time(k, self.families.len()), DASHES[k % DASHES.len()]);
            let dots = placed(&family.dots).into_iter().map(|dot| Series {
                dots: true,
                width: 0.3,
                ..Series::new("", &colour, vec![dot])
            });
            series.extend(dots);
            series.push(Series { dots: true, ..Series::new("", &colour, placed(&family.line)) }.dashed(dash));
            keys.push(key(&family.label, &colour, dash, 1.4));
        }
        let chart = Chart {
            y_label: self.y_label.clone(),
            y_range,
            y_logarithmic: true,
            height: 150.0,
            series,
            ..Chart::default()
        };
        let x_label = "CPU time in s".into();
        Column { x_label, x_range, x_logarithmic: true, keys, charts: vec![chart], ..Column::default() }.draw()
    }
}

fn key(label: &str, colour: &str, dash: &'static str, width: f64) -> Key {
    Key { label: label.into(), colour: colour.to_owned(), dash, width }
}
