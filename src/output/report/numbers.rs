//! Numbers of a history that a reader asks for, and how numbers are written in a page.

use super::html::Cell;
use crate::model::Record;
use crate::output::{Quantity, UnitLabels};

/// A number with four digits, without an exponent where it needs none.
pub fn short(value: f64) -> String {
    let magnitude = value.abs();
    if !value.is_finite() {
        "–".into()
    } else if value == 0.0 || (1e-3..1e6).contains(&magnitude) {
        let digits = if value == 0.0 { 0 } else { (3 - magnitude.log10().floor() as i32).clamp(0, 6) as usize };
        let text = format!("{value:.digits$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        text.replace('-', "−")
    } else {
        format!("{value:.3e}").replace('-', "−")
    }
}

/// A number with its unit.
pub fn with_unit(value: f64, units: &UnitLabels, quantity: Quantity) -> String {
    format!("{} {}", short(value), units.label(quantity)).trim_end().to_owned()
}

/// Mean resistance over mean support, over the way in contact where the body is driven in x, else over the time (trapezoidal rule).
pub fn mean_friction(records: &[Record]) -> f64 {
    let way = |record: &Record, by_time: bool| if by_time { record.time } else { record.drive[0] };
    let moving = records.windows(2).any(|pair| pair[0].drive[0] != pair[1].drive[0]);
    let touching = |pair: &&[Record]| pair.iter().all(|record| record.contact_length > 0.0 && record.converged);
    let integral = |component: usize| -> f64 {
        let one = |pair: &[Record]| {
            let step = (way(&pair[1], !moving) - way(&pair[0], !moving)).abs();
            0.5 * step * (pair[0].force[component] + pair[1].force[component])
        };
        records.windows(2).filter(touching).map(one).sum()
    };
    integral(0) / integral(1)
}

/// Extremes and totals of a history: name, value, where.
pub fn summary(records: &[Record], units: &UnitLabels) -> Vec<Vec<Cell>> {
    type Column = fn(&Record) -> f64;
    const EXTREMES: [(&str, Quantity, Column, bool); 9] = [
        ("largest resistance Fx", Quantity::Force, |r| r.force[0], true),
        ("smallest resistance Fx", Quantity::Force, |r| r.force[0], false),
        ("largest support Fy", Quantity::Force, |r| r.force[1], true),
        ("largest mu_global", Quantity::Number, |r| r.mu_global, true),
        ("smallest mu_global", Quantity::Number, |r| r.mu_global, false),
        ("largest contact angle", Quantity::Angle, |r| r.contact_angle, true),
        ("longest contact", Quantity::Length, |r| r.contact_length, true),
        ("largest pressure", Quantity::Stress, |r| r.pressure_max, true),
        ("largest penetration left", Quantity::Length, |r| r.penetration_max, true),
    ];
    let row = |(name, quantity, column, largest): (&str, Quantity, Column, bool)| {
        let value = |record: &&Record| if largest { column(record) } else { -column(record) };
        let counting = records.iter().filter(|record| record.converged && column(record).is_finite());
        let at = counting.max_by(|a, b| value(a).total_cmp(&value(b)))?;
        let place = format!("step {}, x = {}", at.step, with_unit(at.drive[0], units, Quantity::Length));
        Some(vec![
            Cell::word(name),
            Cell::number(with_unit(column(at), units, quantity)),
            Cell::words(format!("{place}, y = {}", with_unit(at.drive[1], units, Quantity::Length))),
        ])
    };
    EXTREMES.into_iter().filter_map(row).collect()
}

/// Energies at the end, and what their balance leaves open.
pub fn energies(records: &[Record], units: &UnitLabels) -> Vec<Vec<Cell>> {
    let Some(last) = records.last() else { return vec![] };
    let open = last.external_work - last.accounted();
    let absolute: f64 = records.windows(2).map(|pair| (pair[1].external_work - pair[0].external_work).abs()).sum();
    let row = |name: &str, value: f64| {
        let share = format!("{} %", short(100.0 * value / absolute));
        vec![
            Cell::word(name),
            Cell::number(with_unit(value, units, Quantity::Energy)),
            Cell::number(if absolute > 0.0 { share } else { String::new() }),
        ]
    };
    let moving = [
        ("kinetic at the end", last.kinetic_energy),
        ("taken by the time integration", last.numerical_loss),
        ("taken by viscosity", last.viscous_loss),
    ];
    let mut rows = vec![
        row("work of drives, supports and loads", last.external_work),
        row("dissipated by friction", last.dissipated),
        row("stored in the bodies at the end", last.strain_energy),
        row("set free by sudden changes of equilibrium", last.snap_loss),
    ];
    rows.extend(moving.iter().filter(|(_, value)| *value != 0.0).map(|(name, value)| row(name, *value)));
    rows.push(row("left open by finite steps", open));
    rows
}

/// Rows of the history that fit into a page, and the columns that matter.
pub fn history(records: &[Record]) -> (Vec<&'static str>, Vec<Vec<Cell>>, usize) {
    const MOST: usize = 400;
    let stride = records.len().div_ceil(MOST).max(1);
    let heads = vec![
        "step",
        "time",
        "drive x",
        "drive y",
        "Fx",
        "Fy",
        "mu_global",
        "contact angle",
        "contact length",
        "largest pressure",
        "dissipated",
        "iterations",
        "cuts",
    ];
    let row = |r: &Record| {
        let numbers = [
            r.time,
            r.drive[0],
            r.drive[1],
            r.force[0],
            r.force[1],
            r.mu_global,
            r.contact_angle,
            r.contact_length,
            r.pressure_max,
            r.dissipated,
        ];
        let mut cells = vec![Cell::number(r.step.to_string())];
        cells.extend(numbers.map(|number| Cell::number(short(number))));
        cells.extend([r.newton_iterations, r.cuts].map(|count| Cell::number(count.to_string())));
        cells
    };
    (heads, records.iter().step_by(stride).map(row).collect(), stride)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_say_their_size() {
        let cases =
            [(0.0, "0"), (-0.25, "−0.25"), (1234.5, "1234"), (1.23456, "1.235"), (4e-9, "4.000e−9"), (100.0, "100")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(f64::NAN), "–");
    }
}
