//! What is drawn over the bodies: contact pressure as a band normal to the interface, and the resultant as an arrow.

use super::bodies::View;
use super::canvas::{Canvas, Stroke, path};
use super::palette::{BLUE, INK};
use crate::model::{InterfaceRow, Record};

/// Least distance of two pressure ordinates in points.
const ORDINATE_GAP: f64 = 1.6;

/// The pressure band: from each point in contact along the normal into the driven body, `scale` points per stress.
pub fn pressure_band(canvas: &mut Canvas, view: &View, rows: &[InterfaceRow], scale: f64) {
    for run in contact_runs(rows) {
        let base: Vec<[f64; 2]> = run.iter().map(|row| view.place([row.x, row.y])).collect();
        let tips: Vec<[f64; 2]> = run.iter().zip(&base).map(|(row, at)| tip(row, *at, scale)).collect();
        hatched(canvas, &base, &tips);
    }
}

/// A pressure diagram over `base`: white veil, ordinates at least [`ORDINATE_GAP`] apart, outline.
pub fn hatched(canvas: &mut Canvas, base: &[[f64; 2]], tips: &[[f64; 2]]) {
    let band: Vec<_> = base.iter().chain(tips.iter().rev()).copied().collect();
    canvas.fill_path(&path(&band, true), "#ffffff", 0.6, false);
    let mut last: Option<[f64; 2]> = None;
    let mut ordinates = String::new();
    for (foot, tip) in base.iter().zip(tips) {
        if last.is_none_or(|last| (foot[0] - last[0]).hypot(foot[1] - last[1]) >= ORDINATE_GAP) {
            ordinates.push_str(&path(&[*foot, *tip], false));
            last = Some(*foot);
        }
    }
    canvas.stroke_path(&ordinates, Stroke::solid(BLUE, 0.35));
    canvas.stroke_path(&path(&band, true), Stroke::solid(BLUE, 0.8));
}

fn tip(row: &InterfaceRow, [x, y]: [f64; 2], scale: f64) -> [f64; 2] {
    if row.pressure <= 0.0 {
        return [x, y]; // a row without a partner has no normal
    }
    [x + scale * row.pressure * row.normal[0], y - scale * row.pressure * row.normal[1]]
}

/// Neighbouring rows of one pair with pressure, with an open row at each end so that the band closes.
fn contact_runs(rows: &[InterfaceRow]) -> Vec<Vec<&InterfaceRow>> {
    let mut sorted: Vec<&InterfaceRow> = rows.iter().collect();
    sorted.sort_by(|a, b| a.pair.cmp(&b.pair).then(a.arc.total_cmp(&b.arc)));
    let together = |a: &&InterfaceRow, b: &&InterfaceRow| a.pair == b.pair && (a.pressure > 0.0 || b.pressure > 0.0);
    let runs = sorted.chunk_by(together).filter(|run| run.iter().any(|row| row.pressure > 0.0));
    runs.map(<[&InterfaceRow]>::to_vec).collect()
}

/// Force of the interface on the driven body, drawn from the centre of pressure, `scale` points per force.
pub fn resultant(canvas: &mut Canvas, view: &View, record: &Record, rows: &[InterfaceRow], scale: f64) {
    let load = |row: &InterfaceRow| row.weight * row.pressure;
    // Rows without a partner have no normal, and must not even be multiplied by zero.
    let loaded: Vec<&InterfaceRow> = rows.iter().filter(|row| load(row) > 0.0).collect();
    let total: f64 = loaded.iter().copied().map(load).sum();
    if loaded.is_empty() {
        return;
    }
    let mean =
        |value: &dyn Fn(&InterfaceRow) -> f64| loaded.iter().map(|row| load(row) * value(row)).sum::<f64>() / total;
    let from = view.place([mean(&|row| row.x), mean(&|row| row.y)]);
    // Support is positive along the mean normal, whether the driven body lies above or below; resistance is against +x.
    let up = mean(&|row| row.normal[1]).signum();
    arrow(canvas, from, [-scale * record.force[0], -scale * up * record.force[1]]);
}

/// An arrow with white halo, from a point along a vector on the sheet.
pub fn arrow(canvas: &mut Canvas, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    let length = dx.hypot(dy);
    // Shorter than its own head it would be a dot of no direction.
    if length < 3.0 {
        return;
    }
    let (ex, ey) = (dx / length, dy / length);
    let head = (0.4 * length).min(4.2);
    let neck = [x + dx - head * ex, y + dy - head * ey];
    let wing = |side: f64| [neck[0] - side * 0.38 * head * ey, neck[1] + side * 0.38 * head * ex];
    let triangle = path(&[[x + dx, y + dy], wing(1.0), wing(-1.0)], true);
    canvas.polyline(&[[x, y], neck], Stroke::solid("#ffffff", 2.4));
    canvas.stroke_path(&triangle, Stroke::solid("#ffffff", 1.2));
    canvas.polyline(&[[x, y], neck], Stroke::solid(INK, 1.2));
    canvas.fill_path(&triangle, INK, 1.0, false);
}
