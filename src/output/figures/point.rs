//! Figures of one contact point that was driven by itself.
//!
//! | file | content |
//! |---|---|
//! | `*-friction` | coefficient of friction `q/p` over time; of a spring slider also the force of the spring; slip below |
//! | `*-loop` | traction over slip |
//! | `*-states` | internal variables over time, one frame each |

use std::path::{Path, PathBuf};

use asperity_laws::drive::Record;
use asperity_laws::{Unit, Variable};

use super::axis::range;
use super::chart::{Chart, Column, Series};
use super::palette::{BLUE, GREEN, INK, VERMILLION};
use super::save;
use crate::output::{OutputError, UnitLabels};

/// Writes all figures of one history as SVG and PNG, their names beginning with `name`, and returns the paths. Nothing is
/// written for fewer than three records.
///
/// # Errors
/// The path and the reason if a file cannot be written.
pub fn write_figures(
    folder: &Path,
    name: &str,
    records: &[Record],
    variables: &[Variable],
    units: &UnitLabels,
) -> Result<Vec<PathBuf>, OutputError> {
    if records.len() < 3 {
        return Ok(vec![]);
    }
    let mut figures = vec![("friction", friction(records, units)), ("loop", traction_loop(records, units))];
    if !variables.is_empty() {
        figures.push(("states", states(records, variables, units)));
    }
    let mut written = vec![];
    for (kind, svg) in figures {
        written.extend(save(folder, &format!("{name}-{kind}"), &svg)?);
    }
    Ok(written)
}

/// A curve over time; the start itself has no step and thus no traction.
fn over_time(records: &[Record], value: impl Fn(&Record) -> f64) -> Vec<[f64; 2]> {
    records[1..].iter().map(|record| [record.time, value(record)]).collect()
}

fn friction(records: &[Record], units: &UnitLabels) -> String {
    let ratio = |stress: f64, pressure: f64| if pressure > 0.0 { stress / pressure } else { f64::NAN };
    let own = over_time(records, |record| ratio(record.traction, record.pressure));
    let spring = over_time(records, |record| ratio(record.force, record.pressure));
    let mut series = vec![Series { width: 1.0, ..Series::new("", BLUE, own.clone()) }];
    if spring != own {
        series[0].label = "friction *q*/*p*".into();
        series.push(Series { width: 0.9, ..Series::new("spring *f*/*p*", VERMILLION, spring).dashed("4 1.6") });
    }
    let slip = over_time(records, |record| record.slip);
    let charts = vec![
        chart("*q* / *p*".into(), 104.0, series),
        chart(units.axis_of("slip", Unit::LENGTH), 52.0, vec![Series { width: 1.0, ..Series::new("", INK, slip) }]),
    ];
    timed(records, charts, units)
}

fn traction_loop(records: &[Record], units: &UnitLabels) -> String {
    let points: Vec<_> = records[1..].iter().map(|record| [record.slip, record.traction]).collect();
    let x_range = range(points.iter().map(|point| point[0]), 0.05);
    let series = Series { width: 0.9, ..Series::new("", BLUE, points) };
    let charts = vec![chart(units.axis_of("traction *q*", Unit::STRESS), 128.0, vec![series])];
    Column { x_label: units.axis_of("slip", Unit::LENGTH), x_range, charts, ..Column::default() }.draw()
}

fn states(records: &[Record], variables: &[Variable], units: &UnitLabels) -> String {
    let frame = |(k, variable): (usize, &Variable)| {
        let points = over_time(records, |record| record.states[k]);
        let y_range = range(points.iter().map(|point| point[1]), 0.07);
        let series = vec![Series { width: 1.0, ..Series::new("", GREEN, points) }];
        Chart {
            y_label: units.axis_of(&variable.name, variable.unit),
            y_range,
            height: 76.0,
            series,
            ..Chart::default()
        }
    };
    timed(records, variables.iter().enumerate().map(frame).collect(), units)
}

fn timed(records: &[Record], charts: Vec<Chart>, units: &UnitLabels) -> String {
    let [start, end] = range(records.iter().map(|record| record.time), 0.0);
    let x_range = [start, end + 0.04 * (end - start)]; // room for a tick label at the end
    Column { x_label: units.axis_of("time", Unit::TIME), x_range, charts, ..Column::default() }.draw()
}

fn chart(y_label: String, height: f64, series: Vec<Series>) -> Chart {
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]);
    Chart { y_label, y_range: range(values, 0.07), height, series, ..Chart::default() }
}
