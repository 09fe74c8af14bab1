//! A step solved by a sequence of convex programmes.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::geometry::Point;
use crate::model::{Loaded, Model, State, load};

use super::LEAST;
use super::acceleration::Acceleration;
use super::answer::{Answer, advance};
use super::conditions::{Violation, violation};
use super::programme::Solution;
use super::stage::{Stage, Staged, Way};

/// Violation asked of a solution.
pub const GOAL: f64 = 1e-9;
/// Violation with which a step counts as solved where it does not fall any more: sites that just touch or are about to slip.
const ACCEPTED: f64 = 1e-5;
/// Programmes in which the violation was not halved, after which an accepted answer has come to rest.
const PATIENCE: usize = 4;
/// Violation below which the iteration is accelerated where it falls by less than [`SLOW`].
const NEAR: f64 = 0.1;
/// See [`NEAR`].
const SLOW: f64 = 0.3;
/// Programmes at most.
const MOST: usize = 120;
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

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// End of the step.
    pub time: f64,
    /// How to come to Coulomb's law.
    pub way: Way,
    /// Violation wanted.
    pub goal: f64,
}

/// Solves the step from `start`, beginning with the displacements `u`.
///
/// # Errors
/// Why not; nothing is changed.
pub fn solve(
    model: &Model,
    start: &State,
    u: Vec<Point>,
    Aim { time, way, goal }: Aim,
    stage: &mut Stage,
    interrupt: &AtomicBool,
) -> Result<Solved, Unsolved> {
    let mut step = Step { model, start, time, way, stage, iterations: 0 };
    let mut answer = Answer::guess(model, start, u);
    let mut loaded = step.load(&answer).ok_or(Unsolved::Inverted)?;
    let mut course = Course::default();
    let mut acceleration = Acceleration::default();
    while !course.ended(goal) {
        if interrupt.load(Ordering::Relaxed) {
            return Err(Unsolved::Interrupted);
        }
        let (found, at) = match step.advance(&answer, &loaded) {
            Err(Unsolved::Programme(_)) if course.best.is_some() => break,
            next => next?,
        };
        let left = violation(model, &at, &found, time - start.time, LEAST * model.modulus);
        let slow = course.take(left, goal, || Solved {
            answer: found.clone(),
            violation: left,
            contact_forces: at.contact_forces.clone(),
            way,
            programmes: 0,
            iterations: 0,
        });
        let mixed = slow.then(|| step.mix(&mut acceleration, &answer, &found)).flatten();
        (answer, loaded) = mixed.unwrap_or((found, at));
    }
    let (programmes, iterations) = (course.programmes, step.iterations);
    let best = course.best.map(|solved| Solved { programmes, iterations, ..solved });
    best.ok_or(Unsolved::Restless { programmes, violation: course.smallest })
}

/// How the violation went so far.
struct Course {
    programmes: usize,
    smallest: f64,
    last: f64,
    /// Violation when it was last halved, and programmes since.
    halved: f64,
    since: usize,
    best: Option<Solved>,
}

impl Default for Course {
    fn default() -> Self {
        Self {
            programmes: 0,
            smallest: f64::INFINITY,
            last: f64::INFINITY,
            halved: f64::INFINITY,
            since: 0,
            best: None,
        }
    }
}

impl Course {
    /// Takes the violation of the next answer; whether the iteration is near its end and slow.
    fn take(&mut self, left: Violation, goal: f64, solved: impl FnOnce() -> Solved) -> bool {
        let size = left.worst();
        self.programmes += 1;
        (self.halved, self.since) = if size < 0.5 * self.halved { (size, 0) } else { (self.halved, self.since + 1) };
        if size < self.smallest && size <= ACCEPTED.max(goal) {
            self.best = Some(solved());
        }
        let slow = size < NEAR && size > SLOW * self.last;
        (self.smallest, self.last) = (self.smallest.min(size), size);
        slow
    }

    fn ended(&self, goal: f64) -> bool {
        let rest = self.best.is_some() && self.since >= PATIENCE;
        self.smallest <= goal || self.programmes == MOST || rest
    }
}

struct Step<'a> {
    model: &'a Model,
    start: &'a State,
    time: f64,
    way: Way,
    stage: &'a mut Stage,
    iterations: usize,
}

impl Step<'_> {
    fn load(&self, answer: &Answer) -> Option<Loaded> {
        load(self.model, self.start, &answer.u, self.time, &answer.loads())
    }

    /// The programme linearised at an answer, and its solution evaluated.
    fn advance(&mut self, answer: &Answer, loaded: &Loaded) -> Result<(Answer, Loaded), Unsolved> {
        let given = |error: &dyn std::fmt::Display| Unsolved::Programme(error.to_string());
        let how = (self.way, self.time - self.start.time);
        let staged = self.stage.set(self.model, loaded, &answer.pairs, how).map_err(|e| given(&e))?;
        let found = staged.programme.solve().map_err(|e| given(&e))?;
        self.iterations += found.iterations;
        self.move_by(answer, loaded, staged, &found).ok_or(Unsolved::Inverted)
    }

    /// The answer continued by what the last ones tell, where that does not turn a body inside out.
    fn mix(&self, past: &mut Acceleration, from: &Answer, to: &Answer) -> Option<(Answer, Loaded)> {
        let mut mixed = to.clone();
        mixed.set_flat(self.model, &past.next(&from.flat(self.model), to.flat(self.model)));
        let loaded = self.load(&mixed);
        if loaded.is_none() {
            past.clear();
        }
        Some((mixed, loaded?))
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
