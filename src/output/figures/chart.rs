//! Line charts: one or more frames stacked over a shared horizontal axis.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, PER_MM, Rect, Stroke, path};
use super::frame::{Frame, SMALL, TICK};
use super::palette::{GREY, INK};
use super::{labels, text};

/// Width of a single-column figure in points.
pub const COLUMN: f64 = 84.0 * PER_MM;
const GAP: f64 = 9.0;
const SWATCH: f64 = 11.0;
const KEYS_PER_ROW: usize = 3;
const KEY_CELL: f64 = (COLUMN - 18.0) / KEYS_PER_ROW as f64;

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
    /// Whether the points are marked.
    pub dots: bool,
}

impl Series {
    /// A solid curve of usual width.
    pub fn new(label: &str, colour: &str, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, colour: colour.into(), width: 1.2, dash: "", dots: false }
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
    /// Whether the ordinates are powers of ten, and so labelled.
    pub y_logarithmic: bool,
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
    /// Thickness of the swatch in points.
    pub width: f64,
}

/// A figure of stacked frames.
#[derive(Clone, Debug, Default)]
pub struct Column {
    /// Label of the shared horizontal axis.
    pub x_label: String,
    /// Range of the shared horizontal axis.
    pub x_range: [f64; 2],
    /// Whether the abscissas are powers of ten, and so labelled.
    pub x_logarithmic: bool,
    /// Frames from top to bottom.
    pub charts: Vec<Chart>,
    /// Legend above the frames.
    pub keys: Vec<Key>,
    /// Direct labels repeat the legend and may be dropped where they find no place.
    pub labels_repeat_keys: bool,
    /// Letters above the top frame at abscissas.
    pub marks: Vec<(f64, String)>,
}

impl Column {
    /// The figure as SVG. Curves that find no free place for their direct label get a legend entry.
    pub fn draw(mut self) -> String {
        let frames = self.frames();
        let placed: Vec<_> =
            self.charts.iter().zip(&frames).map(|(chart, frame)| labels::place(chart, frame)).collect();
        let crowded = placed.iter().flatten().any(Option::is_none);
        if crowded && !self.labels_repeat_keys {
            self.move_labels_to_legend();
            return self.draw();
        }
        let last = frames.len() - 1;
        let mut canvas = Canvas::new(COLUMN, frames[last].rect.bottom + 25.0);
        self.draw_legend(&mut canvas);
        for (k, (chart, frame)) in self.charts.iter().zip(&frames).enumerate() {
            frame.draw(&mut canvas, &chart.y_label, (k == last).then_some(self.x_label.as_str()));
            chart.draw_data(&mut canvas, frame);
            for (series, at) in chart.series.iter().zip(&placed[k]) {
                if let Some(at) = at.filter(|at| at[0].is_finite()) {
                    canvas.styled_text(at, &series.label, Anchor::Middle, text::SIZE, &series.colour, 0.0);
                }
            }
        }
        self.draw_marks(&mut canvas, &frames[0]);
        canvas.finish()
    }

    /// Boxes of all frames: the widest tick label decides the common left margin.
    fn frames(&self) -> Vec<Frame> {
        let axis = |chart: &Chart| match chart.y_logarithmic {
            true => Axis::decades(chart.y_range),
            false => Axis::new(chart.y_range, (chart.height / 24.0).round() as usize),
        };
        let axes: Vec<Axis> = self.charts.iter().map(axis).collect();
        let labels = axes.iter().flat_map(|axis| &axis.labels).map(|label| text::width(label, SMALL));
        let left = 17.0 + TICK + labels.fold(8.0, f64::max);
        let rows = self.key_cells().last().map_or(0, |cell| cell[1] + 1);
        let power = axes.iter().any(|axis| axis.exponent != 0);
        let above = if power || !self.marks.is_empty() { 7.0 } else { 0.0 };
        let legend = if rows > 0 { 2.0 + 10.0 * rows as f64 } else { 0.0 };
        let mut top = 5.0 + legend + above;
        let mut frames = Vec::with_capacity(axes.len());
        for (chart, y) in self.charts.iter().zip(axes) {
            let rect = Rect { left, top, right: COLUMN - 6.0, bottom: top + chart.height };
            frames.push(Frame { rect, x: self.x_axis(), y });
            top = rect.bottom + if power { GAP + 4.0 } else { GAP };
        }
        frames
    }

