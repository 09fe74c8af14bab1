//! Element integrals with projected dilatations, see [`VolumeSpace`](super::VolumeSpace).

use nalgebra::Matrix2;

use super::elements::{BulkForces, Elements, deformation_gradient};
use super::material::{Dilatation, Material, add_dyad};
use super::stiffness::{Dyads, Stiffness};
use super::volume::{Block, POINTWISE, Volume};
use crate::geometry::Point;

/// What is kept of one block while it is integrated.
struct Sums {
    /// Deformation gradient and dilatation at the quadrature points.
    points: Vec<(Matrix2<f64>, Dilatation)>,
    /// `int phi_k theta dX`.
    theta: Vec<f64>,
    /// Nodal forces of one element.
    forces: Vec<Point>,
    /// `b_k = int phi_k d theta dX` of one element, nodes in a row, and `w d theta` at one point.
    vectors: Vec<Point>,
    vector: Vec<Point>,
    /// Stiffness of one element at constant `P theta`, and `lambda_P sum_k b_k b_k^T` of the block.
    stiffness: Option<(Stiffness, Dyads)>,
}

impl Sums {
    fn new(elements: &Elements, volume: &Volume, stiffness: bool) -> Self {
        let (nodes, points, functions) =
            (elements.nodes_per_element, elements.points_per_element, volume.space.functions());
        let largest = |size: fn(&Block) -> usize| volume.blocks.iter().map(size).max().unwrap_or(0);
        let dyads = || Dyads::new(largest(|block| block.nodes.len()), functions);
        Self {
            points: Vec::with_capacity(points * largest(|block| block.elements.len())),
            theta: vec![0.0; functions],
            forces: vec![Point::zeros(); nodes],
            vectors: vec![Point::zeros(); nodes * functions],
            vector: vec![Point::zeros(); nodes],
            stiffness: stiffness.then(|| (Stiffness::new(nodes, points), dyads())),
        }
    }
}

/// `lambda_0` and `lambda_P`.
fn parts(material: &dyn Material) -> [f64; 2] {
    let (lambda, mu) = material.lame();
    let pointwise = lambda.min(POINTWISE * mu);
    [pointwise, lambda - pointwise]
}

impl Elements {
    /// [`Elements::integrate`] block by block.
    pub(super) fn integrate_projected(
        &self,
        volume: &Volume,
        material: &dyn Material,
        u: &[Point],
        stiffness: bool,
        mut take: impl FnMut(usize, BulkForces),
    ) -> Option<f64> {
        let [_, shared] = parts(material);
        let mut sums = Sums::new(self, volume, stiffness);
        let mut energy = 0.0;
        for (k, block) in volume.blocks.iter().enumerate() {
            self.dilatations(volume, block, material, u, &mut sums)?;
            energy += 0.5 * shared * sums.theta.iter().map(|t| t * t).sum::<f64>();
            if let Some((_, dyads)) = &mut sums.stiffness {
                dyads.clear(block.nodes.len());
            }
            for (slot, &e) in block.elements.iter().enumerate() {
                energy += self.at_given_tau(volume, block, slot, material, &mut sums);
                let (nodes, _, gradients) = self.element(e);
                let stiffness = sums.stiffness.as_mut().map_or(&[][..], |(sum, _)| sum.sum(gradients));
                take(e, BulkForces { nodes, forces: &sums.forces, stiffness });
            }
            if let Some((_, dyads)) = &mut sums.stiffness {
                let stiffness = dyads.sum(block.nodes.len(), shared);
                take(self.count() + k, BulkForces { nodes: &block.nodes, forces: &[], stiffness });
            }
        }
        Some(energy)
    }

    /// Points and `theta` of a block.
    fn dilatations(
        &self,
        volume: &Volume,
        block: &Block,
        material: &dyn Material,
        u: &[Point],
        sums: &mut Sums,
    ) -> Option<()> {
        let functions = sums.theta.len();
        sums.points.clear();
        sums.theta.fill(0.0);
        for &e in &block.elements {
            let (nodes, points, gradients) = self.element(e);
            for (gradients, q) in gradients.chunks_exact(nodes.len()).zip(points) {
                let f = deformation_gradient(nodes, gradients, u);
                let dilatation = material.dilatation(&f)?;
                for (theta, phi) in sums.theta.iter_mut().zip(&volume.values[q * functions..]) {
                    *theta += self.weights[q] * phi * dilatation.value;
                }
                sums.points.push((f, dilatation));
            }
        }
        Some(())
    }

