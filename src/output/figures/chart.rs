//! Line charts: one or more frames stacked over a shared horizontal axis.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, PER_MM, Rect, Stroke, path};
use super::palette::{GREY, GRID, INK};
use super::{labels, text};

/// Width of a single-column figure in points.
pub const COLUMN: f64 = 84.0 * PER_MM;
const TICK: f64 = 2.5;
const SMALL: f64 = 6.8;
const GAP: f64 = 9.0;

/// One curve.
#[derive(Clone, Debug)]
pub struct Series {
    /// Direct label, empty for none.
    pub label: String,
    /// Points in data coordinates; NaN interrupts the line.
    pub points: Vec<[f64; 2]>,
    /// Colour of line and label.
    pub colour: String,
    /// Width in points.
    pub width: f64,
    /// Dash pattern, empty for a solid line.
    pub dash: &'static str,
}

impl Series {
    /// A solid curve of usual width.
    pub fn new(label: &str, colour: &str, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, colour: colour.into(), width: 1.2, dash: "" }
    }

    /// The same curve, dashed.
    pub fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }
}

/// The area between two curves over the same abscissas.
#[derive(Clone, Debug)]
pub struct Band {
    /// Abscissa, lower and upper ordinate; NaN interrupts the band.
    pub edges: Vec<[f64; 3]>,
    /// Fill colour.
    pub colour: String,
}

/// One frame of a figure.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Label of the vertical axis.
    pub y_label: String,
    /// Range of the vertical axis.
    pub y_range: [f64; 2],
    /// Height of the frame in points.
    pub height: f64,
    /// Areas behind the curves.
    pub bands: Vec<Band>,
    /// Curves, later ones on top.
    pub series: Vec<Series>,
}

/// An entry of the legend above the frames.
#[derive(Clone, Debug)]
pub struct Key {
    /// Text.
    pub label: String,
    /// Colour of the swatch.
    pub colour: String,
    /// Dash pattern of the swatch.
    pub dash: &'static str,
}

/// A figure of stacked frames.
#[derive(Clone, Debug, Default)]
pub struct Column {
    /// Label of the shared horizontal axis.
    pub x_label: String,
    /// Range of the shared horizontal axis.
    pub x_range: [f64; 2],
    /// Frames from top to bottom.
    pub charts: Vec<Chart>,
    /// Legend, in rows of `keys_per_row`.
    pub keys: Vec<Key>,
    /// Entries per row of the legend.
    pub keys_per_row: usize,
    /// Letters above the top frame at abscissas.
    pub marks: Vec<(f64, String)>,
}

/// A frame with its axes.
pub struct Frame {
    /// Inner box on the sheet.
    pub rect: Rect,
    x: Axis,
    y: Axis,
}

impl Frame {
    /// Position of a data point on the sheet.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.rect.left + self.x.share(x) * self.rect.width(), self.rect.bottom - self.y.share(y) * self.rect.height()]
    }
}

impl Column {
    /// The figure as SVG. Curves that find no free place for their direct label get a legend entry.
    pub fn draw(mut self) -> String {
        let frames = self.frames();
        let placed: Vec<_> = self.charts.iter().zip(&frames).map(|(chart, frame)| labels::place(chart, frame)).collect();
        let crowded = placed.iter().flatten().any(Option::is_none);
        if crowded && self.keys.is_empty() {
            self.move_labels_to_legend();
            return self.draw();
        }
        let last = frames.len() - 1;
        let mut canvas = Canvas::new(COLUMN, frames[last].rect.bottom + 25.0);
        self.draw_legend(&mut canvas);
        for (k, (chart, frame)) in self.charts.iter().zip(&frames).enumerate() {
            draw_frame(&mut canvas, frame, &chart.y_label, (k == last).then_some(self.x_label.as_str()));
            chart.draw_data(&mut canvas, frame);
            for (series, at) in chart.series.iter().zip(&placed[k]) {
                if let Some(at) = at.filter(|_| !series.label.is_empty()) {
                    canvas.styled_text(at, &series.label, Anchor::Middle, text::SIZE, &series.colour, 0.0);
                }
            }
        }
        self.draw_marks(&mut canvas, &frames[0]);
        canvas.finish()
    }

    /// Boxes of all frames: the widest tick label decides the common left margin.
    fn frames(&self) -> Vec<Frame> {
        let axes: Vec<Axis> =
            self.charts.iter().map(|chart| Axis::new(chart.y_range, (chart.height / 24.0).round() as usize)).collect();
        let labels = axes.iter().flat_map(|axis| &axis.labels).map(|label| text::width(label, SMALL));
        let left = 17.0 + TICK + labels.fold(8.0, f64::max);
        let rows = self.keys.len().div_ceil(self.keys_per_row.max(1));
        let power = axes.iter().any(|axis| axis.exponent != 0);
        let mut top = 5.0 + 10.0 * rows as f64 + if power || !self.marks.is_empty() { 7.0 } else { 0.0 };
        let mut frames = Vec::with_capacity(axes.len());
        for (chart, y) in self.charts.iter().zip(axes) {
            let rect = Rect { left, top, right: COLUMN - 6.0, bottom: top + chart.height };
            frames.push(Frame { rect, x: Axis::new(self.x_range, 6), y });
            top = rect.bottom + if power { GAP + 4.0 } else { GAP };
        }
        frames
    }

