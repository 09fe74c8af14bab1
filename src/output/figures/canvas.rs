//! A sheet of SVG in points (1/72 inch), origin top left, and the few marks that figures are made of.

use std::fmt::Write;

use super::palette::INK;
use super::text;
use crate::output::fingerprint;

/// Points per millimetre.
pub const PER_MM: f64 = 72.0 / 25.4;
/// How exactly paths are written.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// Corners of a line leave it by less than this (in points) to be dropped.
    flat: f64,
    decimals: usize,
}

impl Precision {
    /// For print.
    pub const FINE: Self = Self { flat: 0.03, decimals: 2 };
    /// For pictures that are shown for a moment.
    pub const COARSE: Self = Self { flat: 0.15, decimals: 1 };

    /// SVG path through points, corners that do not show dropped.
    pub fn path(self, points: &[[f64; 2]], closed: bool) -> String {
        let mut text = String::new();
        for (k, [x, y]) in self.visible(points).into_iter().enumerate() {
            let _ = write!(text, "{}{x:.d$} {y:.d$}", if k == 0 { "M" } else { "L" }, d = self.decimals);
        }
        if closed {
            text.push('Z');
        }
        text
    }

    /// Drops points that lie on the line from the last kept point to their successor.
    fn visible(self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut kept: Vec<[f64; 2]> = Vec::with_capacity(points.len());
        let mut pending: Vec<[f64; 2]> = Vec::new();
        for &point in points {
            if let Some(&start) = kept.last()
                && pending.iter().all(|middle| distance(*middle, start, point) < self.flat)
            {
                pending.push(point);
                continue;
            }
            kept.extend(pending.pop());
            pending.clear();
            if kept.is_empty() { kept.push(point) } else { pending.push(point) }
        }
        kept.extend(pending.pop());
        kept
    }
}

/// Stands for the prefix of ids until the whole figure is known.
const CLIP: &str = "@clip-";

/// An axis-parallel box: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Smallest x.
    pub left: f64,
    /// Smallest y.
    pub top: f64,
    /// Largest x.
    pub right: f64,
    /// Largest y.
    pub bottom: f64,
}

impl Rect {
    /// Extent in x.
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Extent in y.
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The box moved inwards by `margin` on all sides.
    pub fn shrunk(&self, margin: f64) -> Self {
        Self {
            left: self.left + margin,
            top: self.top + margin,
            right: self.right - margin,
            bottom: self.bottom - margin,
        }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Stroke<'a> {
    /// Colour.
    pub colour: &'a str,
    /// Width in points.
    pub width: f64,
    /// Dash pattern in points, empty for a solid line.
    pub dash: &'a str,
    /// Opacity.
    pub opacity: f64,
}

impl<'a> Stroke<'a> {
    /// A solid, opaque line.
    pub fn solid(colour: &'a str, width: f64) -> Self {
        Self { colour, width, dash: "", opacity: 1.0 }
    }
}

/// Which part of a text stands at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A growing SVG document.
#[derive(Clone, Debug)]
pub struct Canvas {
    size: [f64; 2],
    body: String,
    clips: usize,
}

impl Canvas {
    /// An empty white sheet of the given size in points.
    pub fn new(width: f64, height: f64) -> Self {
        Self { size: [width, height], body: String::new(), clips: 0 }
    }

    /// A line through points; NaN interrupts it.
    pub fn polyline(&mut self, points: &[[f64; 2]], stroke: Stroke) {
        for run in points.split(|p| !(p[0].is_finite() && p[1].is_finite())).filter(|run| run.len() > 1) {
            let path = path(run, false);
            self.stroke_path(&path, stroke);
        }
    }

    /// Strokes a path given in SVG syntax.
    pub fn stroke_path(&mut self, path: &str, stroke: Stroke) {
        let Stroke { colour, width, dash, opacity } = stroke;
        let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        let opacity = if opacity < 1.0 { format!(" stroke-opacity=\"{opacity}\"") } else { String::new() };
        let _ = writeln!(
            self.body,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{dash}{opacity}/>"
        );
    }

