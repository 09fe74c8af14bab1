//! The certificate of a converged step: do its forces satisfy the conditions, and does a programme at its end stand still?
//!
//! At a solution every programme with a positive definite matrix has the optimum `x = 0`, and its duals are the contact
//! forces of the solution, whatever the matrix (theory 2.9). The bounds are those that the law gives at the claimed pressures.

use crate::contact::ContactStatus;
use crate::model::{Loaded, Model, State, load};

use super::answer::PairAnswer;
use super::bound::{Carries, carries};
use super::check::{Claim, STRESS};
use super::conditions::{Violation, peak, violation};
use super::stage::{Stage, Staged, Way};
use super::uniqueness::{Pattern, coupling};
use super::{LEAST, differ};

/// What was found at a claimed solution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Certificate {
    /// How far its forces miss the conditions.
    pub violation: Violation,
    /// Largest contradiction between the status and the forces of a site, of the peak pressure.
    pub status: f64,
    /// Largest increment of the programme at the solution, of an element.
    pub increment: f64,
    /// Largest difference between the forces of the programme and the claimed ones, of the peak pressure.
    pub forces: f64,
    /// Relative difference of its primal and dual objective.
    pub duality_gap: f64,
    /// `|T|`, see [`super::uniqueness`]: from 1 on the solution need not be unique.
    pub coupling: f64,
    /// Closed sites under a direct law: no cone is behind them.
    pub direct: usize,
    /// Why the programme was not solved.
    pub unsolved: Option<String>,
}

impl Certificate {
    /// Its numbers with their names.
    fn named(&self) -> [(&'static str, f64); 8] {
        let Violation { equilibrium, sign, complementarity, cone, projection } = self.violation;
        [
            ("equilibrium", equilibrium),
            ("the sign of gap or pressure", sign),
            ("complementarity", complementarity),
            ("the friction bound", cone),
            ("the projection of the multipliers", projection),
            ("the status of a site", self.status),
            ("a programme at the solution (increment)", self.increment),
            ("a programme at the solution (forces)", self.forces),
        ]
    }

    /// The largest of its numbers, [`STRESS`] being accepted; `NaN` if there is one.
    pub fn worst(&self) -> f64 {
        self.named().into_iter().fold(0.0, |m: f64, (_, v)| if m.is_nan() || v.is_nan() { f64::NAN } else { m.max(v) })
    }

    /// Which condition is broken, in words.
    pub fn broken(&self) -> Option<String> {
        let (name, worst) = self.named().into_iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        (worst.is_nan() || worst > STRESS).then(|| format!("the claimed solution breaks {name} by {worst:.1e}"))
    }

    /// False where several solutions are possible.
    pub fn unique(&self) -> bool {
        self.coupling < 1.0
    }
}

/// Certifies what is claimed of the end of a step from `start`.
pub fn certify(model: &Model, start: &State, claim: Claim, stage: &mut Stage) -> Certificate {
    let answer = claim.answer();
    let (time, dt) = (claim.state.time, claim.state.time - start.time);
    let unknown = Violation { equilibrium: f64::NAN, ..Default::default() };
    let mut out = Certificate { violation: unknown, ..Default::default() };
    let Some(loaded) = load(model, start, &answer.u, time, &answer.loads()) else { return out };
    out.violation = violation(model, &loaded, &answer, dt, LEAST * model.modulus);
    let states = states(model, &loaded, claim, dt);
    out.status = states.iter().fold(0.0, |m, state| m.max(state.contradiction));
    out.direct = states.iter().filter(|state| state.direct).count();
    match stage.set(model, &loaded, &answer.pairs, (Way::Tresca, dt)) {
        Ok(staged) => out.programme(model, &answer.pairs, &states, staged),
        Err(error) => out.unsolved = Some(error.to_string()),
    }
    out
}

impl Certificate {
    fn programme(&mut self, model: &Model, claimed: &[PairAnswer], states: &[SiteState], staged: Staged) {
        let pattern: Vec<Pattern> = states.iter().map(|state| state.pattern).collect();
        self.coupling = coupling(&staged.programme, &pattern);
        match staged.programme.solve() {
            Ok(found) => {
                let mut pairs = claimed.to_vec();
                let loads = pairs.iter_mut().flat_map(|pair| &mut pair.loads);
                for (load, (p, q)) in loads.zip(found.pressure.iter().zip(&found.traction)) {
                    (load.pressure, load.traction) = (*p, q[0]);
                }
                let [p, q] = differ(model, claimed, &pairs);
                self.forces = p.max(q);
                let size = model.element_size;
                self.increment = found.increment.iter().fold(0.0, |m: f64, x| m.max(x.abs() / size));
                self.duality_gap = found.duality_gap;
            }
            Err(why) => self.unsolved = Some(why),
        }
    }
}

/// What the forces of a site say about its status.
struct SiteState {
    pattern: Pattern,
    contradiction: f64,
    direct: bool,
}

fn states(model: &Model, loaded: &Loaded, claim: Claim, dt: f64) -> Vec<SiteState> {
    let scale = peak(loaded).max(LEAST * model.modulus);
    let pairs = model.pairs.iter().zip(&loaded.sites).zip(&claim.evaluation.interfaces);
    let mut states = vec![];
    for ((pair, sites), found) in pairs {
        for (site, claimed) in sites.iter().zip(&found.sites) {
            let [p, q] = site.load;
            let answer = match (p > 0.0, pair.contact.law()) {
                (true, Some(law)) => Some(carries(&**law, site, p, dt)),
                _ => None,
            };
            let open = (claimed.status == ContactStatus::Open) != (p <= 0.0);
            let (pattern, contradiction) = match (answer, claimed.status) {
                (Some(Carries::Bound([bound, slope, _])), ContactStatus::Slip) => {
                    (Pattern::Slip(slope), (bound - q.abs()).abs() / scale)
                }
                (Some(Carries::Bound([_, slope, _])), _) => (Pattern::Stick(slope), 0.0),
                _ if p > 0.0 => (Pattern::Frictionless, 0.0),
                _ => (Pattern::Open, 0.0),
            };
            // an open site that carries, or a closed one that does not
            let contradiction = if open { contradiction.max(p.abs() / scale) } else { contradiction };
            states.push(SiteState { pattern, contradiction, direct: matches!(answer, Some(Carries::Traction(_))) });
        }
    }
    states
}
