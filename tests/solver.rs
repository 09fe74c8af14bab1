//! The condensed solver against dense LU, the reference solver and itself.

mod support;

use std::path::Path;
use std::sync::Arc;

use asperity::math::{
    CondensedSolver, Counters, DenseLu, DenseMatrix, LinearSolver, Pattern, SolveError, SparseLu, SparseMatrix, System,
};
use asperity::model::{Model, State};
use asperity::scene::{self, Scene};
use asperity::solve::{self, Status};
use proptest::prelude::*;
use support::{Pass, climb, pass, run_by};

/// Two chains of `n` masses with springs to their second neighbours; unknown `i` belongs to chain `i % 2`.
#[derive(Clone, Debug)]
struct Chains {
    n: usize,
    springs: Vec<f64>,
    boundary: Vec<usize>,
    multipliers: usize,
    coupling: Vec<(usize, usize, f64)>,
}

impl Chains {
    /// Symmetric positive definite but for `ground` on each diagonal entry.
    fn system(&self, ground: f64) -> System {
        let n = 2 * self.n;
        let reach = |i: usize| [i, i + 2, i + 4].into_iter().filter(move |j| *j < n);
        let pattern = Pattern::from_cliques(n, (0..n).map(|i| reach(i).collect()));
        let mut values = vec![0.0; pattern.rows.len()];
        for i in 0..n {
            let mut add = |a, b, v| values[pattern.position(a, b).expect("in the pattern")] += v;
            add(i, i, ground);
            for (k, j) in reach(i).skip(1).enumerate() {
                let c = self.springs[2 * i + k];
                [(i, i, c), (j, j, c), (i, j, -c), (j, i, -c)].into_iter().for_each(|(a, b, v)| add(a, b, v));
            }
        }
        System {
            n: n + self.multipliers,
            bulk: SparseMatrix { pattern: Arc::new(pattern), values },
            interface: self.coupling.clone(),
            boundary: self.boundary.clone().into(),
        }
    }
}

/// Chains whose boundary and multipliers are coupled by random entries, none of them symmetric. More multipliers carry
/// nothing: each is coupled with its neighbours only.
fn chains() -> impl Strategy<Value = Chains> {
    (3..40_usize, 0..6_usize).prop_flat_map(|(n, multipliers)| {
        let idle = proptest::collection::vec((-5.0..-0.5, -1.0..1.0, -1.0..1.0), 0..12);
        let boundary = proptest::sample::subsequence((0..2 * n).collect::<Vec<_>>(), 1..=n);
        let springs = proptest::collection::vec(0.1..10.0, 4 * n);
        let entry = (any::<prop::sample::Index>(), any::<prop::sample::Index>(), -3.0..3.0);
        let entries = proptest::collection::vec(entry, 0..60);
        (boundary, springs, entries, idle).prop_map(move |(boundary, springs, entries, idle)| {
            let outer: Vec<usize> = boundary.iter().copied().chain(2 * n..2 * n + multipliers).collect();
            let mut coupling: Vec<_> = entries.iter().map(|(i, j, v)| (*i.get(&outer), *j.get(&outer), *v)).collect();
            coupling.extend((2 * n..2 * n + multipliers).map(|e| (e, e, -20.0)));
            coupling.push((0, 0, 1.0)); // a spring, perhaps on the interior
            for (e, (diagonal, above, below)) in (2 * n + multipliers..).zip(&idle) {
                coupling.push((e, e, *diagonal));
                let before = (e > 2 * n).then(|| [(e - 1, e, *above), (e, e - 1, *below)]);
                coupling.extend(before.into_iter().flatten());
            }
            let multipliers = multipliers + idle.len();
            Chains { n, springs, boundary, multipliers, coupling }
        })
    })
}

fn dense(system: &System) -> DenseMatrix {
    let mut matrix = DenseMatrix::default();
    matrix.reset(system.n);
    system.for_each(|i, j, v| matrix.add(i, j, v));
    matrix
}

fn right(n: usize) -> Vec<f64> {
    (0..n).map(|i| (1.0 + i as f64).sin()).collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m, v| m.max(v.abs()))
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

proptest! {
    #[test]
    fn saddle_systems_agree_with_dense_lu(chains in chains()) {
        let system = chains.system(0.5);
        let mut solver = CondensedSolver::default();
        let (mut lu, mut expected) = (DenseLu::default(), right(system.n));
        lu.factor(&dense(&system));
        lu.solve(&mut expected);
        let size = largest(expected.iter().copied());
        prop_assume!(size < 1e4); // else the matrix is singular but for a hair
        let found = solver.solve(&system, &right(system.n)).expect("regular");
        let error = largest(found.iter().zip(&expected).map(|(a, b)| a - b));
        prop_assert!(error < 1e-10 * size, "{error:e} of {size:e}");
        let counters = solver.counters();
        prop_assert_eq!((counters.factorisations, counters.indefinite, counters.coupled), (1, 0, 0));
        let again = CondensedSolver::default().solve(&system, &right(system.n)).expect("regular");
        prop_assert_eq!(bits(&again), bits(&found));
    }
}