    /// A filled circle.
    pub fn dot(&mut self, [x, y]: [f64; 2], radius: f64, colour: &str) {
        let _ = writeln!(self.body, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"{colour}\"/>");
    }

    /// Fills a path given in SVG syntax. `seamless` leaves no seams between neighbours that share an edge.
    pub fn fill_path(&mut self, path: &str, colour: &str, opacity: f64, seamless: bool) {
        let crisp = match seamless {
            true => format!(" stroke=\"{colour}\" stroke-width=\"0.3\" shape-rendering=\"crispEdges\""),
            false => String::new(),
        };
        let opacity = if opacity < 1.0 { format!(" fill-opacity=\"{opacity}\"") } else { String::new() };
        let _ = writeln!(self.body, "<path d=\"{path}\" fill=\"{colour}\"{opacity}{crisp}/>");
    }

    /// Marked-up text (see [`super::text`]) in ink colour at the running size.
    pub fn text(&mut self, at: [f64; 2], markup: &str, anchor: Anchor) {
        self.styled_text(at, markup, anchor, text::SIZE, INK, 0.0);
    }

    /// Marked-up text with size, colour and rotation in degrees (clockwise).
    pub fn styled_text(&mut self, [x, y]: [f64; 2], markup: &str, anchor: Anchor, size: f64, colour: &str, turn: f64) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = if turn == 0.0 { String::new() } else { format!(" transform=\"rotate({turn} {x:.2} {y:.2})\"") };
        let spans = text::spans(markup, size);
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\" fill=\"{colour}\" text-anchor=\"{anchor}\"{turn}>{spans}</text>"
        );
    }

    /// Restricts what `draw` adds to a box.
    pub fn clipped(&mut self, frame: Rect, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let id = self.clips;
        let (Rect { left, top, .. }, width, height) = (frame, frame.width(), frame.height());
        let _ = writeln!(
            self.body,
            "<clipPath id=\"{CLIP}{id}\"><rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/></clipPath>\n<g clip-path=\"url(#{CLIP}{id})\">"
        );
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// What `draw` adds as one group with the given attributes.
    pub fn group(&mut self, attributes: &str, draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.body, "<g {attributes}>");
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// Rules of CSS for the whole document.
    pub fn style(&mut self, css: &str) {
        let _ = writeln!(self.body, "<style>{css}</style>");
    }

    /// The complete document.
    pub fn finish(self) -> String {
        let [width, height] = self.size;
        let [wide, high] = self.size.map(|points| points / PER_MM);
        // ids must be unique where several figures stand in one HTML page
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{wide:.2}mm\" height=\"{high:.2}mm\" viewBox=\"0 0 {width:.2} {height:.2}\" font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body.replace(CLIP, &format!("c{:x}-", fingerprint(&self.body)))
        )
    }
}

/// SVG path through points, for print.
pub fn path(points: &[[f64; 2]], closed: bool) -> String {
    Precision::FINE.path(points, closed)
}

/// Distance of a point from a segment.
pub fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (d, r) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = d[0] * d[0] + d[1] * d[1];
    let t = if length > 0.0 { ((r[0] * d[0] + r[1] * d[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    (r[0] - t * d[0]).hypot(r[1] - t * d[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_runs_lose_their_middle_points_only() {
        let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [3.0, 2.0], [3.0, 4.0]];
        assert_eq!(path(&line, false), "M0.00 0.00L3.00 0.00L3.00 4.00");
        let bend: Vec<_> = (0..=20).map(|k| [f64::from(k), f64::from(k * k) / 20.0]).collect();
        assert!(Precision::FINE.visible(&bend).len() > 10);
    }

    #[test]
    fn a_line_that_turns_back_keeps_its_turning_point() {
        assert_eq!(Precision::FINE.visible(&[[0.0, 0.0], [5.0, 0.0], [1.0, 0.0]]).len(), 3);
    }
}
