//! The bodies sliding, with the forces below: one SVG that moves by itself in a browser (CSS, no script).
//!
//! Every picture is a group of class `asperity-frame` that is visible for its share of the time; a page may take over by switching
//! the groups itself (see the player of the report). Who prefers less motion, or prints, sees the picture of the largest force.

use super::axis::{Axis, range};
use super::bodies::{Detail, Frame, Scales, View, WIDTH, bounds};
use super::canvas::{Anchor, Canvas, Rect, Stroke};
use super::palette::{BLUE, GREY, VERMILLION};
use super::{abscissa, frame, keys};
use crate::model::Record;
use crate::output::UnitLabels;

/// Most pictures, and seconds for each.
const MOST: usize = 60;
const SECONDS: f64 = 0.12;
/// Heights of the chart and of the keys in points.
const CHART: f64 = 84.0;
const KEYS: f64 = 40.0;
const MARGIN: f64 = 6.0;

/// Rows of the history worth a picture: at most 60 converged ones, evenly spaced over the part that the charts show.
pub fn film(records: &[Record]) -> Vec<usize> {
    let x = abscissa(records, &UnitLabels::default());
    let [low, high] = x.contact_range(records);
    let shown = |k: &usize| records[*k].converged && (low..=high).contains(&x.values[*k]);
    let shown: Vec<usize> = (0..records.len()).filter(shown).collect();
    let stride = shown.len().div_ceil(MOST).max(1);
    shown.into_iter().step_by(stride).collect()
}

/// The animation; `None` for fewer than two frames.
pub fn svg(records: &[Record], frames: &[Frame], units: &UnitLabels) -> Option<String> {
    let bounds = bounds(frames).filter(|_| frames.len() > 1)?;
    let scale = ((WIDTH - 2.0 * MARGIN) / bounds.width()).min(0.6 * WIDTH / bounds.height());
    let (width, height) = (scale * bounds.width(), scale * bounds.height());
    let left = 0.5 * (WIDTH - width);
    let panel = Rect { left, top: MARGIN, right: left + width, bottom: MARGIN + height };
    let scales = Scales::new(frames, height);
    let view = View::new(bounds, panel, Detail::BRIEF);
    let x = abscissa(records, units);
    let top = panel.bottom + KEYS + 14.0;
    let chart = frame::Frame {
        rect: Rect { left: 44.0, top, right: WIDTH - MARGIN, bottom: top + CHART },
        x: Axis::new(x.contact_range(records), 8),
        y: Axis::new(range(records.iter().flat_map(|record| record.force).chain([0.0]), 0.08), 4),
    };
    let mut canvas = Canvas::new(WIDTH, chart.rect.bottom + 25.0);
    canvas.style(&css(frames.len()));
    keys::draw(&mut canvas, panel.bottom + 6.0, scale, &scales, units);
    draw_forces(&mut canvas, &chart, &x, records, units);
    let still = largest(frames);
    for (k, one) in frames.iter().enumerate() {
        let class = if k == still { "asperity-frame asperity-still" } else { "asperity-frame" };
        let delay = format!("class=\"{class}\" style=\"animation-delay:{:.2}s\"", SECONDS * k as f64);
        canvas.group(&delay, |canvas| {
            canvas.clipped(panel, |canvas| one.draw(canvas, &view, &scales));
            if let Some(index) = records.iter().position(|record| record.step == one.record().step) {
                draw_now(canvas, &chart, x.values[index], one.record());
            }
        });
    }
    Some(canvas.finish())
}

/// Each group is visible for its share of the time.
fn css(count: usize) -> String {
    let (all, share) = (SECONDS * count as f64, 100.0 / count as f64);
    format!(
        ".asperity-frame{{visibility:hidden;animation:asperity-frame {all:.2}s step-end infinite}}\
         @keyframes asperity-frame{{0%{{visibility:visible}}{share:.4}%{{visibility:hidden}}}}\
         @media print,(prefers-reduced-motion:reduce){{.asperity-frame{{animation:none}}.asperity-still{{visibility:visible}}}}"
    )
}

/// The frame of the largest resultant.
fn largest(frames: &[Frame]) -> usize {
    let size = |frame: &Frame| frame.record().force[0].hypot(frame.record().force[1]);
    (0..frames.len()).max_by(|a, b| size(&frames[*a]).total_cmp(&size(&frames[*b]))).unwrap_or(0)
}

fn draw_forces(canvas: &mut Canvas, chart: &frame::Frame, x: &super::Abscissa, records: &[Record], units: &UnitLabels) {
    chart.draw(canvas, &units.axis("force *F*", crate::output::Quantity::Force), Some(&x.label));
    for (component, name, colour, dash) in [(0, "*F*_x", VERMILLION, "5 1.6"), (1, "*F*_y", BLUE, "")] {
        let force = |record: &Record| if record.converged { record.force[component] } else { f64::NAN };
        let points: Vec<_> = x.values.iter().zip(records).map(|(x, r)| chart.place([*x, force(r)])).collect();
        canvas.clipped(chart.rect, |canvas| canvas.polyline(&points, Stroke { dash, ..Stroke::solid(colour, 1.2) }));
        let at = [chart.rect.left + 10.0 + 30.0 * component as f64, chart.rect.top + 4.0];
        canvas.styled_text(at, name, Anchor::Start, super::text::SIZE, colour, 0.0);
    }
}

/// Where the chart is at one picture.
fn draw_now(canvas: &mut Canvas, chart: &frame::Frame, x: f64, record: &Record) {
    let Rect { top, bottom, .. } = chart.rect;
    let at = chart.place([x, 0.0])[0];
    canvas.polyline(&[[at, top], [at, bottom]], Stroke::solid(GREY, 0.6));
    for (component, colour) in [(0, VERMILLION), (1, BLUE)] {
        canvas.dot(chart.place([x, record.force[component]]), 2.2, colour);
    }
}
