//! Inertia: consistent mass, and the time integration of Wood, Bossak and Zienkiewicz.
//!
//! With displacement `u`, velocity `v` and acceleration `a` at the start of a step `dt`, the same with a dash at its end, and `R` all
//! forces without inertia (bulk, contact, friction, loads),
//!
//! ```text
//! u' = u + dt v + dt^2 [(1/2 - beta) a + beta a']         v' = v + dt [(1 - gamma) a + gamma a']
//! M [(1 - alpha) a' + alpha a] + R(u', p', q') = 0
//! alpha = (rho - 1)/(rho + 1)     gamma = 1/2 - alpha     beta = (1 - alpha)^2/4         0 <= rho <= 1
//! ```
//!
//! This is the generalised-alpha method (Chung and Hulbert, J. Appl. Mech. 60 (1993) 371) at `alpha_f = 0` (Wood, Bossak and
//! Zienkiewicz, Int. J. Numer. Meth. Eng. 15 (1980) 1562). It is of second order and, for linear bodies, stable at any `dt`; `rho` is
//! the factor by which the amplitude of vibrations too fast for the steps shrinks per step (spectral radius at infinite
//! frequency). `rho = 1` is the trapezoidal rule.
//!
//! Why `alpha_f = 0`. The general method balances forces in between, `(1 - alpha_f) R(u') + alpha_f R(u)`. A contact that opens
//! during the step would still push with `alpha_f` of its old force, one that closes with `1 - alpha_f` of its new one, and complementarity
//! and cone would hold for forces that nothing balances. Here contact and friction are what they are in a quasi-static step:
//! conditions and balance hold together, at its end, and as `dt -> infinity` or `M -> 0` the step is the quasi-static one.
//!
//! Impacts. A control point with mass that meets an obstacle changes its velocity at once, and its contact force is an impulse of
//! one step: contact chatters, and at `rho` near 1 gives more energy than it took. So the control points of contact edges have no
//! mass here (mass redistribution: Khenous, Laborde and Renard, Eur. J. Mech. A/Solids 27 (2008) 918): in the kinetic energy their
//! velocity is continued linearly from the two rows behind, see [`Continued`], so that mass, centre and moment of inertia of
//! a body are exact. They follow as in a quasi-static step, and what they exert on the rest is a convex potential.
//!
//! Energy. With the inertia force `I = M [(1 - alpha) a' + alpha a]` the integrator takes away
//!
//! ```text
//! 1/2 (I + I').(u' - u) - (T' - T) ,      T = 1/2 v.M v
//! ```
//!
//! per step (reported as `numerical_loss`): by the two equations of the first line zero at `rho = 1`. External work then is stored,
//! kinetic, dissipated and numerical loss, up to the trapezoidal rule, as without inertia.
//!
//! Mass. The mass of the reference body is constant at finite strain, and consistent: it fits the pattern of the stiffness,
//! and its frequencies converge at twice the rate of lumped ones (order `2p` against 2). Rigid bodies have no mass.
//!
//! Prescribed displacements come from tables with kinks. Their velocity is the mean one of the step, their acceleration its
//! change: a kink is an impulse on the edge in one step, and does not ring on. At time 0 a driven edge has the velocity of its table.

use std::sync::Arc;

use crate::bulk::masses;
use crate::geometry::Point;
use crate::math::{Pattern, SparseMatrix};

use super::continued::Continued;
use super::{Body, Dof, Model, State};

/// What inertia needs to know of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Matter {
    /// Mass per reference volume (stress time^2/length^2).
    pub density: f64,
    /// Velocity of the whole body at time 0 (length/time).
    pub velocity: [f64; 2],
}

/// Mass of the bodies and the integrator.
#[derive(Clone, Debug)]
pub struct Inertia {
    /// Spectral radius at infinite frequency.
    pub spectral_radius: f64,
    alpha: f64,
    /// Consistent mass between control points, the same in both directions.
    mass: SparseMatrix,
    /// The same between unknowns: lower half, on the pattern of the bulk stiffness.
    pub(super) entries: Vec<f64>,
    /// Its diagonal, for each displacement unknown.
    pub(super) diagonal: Vec<f64>,
    /// Velocity of every control point at time 0, before the drives.
    pub(super) velocity: Vec<Point>,
    continued: Continued,
}

impl Inertia {
    pub(super) fn new(model: &Model, spectral_radius: f64, matter: impl Fn(&Body) -> Matter) -> Self {
        let mut elements = vec![];
        let continued = Continued::new(model);
        let mut velocity = vec![Point::zeros(); model.nodes()];
        for body in &model.bodies {
            let Some(patch) = body.patch() else { continue };
            let Matter { density, velocity: [x, y] } = matter(body);
            velocity[body.nodes()].fill(Point::new(x, y));
            masses(patch, |nodes, mass| {
                elements.push((
                    nodes.iter().map(|a| body.offset + a).collect(),
                    mass.iter().map(|m| density * m).collect(),
                ));
            });
        }
        let mass = assemble(model.nodes(), &elements, &continued);
        let (entries, diagonal) = at_unknowns(model, &mass);
        let alpha = (spectral_radius - 1.0) / (spectral_radius + 1.0);
        Self { spectral_radius, alpha, mass, entries, diagonal, velocity, continued }
    }

    /// `M field`, e.g. the momentum of every control point.
    pub fn times(&self, field: &[Point]) -> Vec<Point> {
        let mut product = vec![Point::zeros(); field.len()];
        let Pattern { columns, rows, .. } = &*self.mass.pattern;
        for (range, x) in columns.windows(2).zip(field) {
            for k in range[0]..range[1] {
                product[rows[k]] += x * self.mass.values[k];
            }
        }
        product
    }