fn simple() -> Chains {
    let coupling = vec![(2, 3, -1.0), (2, 40, 1.0), (40, 2, 1.0), (3, 40, -1.0), (40, 3, -1.0)];
    Chains { n: 20, springs: vec![1.0; 80], boundary: vec![2, 3], multipliers: 1, coupling }
}

fn agrees(solver: &mut impl LinearSolver, system: &System) {
    let found = solver.solve(system, &right(system.n)).expect("regular");
    let expected = SparseLu::default().solve(system, &right(system.n)).expect("regular");
    let (error, size) = (largest(found.iter().zip(&expected).map(|(a, b)| a - b)), largest(expected.into_iter()));
    assert!(error < 1e-10 * size, "{error:e} of {size:e}");
}

#[test]
fn sparse_lu_takes_over_and_is_counted() {
    let mut solver = CondensedSolver::default();
    agrees(&mut solver, &simple().system(0.5));
    agrees(&mut solver, &simple().system(-0.3)); // some modes of the interior turn unstable
    let mut inward = simple();
    inward.coupling.push((2, 11, 0.5));
    agrees(&mut solver, &inward.system(0.5));
    let counters = solver.counters();
    assert_eq!((counters.factorisations, counters.indefinite, counters.coupled, counters.inaccurate), (3, 1, 1, 0));
}

#[test]
fn the_condensed_stiffness_may_be_singular_or_indefinite() {
    let mut solver = CondensedSolver::default();
    let held = |c: f64| {
        let mut chains = simple();
        chains.coupling.extend([(2, 2, c), (3, 3, c)]); // nothing else holds the chains
        chains
    };
    agrees(&mut solver, &held(2.0).system(0.0));
    agrees(&mut solver, &held(2.0).system(-1e-4));
    assert_eq!(solver.counters().indefinite, 0);
}

#[test]
fn an_unknown_that_only_the_interface_holds_is_solved_for() {
    let mut chains = simple();
    chains.coupling.extend([(2, 2, 1.0), (3, 3, 1.0)]);
    let mut system = chains.system(0.0);
    let (pattern, values) = (&system.bulk.pattern, &mut system.bulk.values);
    for (j, range) in pattern.columns.windows(2).enumerate() {
        (range[0]..range[1]).filter(|&k| [pattern.rows[k], j].contains(&39)).for_each(|k| values[k] = 0.0);
    }
    system.boundary = [39, 3, 2].into();
    system.interface.extend([(39, 39, 2.0), (39, 2, 0.5), (2, 39, 0.25)]);
    let mut solver = CondensedSolver::default();
    agrees(&mut solver, &system);
    assert_eq!(solver.counters().indefinite, 0);
}

#[test]
fn a_singular_matrix_is_an_error() {
    let mut system = simple().system(0.5);
    let singular = |found: Result<Vec<f64>, SolveError>| {
        assert!(found.as_ref().map_or(true, |x| x.iter().all(|v| v.is_finite())));
        assert!(found.is_err(), "{found:?}");
    };
    system.interface.clear(); // a multiplier without equation
    singular(CondensedSolver::default().solve(&system, &right(system.n)));
    system.bulk.values[0] = f64::NAN;
    singular(CondensedSolver::default().solve(&system, &right(system.n)));
}

#[test]
fn an_unchanged_bulk_is_not_factored_again() {
    let (mut solver, mut chains) = (CondensedSolver::default(), simple());
    agrees(&mut solver, &chains.system(0.5));
    chains.coupling.extend([(2, 2, 3.0), (40, 40, -1.0)]);
    let changed = chains.system(0.5);
    agrees(&mut solver, &changed);
    assert_eq!(solver.counters().factorisations, 1);
    let again = solver.solve(&changed, &right(changed.n)).expect("regular");
    let fresh = CondensedSolver::default().solve(&changed, &right(changed.n)).expect("regular");
    assert_eq!(bits(&again), bits(&fresh));
    agrees(&mut solver, &chains.system(0.6));
    assert_eq!(solver.counters().factorisations, 2);
}

/// Contact of three unknowns and a multiplier that moves along a boundary of forty.
fn walk(place: usize, idle: usize) -> Chains {
    let bound = 80 + place % (1 + idle);
    let on = [place, place + 1, place + 2];
    let mut coupling: Vec<_> = on.iter().flat_map(|&i| [(i, bound, 1.0), (bound, i, -1.0), (i, on[0], 0.5)]).collect();
    coupling.extend((80..81 + idle).map(|e| (e, e, -4.0)));
    coupling.extend((81..81 + idle).flat_map(|e| [(e, e - 1, -1.0), (e - 1, e, -1.0)]));
    Chains { n: 40, springs: vec![1.0; 160], boundary: (0..40).collect(), multipliers: 1 + idle, coupling }
}

