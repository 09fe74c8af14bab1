//! Element integrals of one body: internal forces, energy and symmetric stiffness.

use nalgebra::Matrix2;

use super::Material;
use super::stiffness::{Stiffness, place};
use super::volume::{Points, Volume, VolumeSpace};
use crate::geometry::{Patch, PatchShape, Point};
use crate::math::gauss;

/// Reference shape gradients of a patch at its quadrature points, computed once.
#[derive(Clone, Debug)]
pub struct Elements {
    /// Control points of each element, `nodes_per_element` in a row.
    nodes: Vec<usize>,
    pub(super) nodes_per_element: usize,
    pub(super) points_per_element: usize,
    /// `dN/dX`, ordered element, quadrature point, node.
    gradients: Vec<[f64; 2]>,
    /// Reference area belonging to each quadrature point.
    pub(super) weights: Vec<f64>,
    /// Where the dilatation is not taken from the point itself.
    pub(super) volume: Option<Volume>,
}

/// What one element contributes.
pub struct BulkForces<'a> {
    /// Control points of the element.
    pub nodes: &'a [usize],
    /// Internal force at each node.
    pub forces: &'a [Point],
    /// One half of the symmetric stiffness, see [`Elements::place`]; empty if not asked for.
    pub stiffness: &'a [f64],
}

impl Elements {
    /// Gauss points: `degree + 1` in each direction. `volume`: space of the dilatations, `None` for each point its own.
    ///
    /// Returns `None` where the map from parameters to the reference body is not invertible (Jacobian not positive).
    pub fn new(patch: &Patch, volume: Option<VolumeSpace>) -> Option<Self> {
        let points_per_element = (patch.basis[0].degree() + 1) * (patch.basis[1].degree() + 1);
        let nodes_per_element = points_per_element; // as many functions as points along each direction
        let mut this = Self {
            nodes: vec![],
            nodes_per_element,
            points_per_element,
            gradients: vec![],
            weights: vec![],
            volume: None,
        };
        let mut parameters = vec![];
        for (element, points) in quadrature(patch) {
            for (uv, weight) in points {
                this.add_point(patch, element, uv, weight)?;
                parameters.push(uv);
            }
            let [[u0, _], [v0, _]] = patch.span_box(element);
            this.nodes.extend(patch.shape(element, [u0, v0]).nodes);
        }
        let points = Points {
            nodes: &this.nodes,
            nodes_per_element,
            parameters: &parameters,
            weights: &this.weights,
            per_element: points_per_element,
        };
        this.volume = volume.map(|space| Volume::new(patch, space, &points));
        Some(this)
    }

    fn add_point(&mut self, patch: &Patch, element: [usize; 2], uv: [f64; 2], weight: f64) -> Option<()> {
        let shape = patch.shape(element, uv);
        let jacobian = jacobian(patch, &shape);
        let determinant = jacobian.determinant();
        let inverse = jacobian.try_inverse().filter(|_| determinant > 0.0)?;
        self.weights.push(weight * determinant);
        for g in &shape.gradients {
            self.gradients.push([
                g[0] * inverse[(0, 0)] + g[1] * inverse[(1, 0)],
                g[0] * inverse[(0, 1)] + g[1] * inverse[(1, 1)],
            ]);
        }
        Some(())
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.nodes.len() / self.nodes_per_element
    }

    /// Number of elements, and of blocks of elements that are coupled by common dilatations: see [`Self::integrate`].
    pub fn cliques(&self) -> usize {
        self.count() + self.volume.as_ref().map_or(0, |volume| volume.blocks.len())
    }

    /// Control points of element `e`, or of the block of that number less the number of elements.
    pub fn nodes(&self, e: usize) -> &[usize] {
        if e >= self.count() {
            self.volume.as_ref().map_or(&[], |v| &v.blocks[e - self.count()].nodes)
        } else {
            &self.nodes[e * self.nodes_per_element..(e + 1) * self.nodes_per_element]
        }
    }

    /// Control points and quadrature points of an element.
    pub(super) fn element(&self, e: usize) -> (&[usize], std::ops::Range<usize>, &[[f64; 2]]) {
        let (n, m) = (self.nodes_per_element, self.points_per_element);
        (&self.nodes[e * n..(e + 1) * n], e * m..(e + 1) * m, &self.gradients[e * n * m..(e + 1) * n * m])
    }

