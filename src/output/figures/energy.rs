//! Where the external work went, and what the balance leaves open; energy of motion, of snaps, and what integrator and viscosity took
//! are drawn where there is any.

use super::axis::range;
use super::chart::{Chart, Column, Series};
use super::palette::{BLUE, GREEN, GREY, INK, PURPLE, VERMILLION};
use super::{Instant, abscissa, marks};
use crate::model::Record;
use crate::output::{Quantity, UnitLabels};

/// External work, strain energy, dissipation and energy set free by snaps above, `W - U - D - S` on its own scale below.
pub fn svg(records: &[Record], instants: &[Instant], units: &UnitLabels) -> String {
    let x = abscissa(records, units);
    let curve = |value: &dyn Fn(&Record) -> f64| -> Vec<[f64; 2]> {
        let value = |record: &Record| if record.converged { value(record) } else { f64::NAN };
        x.values.iter().zip(records).map(|(x, record)| [*x, value(record)]).collect()
    };
    let snaps = records.iter().any(|record| record.snap_loss != 0.0);
    let mut parts = vec![
        Series::new("strain energy *U*", GREEN, curve(&|record| record.strain_energy)).dashed("5 1.6"),
        Series::new("dissipated *D*", VERMILLION, curve(&|record| record.dissipated)).dashed("1.6 1.6"),
        Series::new("external work *W*", BLUE, curve(&|record| record.external_work)),
    ];
    if snaps {
        parts.push(Series::new("set free by snaps *S*", INK, curve(&|record| record.snap_loss)).dashed("3 1.2"));
    }
    let moving = records.iter().any(|record| record.kinetic_energy != 0.0);
    if moving {
        parts.push(Series::new("kinetic *T*", PURPLE, curve(&|record| record.kinetic_energy)).dashed("6 1.2 1.2 1.2"));
    }
    let taken = |record: &Record| record.numerical_loss + record.viscous_loss;
    let lost = records.iter().any(|record| taken(record) != 0.0);
    if lost {
        parts.push(Series::new("integrator and viscosity *N*", GREY, curve(&taken)).dashed("2.4 1.2"));
    }
    let open = curve(&|record| record.external_work - record.accounted());
    let terms = [(snaps, " − *S*"), (moving, " − *T*"), (lost, " − *N*")];
    let balance =
        "*W* − *U* − *D*".to_owned() + &terms.iter().filter(|(there, _)| *there).map(|t| t.1).collect::<String>();
    let charts = vec![
        chart(units.axis("energy per depth", Quantity::Energy), 104.0, parts),
        chart(balance, 44.0, vec![Series { width: 1.0, ..Series::new("", INK, open) }]),
    ];
    Column { marks: marks(&x, instants), x_range: x.range(), x_label: x.label, charts, ..Column::default() }.draw()
}

fn chart(y_label: String, height: f64, series: Vec<Series>) -> Chart {
    let values = series.iter().flat_map(|series| &series.points).map(|point| point[1]).chain([0.0]);
    Chart { y_label, y_range: range(values, 0.08), height, series, ..Chart::default() }
}