    fn x_axis(&self) -> Axis {
        if self.x_logarithmic { Axis::decades(self.x_range) } else { Axis::new(self.x_range, 6) }
    }

    fn move_labels_to_legend(&mut self) {
        for series in self.charts.iter_mut().flat_map(|chart| &mut chart.series) {
            let label = std::mem::take(&mut series.label);
            if !label.is_empty() {
                self.keys.push(Key { label, colour: series.colour.clone(), dash: series.dash, width: 1.6 });
            }
        }
    }

    /// Column and row of each legend entry in a grid of three columns; a long entry takes several.
    fn key_cells(&self) -> Vec<[usize; 2]> {
        let mut next = [0, 0];
        let place = |key: &Key| {
            let wanted = (SWATCH + 3.0 + text::width(&key.label, SMALL)) / KEY_CELL;
            let span = (wanted.ceil() as usize).clamp(1, KEYS_PER_ROW);
            if next[0] + span > KEYS_PER_ROW {
                next = [0, next[1] + 1];
            }
            let cell = next;
            next[0] += span;
            cell
        };
        self.keys.iter().map(place).collect()
    }

    fn draw_legend(&self, canvas: &mut Canvas) {
        for (key, [column, row]) in self.keys.iter().zip(self.key_cells()) {
            let (x, y) = (15.0 + KEY_CELL * column as f64, 10.0 + 10.0 * row as f64);
            let stroke = Stroke { dash: key.dash, ..Stroke::solid(&key.colour, key.width) };
            canvas.polyline(&[[x, y - 2.5], [x + SWATCH, y - 2.5]], stroke);
            canvas.styled_text([x + SWATCH + 3.0, y], &key.label, Anchor::Start, SMALL, INK, 0.0);
        }
    }

    fn draw_marks(&self, canvas: &mut Canvas, frame: &Frame) {
        let top = frame.rect.top;
        let mut marks: Vec<(f64, &str)> =
            self.marks.iter().map(|(value, letter)| (frame.place([*value, 0.0])[0], letter.as_str())).collect();
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let letters = spread(marks.iter().map(|mark| mark.0).collect());
        for ((x, letter), at) in marks.into_iter().zip(letters) {
            canvas.polyline(&[[x, top - 2.0], [x, top + 2.0]], Stroke::solid(GREY, 0.6));
            canvas.styled_text([at, top - 3.5], letter, Anchor::Middle, SMALL, GREY, 0.0);
        }
    }
}

/// Moves ascending positions apart, half each, until letters there do not touch.
fn spread(mut positions: Vec<f64>) -> Vec<f64> {
    for _ in 0..20 {
        for k in 1..positions.len() {
            let lack = (6.5 - (positions[k] - positions[k - 1])).max(0.0);
            positions[k - 1] -= 0.5 * lack;
            positions[k] += 0.5 * lack;
        }
    }
    positions
}

impl Chart {
    fn draw_data(&self, canvas: &mut Canvas, frame: &Frame) {
        canvas.clipped(frame.rect, |canvas| {
            for band in &self.bands {
                let broken = |edge: &[f64; 3]| edge.iter().any(|value| !value.is_finite());
                for run in band.edges.split(broken).filter(|run| run.len() > 1) {
                    let lower = run.iter().map(|[x, low, _]| frame.place([*x, *low]));
                    let upper = run.iter().rev().map(|[x, _, high]| frame.place([*x, *high]));
                    canvas.fill_path(&path(&lower.chain(upper).collect::<Vec<_>>(), true), &band.colour, 1.0, false);
                }
            }
            for series in &self.series {
                let points: Vec<_> = series.points.iter().map(|point| frame.place(*point)).collect();
                canvas.polyline(&points, Stroke { dash: series.dash, ..Stroke::solid(&series.colour, series.width) });
                for point in points.into_iter().filter(|point| series.dots && point.iter().all(|c| c.is_finite())) {
                    canvas.dot(point, 1.1 + 0.4 * series.width, &series.colour);
                }
            }
        });
    }
}
