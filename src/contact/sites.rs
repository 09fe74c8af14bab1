//! Sites: the groups of quadrature points at which the contact conditions hold.

use crate::geometry::Point;
use crate::math::Vec2;

use super::complementarity::SiteAnswer;
use super::integration::QuadraturePoint;
use super::interface::{ContactStatus, SiteMemory, SiteRecord, Sites};
use super::point::PointState;

/// A group of quadrature points at which the conditions hold, and the multipliers it reads.
pub struct Site {
    /// `(quadrature point, c_ai)`.
    pub group: Vec<(usize, f64)>,
    /// `(multiplier, M_aA)`.
    pub reads: Vec<(usize, f64)>,
}

/// A site with its group evaluated.
pub struct SiteState {
    pub site: Site,
    /// `sum_i c_ai` over the points that have a partner; over all points where none has.
    pub weight: f64,
    /// Reference arc length.
    pub arc: f64,
    /// Position of its points, averaged.
    pub position: [f64; 2],
    /// Deflection, traction and closure at the start of the step.
    pub old: [f64; 3],
    /// See [`SiteMemory::closure`].
    pub closure: f64,
    pub gap: f64,
    pub slip: f64,
    pub stretch: f64,
    pub p: f64,
    pub q: f64,
    pub r: [f64; 2],
    pub answer: SiteAnswer,
}

/// The sites of an edge: one per quadrature point, or one per multiplier.
pub fn group(points: &[QuadraturePoint], kind: Sites, multipliers: usize) -> Vec<Site> {
    let reads = |p: &QuadraturePoint| {
        (0..p.multiplier.count).map(|i| (p.multiplier.first + i, p.multiplier.d[0][i])).collect::<Vec<_>>()
    };
    match kind {
        Sites::Quadrature => {
            points.iter().enumerate().map(|(i, p)| Site { group: vec![(i, p.weight)], reads: reads(p) }).collect()
        }
        Sites::Nodal => {
            let mut groups = vec![Vec::new(); multipliers];
            for (i, p) in points.iter().enumerate() {
                reads(p).into_iter().for_each(|(a, value)| groups[a].push((i, p.weight * value)));
            }
            let nodal = |(a, group)| Site { group, reads: vec![(a, 1.0)] };
            groups.into_iter().enumerate().map(nodal).collect()
        }
    }
}

/// What was kept of a site: by its number while there are as many sites as before, else of the nearest one along the edge.
pub fn recall<T>(kept: &[T], place: impl Fn(&T) -> f64, (index, sites): (usize, usize), arc: f64) -> Option<&T> {
    if kept.len() == sites {
        return kept.get(index);
    }
    kept.iter().min_by(|a, b| (place(a) - arc).abs().total_cmp(&(place(b) - arc).abs()))
}

impl SiteState {
    /// What the next step needs to know.
    pub fn memory(&self) -> SiteMemory {
        SiteMemory {
            arc: self.arc,
            deflection: self.answer.deflection,
            traction: self.answer.q,
            closure: self.closure,
            variables: self.answer.variables.clone(),
        }
    }

    /// Work of friction over the step, see `InterfaceForces::dissipated`.
    pub fn dissipated(&self) -> f64 {
        if self.slip.is_nan() {
            return 0.0;
        }
        let [deflection, traction, before] = self.old;
        let now = self.answer.q;
        let mean = if traction * now < 0.0 { now } else { 0.5 * (traction + now) };
        // closed for a part of the step: the closure runs from one value to the other
        let (low, high) = (before.min(self.closure), before.max(self.closure));
        let share = if low < 0.0 && high > 0.0 { high / (high - low) } else { 1.0 };
        let work = mean * share * (self.slip + deflection - self.answer.deflection);
        // rubbing on the way to release cannot give work back
        self.weight * if self.answer.status == ContactStatus::Open { work.max(0.0) } else { work }
    }

    /// What is reported; `states` are the quadrature points.
    pub fn record(&self, states: &[Option<PointState>]) -> SiteRecord {
        let answer = &self.answer;
        let mut x = Point::zeros();
        let (mut normal, mut tangent) = (Vec2::zeros(), Vec2::zeros());
        for &(i, c) in &self.site.group {
            if let Some(at) = &states[i] {
                x += at.x * c;
                normal += at.normal * c;
                tangent += at.tangent * c;
            }
        }
        SiteRecord {
            x: if self.gap.is_nan() { Point::new(f64::NAN, f64::NAN) } else { x / self.weight },
            arc: self.arc,
            normal: normal.try_normalize(0.0).unwrap_or_default(),
            tangent: tangent.try_normalize(0.0).unwrap_or_default(),
            pressure: answer.p / self.stretch,
            traction: answer.q / self.stretch,
            gap: self.gap,
            slip: self.slip,
            status: answer.status,
            weight: self.weight,
            stretch: self.stretch,
            variables: answer.variables.clone(),
            weakening: answer.weakening,
            jumped: self.old[2] > 0.0
                && answer.status != ContactStatus::Open
                && self.site.group.iter().any(|&(i, c)| c != 0.0 && states[i].as_ref().is_some_and(|at| at.jumped)),
        }
    }
}
