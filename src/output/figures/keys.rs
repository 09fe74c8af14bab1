//! The keys below the panels of `bodies`: colour bar, scale bar, pressure ordinates, force arrow.

use super::axis::{Axis, label, round_step};
use super::bodies::{LEVELS, Scales};
use super::canvas::{Anchor, Canvas, Rect, Stroke, path};
use super::palette::INK;
use super::{overlay, palette};
use crate::output::{Quantity, UnitLabels};

/// Colour bar, scale bar, and the keys of band and arrow, below the panels.
pub fn draw(canvas: &mut Canvas, top: f64, scale: f64, scales: &Scales, units: &UnitLabels) {
    colour_bar(canvas, Rect { left: 14.0, top, right: 174.0, bottom: top + 7.0 }, scales, units);
    let (upper, lower, x) = (top + 3.5, top + 18.5, 214.0);
    let length = round_step(24.0 / scale);
    canvas.polyline(&[[x, upper], [x + scale * length, upper]], Stroke::solid(INK, 1.6));
    key(canvas, [x + scale * length + 5.0, upper], &value(length, &units.length));
    if scales.pressure_max > 0.0 {
        let x = x + scale * length + 60.0;
        let ordinates = [
            [x, upper + 3.0],
            [x + 3.0, upper - 2.0],
            [x + 8.0, upper - 3.5],
            [x + 13.0, upper - 2.0],
            [x + 16.0, upper + 3.0],
        ];
        overlay::hatched(canvas, &ordinates.map(|[x, _]| [x, upper + 3.0]), &ordinates);
        let text = format!("contact pressure, largest {}", value(scales.pressure_max, &units.stress));
        key(canvas, [x + 21.0, upper], &text);
    }
    if scales.force_max > 0.0 {
        overlay::arrow(canvas, [x, lower], [20.0, 0.0]);
        let unit = units.label(Quantity::Force);
        let text = format!("contact force on the driven body, largest {}", value(scales.force_max, &unit));
        key(canvas, [x + 25.0, lower], &text);
    }
}

fn key(canvas: &mut Canvas, [x, y]: [f64; 2], markup: &str) {
    canvas.text([x, y + 2.6], markup, Anchor::Start);
}

/// A number with three digits and its unit; a power of ten where plain digits would be many.
fn value(number: f64, unit: &str) -> String {
    // Rounded before the power is taken, so that 999.7 becomes 1000 and not 999.7.
    let rounded: f64 = format!("{number:.2e}").parse().unwrap_or(number);
    let exponent = rounded.abs().log10().floor() as i32;
    let power = if (-3..=3).contains(&exponent) { 0 } else { exponent };
    let mantissa = rounded / 10.0_f64.powi(power);
    let text = label(mantissa, (2 - exponent + power).max(0) as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let factor = if power == 0 { String::new() } else { format!("×10^{{{}}}", label(f64::from(power), 0)) };
    format!("{text}{factor} {unit}").trim_end().to_owned()
}

fn colour_bar(canvas: &mut Canvas, bar: Rect, scales: &Scales, units: &UnitLabels) {
    let cell = bar.width() / LEVELS as f64;
    let rectangle = |left: f64, right: f64| {
        path(&[[left, bar.top], [right, bar.top], [right, bar.bottom], [left, bar.bottom]], true)
    };
    for level in 0..LEVELS {
        let left = bar.left + cell * level as f64;
        canvas.fill_path(
            &rectangle(left, left + cell),
            &palette::stress((level as f64 + 0.5) / LEVELS as f64),
            1.0,
            true,
        );
    }
    if scales.exceeded {
        let tip = [bar.right + 6.0, 0.5 * (bar.top + bar.bottom)];
        canvas.fill_path(
            &path(&[[bar.right, bar.top], tip, [bar.right, bar.bottom]], true),
            &palette::stress(1.0),
            1.0,
            false,
        );
    }
    canvas.stroke_path(&rectangle(bar.left, bar.right), Stroke::solid(INK, 0.4));
    let axis = Axis::new([0.0, scales.stress], 3);
    for (tick, name) in axis.ticks.iter().zip(&axis.labels) {
        let x = bar.left + axis.share(*tick) * bar.width();
        canvas.polyline(&[[x, bar.bottom], [x, bar.bottom + 2.0]], Stroke::solid(INK, 0.4));
        canvas.styled_text([x, bar.bottom + 8.5], name, Anchor::Middle, 6.8, INK, 0.0);
    }
    let power = if axis.exponent == 0 { String::new() } else { format!("  ({})", axis.power()) };
    let name = format!("{}{power}", units.axis("von Mises stress", Quantity::Stress));
    canvas.text([0.5 * (bar.left + bar.right), bar.bottom + 18.5], &name, Anchor::Middle);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_three_digits() {
        let cases =
            [(0.29213, "0.292"), (1.0, "1"), (999.7, "1000"), (12345.0, "1.23×10^{4}"), (2.5e-9, "2.5×10^{−9}")];
        for (number, text) in cases {
            assert_eq!(value(number, "N"), format!("{text} N"));
        }
        assert_eq!(value(0.5, ""), "0.5");
    }
}
