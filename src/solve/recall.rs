//! Ways back: where nothing rubs, a state that was there before is there again.

use std::sync::atomic::AtomicBool;

use crate::geometry::Point;
use crate::model::{Mirror, Model, State};

use super::{Control, Effort, NewtonReport, Witness};

/// Largest difference of displacements, over the largest displacement against rigid motion, of states on the same path.
const SAME: f64 = 1e-6;

/// A nominal step that will be needed again.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Nominal step.
    pub step: usize,
    /// Displacements of all control points.
    pub u: Vec<Point>,
    /// Pressure multipliers of all pairs, one after the other.
    pub pressure: Vec<f64>,
    /// Energy that snaps had set free by then.
    pub snap_loss: f64,
}

/// How a path comes by again.
#[derive(Clone, Copy)]
enum Way {
    /// The drives stand where they stood.
    Back,
    /// They stand at the mirror image.
    Mirrored,
}

/// When the drives of a march come by again, and by what way.
pub struct Ways<'a> {
    model: &'a Model,
    mirror: Option<Mirror>,
    nominal: f64,
    /// Number of nominal steps until all tables have ended.
    last: usize,
}

impl<'a> Ways<'a> {
    /// Of a march through these nominal steps. It may be extended later: what counts is how long the tables go on.
    pub fn new(model: &'a Model, control: &Control) -> Self {
        let nominal = control.end / control.steps as f64;
        let ends = model.motions.iter().filter_map(|m| m.control.table().time.last());
        let last = ends.fold(control.end, |m, t| m.max(*t)) / nominal;
        let mirror = if model.forgets() { Mirror::of(model) } else { None };
        Self { model, mirror, nominal, last: last.round() as usize }
    }

    /// Whether any state will be needed again.
    pub fn any(&self) -> bool {
        (1..=self.last).any(|step| self.keeps(step))
    }

    /// Whether the drives of a nominal step come by again; what stands still is no way back.
    pub fn keeps(&self, step: usize) -> bool {
        let again = |later: usize| {
            later > step + 1 && self.axis(Way::Back, step, later).is_some()
                || self.axis(Way::Mirrored, step, later).is_some()
        };
        self.model.forgets() && (step + 1..=self.last).any(again)
    }

    /// Where the drives of one nominal step are those of another after a way: the axis if it mirrors, else zero.
    fn axis(&self, way: Way, from: usize, to: usize) -> Option<f64> {
        let [a, b] = [from, to].map(|step| step as f64 * self.nominal);
        match way {
            Way::Back => self.model.motions.iter().all(|m| m.control.table().agrees(a, b)).then_some(0.0),
            Way::Mirrored => self.mirror.as_ref()?.axis(self.model, a, b),
        }
    }

    /// The nominal step that ends at a time.
    fn step_at(&self, time: f64) -> Option<usize> {
        let step = (time / self.nominal).round();
        ((time / self.nominal - step).abs() < 1e-9).then_some(step as usize)
    }

    /// What was remembered as it is at another nominal step, everything else taken from `start`; `None` where the drives differ.
    fn image(&self, seen: &Seen, way: Way, step: usize, start: &State) -> Option<State> {
        let axis = self.axis(way, seen.step, step)?;
        let mut state = start.clone();
        state.u.clone_from(&seen.u);
        let pressures = state.pairs.iter_mut().flat_map(|pair| &mut pair.pressure);
        pressures.zip(&seen.pressure).for_each(|(p, old)| *p = *old);
        Some(match (way, &self.mirror) {
            (Way::Mirrored, Some(mirror)) => mirror.image(self.model, &state, axis),
            _ => state,
        })
    }
}

impl Seen {
    /// How many numbers it consists of, for a model with so many control points and multipliers.
    pub fn length(nodes: usize, multipliers: usize) -> usize {
        2 + 2 * nodes + multipliers
    }

    /// All its numbers.
    pub fn numbers(&self) -> Vec<f64> {
        let u = self.u.iter().flat_map(|u| [u.x, u.y]);
        [self.step as f64, self.snap_loss].into_iter().chain(u).chain(self.pressure.iter().copied()).collect()
    }

