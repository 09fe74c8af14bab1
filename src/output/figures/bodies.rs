//! Small multiples of the deformed bodies: von Mises stress, element edges, contact pressure and resultant.

use super::axis::{label, round_step};
use super::canvas::{Anchor, Canvas, PER_MM, Rect, Stroke, path};
use super::palette::{GREY, INK};
use super::sampling::{Sampled, StressRow};
use super::{Instant, overlay, palette, text};
use crate::model::{InterfaceRow, Record};
use crate::output::vtu::BodyField;
use crate::output::{Quantity, UnitLabels};

/// Width of the figure in points: two columns.
const WIDTH: f64 = 174.0 * PER_MM;
const GUTTER: f64 = 6.0;
const TITLE: f64 = 11.0;
const KEYS: f64 = 32.0;
/// Steps of the colour scale.
const LEVELS: usize = 40;
/// Lengths of the longest pressure ordinate and of the longest arrow as shares of the panel height.
const PRESSURE_SHARE: f64 = 0.16;
const FORCE_SHARE: f64 = 0.4;

/// One panel, sampled.
#[derive(Clone, Debug)]
pub struct Frame {
    title: String,
    record: Record,
    interface: Vec<InterfaceRow>,
    bodies: Vec<Sampled>,
}

impl Frame {
    /// Samples the bodies at an instant; `interface` holds the rows of that step.
    pub fn sample(instant: &Instant, record: &Record, bodies: &[BodyField], interface: Vec<InterfaceRow>) -> Self {
        Self {
            title: format!("({})  {}", instant.letter, instant.label),
            record: record.clone(),
            interface,
            bodies: bodies.iter().map(Sampled::new).collect(),
        }
    }
}

/// Map from the plane of the scene to a panel.
pub struct View {
    origin: [f64; 2],
    corner: [f64; 2],
    scale: f64,
}

impl View {
    /// Position on the sheet.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.scale * (x - self.corner[0]), self.origin[1] - self.scale * (y - self.corner[1])]
    }
}

/// Scales common to all panels.
struct Scales {
    stress: f64,
    exceeded: bool,
    pressure: f64,
    force: f64,
    pressure_max: f64,
    force_max: f64,
}

/// The figure, or nothing without frames.
pub fn svg(frames: &[Frame], units: &UnitLabels) -> Option<String> {
    let bounds = bounds(frames)?;
    let columns = if frames.len() > 4 { 3 } else { frames.len().min(2) };
    let panel_width = (WIDTH - GUTTER * (columns + 1) as f64) / columns as f64;
    // A tall scene is made narrower rather than taller than a page.
    let scale = (panel_width / bounds.width()).min(0.9 * WIDTH / bounds.height());
    let panel_height = scale * bounds.height();
    let scales = Scales::new(frames, panel_height);
    let rows = frames.len().div_ceil(columns);
    let bottom = rows as f64 * (panel_height + TITLE + GUTTER);
    let mut canvas = Canvas::new(WIDTH, bottom + KEYS + 8.0);
    for (k, frame) in frames.iter().enumerate() {
        let left = GUTTER + (k % columns) as f64 * (panel_width + GUTTER);
        let top = (k / columns) as f64 * (panel_height + TITLE + GUTTER) + TITLE;
        let inset = left + 0.5 * (panel_width - scale * bounds.width());
        let view = View { origin: [inset, top + panel_height], corner: [bounds.left, bounds.top], scale };
        canvas.text([left, top - 2.0], &frame.title, Anchor::Start);
        frame.draw(&mut canvas, &view, &scales);
    }
    draw_keys(&mut canvas, bottom + 8.0, scale, &scales, units);
    Some(canvas.finish())
}

/// Smallest box (y upwards: `top` is the smallest y) around all frames, with a margin.
fn bounds(frames: &[Frame]) -> Option<Rect> {
    let points = || frames.iter().flat_map(|frame| &frame.bodies).flat_map(Sampled::points);
    points().next()?;
    let [left, right] = super::axis::range(points().map(|p| p[0]), 0.01);
    let [top, bottom] = super::axis::range(points().map(|p| p[1]), 0.02);
    Some(Rect { left, top, right, bottom })
}

