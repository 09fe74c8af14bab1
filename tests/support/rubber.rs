//! Closed forms for rubber near incompressibility: Hertz below the surface, a shrink fit, Cook's membrane.
#![allow(dead_code)] // each test binary uses its part

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use asperity::bulk::{Elements, LinearElastic, Material, Tau, VolumeSpace};
use asperity::contact::{Integration, Sites};
use asperity::geometry::shapes::Nurbs;
use asperity::geometry::{BasisSpec, Edge, Patch, Point, ShapeSpec, build};
use asperity::math::CondensedSolver;
use asperity::model::{BodyKind, BodySpec, Builder, Control, Evaluation, Model, State, Table, evaluate};
use asperity::solve::{Strategy, solve_step};
use nalgebra::Matrix2;

use crate::hertz::Case;
use crate::shrink_fit;

/// What a case leaves to the program, or demands.
pub type Choice = Option<Option<VolumeSpace>>;

/// Errors in percent of `p0`: root mean square of the contact pressure in |x| < 0.95 a, its peak, its ripple (what an
/// error does from site to site: half its second difference), and of `tau = nu (sigma_xx + sigma_yy)` in the body below
/// the contact: root mean square, and ripple from element to element.
pub fn hertz(case: &Case) -> [f64; 5] {
    let found = case.solve();
    let [a, p0] = case.hertz(found.interface.normal_force.y);
    let exact = |x: f64| p0 * (1.0 - (x / a).powi(2)).max(0.0).sqrt();
    let sites = found.pressures(Sites::Quadrature);
    let inside: Vec<_> = sites.iter().filter(|s| s[0].abs() < 0.95 * a).collect();
    let error: Vec<f64> = inside.iter().map(|s| s[1] - exact(s[0])).collect();
    let (square, scale) = inside
        .iter()
        .zip(&error)
        .fold((0.0, 0.0), |(s, t), (site, e)| (s + site[2] * e * e, t + site[2] * exact(site[0]).powi(2)));
    let peak = inside.iter().map(|s| s[1]).fold(0.0, f64::max) / p0 - 1.0;
    let ripple = error.windows(3).map(|e| (0.5 * (e[1] - 0.5 * (e[0] + e[2]))).powi(2)).sum::<f64>();
    let [body, wild] = below(case, &found.model, &found.state, a, p0);
    [(square / scale).sqrt(), peak.abs(), (ripple / (error.len() - 2) as f64).sqrt() / p0, body, wild]
        .map(|v| 100.0 * v)
}

/// Mean of [`hertz`] over loads whose contact edge lies at different places of an element.
pub fn hertz_mean(case: &Case) -> [f64; 5] {
    let load = |k: usize| 1.0 + ((k as f64 + 0.5) / 3.0 - 0.5) / case.per_a;
    let all = [0, 1, 2].map(|k| hertz(&Case { a: load(k), ..*case }));
    std::array::from_fn(|i| all.iter().map(|e| e[i]).sum::<f64>() / 3.0)
}

/// Hydrostatic part below the contact, by McEwen's closed form (Johnson, eq. 4.49):
/// `sigma_xx + sigma_yy = -2 p0/a (m - z)`, `m^2 = (sqrt((a^2 - x^2 + z^2)^2 + 4 x^2 z^2) + a^2 - x^2 + z^2)/2`.
fn below(case: &Case, model: &Model, state: &State, a: f64, p0: f64) -> [f64; 2] {
    let BodyKind::Deformable { patch, elements, material } = &model.bodies[0].kind else { panic!("a deformable body") };
    let u = &state.u[model.bodies[0].nodes()];
    let tau = Stress::new(patch, elements, material.as_ref(), u);
    let [nu, nv] = patch.elements();
    let (mut square, mut count, mut ripple) = (0.0, 0.0, vec![]);
    for j in 0..nv {
        let mut row = vec![];
        for i in 0..nu {
            let [[u0, u1], [v0, v1]] = patch.span_box([i, j]);
            let mut mean = 0.0;
            for (s, t) in [0.2, 0.5, 0.8].into_iter().flat_map(|s| [0.2, 0.5, 0.8].map(|t| (s, t))) {
                let uv = [u0 + s * (u1 - u0), v0 + t * (v1 - v0)];
                let (x, _) = patch.map([i, j], uv);
                let z = x.y + 0.1 / crate::hertz::RADIUS;
                let b = a * a - x.x * x.x + z * z;
                let m = (0.5 * ((b * b + 4.0 * x.x * x.x * z * z).sqrt() + b)).sqrt();
                let error = tau.at([i, j], uv) + case.nu * 2.0 * p0 / a * (m - z);
                mean += error / 9.0;
                if x.x.abs() < 1.4 * a && z < a {
                    square += error * error;
                    count += 1.0;
                }
            }
            let (x, _) = patch.map([i, j], [0.5 * (u0 + u1), 0.5 * (v0 + v1)]);
            if x.x.abs() < 0.9 * a && x.y < a {
                row.push(mean);
            }
        }
        ripple.extend(row.windows(3).map(|e| (0.5 * (e[1] - 0.5 * (e[0] + e[2]))).powi(2)));
    }
    [(square / count).sqrt() / p0, (ripple.iter().sum::<f64>() / ripple.len() as f64).sqrt() / p0]
}

