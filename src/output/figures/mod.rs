//! Figures of a run, as SVG for papers and PNG for everything else, drawn without being asked.
//!
//! | file | content |
//! |---|---|
//! | `forces` | `Fx`, `Fy` over the sliding distance |
//! | `mu_global` | global friction, local value, bounds `tan(contact_angle -+ atan mu)`; masked where `Fy` is small |
//! | `interface` | pressure and traction along the interface at chosen instants |
//! | `states` | internal variables of the law over the closed sites: range and mean (laws with memory only) |
//! | `energy` | external work, strain energy, dissipation, and what the balance leaves open |
//! | `certify` | differences between Newton and conic solution, and what both cost (certified runs only) |
//! | `animation` | the bodies sliding, forces below; SVG only, moves in a browser |
//! | `bodies` | deformed bodies at the same instants, coloured by von Mises stress, with contact pressure and resultant |
//!
//! The SVG is written by this room (a chart is 200 lines, the bodies need their own drawing anyway); `resvg` turns it
//! into PNG with the bundled DejaVu Sans, so that no font of the machine is needed.

mod animation;
mod axis;
mod bodies;
mod canvas;
pub mod certify;
mod chart;
mod energy;
mod forces;
mod frame;
mod friction;
mod instants;
mod interface;
mod keys;
mod labels;
pub mod lines;
mod overlay;
mod palette;
mod png;
pub mod point;
pub mod precision;
mod sampling;
mod states;
#[cfg(test)]
pub(crate) mod synthetic;
mod text;

pub use animation::film;
pub use bodies::Frame;
pub use instants::{CONTACT_THRESHOLD, Instant, choose};
pub use png::DPI;
pub(super) use text::escape;

use std::path::{Path, PathBuf};

use super::run_json::write_atomic;
use super::vtu::BodyField;
use super::{OutputError, Quantity, UnitLabels};
use crate::model::{InterfaceRow, Record};

/// What the figures are drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Data<'a> {
    /// Rows of `history.csv`; rows that did not converge are left out of the curves.
    pub records: &'a [Record],
    /// Rows of `interface.csv`.
    pub interface: &'a [InterfaceRow],
    /// Local coefficient of friction, if the law has one: reference line and bounds of `mu_global`.
    pub local_friction: Option<f64>,
    /// Internal variables of the law, as the columns of `interface.csv`: name, dimension in words.
    pub variables: &'a [(String, String)],
    /// Names of the units.
    pub units: &'a UnitLabels,
}

impl Data<'_> {
    /// Writes `forces`, `mu_global`, `energy`, `states` and `interface` (`interface_0`, ... with several pairs) as SVG and PNG and
    /// returns the paths. Nothing is written for fewer than two rows.
    ///
    /// # Errors
    /// The path and the reason if a file cannot be written.
    pub fn write_charts(&self, folder: &Path) -> Result<Vec<PathBuf>, OutputError> {
        if self.records.len() < 2 {
            return Ok(Vec::new());
        }
        let mut written = Vec::new();
        for (name, svg) in self.charts() {
            written.extend(save(folder, &name, &svg)?);
        }
        Ok(written)
    }

    /// All charts as (name, SVG), for reports that embed them.
    pub fn charts(&self) -> Vec<(String, String)> {
        let instants = choose(self.records);
        let mut figures = vec![
            ("forces".to_owned(), forces::svg(self.records, &instants, self.units)),
            ("mu_global".to_owned(), friction::svg(self.records, self.local_friction, &instants, self.units)),
            ("energy".to_owned(), energy::svg(self.records, &instants, self.units)),
        ];
        let states = states::svg(self.records, self.interface, self.variables, &instants, self.units);
        figures.extend(states.map(|svg| ("states".to_owned(), svg)));
        let pairs = interface::svgs(self.records, self.interface, &instants, self.units);
        let several = pairs.len() > 1;
        figures.extend(pairs.into_iter().map(|(pair, svg)| match several {
            true => (format!("interface_{pair}"), svg),
            false => ("interface".to_owned(), svg),
        }));
        figures
    }

    /// Samples the bodies at one instant for [`Self::write_bodies`], so that the state itself need not be kept.
    pub fn frame(&self, instant: &Instant, bodies: &[BodyField]) -> Frame {
        let record = &self.records[instant.index];
        let rows = self.interface.iter().filter(|row| row.step == record.step).cloned().collect();
        Frame::sample(instant, record, bodies, rows)
    }

    /// Samples the bodies at one row of the history for [`Self::write_animation`].
    pub fn brief_frame(&self, index: usize, bodies: &[BodyField]) -> Frame {
        let record = &self.records[index];
        let first = self.interface.partition_point(|row| row.step < record.step);
        let rows = self.interface[first..].iter().take_while(|row| row.step == record.step).cloned().collect();
        Frame::brief(record, bodies, rows)
    }

    /// Writes `animation` as SVG and returns its path; nothing for fewer than two frames.
    ///
    /// # Errors
    /// The path and the reason if it cannot be written.
    pub fn write_animation(&self, folder: &Path, frames: &[Frame]) -> Result<Option<PathBuf>, OutputError> {
        let Some(svg) = animation::svg(self.records, frames, self.units) else { return Ok(None) };
        let path = folder.join("animation.svg");
        write_atomic(&path, svg.as_bytes())?;
        Ok(Some(path))
    }

    /// Writes `bodies` as SVG and PNG and returns the paths; nothing without frames.
    ///
    /// # Errors
    /// The path and the reason if a file cannot be written.
    pub fn write_bodies(&self, folder: &Path, frames: &[Frame]) -> Result<Vec<PathBuf>, OutputError> {
        match bodies::svg(frames, self.units) {
            Some(svg) => save(folder, "bodies", &svg).map(Vec::from),
            None => Ok(Vec::new()),
        }
    }
}