impl Scales {
    fn new(frames: &[Frame], panel_height: f64) -> Self {
        let mut values: Vec<f64> = frames
            .iter()
            .flat_map(|frame| frame.bodies.iter().flat_map(|body| &body.rows))
            .flat_map(|row| row.values.iter().copied())
            .filter(|value| value.is_finite())
            .collect();
        values.sort_unstable_by(f64::total_cmp);
        // Corners of a clamped edge are singular: the last half percent would darken nothing but themselves.
        let high = values.get(values.len().saturating_sub(1 + values.len() / 200)).copied().unwrap_or(0.0);
        let stress = if high > 0.0 { round_up(high) } else { 1.0 };
        let pressures = frames.iter().flat_map(|frame| &frame.interface).map(|row| row.pressure);
        let pressure_max = pressures.fold(0.0, f64::max);
        let force_max = frames.iter().map(|frame| frame.record.force[0].hypot(frame.record.force[1])).fold(0.0, f64::max);
        Self {
            stress,
            exceeded: values.last().is_some_and(|last| *last > stress),
            pressure: PRESSURE_SHARE * panel_height / if pressure_max > 0.0 { pressure_max } else { 1.0 },
            force: FORCE_SHARE * panel_height / if force_max > 0.0 { force_max } else { 1.0 },
            pressure_max,
            force_max,
        }
    }
}

/// The next number with one and a half digits.
fn round_up(value: f64) -> f64 {
    let step = round_step(value / 5.0);
    (value / step - 1e-9).ceil() * step
}

impl Frame {
    fn draw(&self, canvas: &mut Canvas, view: &View, scales: &Scales) {
        for body in &self.bodies {
            draw_stress(canvas, view, &body.rows, scales.stress);
            let mesh: String = body.mesh.iter().map(|line| placed(view, line)).collect();
            if !mesh.is_empty() {
                canvas.stroke_path(&mesh, Stroke { opacity: 0.35, ..Stroke::solid(GREY, 0.15) });
            }
            let outline: String = body.outline.iter().map(|line| placed(view, line)).collect();
            canvas.stroke_path(&outline, Stroke::solid(INK, if body.rigid { 1.2 } else { 0.5 }));
        }
        overlay::pressure_band(canvas, view, &self.interface, scales.pressure);
        overlay::resultant(canvas, view, &self.record, &self.interface, scales.force);
    }
}

fn placed(view: &View, line: &[[f64; 2]]) -> String {
    path(&line.iter().map(|point| view.place(*point)).collect::<Vec<_>>(), false)
}

/// Fills the cells, one path per colour; neighbours of one colour in a row are one polygon.
fn draw_stress(canvas: &mut Canvas, view: &View, rows: &[StressRow], largest: f64) {
    let level = |value: f64| (value / largest * LEVELS as f64).clamp(0.0, LEVELS as f64 - 1.0) as usize;
    let mut paths = vec![String::new(); LEVELS];
    for row in rows {
        let levels: Vec<usize> = row.values.iter().map(|value| level(*value)).collect();
        let mut start = 0;
        for run in levels.chunk_by(|a, b| a == b) {
            let end = start + run.len();
            let corners = row.lower[start..=end].iter().chain(row.upper[start..=end].iter().rev());
            paths[run[0]].push_str(&path(&corners.map(|point| view.place(*point)).collect::<Vec<_>>(), true));
            start = end;
        }
    }
    for (level, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
        canvas.fill_path(path, &palette::stress((level as f64 + 0.5) / LEVELS as f64), 1.0, true);
    }
}

