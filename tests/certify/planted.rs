//! Errors planted into the claim of the Newton method: each is found.

use std::sync::atomic::AtomicBool;

use asperity::contact::{ContactStatus, Sites};
use asperity::laws::builtin::Coulomb;
use asperity::model::{Evaluation, Model, State, Tangent, evaluate};
use asperity::verify::conic::{Claim, Stage, Verdict, check};
use std::sync::Arc;

use super::support::{Pass, Run, pass, run};

const FRICTION: f64 = 1.0;

/// What is done to a claim.
type Plant = fn(&mut Evaluation);

/// A climb in which part of the contact sticks, by both kinds of sites.
fn climbs() -> [Run; 2] {
    [Sites::Nodal, Sites::Quadrature].map(|sites| {
        let setup = Pass {
            friction: FRICTION,
            sites: Some(sites),
            element: 0.1,
            steps: 16,
            from: -0.6,
            to: -0.2,
            ..Pass::default()
        };
        run(pass(&setup), setup.steps)
    })
}

/// The first step at whose end sites stick and slip, from its start.
fn mixed(found: &Run) -> (State, State) {
    let start = |k: usize| if k == 0 { State::initial(&found.model) } else { found.states[k - 1].clone() };
    let has = |k: usize, status| found.rows[k].iter().any(|row| row.status == status);
    let k = (0..found.states.len()).find(|&k| has(k, ContactStatus::Stick) && has(k, ContactStatus::Slip));
    let k = k.expect("a step with stick and slip");
    (start(k), found.states[k].clone())
}

fn verdict(model: &Model, start: &State, state: &State, plant: impl FnOnce(&mut Evaluation)) -> Verdict {
    let mut evaluation = evaluate(model, start, state, Tangent::None).expect("evaluates");
    plant(&mut evaluation);
    let claim = Claim { state, evaluation: &evaluation };
    check(model, start, claim, &mut Stage::default(), &AtomicBool::new(false)).verdict
}

/// The site of a status with the largest pressure.
fn strongest(evaluation: &mut Evaluation, status: ContactStatus) -> &mut asperity::contact::SiteRecord {
    let sites = evaluation.interfaces[0].sites.iter_mut().filter(|site| site.status == status);
    sites.max_by(|a, b| a.pressure.total_cmp(&b.pressure)).expect("such a site")
}

#[test]
fn planted_errors_disagree() {
    for found in climbs() {
        let (start, end) = mixed(&found);
        let judged = |plant: Plant| verdict(&found.model, &start, &end, plant);
        assert_eq!(judged(|_| ()), Verdict::Agrees);
        let plants: [(&str, Plant); 5] = [
            ("friction sign", |e| strongest(e, ContactStatus::Slip).traction *= -1.0),
            ("pressure times 1.001", |e| strongest(e, ContactStatus::Slip).pressure *= 1.001),
            ("stick marked slip", |e| strongest(e, ContactStatus::Stick).status = ContactStatus::Slip),
            ("traction beyond its bound", |e| strongest(e, ContactStatus::Slip).traction *= 1.0001),
            ("a closed site marked open", |e| strongest(e, ContactStatus::Stick).status = ContactStatus::Open),
        ];
        for (name, plant) in plants {
            let said = judged(plant);
            println!("{name}: {said:?}");
            assert!(matches!(said, Verdict::Disagrees(_)), "{name}: {said:?}");
        }
    }
}

/// The claim of a model with another coefficient of friction.
#[test]
fn a_wrong_bound_disagrees() {
    let friction = 0.3;
    for (sites, wrong) in [(Sites::Nodal, 1.001), (Sites::Quadrature, 0.999)] {
        let setup =
            Pass { friction, sites: Some(sites), element: 0.2, steps: 8, from: -0.6, to: -0.2, ..Pass::default() };
        let claimed =
            run(pass(&Pass { law: Some(Arc::new(Coulomb { friction: friction * wrong })), ..setup.clone() }), 8);
        let model = pass(&setup);
        let k = 3;
        let evaluation = evaluate(&claimed.model, &claimed.states[k - 1], &claimed.states[k], Tangent::None).unwrap();
        let claim = Claim { state: &claimed.states[k], evaluation: &evaluation };
        let said = check(&model, &claimed.states[k - 1], claim, &mut Stage::default(), &AtomicBool::new(false)).verdict;
        assert!(matches!(&said, Verdict::Disagrees(_)), "{said:?}");
    }
}

/// A solution of other equations: the bodies are not in equilibrium.
#[test]
fn displacements_off_equilibrium_disagree() {
    let found = &climbs()[1];
    let (start, mut end) = mixed(found);
    let node = found.model.pairs[0].nonmortar.nodes[0];
    end.u[node].y += 1e-6;
    let said = verdict(&found.model, &start, &end, |_| ());
    assert!(matches!(&said, Verdict::Disagrees(why) if why.contains("equilibrium")), "{said:?}");
}
