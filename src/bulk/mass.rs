//! Consistent mass of a body.

use super::elements::{jacobian, quadrature};
use crate::geometry::Patch;

/// Hands the consistent mass of every element for unit density to `take`: its control points and, row by row, `int N_a N_b dA`
/// over the reference element (an area). The rows of all elements together add up to [`lumped_areas`](super::lumped_areas).
pub fn masses(patch: &Patch, mut take: impl FnMut(&[usize], &[f64])) {
    let mut mass = vec![];
    for (element, points) in quadrature(patch) {
        mass.clear();
        let mut nodes = vec![];
        for (uv, weight) in points {
            let shape = patch.shape(element, uv);
            let area = weight * jacobian(patch, &shape).determinant();
            mass.resize(shape.values.len().pow(2), 0.0);
            for (row, a) in mass.chunks_exact_mut(shape.values.len()).zip(&shape.values) {
                row.iter_mut().zip(&shape.values).for_each(|(entry, b)| *entry += a * b * area);
            }
            nodes = shape.nodes;
        }
        take(&nodes, &mass);
    }
}