/// `tau` wherever it comes from.
struct Stress<'a> {
    patch: &'a Patch,
    deformed: Patch,
    material: &'a dyn Material,
    tau: Tau<'a>,
}

impl<'a> Stress<'a> {
    fn new(patch: &'a Patch, elements: &'a Elements, material: &'a dyn Material, u: &[Point]) -> Self {
        let points = patch.points.iter().zip(u).map(|(x, u)| x + u).collect();
        let deformed = Patch { points, ..patch.clone() };
        Self { patch, deformed, material, tau: elements.tau(material, u) }
    }

    fn at(&self, element: [usize; 2], uv: [f64; 2]) -> f64 {
        let columns = |patch: &Patch| Matrix2::from_columns(&patch.map(element, uv).1);
        let f = columns(&self.deformed) * columns(self.patch).try_inverse().expect("regular");
        let theta = self.material.dilatation(&f).expect("admissible").value;
        self.tau.at(element, uv, theta)
    }
}

/// Largest relative errors of a shrink fit of two quarter rings against Lame: contact pressure, and `tau`, which is
/// constant in each ring: `nu (sigma_rr + sigma_tt)`.
pub fn ring(basis: BasisSpec, nu: f64, refinement: usize, choice: Choice) -> [f64; 2] {
    let [a, b, c] = shrink_fit::RADII;
    let exact = shrink_fit::pressure(1.0, nu);
    let elements = [[8, 4], [6, 4]].map(|counts: [usize; 2]| counts.map(|n| n * refinement));
    let model = shrink_fit::model(basis, elements, Integration::Segment, |builder, name, patch| {
        add(builder, name, patch, nu, choice);
    });
    let (state, found) = solve(&model);
    let pressure = found.interfaces[0].sites.iter().fold(0.0_f64, |m, s| m.max((s.pressure - exact).abs()));
    let mut worst = 0.0_f64;
    let sums = [-b * b / (b * b - a * a), b * b / (c * c - b * b)].map(|s| 2.0 * nu * exact * s);
    for (body, expected) in model.bodies.iter().zip(sums) {
        let BodyKind::Deformable { patch, elements, material } = &body.kind else { panic!("a deformable body") };
        let tau = Stress::new(patch, elements, material.as_ref(), &state.u[body.nodes()]);
        let [nu, nv] = patch.elements();
        for (i, j) in (0..nu).flat_map(|i| (0..nv).map(move |j| (i, j))) {
            let [[u0, u1], [v0, v1]] = patch.span_box([i, j]);
            for (s, t) in [0.0, 0.5, 1.0].into_iter().flat_map(|s| [0.0, 0.5, 1.0].map(|t| (s, t))) {
                let found = tau.at([i, j], [u0 + s * (u1 - u0), v0 + t * (v1 - v0)]);
                worst = worst.max((found - expected).abs());
            }
        }
    }
    [100.0 * pressure / exact, 100.0 * worst / exact]
}

fn add(builder: &mut Builder, name: &str, patch: Patch, nu: f64, choice: Choice) {
    let spec = BodySpec::Deformable(patch, Arc::new(LinearElastic { youngs_modulus: 1.0, poissons_ratio: nu }));
    let added = match choice {
        None => builder.body(name, spec),
        Some(space) => builder.body_in(name, spec, space),
    };
    added.map(drop).expect("a valid patch");
}

/// Deflection of Cook's membrane (48 wide, 44 to 60 high, left edge held) whose right edge moves as one piece in y, free in
/// x, under a force of 1/100 of `E` times its height: found from the force that a given deflection takes.
pub fn cook(basis: BasisSpec, nu: f64, n: usize, choice: Choice) -> f64 {
    let line = vec![0.0, 0.0, 1.0, 1.0];
    let points = vec![[0.0, 0.0], [48.0, 44.0], [0.0, 44.0], [48.0, 60.0]];
    let shape = ShapeSpec::Nurbs(Nurbs { degrees: [1, 1], knots: [line.clone(), line], points, weights: None });
    let patch = build(&shape, &basis, [n, n], None, [0.0; 2], Path::new(".")).expect("a membrane");
    let right = patch.boundary(Edge::Right).nodes;
    let mut builder = Builder::default();
    add(&mut builder, "membrane", patch, nu, choice);
    let built = (|| {
        let held = || Control::Displacement(Table::constant(0.0));
        builder.motion("membrane", Edge::Left, 0, held(), false)?.motion("membrane", Edge::Left, 1, held(), false)?;
        builder.motion("membrane", Edge::Right, 1, Control::Displacement(Table::constant(1.0)), true)?;
        builder.build()
    })();
    let (_, found) = solve(&built.expect("a valid model"));
    0.16 / right.iter().map(|&i| found.forces[i].y).sum::<f64>()
}

fn solve(model: &Model) -> (State, Evaluation) {
    let (start, mut solver) = (State::initial(model), CondensedSolver::default());
    let step = solve_step(model, &start, 1.0, Strategy::default(), &mut solver, &AtomicBool::new(false), &mut 0);
    let state = step.unwrap_or_else(|e| panic!("{e}")).state;
    let found = evaluate(model, &start, &state, asperity::contact::Tangent::None).expect("admissible");
    (state, found)
}
