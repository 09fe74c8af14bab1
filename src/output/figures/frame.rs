//! One frame of a line chart: axes, grid, ticks and their labels.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Rect, Stroke};
use super::palette::{GREY, GRID, INK};
use super::text;

/// Length of a tick in points.
pub const TICK: f64 = 2.5;
/// Size of tick labels and legend entries.
pub const SMALL: f64 = 6.8;

/// A frame with its axes.
pub struct Frame {
    /// Inner box on the sheet.
    pub rect: Rect,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
}

impl Frame {
    /// Position of a data point on the sheet.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.rect.left + self.x.share(x) * self.rect.width(), self.rect.bottom - self.y.share(y) * self.rect.height()]
    }

    /// Grid, axes, ticks and labels; the horizontal axis is labelled where `x_label` is given.
    pub fn draw(&self, canvas: &mut Canvas, y_label: &str, x_label: Option<&str>) {
        let Rect { left, top, right, bottom } = self.rect;
        for (tick, label) in self.x.ticks.iter().zip(&self.x.labels) {
            let x = self.place([*tick, 0.0])[0];
            canvas.polyline(&[[x, top], [x, bottom]], Stroke::solid(GRID, 0.4));
            canvas.polyline(&[[x, bottom], [x, bottom + TICK]], Stroke::solid(INK, 0.5));
            if x_label.is_some() {
                canvas.styled_text([x, bottom + TICK + 6.8], label, Anchor::Middle, SMALL, INK, 0.0);
            }
        }
        for (tick, label) in self.y.ticks.iter().zip(&self.y.labels) {
            let y = self.place([0.0, *tick])[1];
            // Zero separates resistance from drive and load from release: the one grid line worth seeing.
            let line =
                if *tick == 0.0 && !self.y.logarithmic { Stroke::solid(GREY, 0.5) } else { Stroke::solid(GRID, 0.4) };
            canvas.polyline(&[[left, y], [right, y]], line);
            canvas.polyline(&[[left - TICK, y], [left, y]], Stroke::solid(INK, 0.5));
            canvas.styled_text([left - TICK - 1.5, y + 2.5], label, Anchor::End, SMALL, INK, 0.0);
        }
        canvas.polyline(&[[left, top], [left, bottom], [right, bottom]], Stroke::solid(INK, 0.6));
        canvas.styled_text([left - 2.0, top - 3.5], &self.y.power(), Anchor::End, SMALL, INK, 0.0);
        // A long label may reach a little beyond its frame, then it shrinks.
        let size = text::SIZE * ((bottom - top + 8.0) / text::width(y_label, text::SIZE)).min(1.0);
        canvas.styled_text([8.5, 0.5 * (top + bottom)], y_label, Anchor::Middle, size, INK, -90.0);
        if let Some(x_label) = x_label {
            let power = self.x.power();
            let full = if power.is_empty() { x_label.to_owned() } else { format!("{x_label}  ({power})") };
            canvas.text([0.5 * (left + right), bottom + 20.5], &full, Anchor::Middle);
        }
    }
}