    fn move_labels_to_legend(&mut self) {
        for series in self.charts.iter_mut().flat_map(|chart| &mut chart.series) {
            let label = std::mem::take(&mut series.label);
            if !label.is_empty() {
                self.keys.push(Key { label, colour: series.colour.clone(), dash: series.dash });
            }
        }
        self.keys_per_row = 4;
    }

    fn draw_legend(&self, canvas: &mut Canvas) {
        let per_row = self.keys_per_row.max(1);
        let cell = (COLUMN - 24.0) / per_row as f64;
        for (k, key) in self.keys.iter().enumerate() {
            let (x, y) = (20.0 + cell * (k % per_row) as f64, 10.0 + 10.0 * (k / per_row) as f64);
            let stroke = Stroke { dash: key.dash, ..Stroke::solid(&key.colour, 1.6) };
            canvas.polyline(&[[x, y - 2.5], [x + 11.0, y - 2.5]], stroke);
            canvas.styled_text([x + 14.0, y], &key.label, Anchor::Start, SMALL, INK, 0.0);
        }
    }

    fn draw_marks(&self, canvas: &mut Canvas, frame: &Frame) {
        let Rect { top, left, right, .. } = frame.rect;
        for (value, letter) in &self.marks {
            let x = frame.place([*value, 0.0])[0];
            if (left - 0.5..=right + 0.5).contains(&x) {
                canvas.polyline(&[[x, top - 2.0], [x, top + 2.0]], Stroke::solid(GREY, 0.6));
                canvas.styled_text([x, top - 3.5], letter, Anchor::Middle, SMALL, GREY, 0.0);
            }
        }
    }
}

impl Chart {
    fn draw_data(&self, canvas: &mut Canvas, frame: &Frame) {
        canvas.clipped(frame.rect, |canvas| {
            for band in &self.bands {
                for run in band.edges.split(|edge| edge.iter().any(|value| !value.is_finite())) {
                    let lower = run.iter().map(|[x, low, _]| frame.place([*x, *low]));
                    let upper = run.iter().rev().map(|[x, _, high]| frame.place([*x, *high]));
                    canvas.fill_path(&path(&lower.chain(upper).collect::<Vec<_>>(), true), &band.colour, 1.0, false);
                }
            }
            for series in &self.series {
                let points: Vec<_> = series.points.iter().map(|point| frame.place(*point)).collect();
                canvas.polyline(&points, Stroke { dash: series.dash, ..Stroke::solid(&series.colour, series.width) });
            }
        });
    }
}

/// Grid, axes, ticks and labels; the horizontal axis is labelled where `x_label` is given.
fn draw_frame(canvas: &mut Canvas, frame: &Frame, y_label: &str, x_label: Option<&str>) {
    let Rect { left, top, right, bottom } = frame.rect;
    for (tick, label) in frame.x.ticks.iter().zip(&frame.x.labels) {
        let x = frame.place([*tick, 0.0])[0];
        canvas.polyline(&[[x, top], [x, bottom]], Stroke::solid(GRID, 0.4));
        canvas.polyline(&[[x, bottom], [x, bottom + TICK]], Stroke::solid(INK, 0.5));
        if x_label.is_some() {
            canvas.styled_text([x, bottom + TICK + 6.8], label, Anchor::Middle, SMALL, INK, 0.0);
        }
    }
    for (tick, label) in frame.y.ticks.iter().zip(&frame.y.labels) {
        let y = frame.place([0.0, *tick])[1];
        // Zero separates resistance from drive and load from release: the one grid line worth seeing.
        let line = if *tick == 0.0 { Stroke::solid(GREY, 0.5) } else { Stroke::solid(GRID, 0.4) };
        canvas.polyline(&[[left, y], [right, y]], line);
        canvas.polyline(&[[left - TICK, y], [left, y]], Stroke::solid(INK, 0.5));
        canvas.styled_text([left - TICK - 1.5, y + 2.5], label, Anchor::End, SMALL, INK, 0.0);
    }
    canvas.polyline(&[[left, top], [left, bottom], [right, bottom]], Stroke::solid(INK, 0.6));
    canvas.styled_text([left - 2.0, top - 3.5], &frame.y.power(), Anchor::End, SMALL, INK, 0.0);
    canvas.styled_text([8.5, 0.5 * (top + bottom)], y_label, Anchor::Middle, text::SIZE, INK, -90.0);
    if let Some(x_label) = x_label {
        let power = frame.x.power();
        let full = if power.is_empty() { x_label.to_owned() } else { format!("{x_label}  ({power})") };
        canvas.text([0.5 * (left + right), bottom + 20.5], &full, Anchor::Middle);
    }
}
