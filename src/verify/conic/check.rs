//! A converged step against the conic method: certificate, independent solution, verdict.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use crate::contact::SiteLoad;
use crate::model::{Evaluation, Model, State, record, resistance};
use crate::solve::predict;

use super::answer::{Answer, PairAnswer};
use super::certificate::{Certificate, certify};
use super::stage::{Stage, Way};
use super::step::{Aim, GOAL, Solved, Unsolved, solve};
use super::{LEAST, differ};

/// Largest difference of `Fx`, `Fy` accepted, of the force.
pub const FORCE: f64 = 1e-7;
/// Largest difference of a site pressure or traction accepted, of the peak pressure; and of a displacement, of an element.
pub const STRESS: f64 = 1e-6;

/// What a solver claims of a step.
#[derive(Clone, Copy)]
pub struct Claim<'a> {
    /// State at the end.
    pub state: &'a State,
    /// Its evaluation: site forces, statuses, reactions.
    pub evaluation: &'a Evaluation,
}

impl Claim<'_> {
    /// Displacements, site forces (nominal) and multipliers.
    pub fn answer(&self) -> Answer {
        let pair = |(state, found): (&crate::model::PairState, &crate::contact::InterfaceForces)| PairAnswer {
            loads: found
                .sites
                .iter()
                .map(|site| SiteLoad {
                    arc: site.arc,
                    pressure: site.pressure * site.stretch,
                    traction: site.traction * site.stretch,
                })
                .collect(),
            pressure: state.pressure.clone(),
            traction: state.traction.clone(),
        };
        let pairs = self.state.pairs.iter().zip(&self.evaluation.interfaces).map(pair).collect();
        Answer { u: self.state.u.clone(), pairs }
    }
}

/// Verdict on a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The certificate holds and the conic method finds the same solution.
    Agrees,
    /// Nothing is proven, and why.
    Inconclusive(String),
    /// The claim is no solution, or not the one that the conic method finds.
    Disagrees(String),
}

impl Verdict {
    /// `agrees`, `inconclusive` or `disagrees`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Inconclusive(_) => "inconclusive",
            Self::Disagrees(_) => "disagrees",
        }
    }

    /// Why, where it does not agree.
    pub fn reason(&self) -> &str {
        match self {
            Self::Agrees => "",
            Self::Inconclusive(why) | Self::Disagrees(why) => why,
        }
    }
}

/// Relative differences of two solutions of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Displacements, of an element length.
    pub u: f64,
    /// Site pressures, of the peak pressure.
    pub p: f64,
    /// Site tractions, of the peak pressure.
    pub q: f64,
    /// `Fx` and `Fy`, of the force.
    pub force: [f64; 2],
}

/// Outcome for one step.
#[derive(Clone, Debug)]
pub struct Check {
    /// Time at the end of the step.
    pub time: f64,
    /// What one programme at the claimed solution says.
    pub certificate: Certificate,
    /// Independent solution from the same start, or why there is none.
    pub solved: Result<Solved, Unsolved>,
    /// Its differences to the claim.
    pub difference: Option<Difference>,
    /// Wall time of certificate and solution in seconds.
    pub wall_s: f64,
    /// Verdict.
    pub verdict: Verdict,
}

/// Checks what is claimed of the end of a step from `start`.
pub fn check(model: &Model, start: &State, claim: Claim, stage: &mut Stage, interrupt: &AtomicBool) -> Check {
    let clock = Instant::now();
    let time = claim.state.time;
    let certificate = certify(model, start, claim, stage);
    let solved = from_start(model, start, (time, GOAL), stage, interrupt);
    let difference = solved.as_ref().ok().map(|solved| difference(model, claim, solved));
    let verdict = judge(&certificate, &solved, difference.as_ref());
    Check { time, certificate, solved, difference, wall_s: clock.elapsed().as_secs_f64(), verdict }
}

/// Solves a step from the state at its start with the driven bodies moved, to a violation `goal`: by Tresca's way, and by De Saxce's
/// where that does not come to rest.
///
/// # Errors
/// Why Tresca's way failed.
pub fn from_start(
    model: &Model,
    start: &State,
    (time, goal): (f64, f64),
    stage: &mut Stage,
    interrupt: &AtomicBool,
) -> Result<Solved, Unsolved> {
    let guess = predict(model, start, time).u;
    let mut by = |way| solve(model, start, guess.clone(), Aim { time, way, goal }, stage, interrupt);
    by(Way::Tresca).or_else(|first| by(Way::DeSaxce).map_err(|_| first))
}

