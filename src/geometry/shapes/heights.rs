//! Edge profiles of a block: checks and heights.

use std::f64::consts::PI;
use std::path::Path;

use super::outline::{self, Outline};
use super::profile::{ArcProfile, Cosine, Polyline, Profile, Wedge};
use super::table::{self, Monotone};
use super::{finite, positive};
use crate::geometry::{GeometryError, Point};

impl Profile {
    /// Heights over the edge `x`; errors name keys below `key` (`top` or `bottom`).
    pub(super) fn outline(&self, x: [f64; 2], base_dir: &Path, key: &str) -> Result<Outline, GeometryError> {
        match self {
            Self::Flat(_) => Ok(Outline::graph(|_| 0.0, vec![])),
            Self::Cosine(profile) => profile.outline(x, key),
            Self::Arc(profile) => profile.outline(x, key),
            Self::Wedge(profile) => profile.outline(x, key),
            Self::Polyline(profile) => profile.outline(x, key),
            Self::Csv(profile) => {
                let points = table::read(&base_dir.join(&profile.file), x, &format!("{key}.file"))?;
                let curve = Monotone::new(&points);
                Ok(Outline::graph(move |x| curve.value(x), vec![]))
            }
        }
    }
}

impl Cosine {
    fn outline(&self, x: [f64; 2], key: &str) -> Result<Outline, GeometryError> {
        finite(&format!("{key}.height"), &[self.height])?;
        positive(&format!("{key}.wavelength"), self.wavelength)?;
        let centers = places(&self.centers, self.count, self.spacing, x, key)?;
        let (height, length) = (self.height, self.wavelength);
        if let Some(c) = centers.iter().find(|&&c| c + 0.5 * length <= x[0] || c - 0.5 * length >= x[1]) {
            let message = format!("the bump at {c} lies beside the edge from {} to {}", x[0], x[1]);
            return Err(GeometryError::shape(format!("{key}.centers"), message));
        }
        let ends = |c: &f64| [c - 0.5 * length, c + 0.5 * length];
        let joints = centers.iter().flat_map(ends).collect();
        let bump = move |d: f64| {
            if d.abs() <= 0.5 * length { 0.5 * height * (1.0 + (2.0 * PI * d / length).cos()) } else { 0.0 }
        };
        let sum = move |x: f64| centers.iter().map(|c| bump(x - c)).sum();
        Ok(Outline::graph(sum, joints))
    }
}

impl ArcProfile {
    fn outline(&self, x: [f64; 2], key: &str) -> Result<Outline, GeometryError> {
        let fail = |name: &str, message: String| Err(GeometryError::shape(format!("{key}.{name}"), message));
        positive(&format!("{key}.radius"), self.radius)?;
        let half = 0.5 * (x[1] - x[0]);
        let Some(height) = self.height else {
            if self.centers.is_some() || self.count.is_some() || self.spacing.is_some() {
                return fail("height", "is needed for arcs at `centers`: without it one arc spans the edge".into());
            }
            if self.radius < half {
                return fail("radius", format!("must be at least {half}, half the edge, is {}", self.radius));
            }
            // R - sqrt(R^2 - a^2) without cancellation
            let root = (self.radius * self.radius - half * half).sqrt();
            let (bump, _) = outline::cap(self.radius, half * half / (self.radius + root));
            return Outline::bumps(&bump, half, &[0.5 * (x[0] + x[1])], x, &format!("{key}.radius"));
        };
        positive(&format!("{key}.height"), height)?;
        if height >= self.radius {
            return fail("height", format!("must be below the radius {}, is {height}", self.radius));
        }
        let centers = places(&self.centers, self.count, self.spacing, x, key)?;
        let (bump, half) = outline::cap(self.radius, height);
        Outline::bumps(&bump, half, &centers, x, &format!("{key}.centers"))
    }
}

impl Wedge {
    fn outline(&self, x: [f64; 2], key: &str) -> Result<Outline, GeometryError> {
        positive(&format!("{key}.height"), self.height)?;
        positive(&format!("{key}.tip_radius"), self.tip_radius)?;
        let (half_width, slope) = self.flanks(key)?;
        // the flank must not vanish: the tip touches it above the foot
        let foot = self.tip_radius * (1.0 - slope.cos());
        if foot >= self.height {
            let message =
                format!("too large: a tip this round needs a height above {foot}, the height is {}", self.height);
            return Err(GeometryError::shape(format!("{key}.tip_radius"), message));
        }
        let centers = places(&self.centers, self.count, self.spacing, x, key)?;
        let bump = outline::wedge(self.height, half_width, slope, self.tip_radius);
        Outline::bumps(&bump, half_width, &centers, x, &format!("{key}.centers"))
    }