    /// Forces and stiffness of an element of a block whose `theta` is known; energy without the projected part.
    fn at_given_tau(
        &self,
        volume: &Volume,
        block: &Block,
        slot: usize,
        material: &dyn Material,
        sums: &mut Sums,
    ) -> f64 {
        let (nodes, points, gradients) = self.element(block.elements[slot]);
        let (n, functions) = (nodes.len(), sums.theta.len());
        let [pointwise, shared] = parts(material);
        let states = &sums.points[slot * self.points_per_element..];
        let mut energy = 0.0;
        sums.forces.fill(Point::zeros());
        sums.vectors.fill(Point::zeros());
        for (s, ((gradients, q), (f, dilatation))) in gradients.chunks_exact(n).zip(points).zip(states).enumerate() {
            let (w, phi) = (self.weights[q], &volume.values[q * functions..(q + 1) * functions]);
            let projected = sums.theta.iter().zip(phi).map(|(theta, phi)| theta * phi).sum::<f64>();
            let tau = pointwise * dilatation.value + shared * projected;
            let (rest, stress) = material.elastic(f, dilatation, tau);
            energy += w * (rest + 0.5 * pointwise * dilatation.value * dilatation.value);
            for (force, g) in sums.forces.iter_mut().zip(gradients) {
                *force += stress * Point::new(g[0], g[1]) * w;
            }
            if let Some((stiffness, _)) = &mut sums.stiffness {
                let mut moduli = material.moduli(dilatation, tau);
                add_dyad(&mut moduli, pointwise, &dilatation.gradient);
                stiffness.set(s, &moduli, w);
                for (d, g) in sums.vector.iter_mut().zip(gradients) {
                    *d = dilatation.gradient * Point::new(g[0], g[1]) * w;
                }
                for (vector, phi) in sums.vectors.chunks_exact_mut(n).zip(phi) {
                    vector.iter_mut().zip(&sums.vector).for_each(|(b, d)| *b += d * *phi);
                }
            }
        }
        if let Some((_, dyads)) = &mut sums.stiffness {
            for (k, vector) in sums.vectors.chunks_exact(n).enumerate() {
                let places = &block.places[slot * n..(slot + 1) * n];
                places.iter().zip(vector).for_each(|(&place, b)| dyads.add(k, place, b));
            }
        }
        energy
    }

    /// The part of `tau` that is no matter of the point alone, for the displacement `u`.
    pub fn tau(&self, material: &dyn Material, u: &[Point]) -> Tau<'_> {
        let [pointwise, shared] = parts(material);
        let Some(volume) = &self.volume else { return Tau { pointwise: material.lame().0, field: None } };
        let mut sums = Sums::new(self, volume, false);
        let of_block = |block: &Block| -> Vec<f64> {
            let found = self.dilatations(volume, block, material, u, &mut sums);
            sums.theta.iter().map(|theta| found.map_or(f64::NAN, |()| shared * theta)).collect()
        };
        let values = volume.blocks.iter().map(of_block).collect();
        Tau { pointwise, field: Some((volume, values)) }
    }
}

/// The stress that resists the change of volume, as a field over a body.
pub struct Tau<'a> {
    /// `lambda_0`, or `lambda` without projection.
    pointwise: f64,
    /// `lambda_P P theta`: coefficients of each block.
    field: Option<(&'a Volume, Vec<Vec<f64>>)>,
}

impl Tau<'_> {
    /// At the parameters `uv` of an element `[i, j]` where the dilatation is `theta`; NaN in a block that holds a point without
    /// a state.
    pub fn at(&self, element: [usize; 2], uv: [f64; 2], theta: f64) -> f64 {
        let projected = self.field.as_ref().map_or(0.0, |(volume, values)| {
            let (block, phi) = volume.at(element, uv);
            phi.iter().zip(&values[block]).map(|(phi, tau)| phi * tau).sum()
        });
        self.pointwise * theta + projected
    }
}
