//! Steep, soft asperities lose their equilibrium path behind the apex: the run crosses the snap, goes on behind it, and accounts
//! for the energy set free.

mod support;

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use asperity::math::CondensedSolver;
use asperity::model::{Model, Record, State};
use asperity::solve::{Control, Outcome, Rung, Strategy, Tools, Witness, proceed};
use support::{Pass, Run, done};

/// Flanks of 60 degrees, overlapping by half of their height.
fn steep() -> Pass {
    let height = 1.6 * 60.0_f64.to_radians().tan() / PI;
    Pass { friction: 0.0, height, overlap: 0.5 * height, ..Pass::default() }
}

fn end(run: &Run) -> &Record {
    run.records.last().expect("a whole pass")
}

/// Without friction all of the path but the snap conserves energy, and the bodies end as they began, apart: the work of the
/// drive over the pass is what the snap set free. The work is summed over the whole pass, the loss taken at the crossing.
#[test]
fn work_of_a_frictionless_pass_is_the_energy_set_free() {
    let coarse = done(&steep());
    let fine = done(&Pass { steps: 304, ..steep() });
    for run in [&coarse, &fine] {
        let (work, loss) = (end(run).external_work, end(run).snap_loss);
        let peak = run.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
        assert!(run.outcome.snaps >= 1 && loss > 0.3 * peak, "{} snaps, {loss:.3e} of {peak:.3e}", run.outcome.snaps);
        assert!((work - loss).abs() < 5e-3 * peak, "work {work:.4e}, set free {loss:.4e}, largest energy {peak:.4e}");
        assert!(end(run).strain_energy < 1e-9 * peak && end(run).dissipated == 0.0);
        let marked: usize = run.records.iter().map(|r| r.snaps).sum();
        assert_eq!(marked, run.outcome.snaps);
    }
    let change = end(&fine).snap_loss / end(&coarse).snap_loss - 1.0;
    assert!(change.abs() < 0.1, "the energy set free changes by {change:.2e} with four times the steps");
}

/// Driven the other way the snap happens at the mirrored place and sets the same energy free.
#[test]
fn the_mirrored_pass_snaps_alike() {
    let there = done(&steep());
    let back = done(&Pass { from: 1.9, to: -1.9, ..steep() });
    let (a, b) = (end(&there).snap_loss, end(&back).snap_loss);
    assert!((a - b).abs() < 1e-3 * a, "{a:.6e} and {b:.6e}");
    let places = |run: &Run| run.records.iter().filter(|r| r.snaps > 0).map(|r| r.step).collect::<Vec<_>>();
    assert_eq!(places(&there), places(&back));
}

/// Offers what another run found at the next time that it reported.
struct Knows(Vec<State>);

impl Witness for Knows {
    fn rescue(&mut self, model: &Model, start: &State, time: f64, _: &AtomicBool) -> Option<State> {
        let known = self.0.iter().find(|state| state.time >= time)?;
        let mut guess = State { u: known.u.clone(), ..start.clone() };
        guess.pairs.iter_mut().zip(&known.pairs).for_each(|(pair, known)| pair.pressure.clone_from(&known.pressure));
        guess.prescribe(model, time);
        Some(guess)
    }
}

/// A guess from behind the end of the path leads over the snap in one converging step: that is found out, and the snap crossed and
/// told all the same.
#[test]
fn a_rescue_does_not_hide_a_snap() {
    let (known, never) = (done(&steep()), AtomicBool::new(false));
    let control = Control { end: 1.0, steps: 76, max_cuts: 8, strategy: Strategy::default() };
    let (mut solver, mut witness) = (CondensedSolver::default(), Knows(known.states.clone()));
    let tools = Tools { solver: &mut solver, witness: &mut witness };
    let from = Outcome::at(State::initial(&known.model));
    let Ok(outcome) = proceed(&known.model, from, &control, tools, &never, |_| Ok::<(), std::convert::Infallible>(()));
    let ledger = &outcome.state.ledger;
    println!("{} snaps, set free {:.4e}, work {:.4e}", outcome.snaps, ledger.snap_loss, ledger.external_work);
    let mut left = outcome.log.events.iter().flat_map(|event| &event.tried);
    assert!(left.any(|t| t.rung == Rung::Conic && t.reason.contains("leapt to another equilibrium path")));
    let peak = known.records.iter().fold(0.0_f64, |m, r| m.max(r.strain_energy));
    assert!(outcome.snaps > 0 && (ledger.external_work - ledger.snap_loss).abs() < 5e-3 * peak);
}

/// Gentle slopes have no snap.
#[test]
fn a_gentle_pass_has_none() {
    let run = done(&Pass { friction: 0.3, ..Pass::default() });
    assert_eq!((run.outcome.snaps, end(&run).snap_loss), (0, 0.0));
}

/// With friction what is left of the work is what friction took.
#[test]
fn work_is_friction_and_snap() {
    let run = done(&Pass { friction: 0.3, steps: 304, ..steep() });
    let last = end(&run);
    let missing = last.external_work - last.dissipated - last.snap_loss;
    assert!(run.outcome.snaps >= 1 && last.snap_loss > 0.1 * last.external_work);
    assert!(missing.abs() < 0.02 * last.external_work, "{missing:.2e} of {:.3e}", last.external_work);
}