/// Writes `<name>.svg` and `<name>.png`.
fn save(folder: &Path, name: &str, svg: &str) -> Result<[PathBuf; 2], OutputError> {
    let [vector, raster] = ["svg", "png"].map(|kind| folder.join(format!("{name}.{kind}")));
    write_atomic(&vector, svg.as_bytes())?;
    write_atomic(&raster, &png::render(svg, &raster)?)?;
    Ok([vector, raster])
}

/// Margin around the touching part of a pass, as a share of it.
const CONTACT_MARGIN: f64 = 0.15;
/// Share of the analysis above which the touching part is not looked at alone.
const MOST_OF_IT: f64 = 0.7;

/// Horizontal coordinate of the charts over the history.
struct Abscissa {
    label: String,
    values: Vec<f64>,
}

impl Abscissa {
    /// From the start of the analysis, which has no row, to the last row.
    fn range(&self) -> [f64; 2] {
        axis::range(self.values.iter().copied().chain([0.0]), 0.0)
    }

    /// The part in which the bodies touch, with a margin; all of it where that is most of it, or where they never touch.
    fn contact_range(&self, records: &[Record]) -> [f64; 2] {
        let touching = || self.values.iter().zip(records).filter(|(_, r)| r.contact_length > 0.0).map(|(x, _)| *x);
        let ([start, end], [low, high]) = (self.range(), axis::range(touching(), CONTACT_MARGIN));
        if touching().count() < 2 || high - low > MOST_OF_IT * (end - start) {
            return [start, end];
        }
        [low.max(start), high.min(end)]
    }
}

/// The sliding distance where the body is driven in x, else the approach where it is driven in y, else the time.
fn abscissa(records: &[Record], units: &UnitLabels) -> Abscissa {
    let column = |value: &dyn Fn(&Record) -> f64| -> Vec<f64> { records.iter().map(value).collect() };
    let [x, y] = [column(&|record| record.drive[0]), column(&|record| record.drive[1])];
    let size = |values: &[f64]| values.iter().fold(0.0_f64, |size, value| size.max((value - values[0]).abs()));
    let moving = 1e-9 * size(&x).max(size(&y));
    if size(&x) > moving {
        Abscissa { label: units.axis("sliding distance", Quantity::Length), values: x }
    } else if size(&y) > moving {
        Abscissa { label: units.axis("vertical displacement", Quantity::Length), values: y }
    } else {
        Abscissa { label: units.axis("time", Quantity::Time), values: column(&|record| record.time) }
    }
}

/// Letters of the instants at their abscissas.
fn marks(x: &Abscissa, instants: &[Instant]) -> Vec<(f64, String)> {
    instants.iter().map(|instant| (x.values[instant.index], instant.letter.to_string())).collect()
}