    /// Half width and slope (rad) of the flanks. The flank `h = tan a (b - |x|)` touches the tip circle at
    /// `(r sin a, H - r + r cos a)`, hence `b sin a - (H - r) cos a = r`; with `b = R cos f`, `H - r = R sin f` that
    /// is `R sin(a - f) = r`.
    fn flanks(&self, key: &str) -> Result<(f64, f64), GeometryError> {
        let (height, radius) = (self.height, self.tip_radius);
        match (self.half_width, self.angle) {
            (None, Some(angle)) => {
                if !(0.0 < angle && angle < 90.0) {
                    let message = format!("must be between 0 and 90 degrees, is {angle}");
                    return Err(GeometryError::shape(format!("{key}.angle"), message));
                }
                let slope = angle.to_radians();
                let width = (radius + (height - radius) * slope.cos()) / slope.sin();
                Ok((width, slope))
            }
            (Some(width), None) => {
                positive(&format!("{key}.half_width"), width)?;
                let reach = width.hypot(height - radius);
                let slope = (height - radius).atan2(width) + (radius / reach).asin();
                // written so that a NaN (no tangent from the foot to the tip) fails
                if slope > 0.0 && slope < 0.5 * PI {
                    return Ok((width, slope));
                }
                let message = format!("no flank from a foot at {width} touches a tip of radius {radius}");
                Err(GeometryError::shape(format!("{key}.half_width"), message))
            }
            _ => {
                let message = "give either `half_width` or `angle`";
                Err(GeometryError::shape(format!("{key}.half_width"), message))
            }
        }
    }
}

impl Polyline {
    fn outline(&self, x: [f64; 2], key: &str) -> Result<Outline, GeometryError> {
        let key = format!("{key}.points");
        finite(&key, self.points.as_flattened())?;
        let increasing = self.points.windows(2).all(|p| p[0][0] < p[1][0]);
        if self.points.len() < 2 || !increasing {
            let message = "must be at least two points [x, height] with increasing x";
            return Err(GeometryError::shape(key, message));
        }
        if self.smooth {
            let curve = Monotone::new(&self.points);
            return Ok(Outline::graph(move |x| curve.value(x), vec![]));
        }
        let tolerance = 1e-9 * (x[1] - x[0]);
        let inside = |p: &&[f64; 2]| x[0] + tolerance < p[0] && p[0] < x[1] - tolerance;
        let mut corners = vec![Point::new(x[0], table::linear(&self.points, x[0]))];
        corners.extend(self.points.iter().filter(inside).map(|&p| Point::from(p)));
        corners.push(Point::new(x[1], table::linear(&self.points, x[1])));
        Outline::broken_line(&corners, x)
    }
}

/// Middle of each bump, sorted.
fn places(
    centers: &Option<Vec<f64>>,
    count: Option<usize>,
    spacing: Option<f64>,
    x: [f64; 2],
    key: &str,
) -> Result<Vec<f64>, GeometryError> {
    let fail = |name: &str, message: &str| Err(GeometryError::shape(format!("{key}.{name}"), message));
    let middle = 0.5 * (x[0] + x[1]);
    match (centers, count, spacing) {
        (Some(centers), None, None) => {
            finite(&format!("{key}.centers"), centers)?;
            if centers.is_empty() {
                return fail("centers", "must name at least one place; an edge without bumps is `flat`");
            }
            let mut sorted = centers.clone();
            sorted.sort_by(f64::total_cmp);
            Ok(sorted)
        }
        (None, None, None) => Ok(vec![middle]),
        (None, Some(0), _) => fail("count", "must be at least 1"),
        (None, Some(n), Some(d)) => {
            positive(&format!("{key}.spacing"), d)?;
            let first = middle - 0.5 * d * (n - 1) as f64;
            Ok((0..n).map(|i| first + d * i as f64).collect())
        }
        (None, _, _) => fail("spacing", "`count` and `spacing` must be given together"),
        (Some(_), _, _) => fail("centers", "give either `centers` or `count` and `spacing`"),
    }
}
