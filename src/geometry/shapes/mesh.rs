//! From exact shapes to element meshes: breaks, change of basis, check of the Jacobian.

use std::f64::consts::PI;
use std::sync::Arc;

use super::BasisSpec;
use super::grading::{Density, Grading};
use crate::geometry::patch::map_lines;
use crate::geometry::refine::{Homogeneous, combine, embed, project};
use crate::geometry::{BSpline, Basis, GeometryError, Patch};

/// A place inside a parameter range at which an element has to end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// Parameter.
    pub at: f64,
    /// Number of continuous derivatives of the geometry there; 0 for a kink or a joint of exact arcs.
    pub continuity: usize,
}

/// Exact patch in B-splines, before it is expressed in the basis of the body.
#[derive(Clone, Debug)]
pub(super) struct Master {
    pub basis: [BSpline; 2],
    pub net: Vec<Homogeneous>,
}

/// Element ends from `range[0]` to `range[1]` with an end on every joint (sorted, inside the range), and the continuity
/// wanted at each of them (`None`: as smooth as the basis allows).
pub(super) struct Breaks {
    pub at: Vec<f64>,
    pub continuity: Vec<Option<usize>>,
}

impl Breaks {
    /// Distributes `n` elements over the pieces between the joints.
    pub(super) fn new(
        range: [f64; 2],
        joints: &[Joint],
        n: usize,
        density: &Density,
        direction: usize,
    ) -> Result<Self, GeometryError> {
        let mut ends = vec![range[0]];
        ends.extend(joints.iter().map(|j| j.at));
        ends.push(range[1]);
        let shares: Vec<f64> = ends.windows(2).map(|e| density.share(e[0], e[1])).collect();
        if n < shares.len() {
            let name = ["first", "second"][direction];
            let message = format!(
                "the {name} count must be at least {}, one element for each smooth piece of the shape, is {n}",
                shares.len()
            );
            return Err(GeometryError::outside("elements", "", message));
        }
        let mut breaks = Self { at: vec![range[0]], continuity: vec![None] };
        for (i, count) in allot(&shares, n).into_iter().enumerate() {
            density.divide(ends[i], ends[i + 1], count, &mut breaks.at);
            breaks.continuity.resize(breaks.at.len(), None);
            if let Some(joint) = joints.get(i) {
                breaks.continuity[breaks.at.len() - 1] = Some(joint.continuity);
            }
        }
        Ok(breaks)
    }

    /// Basis on these breaks.
    pub(super) fn basis(self, spec: &BasisSpec) -> Result<Arc<dyn Basis>, GeometryError> {
        spec.on(self.at, |i| self.continuity[i])
    }
}

/// Splits `n` into whole numbers, at least 1 each, close to the shares (largest remainders).
fn allot(shares: &[f64], n: usize) -> Vec<usize> {
    // one element each first, the rest in proportion to what is still missing
    let missing = shares.iter().map(|s| (s * n as f64 - 1.0).max(0.0));
    let missing: Vec<f64> = missing.collect();
    let total: f64 = missing.iter().sum();
    let scale = if total > 0.0 { (n - shares.len()) as f64 / total } else { 0.0 };
    let whole = |m: &f64| (m * scale + 1e-9).floor();
    let mut counts: Vec<usize> = missing.iter().map(|m| 1 + whole(m) as usize).collect();
    let remainders = missing.iter().map(|m| m * scale - whole(m)).collect();
    let left = n - counts.iter().sum::<usize>();
    hand_out(left, remainders, &mut counts);
    counts
}

/// Hands out the elements left over by rounding, to the largest remainders first. Mirrored pieces with equal remainders
/// are served together or, if one element is left, the middle piece gets it: a symmetric body keeps a symmetric mesh.
fn hand_out(mut left: usize, mut remainders: Vec<f64>, counts: &mut [usize]) {
    let last = counts.len() - 1;
    let mirrored = |i: usize| i != last - i && (remainders[i] - remainders[last - i]).abs() < 1e-9;
    let paired: Vec<bool> = (0..=last).map(mirrored).collect();
    while left > 0 {
        let open = (0..=last).filter(|&i| remainders[i].is_finite() && (left > 1 || !paired[i]));
        let Some(i) = open.max_by(|&a, &b| remainders[a].total_cmp(&remainders[b])) else {
            counts[counts.len() / 2] += left;
            return;
        };
        for served in [Some(i), paired[i].then_some(last - i)].into_iter().flatten() {
            counts[served] += 1;
            remainders[served] = f64::NEG_INFINITY;
            left -= 1;
        }
    }
}