fn difference(model: &Model, claim: Claim, solved: &Solved) -> Difference {
    let claimed = claim.answer();
    let [p, q] = differ(model, &claimed.pairs, &solved.answer.pairs);
    let moved = |(a, b): (&crate::geometry::Point, &crate::geometry::Point)| (a - b).amax() / model.element_size;
    let force = record(model, claim.state, claim.evaluation).force;
    let size = force[0].hypot(force[1]).max(LEAST * model.modulus * model.size());
    let found = resistance(model, &solved.contact_forces);
    Difference {
        u: claimed.u.iter().zip(&solved.answer.u).map(moved).fold(0.0, f64::max),
        p,
        q,
        force: std::array::from_fn(|c| (force[c] - found[c]).abs() / size),
    }
}

fn judge(certificate: &Certificate, solved: &Result<Solved, Unsolved>, difference: Option<&Difference>) -> Verdict {
    if let Some(why) = certificate.broken() {
        return Verdict::Disagrees(why);
    }
    let unsure =
        format!("the solution need not be unique (friction {:.2} of the stiffness it meets)", certificate.coupling);
    let (solved, difference) = match (solved, difference) {
        (Ok(solved), Some(difference)) => (solved, difference),
        (Err(why), _) if !certificate.unique() => return Verdict::Inconclusive(format!("{why}; {unsure}")),
        (Err(why), _) => return Verdict::Inconclusive(why.to_string()),
        (Ok(_), None) => return Verdict::Inconclusive("no difference was taken".into()),
    };
    let Difference { u, p, q, force } = *difference;
    let limits =
        [("u", u, STRESS), ("p", p, STRESS), ("q", q, STRESS), ("Fx", force[0], FORCE), ("Fy", force[1], FORCE)];
    let apart: Vec<String> = limits
        .iter()
        .filter(|(_, value, limit)| value.is_nan() || value > limit)
        .map(|(name, value, limit)| format!("{name} differs by {value:.1e} (accepted {limit:.0e})"))
        .collect();
    let accuracy = solved.violation.worst();
    match (apart.is_empty(), certificate.unique()) {
        (true, _) => Verdict::Agrees,
        (false, false) => Verdict::Inconclusive(format!("{}; {unsure}", apart.join(", "))),
        (false, true) if accuracy > FORCE => Verdict::Inconclusive(format!(
            "{}, but the conic solution is no better than {accuracy:.1e}",
            apart.join(", ")
        )),
        (false, true) => Verdict::Disagrees(format!("{} after {} programmes", apart.join(", "), solved.programmes)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::conditions::Violation;
    use super::*;

    /// A difference is a disagreement where the solution is unique and the conic one accurate, and no proof of anything else.
    #[test]
    fn differences_are_judged_by_uniqueness_and_accuracy() {
        let certificate = |coupling| Certificate { coupling, ..Certificate::default() };
        let solved = |violation| {
            let violation = Violation { equilibrium: violation, ..Violation::default() };
            let answer = Answer { u: vec![], pairs: vec![] };
            Ok(Solved { answer, violation, contact_forces: vec![], way: Way::Tresca, programmes: 3, iterations: 40 })
        };
        let apart = Difference { p: 1e-3, ..Difference::default() };
        let verdict = |coupling, violation| judge(&certificate(coupling), &solved(violation), Some(&apart));
        assert!(matches!(verdict(0.5, 1e-9), Verdict::Disagrees(why) if why.contains("p differs by 1.0e-3")));
        assert!(matches!(verdict(1.3, 1e-9), Verdict::Inconclusive(why) if why.contains("need not be unique")));
        assert!(matches!(verdict(0.5, 1e-5), Verdict::Inconclusive(why) if why.contains("no better than")));
        let none = Err(Unsolved::Programme("Clarabel answers InsufficientProgress".into()));
        assert!(
            matches!(judge(&certificate(0.5), &none, None), Verdict::Inconclusive(why) if why.contains("Clarabel"))
        );
        assert_eq!(judge(&certificate(1.3), &solved(1e-9), Some(&Difference::default())), Verdict::Agrees);
    }
}
