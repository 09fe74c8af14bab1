//! Small multiples of the deformed bodies: von Mises stress, element edges, contact pressure and resultant.

use super::axis::round_step;
use super::canvas::{Anchor, Canvas, PER_MM, Precision, Rect, Stroke};
use super::palette::{GREY, INK};
use super::sampling::{Sampled, StressRow};
use super::{Instant, keys, overlay, palette};
use crate::model::{InterfaceRow, Record};
use crate::output::UnitLabels;
use crate::output::vtu::BodyField;

/// Width of the figure in points: two columns.
pub const WIDTH: f64 = 174.0 * PER_MM;
const GUTTER: f64 = 6.0;
const TITLE: f64 = 11.0;
const KEYS: f64 = 32.0;
/// Steps of the colour scale.
pub const LEVELS: usize = 40;
/// Lengths of the longest pressure ordinate and of the longest arrow as shares of the panel height.
const PRESSURE_SHARE: f64 = 0.16;
const FORCE_SHARE: f64 = 0.4;
/// A contact that stays within this share of the bodies is shown with surroundings of that many times its size each way.
const SMALL_CONTACT: f64 = 0.06;
const SURROUNDINGS: f64 = 3.0;

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
            title: format!("({}) {}", instant.letter, instant.label),
            record: record.clone(),
            interface,
            bodies: bodies.iter().map(Sampled::new).collect(),
        }
    }

    /// Samples the bodies for one picture of an animation: one cell an element.
    pub fn brief(record: &Record, bodies: &[BodyField], interface: Vec<InterfaceRow>) -> Self {
        let bodies = bodies.iter().map(Sampled::brief).collect();
        Self { title: String::new(), record: record.clone(), interface, bodies }
    }

    /// What was computed at this instant.
    pub fn record(&self) -> &Record {
        &self.record
    }
}

/// How much is drawn of a body.
#[derive(Clone, Copy, Debug)]
pub struct Detail {
    precision: Precision,
    levels: usize,
    mesh: bool,
}

impl Detail {
    /// For print.
    pub const FULL: Self = Self { precision: Precision::FINE, levels: LEVELS, mesh: true };
    /// For one of many pictures.
    pub const BRIEF: Self = Self { precision: Precision::COARSE, levels: LEVELS / 4, mesh: false };
}

/// Map from the plane of the scene to a panel.
pub struct View {
    origin: [f64; 2],
    corner: [f64; 2],
    scale: f64,
    detail: Detail,
}

impl View {
    /// The view of a part of the plane in a panel that is as wide; y upwards in the plane, so that its `top` is the smallest y.
    pub fn new(bounds: Rect, panel: Rect, detail: Detail) -> Self {
        let scale = panel.width() / bounds.width();
        Self { origin: [panel.left, panel.bottom], corner: [bounds.left, bounds.top], scale, detail }
    }

    /// Position on the sheet.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.scale * (x - self.corner[0]), self.origin[1] - self.scale * (y - self.corner[1])]
    }
}

/// Scales common to all panels.
pub struct Scales {
    /// Stress at the dark end of the colours.
    pub stress: f64,
    /// True if some stresses lie beyond it.
    pub exceeded: bool,
    /// Points per unit of pressure.
    pub pressure: f64,
    /// Points per unit of force.
    pub force: f64,
    /// Largest pressure of all panels.
    pub pressure_max: f64,
    /// Largest force of all panels.
    pub force_max: f64,
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
        let panel = Rect { left: inset, top, right: inset + scale * bounds.width(), bottom: top + panel_height };
        let view = View::new(bounds, panel, Detail::FULL);
        canvas.text([left, top - 2.0], &frame.title, Anchor::Start);
        canvas.clipped(panel, |canvas| frame.draw(canvas, &view, &scales));
    }
    keys::draw(&mut canvas, bottom + 8.0, scale, &scales, units);
    Some(canvas.finish())
}

/// The part of the plane that is shown (y upwards: `top` is the smallest y): the bodies, or the surroundings of a contact
/// that would hardly be seen on them.
pub fn bounds(frames: &[Frame]) -> Option<Rect> {
    let whole = extent(frames)?;
    let touching = || frames.iter().flat_map(|frame| &frame.interface).filter(|row| row.pressure > 0.0);
    let [left, right] = super::axis::range(touching().map(|row| row.x), 0.0);
    let [top, bottom] = super::axis::range(touching().map(|row| row.y), 0.0);
    let size = (right - left).max(bottom - top);
    if touching().next().is_none() || size > SMALL_CONTACT * whole.width().max(whole.height()) {
        return Some(whole);
    }
    let (x, y, reach) = (0.5 * (left + right), 0.5 * (top + bottom), SURROUNDINGS * size);
    Some(Rect {
        left: whole.left.max(x - reach),
        right: whole.right.min(x + reach),
        top: whole.top.max(y - 0.75 * reach),
        bottom: whole.bottom.min(y + 0.75 * reach),
    })
}

/// Smallest box around all frames, with a margin.
fn extent(frames: &[Frame]) -> Option<Rect> {
    let points = || frames.iter().flat_map(|frame| &frame.bodies).flat_map(Sampled::points);
    points().next()?;
    let [left, right] = super::axis::range(points().map(|p| p[0]), 0.01);
    let [top, bottom] = super::axis::range(points().map(|p| p[1]), 0.02);
    Some(Rect { left, top, right, bottom })
}

impl Scales {
    /// Scales of all frames in panels of the given height.
    pub fn new(frames: &[Frame], panel_height: f64) -> Self {
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
        let force_max =
            frames.iter().map(|frame| frame.record.force[0].hypot(frame.record.force[1])).fold(0.0, f64::max);
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
    /// Draws the bodies, the pressure and the resultant.
    pub fn draw(&self, canvas: &mut Canvas, view: &View, scales: &Scales) {
        for body in &self.bodies {
            draw_stress(canvas, view, &body.rows, scales.stress);
            let mesh: String = body.mesh.iter().map(|line| placed(view, line)).collect();
            if view.detail.mesh && !mesh.is_empty() {
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
    view.detail.precision.path(&line.iter().map(|point| view.place(*point)).collect::<Vec<_>>(), false)
}

/// Fills the cells, one path per colour; neighbours of one colour in a row are one polygon.
fn draw_stress(canvas: &mut Canvas, view: &View, rows: &[StressRow], largest: f64) {
    let Detail { precision, levels: count, .. } = view.detail;
    let level = |value: f64| (value / largest * count as f64).clamp(0.0, count as f64 - 1.0) as usize;
    let mut paths = vec![String::new(); count];
    for row in rows {
        let levels: Vec<usize> = row.values.iter().map(|value| level(*value)).collect();
        let mut start = 0;
        for run in levels.chunk_by(|a, b| a == b) {
            let end = start + run.len();
            let corners = row.lower[start..=end].iter().chain(row.upper[start..=end].iter().rev());
            let placed: Vec<_> = corners.map(|point| view.place(*point)).collect();
            paths[run[0]].push_str(&precision.path(&placed, true));
            start = end;
        }
    }
    for (level, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
        canvas.fill_path(path, &palette::stress((level as f64 + 0.5) / count as f64), 1.0, true);
    }
}