    /// `v.M v/2`.
    pub(super) fn kinetic_energy(&self, velocity: &[Point]) -> f64 {
        0.5 * self.times(velocity).iter().zip(velocity).map(|(a, b)| a.dot(b)).sum::<f64>()
    }

    /// Derivative of the inertia force by the displacement, in units of the mass.
    pub(super) fn factor(&self, dt: f64) -> f64 {
        4.0 / ((1.0 - self.alpha) * dt * dt)
    }

    fn beta(&self) -> f64 {
        0.25 * (1.0 - self.alpha).powi(2)
    }

    /// Where the control points would be without forces at the end of the step.
    fn coast(&self, start: &State, dt: f64) -> impl Iterator<Item = Point> {
        let share = dt * dt * (0.5 - self.beta());
        let moved = start.rates.velocity.iter().zip(&start.rates.acceleration).map(move |(v, a)| v * dt + a * share);
        start.u.iter().zip(moved).map(|(u, moved)| u + moved)
    }

    /// Displacements with the acceleration of the start: the guess that is exact in free flight.
    pub(super) fn ballistic(&self, start: &State, dt: f64) -> Vec<Point> {
        let share = dt * dt * self.beta();
        self.coast(start, dt).zip(&start.rates.acceleration).map(|(u, a)| u + a * share).collect()
    }

    /// Accelerations at the end of a step `dt` for displacements `u` there.
    pub(super) fn accelerations(&self, model: &Model, start: &State, u: &[Point], dt: f64) -> Vec<Point> {
        let share = dt * dt * self.beta();
        let nodes = self.coast(start, dt).zip(u).zip(start.u.iter().zip(&start.rates.velocity));
        let accelerations = nodes.zip(&model.equations.dofs).map(|(((coast, u), (before, v)), dofs)| {
            let (free, held) = ((u - coast) / share, ((u - before) / dt - v) / dt);
            Point::from([0, 1].map(|c| if matches!(dofs[c], Dof::Unknown(_)) { free[c] } else { held[c] }))
        });
        self.continued.apply(accelerations.collect())
    }

    /// Velocities that go with them.
    pub(super) fn velocities(&self, model: &Model, start: &State, end: &State, a: &[Point]) -> Vec<Point> {
        let (dt, gamma) = (end.time - start.time, 0.5 - self.alpha);
        let before = start.rates.velocity.iter().zip(&start.rates.acceleration).zip(a);
        let nodes = before.zip(end.u.iter().zip(&start.u)).zip(&model.equations.dofs);
        let velocities = nodes.map(|((((v, before), a), (u, u_before)), dofs)| {
            let (free, held) = (v + (before * (1.0 - gamma) + a * gamma) * dt, (u - u_before) / dt);
            Point::from([0, 1].map(|c| if matches!(dofs[c], Dof::Unknown(_)) { free[c] } else { held[c] }))
        });
        self.continued.apply(velocities.collect())
    }

    /// Inertia forces for accelerations `a` at the end of a step.
    pub(super) fn forces(&self, start: &State, a: &[Point]) -> Vec<Point> {
        let mixed =
            a.iter().zip(&start.rates.acceleration).map(|(new, old)| new * (1.0 - self.alpha) + old * self.alpha);
        self.times(&mixed.collect::<Vec<_>>())
    }
}

/// Control points and mass of one element, row by row.
type ElementMass = (Vec<usize>, Vec<f64>);

/// The mass between control points, that of continued ones given to those they are continued from.
fn assemble(nodes: usize, elements: &[ElementMass], continued: &Continued) -> SparseMatrix {
    let single = (0..nodes).map(|i| vec![i]);
    let pattern = Pattern::from_cliques(nodes, elements.iter().map(|(nodes, _)| nodes.clone()).chain(single));
    let mut mass = SparseMatrix { values: vec![0.0; pattern.rows.len()], pattern: Arc::new(pattern) };
    for (nodes, values) in elements {
        for (&i, row) in nodes.iter().zip(values.chunks_exact(nodes.len())) {
            for (&j, value) in nodes.iter().zip(row) {
                for (a, factor_a) in continued.of(i) {
                    for (b, factor_b) in continued.of(j) {
                        let place = mass.pattern.position(a, b).expect("continued within an element");
                        mass.values[place] += factor_a * factor_b * value;
                    }
                }
            }
        }
    }
    mass
}

/// Lower half on the pattern of the bulk stiffness, and diagonal.
fn at_unknowns(model: &Model, mass: &SparseMatrix) -> (Vec<f64>, Vec<f64>) {
    let pattern = &model.equations.pattern;
    let mut entries = vec![0.0; pattern.rows.len()];
    for j in 0..mass.pattern.n {
        for k in mass.pattern.columns[j]..mass.pattern.columns[j + 1] {
            for c in 0..2 {
                let unknowns = [mass.pattern.rows[k], j].map(|node| model.equations.unknown(node, c));
                if let [Some(row), Some(column)] = unknowns
                    && row >= column
                {
                    entries[pattern.position(row, column).expect("a clique of the stiffness")] += mass.values[k];
                }
            }
        }
    }
    let at = |e| entries[pattern.position(e, e).expect("patterns hold their diagonal")];
    let diagonal = (0..pattern.n).map(at).collect();
    (entries, diagonal)
}