/// Colour bar, scale bar, and the keys of band and arrow, in one line below the panels.
fn draw_keys(canvas: &mut Canvas, top: f64, scale: f64, scales: &Scales, units: &UnitLabels) {
    colour_bar(canvas, Rect { left: 14.0, top, right: 174.0, bottom: top + 7.0 }, scales, units);
    let middle = top + 5.0;
    let length = round_step(0.4 * 60.0 / scale);
    let mut x = 200.0;
    canvas.polyline(&[[x, middle], [x + scale * length, middle]], Stroke::solid(INK, 1.6));
    x += scale * length + 5.0;
    x = key(canvas, [x, middle], &value(length, &units.length)) + 20.0;
    if scales.pressure_max > 0.0 {
        let height = scales.pressure * scales.pressure_max;
        canvas.fill_path(&path(&[[x, middle + 3.0], [x + 7.0, middle + 3.0], [x + 7.0, middle + 3.0 - height.min(20.0)], [x, middle + 3.0 - height.min(20.0)]], true), palette::BLUE, 0.45, false);
        let text = format!("contact pressure, max {}", value(three_digits(scales.pressure_max), &units.stress));
        x = key(canvas, [x + 12.0, middle], &text) + 20.0;
    }
    if scales.force_max > 0.0 {
        overlay::arrow(canvas, [x, middle], [18.0, 0.0]);
        let text = format!("force on the driven body, max {}", value(three_digits(scales.force_max), &units.label(Quantity::Force)));
        key(canvas, [x + 23.0, middle], &text);
    }
}

fn key(canvas: &mut Canvas, [x, y]: [f64; 2], markup: &str) -> f64 {
    canvas.text([x, y + 2.6], markup, Anchor::Start);
    x + text::width(markup, text::SIZE)
}

fn three_digits(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - 2.0);
    (value / unit).round() * unit
}

/// A number with its unit; powers of ten where plain digits would be many.
fn value(number: f64, unit: &str) -> String {
    let exponent = number.abs().log10().floor();
    let (mantissa, power) = match exponent as i32 {
        e @ -3..=3 => (number, if e < -3 { e } else { 0 }),
        e => (number / 10.0_f64.powi(e), e),
    };
    let digits = (2.0 - mantissa.abs().log10().floor()).clamp(0.0, 5.0) as usize;
    let text = label(mantissa, digits);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let power = if power == 0 { String::new() } else { format!("×10^{{{}}}", label(f64::from(power), 0)) };
    format!("{text}{power} {unit}").trim_end().to_owned()
}

fn colour_bar(canvas: &mut Canvas, bar: Rect, scales: &Scales, units: &UnitLabels) {
    let cell = bar.width() / LEVELS as f64;
    let rectangle = |left: f64, right: f64| path(&[[left, bar.top], [right, bar.top], [right, bar.bottom], [left, bar.bottom]], true);
    for level in 0..LEVELS {
        let left = bar.left + cell * level as f64;
        canvas.fill_path(&rectangle(left, left + cell), &palette::stress((level as f64 + 0.5) / LEVELS as f64), 1.0, true);
    }
    if scales.exceeded {
        let tip = [bar.right + 6.0, 0.5 * (bar.top + bar.bottom)];
        canvas.fill_path(&path(&[[bar.right, bar.top], tip, [bar.right, bar.bottom]], true), &palette::stress(1.0), 1.0, false);
    }
    canvas.stroke_path(&rectangle(bar.left, bar.right), Stroke::solid(INK, 0.4));
    let axis = super::axis::Axis::new([0.0, scales.stress], 5);
    for (tick, name) in axis.ticks.iter().zip(&axis.labels) {
        let x = bar.left + axis.share(*tick) * bar.width();
        canvas.polyline(&[[x, bar.bottom], [x, bar.bottom + 2.0]], Stroke::solid(INK, 0.4));
        canvas.styled_text([x, bar.bottom + 8.5], name, Anchor::Middle, 6.8, INK, 0.0);
    }
    let power = if axis.exponent == 0 { String::new() } else { format!("  ({})", axis.power()) };
    let name = format!("{}{power}", units.axis("von Mises stress", Quantity::Stress));
    canvas.text([0.5 * (bar.left + bar.right), bar.bottom + 18.5], &name, Anchor::Middle);
}
