//! Colours that stay apart for colour-blind readers and in grey print, on a white ground.
//!
//! Lines: Okabe and Ito (2008). Order in time: viridis without its yellow end. Stress: Tol's YlOrBr, light = low.

/// Text, axes and outlines.
pub const INK: &str = "#222222";
/// Secondary text and thin marks.
pub const GREY: &str = "#6b6b6b";
/// Grid lines.
pub const GRID: &str = "#e3e3e3";
/// Blue of Okabe and Ito.
pub const BLUE: &str = "#0072b2";
/// Vermillion of Okabe and Ito.
pub const VERMILLION: &str = "#d55e00";
/// Bluish green of Okabe and Ito.
pub const GREEN: &str = "#007f5f";
/// Reddish purple of Okabe and Ito.
pub const PURPLE: &str = "#cc79a7";
/// Pale blue for areas behind lines.
pub const PALE_BLUE: &str = "#d3e5f1";

const TIME: [[u8; 3]; 6] = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 150, 136], [70, 165, 95], [110, 165, 30]];
const STRESS: [[u8; 3]; 9] = [
    [255, 255, 229],
    [255, 247, 188],
    [254, 227, 145],
    [254, 196, 79],
    [251, 154, 41],
    [236, 112, 20],
    [204, 76, 2],
    [153, 52, 4],
    [102, 37, 6],
];

/// Colour of instant `index` out of `count`, dark to light in the order of time.
pub fn time(index: usize, count: usize) -> String {
    interpolate(&TIME, if count < 2 { 0.0 } else { index as f64 / (count - 1) as f64 })
}

/// Colour of a stress level in `[0, 1]`.
pub fn stress(level: f64) -> String {
    interpolate(&STRESS, level)
}

fn interpolate(stops: &[[u8; 3]], level: f64) -> String {
    let position = level.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let below = (position as usize).min(stops.len() - 2);
    let share = position - below as f64;
    let mixed = [0, 1, 2].map(|c| {
        let (a, b) = (f64::from(stops[below][c]), f64::from(stops[below + 1][c]));
        (a + share * (b - a)).round() as u8
    });
    format!("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2])
}