#[test]
fn the_dense_block_follows_the_contact() {
    let systems: Vec<System> = (0..38).map(|place| walk(place, 20).system(0.5)).collect();
    let mut solver = CondensedSolver::default();
    systems.iter().for_each(|system| agrees(&mut solver, system));
    let counters = solver.counters();
    assert!(counters.analyses > 2 && counters.analyses < 38, "{counters:?}");
    assert!(counters.dense_rows < 40, "of 40 unknowns and 21 multipliers: {counters:?}");
    assert_eq!((counters.indefinite, counters.coupled, counters.inaccurate), (0, 0, 0));
    let pass = || {
        let mut solver = CondensedSolver::default();
        systems.iter().map(|s| bits(&solver.solve(s, &right(s.n)).expect("regular"))).collect::<Vec<_>>()
    };
    assert_eq!(pass(), pass());
}

#[test]
fn a_small_block_stays_as_it_is() {
    let setup = Pass { element: 0.1, ..climb() };
    let (model, mut solver) = (pass(&setup), CondensedSolver::default());
    march(&model, setup.steps, &mut solver);
    assert!(solver.counters().analyses == 1, "{:?}", solver.counters());
}

/// Forces and positions after some steps into contact.
fn march(model: &Model, steps: usize, solver: &mut dyn LinearSolver) -> State {
    let control = solve::Control { end: 1.0, steps, max_cuts: 8, strategy: Default::default() };
    let quiet = std::sync::atomic::AtomicBool::new(false);
    let report = |_: solve::StepReport| Ok::<(), std::convert::Infallible>(());
    let outcome = solve::march(model, State::initial(model), &control, solver, &quiet, report);
    let outcome = outcome.unwrap_or_else(|never| match never {});
    assert_eq!(outcome.status, Status::Done);
    outcome.state
}

/// Solves with both solvers, and again with the condensed one; what the latter took.
fn compare(model: &Model, steps: usize) -> Counters {
    let mut condensed = CondensedSolver::default();
    let found = march(model, steps, &mut condensed);
    let expected = march(model, steps, &mut SparseLu::default());
    let again = march(model, steps, &mut CondensedSolver::default());
    let size = largest(expected.u.iter().map(|u| u.amax()));
    let error = largest(found.u.iter().zip(&expected.u).map(|(a, b)| (a - b).amax()));
    println!("difference of the displacements {:.1e}", error / size);
    assert!(error < 1e-10 * size, "{error:e} of {size:e}");
    let pressures = |state: &State| state.pairs.iter().flat_map(|p| p.pressure.clone()).collect::<Vec<f64>>();
    let size = largest(pressures(&expected).into_iter());
    let error = largest(pressures(&found).iter().zip(pressures(&expected)).map(|(a, b)| a - b));
    assert!(size > 0.0 && error < 1e-10 * size, "pressures: {error:e} of {size:e}");
    assert_eq!(bits(&pressures(&found)), bits(&pressures(&again)));
    let counters = condensed.counters();
    assert_eq!((counters.indefinite, counters.coupled, counters.inaccurate), (0, 0, 0));
    counters
}

#[test]
fn a_climb_is_that_of_the_reference_solver_and_repeats_itself() {
    for setup in [climb(), Pass { lagrange: true, degree: 1, ..climb() }] {
        compare(&pass(&setup), setup.steps);
    }
}

#[test]
fn an_inner_loop_on_the_interface_finds_the_same_solution() {
    let setup = Pass { element: 0.1, from: -0.6, to: 0.2, steps: 16, ..Pass::default() };
    let [monolithic, interface] = [solve::Strategy::Monolithic, solve::Strategy::Interface]
        .map(|strategy| run_by(pass(&setup), setup.steps, strategy));
    assert_eq!(interface.outcome.status, solve::Status::Done);
    for (a, b) in monolithic.records.iter().zip(&interface.records) {
        for c in 0..2 {
            assert!((a.force[c] - b.force[c]).abs() < 1e-8 * monolithic.peak(c), "step {}", a.step);
        }
    }
    println!("linear solves with a new bulk: {} and {}", monolithic.outcome.iterations, interface.outcome.iterations);
    assert!(interface.outcome.iterations < monolithic.outcome.iterations);
}

#[test]
fn several_contacts_are_those_of_the_reference_solver() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/multi_asperity.toml");
    let (scene, _) = Scene::load(&file, &[]).expect("an example");
    let model = scene::build(&scene, Path::new(".")).expect("an example");
    let counters = compare(&model, 10);
    assert!(counters.analyses > 1, "{counters:?}");
    assert!(counters.dense_rows < model.boundary.len(), "{counters:?}");
}
