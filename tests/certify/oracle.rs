//! Small problems with random stiffness against the list of all their solutions.

use std::cell::Cell;

use asperity::verify::conic::programme::{Cone, Facing, Friction, Programme, Site};
use asperity::verify::conic::uniqueness::{Pattern, coupling};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};

/// `k` sites, each with its own normal and tangential displacement.
#[derive(Clone, Debug)]
struct Problem {
    stiffness: DMatrix<f64>,
    force: Vec<f64>,
    friction: f64,
}

impl Problem {
    fn sites(&self) -> usize {
        self.force.len() / 2
    }

    fn programme(&self, bounds: &[f64]) -> Programme {
        let site = |(k, bound): (usize, &f64)| Site {
            weight: 1.0,
            r: [1.0; 2],
            reads: vec![(k, 1.0)],
            relaxed: false,
            rubs: true,
            facing: Some(Facing {
                gap: 0.0,
                gap_row: vec![(2 * k, 1.0)],
                slip: [0.0],
                slip_rows: [vec![(2 * k + 1, 1.0)]],
                friction: Friction::Cone(Cone { constant: *bound, slope: 0.0, hardening: 0.0, shift: 0.0 }),
            }),
        };
        let sites = bounds.iter().enumerate().map(site).collect();
        let (stiffness, force) = (self.stiffness.clone(), self.force.clone());
        Programme { stiffness, force, sites, multipliers: self.sites(), modulus: 1.0, length: 1.0 }
    }

    /// `p, q` of the solution under a pattern (0 open, 1 stick, 2 and 3 slip), where it satisfies all conditions.
    fn under(&self, pattern: &[usize]) -> Option<Vec<[f64; 2]>> {
        let n = self.force.len();
        let mut matrix = DMatrix::zeros(2 * n, 2 * n);
        let mut right = DVector::zeros(2 * n);
        matrix.view_mut((0, 0), (n, n)).copy_from(&self.stiffness);
        for (k, &state) in pattern.iter().enumerate() {
            let (u, v, p, q) = (2 * k, 2 * k + 1, n + 2 * k, n + 2 * k + 1);
            (right[u], right[v]) = (-self.force[u], -self.force[v]);
            (matrix[(u, p)], matrix[(v, q)]) = (-1.0, 1.0);
            matrix[if state == 0 { (p, p) } else { (p, u) }] = 1.0;
            match state {
                0 => matrix[(q, q)] = 1.0,
                1 => matrix[(q, v)] = 1.0,
                _ => {
                    let sign = if state == 2 { 1.0 } else { -1.0 };
                    (matrix[(q, q)], matrix[(q, p)]) = (1.0, -sign * self.friction);
                }
            }
        }
        let x = matrix.lu().solve(&right)?;
        let small = 1e-9;
        let holds = pattern.iter().enumerate().all(|(k, &state)| {
            let (u, v, p, q) = (x[2 * k], x[2 * k + 1], x[n + 2 * k], x[n + 2 * k + 1]);
            match state {
                0 => u >= -small,
                1 => p >= -small && q.abs() <= self.friction * p + small,
                2 => p >= -small && v >= -small,
                _ => p >= -small && v <= small,
            }
        });
        holds.then(|| (0..self.sites()).map(|k| [x[n + 2 * k], x[n + 2 * k + 1]]).collect())
    }

    fn patterns(&self) -> impl Iterator<Item = Vec<usize>> {
        let sites = self.sites();
        (0..4_usize.pow(sites as u32)).map(move |code| (0..sites).map(|k| code / 4_usize.pow(k as u32) % 4).collect())
    }

    /// All solutions, each once.
    fn all(&self) -> Vec<Vec<[f64; 2]>> {
        let mut found: Vec<Vec<[f64; 2]>> = vec![];
        let apart = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            a.iter().flatten().zip(b.iter().flatten()).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        };
        for solution in self.patterns().filter_map(|pattern| self.under(&pattern)) {
            if found.iter().all(|other| apart(other, &solution) > 1e-6) {
                found.push(solution);
            }
        }
        found
    }

    /// Largest coupling over all patterns: below 1 the map of Tresca's way contracts everywhere.
    fn coupling(&self) -> f64 {
        let programme = self.programme(&vec![0.0; self.sites()]);
        let of = |state: &usize| match state {
            0 => Pattern::Open,
            1 => Pattern::Stick(self.friction),
            _ => Pattern::Slip(self.friction),
        };
        self.patterns().map(|p| coupling(&programme, &p.iter().map(of).collect::<Vec<_>>())).fold(0.0, f64::max)
    }

    /// Tresca's way.
    fn conic(&self) -> Option<Vec<[f64; 2]>> {
        let mut bounds = vec![0.0; self.sites()];
        for _ in 0..2000 {
            let found = self.programme(&bounds).solve().ok()?;
            let next: Vec<f64> = found.pressure.iter().map(|p| self.friction * p.max(0.0)).collect();
            let moved = next.iter().zip(&bounds).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
            bounds = next;
            if moved < 1e-8 {
                return Some(found.pressure.iter().zip(&found.traction).map(|(p, q)| [*p, q[0]]).collect());
            }
        }
        None
    }
}

fn problems() -> impl Strategy<Value = Problem> {
    (1_usize..=3).prop_flat_map(|sites| {
        let n = 2 * sites;
        let entries = prop::collection::vec(-1.0..1.0, n * n);
        (entries, prop::collection::vec(-1.0..1.0, n), prop_oneof![0.05..1.0, 1.0..20.0], 0.1..1.0).prop_map(
            move |(a, force, friction, base)| {
                let a = DMatrix::from_vec(n, n, a);
                Problem { stiffness: &a * a.transpose() + DMatrix::identity(n, n) * base, force, friction }
            },
        )
    })
}

#[test]
fn one_solution_where_the_criterion_says_so_and_the_conic_method_finds_it() {
    let [unique, several] = [0; 2].map(Cell::new);
    let config = Config { cases: 800, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() };
    let outcome = TestRunner::new(config).run(&problems(), |problem| {
        let (solutions, coupling) = (problem.all(), problem.coupling());
        if coupling < 0.95 {
            unique.update(|n| n + 1);
            prop_assert_eq!(solutions.len(), 1, "coupling {}", coupling);
            let found = problem.conic().expect("a contraction");
            for (a, b) in found.iter().flatten().zip(solutions[0].iter().flatten()) {
                prop_assert!((a - b).abs() < 1e-5, "{:?} against {:?}", found, solutions[0]);
            }
        }
        if solutions.len() != 1 {
            several.update(|n| n + 1);
            prop_assert!(coupling >= 1.0, "{} solutions at coupling {coupling}", solutions.len());
        }
        Ok(())
    });
    outcome.expect("all problems");
    let [unique, several] = [unique, several].map(Cell::into_inner);
    println!("{unique} unique by the criterion, {several} with none or several solutions");
    assert!(unique > 200 && several > 5);
}

/// `mu |k_nt| < k_t` (theory 6.1).
#[test]
fn one_site_has_the_classical_criterion() {
    let stiffness = DMatrix::from_row_slice(2, 2, &[2.0, 0.7, 0.7, 1.5]);
    let problem = Problem { stiffness, force: vec![-1.0, 0.3], friction: 1.2 };
    assert!((problem.coupling() - 1.2 * 0.7 / 1.5).abs() < 1e-12);
}
