//! Horizontal resistance and normal support over the sliding distance.

use super::axis::range;
use super::chart::{Chart, Column, Series};
use super::palette::{BLUE, VERMILLION};
use super::{Instant, abscissa, marks};
use crate::model::Record;
use crate::output::{Quantity, UnitLabels};

/// `Fx` (resistance) and `Fy` (support) of all converged rows; letters mark the chosen instants.
pub fn svg(records: &[Record], instants: &[Instant], units: &UnitLabels) -> String {
    let x = abscissa(records, units);
    let component = |c: usize| -> Vec<[f64; 2]> {
        let force = |record: &Record| if record.converged { record.force[c] } else { f64::NAN };
        x.values.iter().zip(records).map(|(x, record)| [*x, force(record)]).collect()
    };
    let series =
        vec![Series::new("*F*_y", BLUE, component(1)), Series::new("*F*_x", VERMILLION, component(0)).dashed("5 1.6")];
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]).chain([0.0]);
    let chart = Chart {
        y_label: units.axis("force per depth *F*", Quantity::Force),
        y_range: range(values, 0.06),
        height: 128.0,
        series,
        ..Chart::default()
    };
    Column {
        marks: marks(&x, instants),
        x_range: x.contact_range(records),
        x_label: x.label,
        charts: vec![chart],
        ..Column::default()
    }
    .draw()
}