    /// Back from its [`Self::numbers`], for a model with so many control points.
    pub fn from_numbers(numbers: &[f64], nodes: usize) -> Self {
        let (u, pressure) = numbers[2..].split_at(2 * nodes);
        Self {
            step: numbers[0] as usize,
            u: u.chunks(2).map(|u| Point::new(u[0], u[1])).collect(),
            pressure: pressure.to_vec(),
            snap_loss: numbers[1],
        }
    }

    /// The state at the end of a nominal step.
    pub fn of(step: usize, state: &State) -> Self {
        let pressure = state.pairs.iter().flat_map(|pair| pair.pressure.iter().copied()).collect();
        Self { step, u: state.u.clone(), pressure, snap_loss: state.ledger.snap_loss }
    }
}

/// Whether two fields of displacements agree, in units of the largest difference between two control points.
fn same(a: &[Point], b: &[Point]) -> bool {
    let spread = a.iter().fold(0.0_f64, |m, u| m.max((u - a[0]).amax()));
    a.iter().zip(b).all(|(a, b)| (a - b).amax() <= SAME * spread)
}

/// A companion of a march that remembers states of frictionless contact and offers them, or their mirror images, where the
/// drives come by again: unloading after loading, a second cycle, the way down from an asperity that was climbed.
///
/// Elastic bodies without friction forget, so such a state is in equilibrium again, which the march verifies by one
/// evaluation. Where there are several equilibria it must also be the one that lies on the path: so an offer is made only
/// next to a state that agrees with what is remembered there, and never from the other side of a snap.
pub struct Recall<'a, W> {
    inner: W,
    ways: &'a Ways<'a>,
    /// What is remembered, in order of time.
    seen: Vec<Seen>,
}

impl<'a, W> Recall<'a, W> {
    /// Around another companion; `seen` is what an earlier part of the march remembered.
    pub fn new(ways: &'a Ways<'a>, inner: W, seen: Vec<Seen>) -> Self {
        Self { inner, ways, seen }
    }

    /// Whether the state at a nominal step agrees with what is remembered next to `seen`, the state itself included: there a
    /// path may turn.
    fn on_path(&self, seen: &Seen, way: Way, start: &State, step: usize) -> bool {
        let now = Seen::of(step, start);
        let near = |s: &&Seen| s.step.abs_diff(seen.step) == 1 && s.snap_loss == now.snap_loss;
        let agrees = |s: &Seen| self.ways.image(s, way, step, start).is_some_and(|image| same(&image.u, &start.u));
        seen.snap_loss == now.snap_loss && self.seen.iter().chain([&now]).filter(near).any(agrees)
    }
}

impl<W: Witness> Witness for Recall<'_, W> {
    fn foresee(&mut self, start: &State, time: f64) -> Option<State> {
        let (step, before) = (self.ways.step_at(time)?, self.ways.step_at(start.time)?);
        if before + 1 != step {
            return None;
        }
        let ways = self.seen.iter().rev().flat_map(|seen| [Way::Back, Way::Mirrored].map(|way| (seen, way)));
        let mut known = ways.filter(|(seen, way)| self.ways.axis(*way, seen.step, step).is_some());
        let (seen, way) = known.find(|(seen, way)| self.on_path(seen, *way, start, before))?;
        let mut state = self.ways.image(seen, way, step, start)?;
        state.prescribe(self.ways.model, time);
        Some(state)
    }

    fn accepted(&mut self, model: &Model, start: &State, found: &NewtonReport, effort: Effort) {
        if let Some(step) = self.ways.step_at(found.state.time).filter(|&step| self.ways.keeps(step)) {
            self.seen.push(Seen::of(step, &found.state));
        }
        self.inner.accepted(model, start, found, effort);
    }

    fn rescue(&mut self, model: &Model, start: &State, time: f64, interrupt: &AtomicBool) -> Option<State> {
        self.inner.rescue(model, start, time, interrupt)
    }
}
