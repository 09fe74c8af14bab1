//! Disk, half disk and ring sector as exact NURBS patches.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::arcs::{Piece, arc, chain, on_circle};
use super::mesh::Master;
use super::{finite, increasing, positive};
use crate::geometry::refine::Homogeneous;
use crate::geometry::{BSpline, GeometryError, Point};

/// Full disk on one patch: each edge is a quarter circle, `bottom` the one around the lowest point. The four corners
/// lie on the circle, where the Jacobian vanishes; inside it is positive (`lagrange` of degree 2 only approximates the
/// circle and folds within about a thirtieth of an element of a corner). Contact belongs on the middle of an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Disk {
    /// Centre of the circle, `[0, 0]` if omitted.
    #[serde(default)]
    pub center: [f64; 2],
    /// Radius.
    pub radius: f64,
}

/// Half disk. Its edge `bottom` (for `round = "top"`: `top`) is the quarter circle around the lowest (highest) point,
/// the opposite edge is the diameter, `left` and `right` are the remaining eighths of the circle. The Jacobian vanishes
/// at the two ends of the quarter circle only, with the same reservation as for [`Disk`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HalfDisk {
    /// Middle of the diameter, `[0, 0]` if omitted.
    #[serde(default)]
    pub center: [f64; 2],
    /// Radius.
    pub radius: f64,
    /// Where the round side is, `bottom` if omitted.
    #[serde(default)]
    pub round: Round,
}

/// Round side of a half disk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Round {
    /// Round side down.
    #[default]
    Bottom,
    /// Round side up.
    Top,
}

/// Part of a ring between two angles. Edge `bottom` is the inner arc, `top` the outer arc; `u` runs clockwise from
/// `angles[1]` to `angles[0]`, so for angles between 0 and 180 degrees it runs along x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnnulusSector {
    /// Common centre of the arcs, `[0, 0]` if omitted.
    #[serde(default)]
    pub center: [f64; 2],
    /// Inner and outer radius.
    pub radii: [f64; 2],
    /// First and last angle in degrees, counter-clockwise from the x axis.
    pub angles: [f64; 2],
}

impl Disk {
    pub(super) fn master(&self) -> Result<Master, GeometryError> {
        finite("center", &self.center)?;
        positive("radius", self.radius)?;
        let quarter = |from: f64| one_arc(self.center.into(), self.radius, from * PI, (from + 0.5) * PI);
        let (bottom, right) = (quarter(1.25), quarter(1.75));
        let (top, left) = (reversed(quarter(0.25)), reversed(quarter(0.75)));
        coons(bottom, right, top, left)
    }
}

impl HalfDisk {
    pub(super) fn master(&self) -> Result<Master, GeometryError> {
        finite("center", &self.center)?;
        positive("radius", self.radius)?;
        let center: Point = self.center.into();
        let arc = |from: f64, to: f64| one_arc(center, self.radius, from * PI, to * PI);
        let diameter = Piece::line(on_circle(center, self.radius, PI), on_circle(center, self.radius, 0.0));
        match self.round {
            Round::Bottom => coons(arc(1.25, 1.75), arc(1.75, 2.0), diameter, arc(1.25, 1.0)),
            Round::Top => coons(diameter, arc(0.0, 0.25), arc(0.75, 0.25), arc(1.0, 0.75)),
        }
    }
}

impl AnnulusSector {
    pub(super) fn master(&self) -> Result<Master, GeometryError> {
        finite("center", &self.center)?;
        increasing("radii", self.radii)?;
        positive("radii", self.radii[0])?;
        increasing("angles", self.angles)?;
        if self.angles[1] - self.angles[0] >= 360.0 {
            let message = "must span less than 360 degrees: a closed ring is not one patch";
            return Err(GeometryError::shape("angles", message));
        }
        let [from, to] = self.angles.map(f64::to_radians);
        let ring = |radius: f64| arc(self.center.into(), radius, to, from);
        let (inner, outer) = (ring(self.radii[0]), ring(self.radii[1]));
        let count = inner.len();
        let breaks: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
        let (u, mut net) = chain(&inner, &breaks)?;
        net.extend(chain(&outer, &breaks)?.1);
        let v = BSpline::from_breaks(1, &[0.0, 1.0], |_| 1)?;
        Ok(Master { basis: [u, v], net })
    }
}

/// An arc of at most a quarter circle.
fn one_arc(center: Point, radius: f64, from: f64, to: f64) -> Piece {
    arc(center, radius, from, to)[0]
}

fn reversed(piece: Piece) -> Piece {
    Piece { start: piece.end, end: piece.start, ..piece }
}

/// Biquadratic patch inside four edges (`bottom` and `top` along x, `left` and `right` upwards) whose corners meet: the
/// Coons blend in homogeneous coordinates, of which only the middle control point is not given by the edges.
fn coons(bottom: Piece, right: Piece, top: Piece, left: Piece) -> Result<Master, GeometryError> {
    let [b, r, t, l] = [bottom, right, top, left].map(|p| p.net());
    let corners: Homogeneous = b[0] + b[2] + t[0] + t[2];
    let middle = (b[1] + r[1] + t[1] + l[1]) * 0.5 - corners * 0.25;
    let net = vec![b[0], b[1], b[2], l[1], middle, r[1], t[0], t[1], t[2]];
    let line = || BSpline::from_breaks(2, &[0.0, 1.0], |_| 1);
    Ok(Master { basis: [line()?, line()?], net })
}
