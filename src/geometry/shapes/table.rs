//! Profiles given by points: reading a file, and the curves through the points.

use std::path::Path;

use crate::geometry::GeometryError;

/// Monotone piecewise cubic through points (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 1984, 300-304): slopes
/// are weighted harmonic means of the neighbouring secants, and 0 where these change sign, so peaks stay on points.
/// Constant beyond the ends.
#[derive(Clone, Debug)]
pub(super) struct Monotone {
    points: Vec<[f64; 2]>,
    slopes: Vec<f64>,
}

impl Monotone {
    /// Curve through at least two points with increasing x.
    pub(super) fn new(points: &[[f64; 2]]) -> Self {
        let secants: Vec<[f64; 2]> =
            points.windows(2).map(|p| [p[1][0] - p[0][0], (p[1][1] - p[0][1]) / (p[1][0] - p[0][0])]).collect();
        let mut slopes = vec![secants[0][1]];
        slopes.extend(secants.windows(2).map(|s| {
            let ([h0, d0], [h1, d1]) = (s[0], s[1]);
            if d0 * d1 <= 0.0 {
                return 0.0;
            }
            let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
            (w0 + w1) / (w0 / d0 + w1 / d1)
        }));
        slopes.push(secants[secants.len() - 1][1]);
        Self { points: points.to_vec(), slopes }
    }

    /// Height at `x` (cubic Hermite form).
    pub(super) fn value(&self, x: f64) -> f64 {
        let (i, t) = locate(&self.points, x);
        let ([x0, y0], [x1, y1]) = (self.points[i], self.points[i + 1]);
        let (m0, m1) = (self.slopes[i] * (x1 - x0), self.slopes[i + 1] * (x1 - x0));
        let s = 1.0 - t;
        s * s * ((1.0 + 2.0 * t) * y0 + t * m0) + t * t * ((3.0 - 2.0 * t) * y1 - s * m1)
    }
}

/// Height of the broken line at `x`, constant beyond the ends.
pub(super) fn linear(points: &[[f64; 2]], x: f64) -> f64 {
    let (i, t) = locate(points, x);
    points[i][1] * (1.0 - t) + points[i + 1][1] * t
}

/// Interval of `x` and the place in it, 0 to 1.
fn locate(points: &[[f64; 2]], x: f64) -> (usize, f64) {
    let i = points[1..points.len() - 1].partition_point(|p| p[0] <= x);
    let t = (x - points[i][0]) / (points[i + 1][0] - points[i][0]);
    (i, t.clamp(0.0, 1.0))
}

/// Reads the points of a profile file and checks that they cover the edge `x`.
pub(super) fn read(file: &Path, x: [f64; 2], key: &str) -> Result<Vec<[f64; 2]>, GeometryError> {
    let fail = |line: usize, message: String| GeometryError::File {
        key: key.to_owned(),
        file: file.to_owned(),
        line,
        message,
    };
    let text = std::fs::read_to_string(file).map_err(|e| fail(0, format!("cannot be read: {e}")))?;
    let points = parse(&text).map_err(|(line, message)| fail(line, message))?;
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Err(fail(0, "holds no points".into()));
    };
    let tolerance = 1e-9 * (x[1] - x[0]);
    if points.len() < 2 || first[0] > x[0] + tolerance || last[0] < x[1] - tolerance {
        let message = format!(
            "the points reach from x = {} to {}, they must cover the edge from {} to {}",
            first[0], last[0], x[0], x[1]
        );
        return Err(fail(0, message));
    }
    Ok(points)
}

/// Points of a text; an error carries its line number, counted from 1.
fn parse(text: &str) -> Result<Vec<[f64; 2]>, (usize, String)> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut header_allowed = true;
    for (number, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let fail = |message: String| Err((number + 1, message));
        let fields = split(line);
        let numbers: Vec<Option<f64>> = fields.iter().map(|f| f.parse().ok()).collect();
        if header_allowed && numbers.iter().all(Option::is_none) {
            header_allowed = false;
            continue;
        }
        header_allowed = false;
        let [Some(x), Some(height)] = numbers[..] else {
            return fail(format!("expected two numbers x, height, found `{line}`"));
        };
        if !(x.is_finite() && height.is_finite()) {
            return fail(format!("the numbers must be finite, found `{line}`"));
        }
        if let Some(last) = points.last().filter(|last| last[0] >= x) {
            return fail(format!("x must increase from line to line, but {x} follows {}", last[0]));
        }
        points.push([x, height]);
    }
    Ok(points)
}

/// Fields of a line, separated by commas, semicolons or blanks.
fn split(line: &str) -> Vec<&str> {
    let separator = [',', ';'].into_iter().find(|c| line.contains(*c));
    match separator {
        Some(c) => line.split(c).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}
