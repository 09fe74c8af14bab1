//! The inner loops of the element stiffness `K_aibk = sum_q w dN_a,J A_iJkL dN_b,L`.

use crate::geometry::Point;

/// Nodes that are treated at once.
const LANES: usize = 4;

/// `x` and `y` parts of the gradients of some nodes.
type Gradients = [[f64; LANES]; 2];

/// Blocks `xx, xy, yx, yy` of one node with some others.
type Blocks = [[f64; LANES]; 4];

/// Stiffness of one element. Symmetric, so that only the blocks of a node with the groups of [`LANES`] nodes up to its own
/// are kept; [`place`] says where.
pub(super) struct Stiffness {
    /// `w A_iJkL` at each quadrature point.
    moduli: Vec<[[f64; 4]; 4]>,
    /// `dN_b,L` for each group of nodes and quadrature point.
    columns: Vec<Gradients>,
    /// `w dN_a,J A_iJkL` of one node at each quadrature point, `(i, k, L)` in a row.
    row: Vec<[f64; 8]>,
    blocks: Vec<Blocks>,
    arch: pulp::Arch,
}

impl Stiffness {
    pub fn new(nodes: usize, points: usize) -> Self {
        Self {
            moduli: vec![[[0.0; 4]; 4]; points],
            columns: vec![[[0.0; LANES]; 2]; nodes.div_ceil(LANES) * points],
            row: vec![[0.0; 8]; points],
            blocks: vec![[[0.0; LANES]; 4]; first_block(nodes)],
            arch: pulp::Arch::new(),
        }
    }

    /// Moduli at quadrature point `q` and its weight.
    pub fn set(&mut self, q: usize, moduli: &[[f64; 4]; 4], weight: f64) {
        self.moduli[q] = moduli.map(|row| row.map(|v| weight * v));
    }

    /// The stiffness once all moduli are set; `gradients` point by point.
    pub fn sum(&mut self, gradients: &[[f64; 2]]) -> &[f64] {
        self.arch.dispatch(Sum(self, gradients));
        self.blocks.as_flattened().as_flattened()
    }
}

/// The work, for the widest registers that the machine has.
struct Sum<'a>(&'a mut Stiffness, &'a [[f64; 2]]);

impl pulp::NullaryFnOnce for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Stiffness { moduli, columns, row, blocks, .. } = self.0;
        let points = moduli.len();
        let nodes = self.1.len() / points;
        for (q, gradients) in self.1.chunks_exact(nodes).enumerate() {
            for (b, g) in gradients.iter().enumerate() {
                let group = &mut columns[b / LANES * points + q];
                (group[0][b % LANES], group[1][b % LANES]) = (g[0], g[1]);
            }
        }
        let mut target = blocks.iter_mut();
        for a in 0..nodes {
            for ((row, moduli), g) in row.iter_mut().zip(moduli.iter()).zip(self.1[a..].iter().step_by(nodes)) {
                for (row, ij) in row.chunks_exact_mut(4).zip(moduli.chunks_exact(2)) {
                    for kl in 0..4 {
                        row[kl] = g[0] * ij[0][kl] + g[1] * ij[1][kl];
                    }
                }
            }
            let groups = columns.chunks_exact(points).take(a / LANES + 1);
            for (group, block) in groups.zip(&mut target) {
                *block = product(row, group);
            }
        }
    }
}

/// Sum over the quadrature points.
#[inline(always)]
fn product(row: &[[f64; 8]], group: &[Gradients]) -> Blocks {
    let mut sum = [[0.0; LANES]; 4];
    for (r, [x, y]) in row.iter().zip(group) {
        for (ik, sum) in sum.iter_mut().enumerate() {
            for lane in 0..LANES {
                sum[lane] += r[2 * ik] * x[lane] + r[2 * ik + 1] * y[lane];
            }
        }
    }
    sum
}

/// Sum of dyads `factor v v^T` of vectors at the nodes, kept like a [`Stiffness`].
pub(super) struct Dyads {
    /// Entries of each vector, group by group of nodes.
    vectors: Vec<Gradients>,
    groups: usize,
    blocks: Vec<Blocks>,
    arch: pulp::Arch,
}

impl Dyads {
    pub fn new(nodes: usize, count: usize) -> Self {
        let groups = nodes.div_ceil(LANES);
        let vectors = vec![[[0.0; LANES]; 2]; groups * count];
        Self { vectors, groups, blocks: vec![[[0.0; LANES]; 4]; first_block(nodes)], arch: pulp::Arch::new() }
    }

    /// Sets all vectors to zero, for another number of nodes.
    pub fn clear(&mut self, nodes: usize) {
        self.vectors.fill([[0.0; LANES]; 2]);
        self.blocks.resize(first_block(nodes), [[0.0; LANES]; 4]);
    }

