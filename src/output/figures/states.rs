//! Internal variables of the law where the interface is closed: their range and pressure-weighted mean over the pass.

use super::axis::range;
use super::chart::{Band, Chart, Column, Key, Series};
use super::palette::{BLUE, PALE_BLUE};
use super::{Instant, abscissa, marks};
use crate::model::{ContactStatus, InterfaceRow, Record};
use crate::output::UnitLabels;

/// One chart per variable (name, unit), below each other; `None` without variables or contact.
pub fn svg(
    records: &[Record],
    rows: &[InterfaceRow],
    variables: &[(String, String)],
    instants: &[Instant],
    units: &UnitLabels,
) -> Option<String> {
    let x = abscissa(records, units);
    let charts: Vec<Chart> = variables
        .iter()
        .enumerate()
        .filter_map(|(k, (name, unit))| {
            let values: Vec<Option<Spread>> = records.iter().map(|record| spread(rows, record.step, k)).collect();
            let closed = || x.values.iter().zip(&values);
            let edges: Vec<[f64; 3]> = closed().filter_map(|(x, v)| v.as_ref().map(|v| [*x, v.low, v.high])).collect();
            let mean = closed().map(|(x, v)| [*x, v.as_ref().map_or(f64::NAN, |v| v.mean)]).collect();
            let y_range = range(edges.iter().flat_map(|edge| [edge[1], edge[2]]), 0.08);
            (!edges.is_empty()).then(|| Chart {
                y_label: units.variable(name, unit),
                y_range,
                height: 80.0,
                series: vec![Series { width: 1.4, ..Series::new("", BLUE, mean) }],
                bands: vec![Band { edges, colour: PALE_BLUE.into() }],
                ..Chart::default()
            })
        })
        .collect();
    let label = "range and mean over the touching points".into();
    let keys = vec![Key { label, colour: PALE_BLUE.into(), dash: "", width: 5.0 }];
    let (marks, x_range) = (marks(&x, instants), x.contact_range(records));
    (!charts.is_empty()).then(|| Column { marks, x_range, x_label: x.label, charts, keys, ..Column::default() }.draw())
}

/// A variable over the closed sites of one step.
struct Spread {
    low: f64,
    high: f64,
    mean: f64,
}

fn spread(rows: &[InterfaceRow], step: usize, variable: usize) -> Option<Spread> {
    let start = rows.partition_point(|row| row.step < step);
    let of_step = rows[start..].iter().take_while(|row| row.step == step);
    let closed = of_step.filter(|row| row.status != ContactStatus::Open);
    let values = closed.filter_map(|row| {
        let value = row.variables.get(variable).copied().filter(|value| value.is_finite())?;
        Some((value, row.weight * row.pressure))
    });
    let (mut low, mut high, mut sum, mut weight) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
    for (value, load) in values {
        (low, high) = (low.min(value), high.max(value));
        (sum, weight) = (sum + value * load, weight + load);
    }
    (weight > 0.0).then(|| Spread { low, high, mean: sum / weight })
}
