//! The deformed bodies of one instant as points, lines and stress cells: what a picture needs, and no more.

use crate::geometry::{Curve, Patch, Point};
use crate::output::vtu::{BodyField, StressField};

/// Most stress cells of one body; more are not seen at the printed size.
const MOST_CELLS: usize = 10_000;
/// Points per element edge.
const EDGE_POINTS: usize = 4;

/// A line in the plane of the scene.
pub type Line = Vec<[f64; 2]>;

/// One row of stress cells: values between two lines with one more point than there are cells.
#[derive(Clone, Debug)]
pub struct StressRow {
    /// Lower corners of the cells.
    pub lower: Line,
    /// Upper corners of the cells.
    pub upper: Line,
    /// Von Mises stress in the middle of each cell.
    pub values: Vec<f64>,
}

/// One sampled body.
#[derive(Clone, Debug, Default)]
pub struct Sampled {
    /// Coloured cells; none for a rigid body.
    pub rows: Vec<StressRow>,
    /// Edges between elements.
    pub mesh: Vec<Line>,
    /// Contour; of a rigid body its curve.
    pub outline: Vec<Line>,
    /// True for a rigid body.
    pub rigid: bool,
}

impl Sampled {
    /// Samples a body in its deformed position.
    pub fn new(body: &BodyField) -> Self {
        Self::with(body, MOST_CELLS)
    }

    /// The same with one cell an element.
    pub fn brief(body: &BodyField) -> Self {
        Self::with(body, 0)
    }

    fn with(body: &BodyField, most_cells: usize) -> Self {
        match body {
            BodyField::Deformable { patch, displacement, stress, .. } => {
                Deformed { patch, displacement }.sampled(stress, most_cells)
            }
            BodyField::Rigid { curve, displacement, .. } => rigid(curve, displacement),
        }
    }

    /// All points that a view of the body must contain.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.outline.iter().flatten().copied()
    }
}

fn rigid(curve: &Curve, displacement: &[Point]) -> Sampled {
    let placed: Vec<Point> = curve.points.iter().zip(displacement).map(|(p, u)| p + u).collect();
    let breaks = curve.basis.breaks();
    let on_span = |span: usize| {
        let placed = &placed;
        (0..=12).map(move |k| {
            let t = f64::from(k) / 12.0;
            let xi = (1.0 - t) * breaks[span] + t * breaks[span + 1];
            let p = curve.place(&curve.shape(span, xi), 0, placed);
            [p.x, p.y]
        })
    };
    let line = (0..curve.spans()).flat_map(on_span).collect();
    Sampled { outline: vec![line], rigid: true, ..Sampled::default() }
}

struct Deformed<'a> {
    patch: &'a Patch,
    displacement: &'a [Point],
}

impl Deformed<'_> {
    fn sampled(&self, stress: &StressField, most_cells: usize) -> Sampled {
        let [nu, nv] = self.patch.elements();
        let mut sampled = Sampled { rows: self.stress_rows(stress, most_cells), ..Sampled::default() };
        let across = (0..=nu).map(|i| (self.line(0, i), i == 0 || i == nu));
        let along = (0..=nv).map(|j| (self.line(1, j), j == 0 || j == nv));
        for (line, border) in across.chain(along) {
            if border { sampled.outline.push(line) } else { sampled.mesh.push(line) }
        }
        sampled
    }

    fn place(&self, element: [usize; 2], local: [f64; 2]) -> [f64; 2] {
        let shape = self.patch.shape(element, self.parameters(element, local));
        let mut x = Point::zeros();
        for (node, value) in shape.nodes.iter().zip(&shape.values) {
            x += *value * (self.patch.points[*node] + self.displacement[*node]);
        }
        [x.x, x.y]
    }

    fn parameters(&self, element: [usize; 2], [s, t]: [f64; 2]) -> [f64; 2] {
        let [[u0, u1], [v0, v1]] = self.patch.span_box(element);
        [u0 + s * (u1 - u0), v0 + t * (v1 - v0)]
    }

    /// The line where parameter `fixed` (0: u, 1: v) equals its break number `index`.
    fn line(&self, fixed: usize, index: usize) -> Line {
        let spans = self.patch.elements();
        let (span, side) = if index == spans[fixed] { (index - 1, 1.0) } else { (index, 0.0) };
        let mut line = Vec::with_capacity(spans[1 - fixed] * EDGE_POINTS + 1);
        for running in 0..spans[1 - fixed] {
            let first = usize::from(running > 0);
            for k in first..=EDGE_POINTS {
                let t = k as f64 / EDGE_POINTS as f64;
                let at = if fixed == 0 { ([span, running], [side, t]) } else { ([running, span], [t, side]) };
                line.push(self.place(at.0, at.1));
            }
        }
        line
    }

    /// Rows of cells, every element divided alike, as finely as `most_cells` allows (at most 4 x 4).
    fn stress_rows(&self, stress: &StressField, most_cells: usize) -> Vec<StressRow> {
        let [nu, nv] = self.patch.elements();
        let pieces = (4..=4).chain([3, 2]).find(|n| n * n * nu * nv <= most_cells).unwrap_or(1);
        let level = |j: usize, t: f64| -> Line {
            let corner = |k: usize| match k {
                k if k == nu * pieces => self.place([nu - 1, j], [1.0, t]),
                k => self.place([k / pieces, j], [(k % pieces) as f64 / pieces as f64, t]),
            };
            (0..=nu * pieces).map(corner).collect()
        };
        let mut rows = Vec::with_capacity(nv * pieces);
        for row in 0..nv * pieces {
            let (j, below) = (row / pieces, (row % pieces) as f64 / pieces as f64);
            let above = below + 1.0 / pieces as f64;
            let middle = |k: usize| {
                let s = ((k % pieces) as f64 + 0.5) / pieces as f64;
                let element = [k / pieces, j];
                stress(element, self.parameters(element, [s, 0.5 * (below + above)])).von_mises()
            };
            let values = (0..nu * pieces).map(middle).collect();
            rows.push(StressRow { lower: level(j, below), upper: level(j, above), values });
        }
        rows
    }
}
