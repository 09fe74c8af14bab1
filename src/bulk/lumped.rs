//! Areas that belong to the control points.

use nalgebra::Matrix2;

use crate::geometry::Patch;
use crate::math::gauss;

/// `int N_a dA` over the reference body for every control point `a`: a lumped mass matrix of unit density. The areas are
/// positive (B-splines, NURBS and Lagrange elements up to degree 2) and add up to that of the body.
pub fn lumped_areas(patch: &Patch) -> Vec<f64> {
    let [nu, nv] = patch.elements();
    let rules = [gauss(patch.basis[0].degree() + 1), gauss(patch.basis[1].degree() + 1)];
    let mut areas = vec![0.0; patch.points.len()];
    for element in (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j])) {
        let [[u0, u1], [v0, v1]] = patch.span_box(element);
        for (eta, wv) in rules[1].points.iter().zip(&rules[1].weights) {
            for (xi, wu) in rules[0].points.iter().zip(&rules[0].weights) {
                let shape = patch.shape(element, [u0 + xi * (u1 - u0), v0 + eta * (v1 - v0)]);
                let mut jacobian = Matrix2::zeros();
                for (&node, gradient) in shape.nodes.iter().zip(&shape.gradients) {
                    jacobian += patch.points[node] * nalgebra::RowVector2::from(*gradient);
                }
                let area = wu * wv * (u1 - u0) * (v1 - v0) * jacobian.determinant();
                shape.nodes.iter().zip(&shape.values).for_each(|(&node, value)| areas[node] += value * area);
            }
        }
    }
    areas
}