    /// Adds to vector `k` at a node.
    pub fn add(&mut self, k: usize, node: usize, value: &Point) {
        let [x, y] = &mut self.vectors[k * self.groups + node / LANES];
        x[node % LANES] += value.x;
        y[node % LANES] += value.y;
    }

    /// The sum over all vectors, for `nodes` nodes.
    pub fn sum(&mut self, nodes: usize, factor: f64) -> &[f64] {
        self.arch.dispatch(SumDyads { dyads: self, nodes, factor });
        self.blocks.as_flattened().as_flattened()
    }
}

/// The work, for the widest registers that the machine has.
struct SumDyads<'a> {
    dyads: &'a mut Dyads,
    nodes: usize,
    factor: f64,
}

impl pulp::NullaryFnOnce for SumDyads<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Dyads { vectors, groups, blocks, .. } = self.dyads;
        let mut target = blocks.iter_mut();
        for a in 0..self.nodes {
            for (g, block) in (0..a / LANES + 1).zip(&mut target) {
                let mut sum = [[0.0; LANES]; 4];
                for vector in vectors.chunks_exact(*groups) {
                    for (ik, sum) in sum.iter_mut().enumerate() {
                        let row = self.factor * vector[a / LANES][ik / 2][a % LANES];
                        for lane in 0..LANES {
                            sum[lane] += row * vector[g][ik % 2][lane];
                        }
                    }
                }
                *block = sum;
            }
        }
    }
}

/// Number of blocks before those of node `a`.
fn first_block(a: usize) -> usize {
    let full = a / LANES;
    LANES * full * (full + 1) / 2 + a % LANES * (full + 1)
}

/// Where entry `(i, j)` of the element stiffness stands, unknowns ordered node by node.
pub(super) fn place(i: usize, j: usize) -> usize {
    let (i, j) = if j / 2 / LANES > i / 2 / LANES { (j, i) } else { (i, j) };
    let (a, b) = (i / 2, j / 2);
    let block = first_block(a) + b / LANES;
    (4 * block + 2 * (i % 2) + j % 2) * LANES + b % LANES
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the plain sum, for every entry of elements of several sizes.
    #[test]
    fn blocks_hold_the_plain_sum() {
        let noise = |k: usize| ((k * 7919) % 1009) as f64 / 504.5 - 1.0;
        for (nodes, points) in [(4, 4), (6, 6), (9, 9), (16, 9)] {
            let mut stiffness = Stiffness::new(nodes, points);
            let gradients: Vec<[f64; 2]> = (0..nodes * points).map(|k| [noise(2 * k), noise(2 * k + 1)]).collect();
            let moduli = |q: usize| -> [[f64; 4]; 4] {
                std::array::from_fn(|r| std::array::from_fn(|c| noise(31 * q + r.min(c) + 5 * r.max(c))))
            };
            for q in 0..points {
                stiffness.set(q, &moduli(q), 0.1 * (q + 1) as f64);
            }
            let found = stiffness.sum(&gradients).to_vec();
            for (i, j) in (0..2 * nodes).flat_map(|i| (0..2 * nodes).map(move |j| (i, j))) {
                let term = |q: usize| -> f64 {
                    let (ga, gb) = (gradients[q * nodes + i / 2], gradients[q * nodes + j / 2]);
                    let at =
                        |jl: usize| ga[jl / 2] * moduli(q)[2 * (i % 2) + jl / 2][2 * (j % 2) + jl % 2] * gb[jl % 2];
                    0.1 * (q + 1) as f64 * (0..4).map(at).sum::<f64>()
                };
                let expected: f64 = (0..points).map(term).sum();
                assert!((found[place(i, j)] - expected).abs() < 1e-12, "{nodes} nodes, ({i}, {j})");
            }
        }
    }

    /// As above, of one set of vectors after another of a different number of nodes.
    #[test]
    fn dyads_hold_the_plain_sum() {
        let noise = |k: usize| ((k * 7919) % 1009) as f64 / 504.5 - 1.0;
        let mut dyads = Dyads::new(16, 3);
        for nodes in [16, 9, 6] {
            let vector = |k: usize, i: usize| noise(100 * k + i);
            dyads.clear(nodes);
            for (k, a) in (0..3).flat_map(|k| (0..nodes).map(move |a| (k, a))) {
                dyads.add(k, a, &Point::new(vector(k, 2 * a), vector(k, 2 * a + 1)));
            }
            let found = dyads.sum(nodes, 2.5).to_vec();
            for (i, j) in (0..2 * nodes).flat_map(|i| (0..2 * nodes).map(move |j| (i, j))) {
                let expected: f64 = (0..3).map(|k| 2.5 * vector(k, i) * vector(k, j)).sum();
                assert!((found[place(i, j)] - expected).abs() < 1e-12, "{nodes} nodes, ({i}, {j})");
            }
        }
    }
}
