//! Pressure and, unless frictionless, tangential traction along one interface at the chosen instants.

use super::axis::range;
use super::chart::{Chart, Column, Key, Series};
use super::{Instant, palette};
use crate::model::{InterfaceRow, Record};
use crate::output::{Quantity, UnitLabels};

/// One figure per contact pair that ever carries pressure: (pair, SVG).
pub fn svgs(
    records: &[Record],
    rows: &[InterfaceRow],
    instants: &[Instant],
    units: &UnitLabels,
) -> Vec<(usize, String)> {
    let mut pairs: Vec<usize> = rows.iter().map(|row| row.pair).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let of_pair = |pair: usize| Some((pair, svg(records, rows, pair, instants, units)?));
    pairs.into_iter().filter_map(of_pair).collect()
}

fn svg(
    records: &[Record],
    rows: &[InterfaceRow],
    pair: usize,
    instants: &[Instant],
    units: &UnitLabels,
) -> Option<String> {
    let at = |instant: &Instant| -> Vec<&InterfaceRow> {
        let step = records[instant.index].step;
        let mut found: Vec<_> = rows.iter().filter(|row| row.pair == pair && row.step == step).collect();
        found.sort_by(|a, b| a.arc.total_cmp(&b.arc));
        found
    };
    let profiles: Vec<Vec<&InterfaceRow>> = instants.iter().map(at).collect();
    let x_range = loaded_range(&profiles)?;
    let panel = |label: String, height: f64, value: fn(&InterfaceRow) -> f64, named: bool| {
        let series = profiles.iter().zip(instants).enumerate().map(|(k, (profile, instant))| {
            let points = profile.iter().map(|row| [row.arc, value(row)]).collect();
            let name = if named { instant.letter.to_string() } else { String::new() };
            Series::new(&name, &palette::time(k, instants.len()), points)
        });
        chart(label, height, series.collect())
    };
    let mut charts = vec![panel(units.axis("pressure *p*", Quantity::Stress), 88.0, |row| row.pressure, true)];
    if profiles.iter().flatten().any(|row| row.traction != 0.0) {
        charts.push(panel(units.axis("traction *q*", Quantity::Stress), 66.0, |row| row.traction, false));
    }
    let x_label = units.axis("arc length along the interface", Quantity::Length);
    Some(
        Column { x_label, x_range, charts, keys: keys(instants), labels_repeat_keys: true, ..Column::default() }.draw(),
    )
}

fn keys(instants: &[Instant]) -> Vec<Key> {
    let key = |(k, instant): (usize, &Instant)| Key {
        label: format!("({}) {}", instant.letter, instant.label),
        colour: palette::time(k, instants.len()),
        dash: "",
        width: 1.6,
    };
    instants.iter().enumerate().map(key).collect()
}

/// The part of the interface that carries pressure at any of the instants, with a margin.
fn loaded_range(profiles: &[Vec<&InterfaceRow>]) -> Option<[f64; 2]> {
    let largest = profiles.iter().flatten().map(|row| row.pressure).fold(0.0, f64::max);
    let loaded = profiles.iter().flatten().filter(|row| row.pressure > 1e-3 * largest);
    (largest > 0.0).then(|| range(loaded.map(|row| row.arc), 0.08))
}

fn chart(y_label: String, height: f64, series: Vec<Series>) -> Chart {
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]).chain([0.0]);
    Chart { y_label, y_range: range(values, 0.07), height, series, ..Chart::default() }
}
