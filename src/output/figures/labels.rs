//! Places a direct label beside each curve where it covers no data and cannot be taken for another curve's.

use super::canvas::Rect;
use super::chart::{Chart, Series};
use super::frame::Frame;
use super::text;

/// Free space around a label in points.
const CLEAR: f64 = 2.2;
/// Spacing of the points that stand for a curve in distance checks.
const SPACING: f64 = 1.5;
/// A clearance beyond this is no further gain.
const AMPLE: f64 = 14.0;

/// Position (middle of the base line) of each curve's label; `None` where a wanted label finds no place.
/// Curves without label, or with nothing to see in the frame, need none and get an arbitrary position.
pub fn place(chart: &Chart, frame: &Frame) -> Vec<Option<[f64; 2]>> {
    let curves: Vec<Vec<[f64; 2]>> = chart.series.iter().map(|series| trace(series, frame)).collect();
    let mut taken: Vec<Rect> = Vec::new();
    let mut found = Vec::with_capacity(curves.len());
    for (own, series) in chart.series.iter().enumerate() {
        if series.label.is_empty() || curves[own].is_empty() {
            found.push(Some([f64::NAN; 2]));
            continue;
        }
        let best = candidates(&curves[own], &series.label)
            .filter_map(|label| Some((score(label, own, &curves, &taken, frame)?, label)))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        taken.extend(best.map(|(_, label)| label));
        found.push(best.map(|(_, label)| [0.5 * (label.left + label.right), label.bottom - 0.22 * text::SIZE]));
    }
    found
}

/// Points of a curve on the sheet at most [`SPACING`] apart, inside the frame only.
fn trace(series: &Series, frame: &Frame) -> Vec<[f64; 2]> {
    let points: Vec<_> = series.points.iter().map(|point| frame.place(*point)).collect();
    let mut dense = Vec::new();
    for pair in points.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        if !(dx.is_finite() && dy.is_finite()) {
            continue;
        }
        // A spike may leave the frame by far: no more points than could be seen.
        let pieces = (dx.hypot(dy) / SPACING).ceil().clamp(1.0, 400.0);
        dense.extend((0..=pieces as usize).map(|k| {
            let t = k as f64 / pieces;
            [pair[0][0] + t * dx, pair[0][1] + t * dy]
        }));
    }
    let Rect { left, top, right, bottom } = frame.rect;
    dense.retain(|[x, y]| (left..=right).contains(x) && (top..=bottom).contains(y));
    dense
}

/// Boxes of a label around points spread over its curve.
fn candidates(curve: &[[f64; 2]], label: &str) -> impl Iterator<Item = Rect> {
    let (half, rise) = (0.5 * text::width(label, text::SIZE), 0.5 * text::SIZE);
    let stride = (curve.len() / 120).max(1);
    let around = move |[x, y]: [f64; 2]| {
        let (aside, above) = (half + CLEAR + 1.5, rise + CLEAR + 1.0);
        [
            [0.0, -above],
            [0.0, above],
            [-aside, 0.0],
            [aside, 0.0],
            [-aside, -above],
            [aside, -above],
            [-aside, above],
            [aside, above],
        ]
        .map(|[dx, dy]| Rect {
            left: x + dx - half,
            top: y + dy - rise,
            right: x + dx + half,
            bottom: y + dy + rise,
        })
    };
    curve.iter().step_by(stride).flat_map(move |point| around(*point))
}

/// Clearance from everything else, `None` where the label would cover something or leave the frame.
fn score(label: Rect, own: usize, curves: &[Vec<[f64; 2]>], taken: &[Rect], frame: &Frame) -> Option<f64> {
    let inside = frame.rect.shrunk(1.0);
    if label.left < inside.left || label.right > inside.right || label.top < inside.top || label.bottom > inside.bottom
    {
        return None;
    }
    let to_curve =
        |curve: &Vec<[f64; 2]>| curve.iter().fold(f64::INFINITY, |near, point| near.min(outside(*point, label)));
    // The frame counts half: near it there is room, but a label should not lean on an axis.
    let edges =
        [label.left - inside.left, inside.right - label.right, label.top - inside.top, inside.bottom - label.bottom];
    let mut clearance = edges.into_iter().fold(AMPLE, |near, edge| near.min(2.0 * edge));
    for (k, curve) in curves.iter().enumerate() {
        let distance = to_curve(curve);
        if distance < CLEAR || (k != own && distance < 2.0 * CLEAR) {
            return None;
        }
        clearance = if k == own { clearance } else { clearance.min(distance) };
    }
    for other in taken {
        let distance = apart(*other, label);
        if distance < 2.0 * CLEAR {
            return None;
        }
        clearance = clearance.min(distance);
    }
    let zero = frame.place([0.0, 0.0])[1];
    let struck = if (label.top..label.bottom).contains(&zero) { 4.0 } else { 0.0 };
    // Among equally free places the one nearest to the own curve and not struck through by the zero line.
    Some(clearance - struck - 0.3 * to_curve(&curves[own]))
}

/// Distance of a point from a box, 0 inside.
fn outside([x, y]: [f64; 2], r: Rect) -> f64 {
    let (dx, dy) = ((r.left - x).max(x - r.right).max(0.0), (r.top - y).max(y - r.bottom).max(0.0));
    dx.hypot(dy)
}

/// Distance between two boxes, 0 where they overlap.
fn apart(a: Rect, b: Rect) -> f64 {
    let (dx, dy) =
        ((a.left - b.right).max(b.left - a.right).max(0.0), (a.top - b.bottom).max(b.top - a.bottom).max(0.0));
    dx.hypot(dy)
}
