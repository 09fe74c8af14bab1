//! Areas that belong to the control points.

use super::elements::{jacobian, quadrature};
use crate::geometry::Patch;

/// `int N_a dA` over the reference body for every control point `a`: a lumped mass matrix of unit density. The areas are
/// positive (B-splines, NURBS and Lagrange elements up to degree 2) and add up to that of the body.
pub fn lumped_areas(patch: &Patch) -> Vec<f64> {
    let mut areas = vec![0.0; patch.points.len()];
    for (element, points) in quadrature(patch) {
        for (uv, weight) in points {
            let shape = patch.shape(element, uv);
            let area = weight * jacobian(patch, &shape).determinant();
            shape.nodes.iter().zip(&shape.values).for_each(|(&node, value)| areas[node] += value * area);
        }
    }
    areas
}
