//! Ways back: where nothing rubs, a state that was there before is there again.

use std::sync::atomic::AtomicBool;

use crate::geometry::Point;
use crate::model::{Model, State};

use super::ways::{Way, Ways};
use super::{Effort, NewtonReport, Witness};

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

    /// What was remembered as it is after a way, everything else taken from `start`.
    fn image(&self, seen: &Seen, way: Way, start: &State) -> State {
        let mut state = start.clone();
        state.u.clone_from(&seen.u);
        let pressures = state.pairs.iter_mut().flat_map(|pair| &mut pair.pressure);
        pressures.zip(&seen.pressure).for_each(|(p, old)| *p = *old);
        match (way, &self.ways.mirror) {
            (Way::Mirrored, Some(mirror)) => mirror.image(self.ways.model, &state),
            _ => state,
        }
    }

    /// Whether the state at a nominal step agrees with what is remembered next to `seen`, the state itself included: there a
    /// path may turn.
    fn on_path(&self, seen: &Seen, way: Way, start: &State, step: usize) -> bool {
        let now = Seen::of(step, start);
        let near = |s: &&Seen| s.step.abs_diff(seen.step) == 1 && s.snap_loss == now.snap_loss;
        let agrees = |s: &Seen| self.ways.leads(way, s.step, step) && same(&self.image(s, way, start).u, &start.u);
        seen.snap_loss == now.snap_loss && self.seen.iter().chain([&now]).filter(near).any(agrees)
    }
}

impl<W: Witness> Witness for Recall<'_, W> {
    fn foresee(&mut self, start: &State, time: f64) -> Option<State> {
        if !self.ways.any() {
            return None;
        }
        let (step, before) = (self.ways.step_at(time)?, self.ways.step_at(start.time)?);
        if before + 1 != step {
            return None;
        }
        let known = |other| self.seen.binary_search_by_key(&other, |seen| seen.step).ok().map(|k| &self.seen[k]);
        let of = |way| self.ways.candidates(way, step).filter_map(known).map(move |seen| (seen, way));
        let mut known = Way::ALL.into_iter().flat_map(of).filter(|(seen, way)| self.ways.leads(*way, seen.step, step));
        let (seen, way) = known.find(|(seen, way)| self.on_path(seen, *way, start, before))?;
        let mut state = self.image(seen, way, start);
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
