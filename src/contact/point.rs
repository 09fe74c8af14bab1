//! One quadrature point in a configuration: partner, gap, slip and the rows of their derivatives.

use crate::geometry::{Curve, Point, Shape};
use crate::math::{GaussRule, Vec2, rot90};

use super::integration::QuadraturePoint;
use super::interface::{Configuration, InterfaceStart, InterfaceTrial};
use super::kinematics::{Frame, Orientation, SlotMatrix, Slots};
use super::projection::{Partner, Seeker, Target, parameter_near};
use super::slip::{Path, path};

/// The two curves of a pair and how they see each other.
#[derive(Clone, Copy)]
pub struct Curves<'a> {
    /// Carries multipliers and quadrature points.
    pub nonmortar: &'a Curve,
    /// Is projected onto.
    pub mortar: &'a Curve,
    /// Projection and sides.
    pub orientation: Orientation,
    /// Quadrature of the slip path.
    pub rule: &'a GaussRule,
}

/// A point that has a partner.
#[derive(Clone, Debug)]
pub struct PointState {
    /// Partner on the mortar curve.
    pub partner: Partner,
    /// Local vector.
    pub z: Slots,
    /// `y'''`.
    pub third: [f64; 2],
    /// Gap, virtual slip and projection parameter with their coefficients.
    pub frame: Frame,
    /// Finite slip of the step and its derivative along the curve.
    pub path: Path,
    /// True where the partner at the start of the step was on another flank.
    pub jumped: bool,
    /// Position.
    pub x: Point,
    /// Unit vector along which slip and traction are positive.
    pub tangent: Vec2,
    /// Unit vector along which the pressure acts on the nonmortar body: the outward normal of the mortar curve, with ray
    /// projection the inward normal of the nonmortar curve.
    pub normal: Vec2,
}

/// Position and normal of a nonmortar point.
pub fn seeker(curve: &Curve, shape: &Shape, points: &[Point]) -> Seeker {
    let tangent = curve.place(shape, 1, points).normalize();
    Seeker { x: curve.place(shape, 0, points), tangent, normal: rot90(tangent) * curve.side }
}

impl Curves<'_> {
    /// Kinematics of a point, or `None` without a partner. `was` is its partner at the start of the step, `new` the mortar
    /// curve now.
    pub fn point(
        &self,
        point: &QuadraturePoint,
        (was, start): (Option<&Partner>, &InterfaceStart),
        (new, trial): (&Target, &InterfaceTrial),
        gradient: bool,
    ) -> Option<PointState> {
        let here = seeker(self.nonmortar, &point.shape, trial.at.nonmortar);
        let partner = new.project(&here)?;
        let edge = self.nonmortar.place(&point.shape, 1, trial.at.nonmortar);
        let [y, a, b, c] = [0, 1, 2, 3].map(|k| self.mortar.place(&partner.shape, k, trial.at.mortar));
        let d = here.x - y;
        let z = [d.x, d.y, a.x, a.y, b.x, b.y, edge.x, edge.y];
        let (from, jumped) = self.anchor(point, was, start, &here, &partner, trial.at);
        let path = path(self.mortar, trial.at.mortar, self.rule, from, partner.xi, gradient);
        let frame = self.orientation.frame(&z);
        let normal = Vec2::new(frame.normal[0], frame.normal[1]);
        Some(PointState {
            frame,
            partner,
            z,
            third: [c.x, c.y],
            path,
            jumped,
            x: here.x,
            tangent: rot90(normal) * -self.mortar.side,
            normal,
        })
    }

    /// Parameter from which the slip of this step counts: the partner at the start of the step. A partner on another
    /// flank (farther along the curve than the two points can have moved against each other) is a release and a new
    /// contact: then the place on the new flank that was nearest at the start of the step, and `true`.
    fn anchor(
        &self,
        point: &QuadraturePoint,
        was: Option<&Partner>,
        start: &InterfaceStart,
        here: &Seeker,
        partner: &Partner,
        at: Configuration,
    ) -> (f64, bool) {
        let before = self.nonmortar.place(&point.shape, 0, start.at.nonmortar);
        let moved = |shape: &Shape| {
            let y = self.mortar.place(shape, 0, at.mortar) - self.mortar.place(shape, 0, start.at.mortar);
            (here.x - before - y).norm()
        };
        if let Some(was) = was {
            let length = path(self.mortar, at.mortar, self.rule, was.xi, partner.xi, false).length.abs();
            let gap = (self.mortar.place(&partner.shape, 0, at.mortar) - here.x).norm();
            let bound = moved(&was.shape).max(moved(&partner.shape)) + gap;
            if length <= 3.0 * bound {
                return (was.xi, false);
            }
        }
        (parameter_near(self.mortar, start.at.mortar, before, partner.xi), was.is_some())
    }

    /// Spreads coefficients on slots to the control points: `visit(control point, coefficient)`, numbered as in
    /// [`Self::columns`].
    pub fn spread(&self, point: &QuadraturePoint, partner: &Partner, row: &Slots, mut visit: impl FnMut(usize, Vec2)) {
        let v: [Vec2; 4] = std::array::from_fn(|k| Vec2::new(row[2 * k], row[2 * k + 1]));
        for (node, [d, a, b, e]) in self.columns(point, partner) {
            visit(node, v[0] * d + v[1] * a + v[2] * b + v[3] * e);
        }
    }

    /// The slot map of the control points that move a point: what each does to `(d, a, b, e)`. Mortar control points are
    /// numbered after the nonmortar ones.
    pub fn columns<'a>(
        &self,
        point: &'a QuadraturePoint,
        partner: &'a Partner,
    ) -> impl Iterator<Item = (usize, [f64; 4])> + 'a {
        let (edge, mortar) = (&point.shape, &partner.shape);
        let offset = self.nonmortar.points.len() + mortar.first;
        let of_edge = (0..edge.count).map(|i| (edge.first + i, [edge.d[0][i], 0.0, 0.0, edge.d[1][i]]));
        let of_mortar =
            (0..mortar.count).map(move |i| (offset + i, [-mortar.d[0][i], mortar.d[1][i], mortar.d[2][i], 0.0]));
        of_edge.chain(of_mortar)
    }
}

/// `B^T form B` entry by entry for the columns of a point: `visit(row unknown, column unknown, value)`.
pub fn congruence(columns: &[(usize, [f64; 4])], form: &SlotMatrix, mut visit: impl FnMut(usize, usize, f64)) {
    for (node_j, cj) in columns {
        for jc in 0..2 {
            // form B, one column
            let mut image = [0.0; 8];
            for (i, value) in image.iter_mut().enumerate() {
                *value = (0..4).map(|k| form[i][2 * k + jc] * cj[k]).sum();
            }
            for (node_i, ci) in columns {
                for ic in 0..2 {
                    let value: f64 = (0..4).map(|k| ci[k] * image[2 * k + ic]).sum();
                    visit(2 * node_i + ic, 2 * node_j + jc, value);
                }
            }
        }
    }
}