/// Expresses an exact patch in the basis of the body: exactly for `nurbs`, through the nodes for `lagrange`.
pub(super) fn express(
    master: &Master,
    spec: &BasisSpec,
    elements: [usize; 2],
    grading: Option<&Grading>,
) -> Result<Patch, GeometryError> {
    let mut bases: Vec<Arc<dyn Basis>> = Vec::with_capacity(2);
    let mut net = master.net.clone();
    let mut nu = master.basis[0].len();
    for (direction, &count) in elements.iter().enumerate() {
        let old = &master.basis[direction];
        let new = refined_basis(old, spec, count, grading, direction)?;
        net = map_lines(&net, nu, direction, |line| {
            Ok(match spec {
                BasisSpec::Nurbs { .. } => embed(old, line, new.as_ref()),
                BasisSpec::Lagrange { .. } => new.nodes().iter().map(|&xi| combine(old, line, xi)).collect(),
            })
        })?;
        if direction == 0 {
            nu = new.len();
        }
        bases.push(new);
    }
    if matches!(spec, BasisSpec::Lagrange { .. }) {
        // the nodal values are points now: drop the weights
        net.iter_mut().for_each(|h| *h /= h.z);
    }
    let (points, weights) = project(&net);
    Ok(Patch { basis: [Arc::clone(&bases[0]), Arc::clone(&bases[1])], weights, points })
}

/// Basis of the body in one direction: the breaks of the exact patch and its continuity there are kept.
fn refined_basis(
    old: &BSpline,
    spec: &BasisSpec,
    count: usize,
    grading: Option<&Grading>,
    direction: usize,
) -> Result<Arc<dyn Basis>, GeometryError> {
    let (p, breaks) = (old.degree(), old.breaks());
    if matches!(spec, BasisSpec::Nurbs { .. }) && spec.degree() < p {
        let message = format!("this shape needs degree {p} or more, not {}", spec.degree());
        return Err(GeometryError::outside("basis", "degree", message));
    }
    let inner = &breaks[1..breaks.len() - 1];
    let joints: Vec<Joint> =
        inner.iter().map(|&at| Joint { at, continuity: p.saturating_sub(old.multiplicity(at)) }).collect();
    let range = [breaks[0], breaks[breaks.len() - 1]];
    let density = Grading::density(grading, direction, range)?;
    Breaks::new(range, &joints, count, &density, direction)?.basis(spec)
}

/// Checks that the Jacobian is positive inside every element, at Chebyshev points, which reach closer to the element
/// edges than Gauss points of the same number.
///
/// # Errors
/// Names the place of the first point at which it is not.
pub(super) fn check_jacobian(patch: &Patch) -> Result<(), GeometryError> {
    let n = 2 + patch.basis[0].degree().max(patch.basis[1].degree());
    let place = |i: usize| 0.5 - 0.5 * (PI * (i as f64 + 0.5) / n as f64).cos();
    let [nu, nv] = patch.elements();
    for element in (0..nu * nv).map(|e| [e % nu, e / nu]) {
        let [u, v] = patch.span_box(element);
        for k in 0..n * n {
            let uv = [u, v].into_iter().zip([k % n, k / n]);
            let uv: Vec<f64> = uv.map(|([a, b], i)| a + (b - a) * place(i)).collect();
            let (x, [du, dv]) = patch.map(element, [uv[0], uv[1]]);
            let jacobian = du.perp(&dv);
            if jacobian.is_nan() || jacobian <= 0.0 {
                let message = format!(
                    "the shape folds over or is clockwise: the Jacobian is not positive near ({}, {}) in element {element:?}",
                    x.x, x.y
                );
                return Err(GeometryError::shape("", message));
            }
        }
    }
    Ok(())
}
