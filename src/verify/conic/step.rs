//! A step solved by a sequence of convex programmes.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::geometry::Point;
use crate::model::{Loaded, Model, State, load};

use super::LEAST;
use super::answer::{Answer, advance};
use super::conditions::{Violation, violation};
use super::programme::Solution;
use super::stage::{Stage, Staged, Way};

/// Violation at which the iteration stops.
const GOAL: f64 = 1e-9;
/// Violation with which a step counts as solved where it does not fall any more.
pub const ACCEPTED: f64 = 1e-6;
/// Programmes without the violation falling to half of the best before, after which it has come to rest.
const PATIENCE: usize = 4;
/// Programmes at most.
const MOST: usize = 60;
/// Increments are halved so often while a body is turned inside out.
const HALVINGS: usize = 8;

/// A step that was solved.
#[derive(Clone, Debug)]
pub struct Solved {
    /// Displacements and contact forces.
    pub answer: Answer,
    /// What is left of its violations.
    pub violation: Violation,
    /// Contact forces at every control point, in the sign of the residual.
    pub contact_forces: Vec<Point>,
    /// How Coulomb's law was reached.
    pub way: Way,
    /// Programmes solved.
    pub programmes: usize,
    /// Iterations of the interior-point method.
    pub iterations: usize,
}

/// Why a step was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsolved {
    /// Clarabel or the condensation gave up.
    #[error("{0}")]
    Programme(String),
    /// The outer iteration did not come to rest.
    #[error("no rest after {programmes} programmes: violation {violation:.1e}")]
    Restless {
        /// Programmes solved.
        programmes: usize,
        /// Smallest violation seen.
        violation: f64,
    },
    /// A body was turned inside out.
    #[error("a body is turned inside out")]
    Inverted,
    /// Stopped from outside.
    #[error("interrupted")]
    Interrupted,
}

/// Solves the step from `start` to `time`, beginning with the displacements `u`.
///
/// # Errors
/// Why not; nothing is changed.
pub fn solve(
    model: &Model,
    start: &State,
    u: Vec<Point>,
    (time, way): (f64, Way),
    stage: &mut Stage,
    interrupt: &AtomicBool,
) -> Result<Solved, Unsolved> {
    let mut step = Step { model, start, time, stage, iterations: 0 };
    let mut answer = Answer::guess(model, start, u);
    let mut loaded = step.load(&answer).ok_or(Unsolved::Inverted)?;
    let mut best: Option<Solved> = None;
    let (mut smallest, mut since) = (f64::INFINITY, 0);
    for programmes in 1..=MOST {
        if interrupt.load(Ordering::Relaxed) {
            return Err(Unsolved::Interrupted);
        }
        (answer, loaded) = match step.advance(&answer, &loaded, way) {
            Err(Unsolved::Programme(_)) if best.is_some() => break,
            next => next?,
        };
        let left = violation(model, &loaded, &answer, time - start.time, LEAST * model.modulus);
        let size = left.worst();
        if std::env::var_os("CONIC").is_some() {
            eprintln!("  {programmes} {left:?}");
        }
        if size < smallest {
            (smallest, since) = (size, if size < 0.5 * smallest { 0 } else { since + 1 });
            let (answer, contact_forces) = (answer.clone(), loaded.contact_forces.clone());
            let solved = Solved { answer, violation: left, contact_forces, way, programmes, iterations: 0 };
            best = best.filter(|_| size > ACCEPTED).or((size <= ACCEPTED).then_some(solved));
        } else {
            since += 1;
        }
        if smallest <= GOAL || (best.is_some() && since >= PATIENCE) {
            break;
        }
    }
    let iterations = step.iterations;
    let best = best.map(|solved| Solved { iterations, ..solved });
    best.ok_or(Unsolved::Restless { programmes: MOST, violation: smallest })
}

struct Step<'a> {
    model: &'a Model,
    start: &'a State,
    time: f64,
    stage: &'a mut Stage,
    iterations: usize,
}

impl Step<'_> {
    fn load(&self, answer: &Answer) -> Option<Loaded> {
        load(self.model, self.start, &answer.u, self.time, &answer.loads())
    }

    /// The programme linearised at an answer, and its solution evaluated.
    fn advance(&mut self, answer: &Answer, loaded: &Loaded, way: Way) -> Result<(Answer, Loaded), Unsolved> {
        let given = |error: &dyn std::fmt::Display| Unsolved::Programme(error.to_string());
        let how = (way, self.time - self.start.time);
        let staged = self.stage.set(self.model, loaded, &answer.pairs, how).map_err(|e| given(&e))?;
        let found = staged.programme.solve().map_err(|e| given(&e))?;
        self.iterations += found.iterations;
        self.move_by(answer, loaded, staged, &found).ok_or(Unsolved::Inverted)
    }

    fn move_by(
        &mut self,
        from: &Answer,
        loaded: &Loaded,
        staged: Staged,
        found: &Solution,
    ) -> Option<(Answer, Loaded)> {
        let increment = self.stage.complete(staged, &found.increment);
        let arcs: Vec<Vec<f64>> =
            loaded.sites.iter().map(|sites| sites.iter().map(|site| site.arc).collect()).collect();
        let mut next = from.clone();
        next.take(self.model, &arcs, found);
        let mut factor = 1.0;
        for _ in 0..HALVINGS {
            next.u.clone_from(&from.u);
            advance(self.model, &mut next.u, &increment, factor);
            if let Some(loaded) = self.load(&next) {
                return Some((next, loaded));
            }
            factor *= 0.5;
        }
        None
    }
}