    /// The space of dilatations, where they are projected.
    pub fn volume(&self) -> Option<VolumeSpace> {
        self.volume.as_ref().map(|volume| volume.space)
    }

    /// Reference area of the body.
    pub fn area(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// Where entry `(i, j)` of an element stiffness stands in [`BulkForces::stiffness`], unknowns ordered node by node; the
    /// same as that of `(j, i)`.
    pub fn place(i: usize, j: usize) -> usize {
        place(i, j)
    }

    /// Integrates all elements for the displacement `u` of the control points and hands each to `take`. Blocks with common
    /// dilatations follow behind their elements: they add stiffness alone and are numbered behind all elements.
    /// Returns the strain energy, or `None` where `det F <= 0` somewhere.
    pub fn integrate(
        &self,
        material: &dyn Material,
        u: &[Point],
        stiffness: bool,
        mut take: impl FnMut(usize, BulkForces),
    ) -> Option<f64> {
        if let Some(volume) = &self.volume {
            return self.integrate_projected(volume, material, u, stiffness, take);
        }
        let n = self.nodes_per_element;
        let mut forces = vec![Point::zeros(); n];
        let mut sums = stiffness.then(|| Stiffness::new(n, self.points_per_element));
        let mut energy = 0.0;
        for e in 0..self.count() {
            let (nodes, points, of_points) = self.element(e);
            forces.fill(Point::zeros());
            for ((q, gradients), &w) in of_points.chunks_exact(n).enumerate().zip(&self.weights[points]) {
                let f = deformation_gradient(nodes, gradients, u);
                let (density, stress) = match &mut sums {
                    None => material.stress(&f)?,
                    Some(sums) => {
                        let response = material.response(&f)?;
                        sums.set(q, &response.tangent, w);
                        (response.energy, response.stress)
                    }
                };
                energy += w * density;
                for (force, g) in forces.iter_mut().zip(gradients) {
                    *force += stress * Point::new(g[0], g[1]) * w;
                }
            }
            let stiffness = sums.as_mut().map_or(&[][..], |sums| sums.sum(of_points));
            take(e, BulkForces { nodes, forces: &forces, stiffness });
        }
        Some(energy)
    }
}

/// `F = I + sum_a u_a x dN_a/dX`.
pub(super) fn deformation_gradient(nodes: &[usize], gradients: &[[f64; 2]], u: &[Point]) -> Matrix2<f64> {
    let mut f = [1.0, 0.0, 0.0, 1.0];
    for (&node, g) in nodes.iter().zip(gradients) {
        let d = u[node];
        f[0] += d.x * g[0];
        f[1] += d.x * g[1];
        f[2] += d.y * g[0];
        f[3] += d.y * g[1];
    }
    Matrix2::new(f[0], f[1], f[2], f[3])
}

/// Every element of a patch with its Gauss points, `degree + 1` in each direction, and their weights in the parameters.
pub(super) fn quadrature(patch: &Patch) -> impl Iterator<Item = ([usize; 2], Vec<([f64; 2], f64)>)> + '_ {
    let [nu, nv] = patch.elements();
    let rules = [0, 1].map(|d| gauss(patch.basis[d].degree() + 1));
    (0..nv).flat_map(move |j| (0..nu).map(move |i| [i, j])).map(move |element| {
        let [[u0, u1], [v0, v1]] = patch.span_box(element);
        let [along_u, along_v] = &rules;
        let mut points = Vec::with_capacity(along_u.points.len() * along_v.points.len());
        for (eta, wv) in along_v.points.iter().zip(&along_v.weights) {
            for (xi, wu) in along_u.points.iter().zip(&along_u.weights) {
                points.push(([u0 + xi * (u1 - u0), v0 + eta * (v1 - v0)], wu * wv * (u1 - u0) * (v1 - v0)));
            }
        }
        (element, points)
    })
}

/// Derivative of the reference position by the parameters.
pub(super) fn jacobian(patch: &Patch, shape: &PatchShape) -> Matrix2<f64> {
    let mut jacobian = Matrix2::zeros();
    for (node, gradient) in shape.nodes.iter().zip(&shape.gradients) {
        let x = patch.points[*node];
        jacobian += Matrix2::new(x.x * gradient[0], x.x * gradient[1], x.y * gradient[0], x.y * gradient[1]);
    }
    jacobian
}
