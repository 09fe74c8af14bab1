//! Where the external work went, and what the balance leaves open.

use super::axis::range;
use super::chart::{Chart, Column, Series};
use super::palette::{BLUE, GREEN, INK, VERMILLION};
use super::{Instant, abscissa, marks};
use crate::model::Record;
use crate::output::{Quantity, UnitLabels};

/// External work, strain energy and dissipation above, `W - U - D` on its own scale below.
pub fn svg(records: &[Record], instants: &[Instant], units: &UnitLabels) -> String {
    let x = abscissa(records, units);
    let curve = |value: &dyn Fn(&Record) -> f64| -> Vec<[f64; 2]> {
        let value = |record: &Record| if record.converged { value(record) } else { f64::NAN };
        x.values.iter().zip(records).map(|(x, record)| [*x, value(record)]).collect()
    };
    let parts = vec![
        Series::new("strain energy *U*", GREEN, curve(&|record| record.strain_energy)).dashed("5 1.6"),
        Series::new("dissipated *D*", VERMILLION, curve(&|record| record.dissipated)).dashed("1.6 1.6"),
        Series::new("external work *W*", BLUE, curve(&|record| record.external_work)),
    ];
    let open = curve(&|record| record.external_work - record.strain_energy - record.dissipated);
    let charts = vec![
        chart(units.axis("energy per depth", Quantity::Energy), 104.0, parts),
        chart("*W* − *U* − *D*".into(), 44.0, vec![Series { width: 1.0, ..Series::new("", INK, open) }]),
    ];
    Column { marks: marks(&x, instants), x_range: x.range(), x_label: x.label, charts, ..Column::default() }.draw()
}

fn chart(y_label: String, height: f64, series: Vec<Series>) -> Chart {
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]).chain([0.0]);
    Chart { y_label, y_range: range(values, 0.08), height, series, bands: Vec::new() }
}
