//! The global coefficient of friction against what the local law and the contact angle allow.

use super::axis::range;
use super::chart::{Band, Chart, Column, Key, Series};
use super::instants::CONTACT_THRESHOLD;
use super::palette::{BLUE, GREY, INK, PALE_BLUE};
use super::{Abscissa, Instant, abscissa, marks};
use crate::model::Record;
use crate::output::UnitLabels;

/// Angles beyond this (about 86 degrees) have no tangent worth drawing.
const STEEPEST: f64 = 1.5;

/// `mu_global` where `|Fy|` exceeds 2% of its largest value; with the local coefficient of the law (if it has one) and
/// the bounds `tan(contact_angle -+ atan mu)`, otherwise with the frictionless value `tan(contact_angle)`.
pub fn svg(records: &[Record], local: Option<f64>, instants: &[Instant], units: &UnitLabels) -> String {
    let x = abscissa(records, units);
    let loaded = loaded(records);
    let masked = |value: &dyn Fn(&Record) -> f64| -> Vec<[f64; 2]> {
        let value = |(record, loaded): (&Record, &bool)| if *loaded { value(record) } else { f64::NAN };
        x.values.iter().zip(records.iter().zip(&loaded)).map(|(x, pair)| [*x, value(pair)]).collect()
    };
    let global = masked(&|record| record.mu_global);
    let angles = masked(&|record| record.contact_angle);
    let mut chart = Chart {
        y_label: "global friction *μ*_{global} = *F*_x / *F*_y".into(),
        y_range: robust_range(&global, local),
        height: 128.0,
        ..Chart::default()
    };
    let keys = reference(&mut chart, (&x, records), &angles, local);
    chart.series.push(Series { width: 1.4, ..Series::new("*μ*_{global}", BLUE, global) });
    let (marks, x_range) = (marks(&x, instants), x.contact_range(records));
    Column { marks, x_range, x_label: x.label, charts: vec![chart], keys, ..Column::default() }.draw()
}

/// Adds what `mu_global` is compared with and returns the legend it needs.
fn reference(
    chart: &mut Chart,
    (x, records): (&Abscissa, &[Record]),
    angles: &[[f64; 2]],
    local: Option<f64>,
) -> Vec<Key> {
    let Some(mu) = local else {
        let frictionless = angles.iter().map(|[x, angle]| [*x, tangent(*angle)]).collect();
        chart.series.push(Series::new("tan *θ*", GREY, frictionless).dashed("3 2"));
        return Vec::new();
    };
    let band = bounds(angles, mu);
    chart.series.extend(bound_lines(&band));
    chart.series.push(level(x, records, mu));
    chart.bands.push(band);
    let label = "between tan(*θ* ± arctan *μ*_{local}), *θ* = mean contact angle".into();
    vec![Key { label, colour: PALE_BLUE.into(), dash: "", width: 5.0 }]
}

fn loaded(records: &[Record]) -> Vec<bool> {
    let largest = records.iter().map(|record| record.force[1].abs()).filter(|fy| fy.is_finite()).fold(0.0, f64::max);
    let loaded = |record: &Record| record.converged && record.force[1].abs() > CONTACT_THRESHOLD * largest;
    records.iter().map(loaded).collect()
}

fn tangent(angle: f64) -> f64 {
    if angle.abs() < STEEPEST { angle.tan() } else { f64::NAN }
}

fn bounds(angles: &[[f64; 2]], mu: f64) -> Band {
    let phi = mu.atan();
    let edges = angles.iter().map(|[x, angle]| [*x, tangent(angle - phi), tangent(angle + phi)]).collect();
    Band { edges, colour: PALE_BLUE.into() }
}

fn bound_lines(band: &Band) -> [Series; 2] {
    [1, 2].map(|edge| Series {
        width: 0.5,
        ..Series::new("", GREY, band.edges.iter().map(|values| [values[0], values[edge]]).collect())
    })
}

fn level(x: &Abscissa, records: &[Record], mu: f64) -> Series {
    let [start, end] = x.contact_range(records);
    Series { width: 0.9, ..Series::new("*μ*_{local}", INK, vec![[start, mu], [end, mu]]).dashed("4 2") }
}

/// Range of all but the outermost 2% of the values, widened by a fifth, never beyond all values: a spike near first or
/// last contact leaves the frame instead of flattening the curve.
fn robust_range(points: &[[f64; 2]], local: Option<f64>) -> [f64; 2] {
    let mut values: Vec<f64> = points.iter().map(|point| point[1]).filter(|value| value.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else { return [0.0, 1.0] };
    let cut = (0.02 * values.len() as f64).ceil() as usize;
    let (low, high) = (values[cut.min(last / 2)], values[last - cut.min(last / 2)]);
    let reach = 0.2 * (high - low);
    let ends = [values[0].max(low - reach), values[last].min(high + reach), 0.0];
    range(ends.into_iter().chain(local), 0.06)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spikes_do_not_set_the_range() {
        let mut points: Vec<_> = (0..100).map(|k| [f64::from(k), 0.5 + 0.01 * f64::from(k % 10)]).collect();
        points[0][1] = 80.0;
        points[99][1] = -40.0;
        let [low, high] = robust_range(&points, Some(0.3));
        assert!(low > -0.5 && high < 1.0, "{low} {high}");
    }

    #[test]
    fn bounds_near_the_vertical_are_left_out() {
        assert!(tangent(1.55).is_nan());
        assert!((tangent(0.5) - 0.5_f64.tan()).abs() < 1e-15);
    }
}
