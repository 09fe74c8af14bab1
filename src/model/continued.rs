//! Contact edges without mass: their motion is continued from inside the body.

use crate::geometry::{Edge, Point};

use super::{Body, Model};

/// Rounds of substitution after which a control point keeps its mass: in a body one element thick both rows may be edges.
const ROUNDS: usize = 3;

/// For every control point, where its velocity is taken from and with which factors; itself with factor 1 inside.
///
/// On a contact edge `v_0 = (1 + s) v_1 - s v_2` from the two rows of control points behind it, `s` such that the reference positions
/// obey the same rule as nearly as they can (exactly in a block); `v_0 = v_1` for degree 1, where the second row is none of the same
/// element.
#[derive(Clone, Debug)]
pub(super) struct Continued {
    /// Control points that are continued.
    edge: Vec<(usize, Vec<(usize, f64)>)>,
    /// Place in `edge` of every control point.
    place: Vec<Option<usize>>,
}

impl Continued {
    pub fn new(model: &Model) -> Self {
        let mut this = Self { edge: vec![], place: vec![None; model.nodes()] };
        for side in model.pairs.iter().flat_map(|pair| [&pair.nonmortar, &pair.mortar]) {
            for (node, rule) in rules(&model.bodies[side.body], &side.nodes) {
                if this.place[node].is_none() {
                    this.place[node] = Some(this.edge.len());
                    this.edge.push((node, rule));
                }
            }
        }
        for _ in 0..ROUNDS {
            let before = this.clone();
            for (_, rule) in &mut this.edge {
                *rule = rule.iter().flat_map(|&(i, f)| before.of(i).map(move |(j, g)| (j, f * g))).collect();
            }
        }
        let open: Vec<usize> =
            (0..this.edge.len()).filter(|&k| this.edge[k].1.iter().any(|(i, _)| this.place[*i].is_some())).collect();
        open.into_iter().for_each(|k| this.place[this.edge[k].0] = None);
        this
    }

    /// Where the velocity of a control point comes from.
    pub fn of(&self, node: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let rule = self.place[node].map(|k| &self.edge[k].1);
        rule.into_iter().flatten().copied().chain(rule.is_none().then_some((node, 1.0)))
    }

    /// Sets the continued values of a field.
    pub fn apply(&self, mut field: Vec<Point>) -> Vec<Point> {
        for (node, rule) in self.edge.iter().filter(|(node, _)| self.place[*node].is_some()) {
            field[*node] = rule.iter().map(|&(i, factor)| field[i] * factor).sum();
        }
        field
    }
}

/// How the control points of an edge are continued, numbered over all bodies.
fn rules(body: &Body, nodes: &[usize]) -> Vec<(usize, Vec<(usize, f64)>)> {
    let Some(patch) = body.patch() else { return vec![] };
    let edges = [Edge::Bottom, Edge::Right, Edge::Top, Edge::Left];
    let local = |node: &usize| node - body.offset;
    let own = |edge: &Edge| patch.boundary(*edge).nodes.iter().copied().eq(nodes.iter().map(local));
    let Some(edge) = edges.into_iter().find(own) else { return vec![] };
    let columns = isize::try_from(patch.basis[0].len()).expect("far fewer control points");
    let (inwards, across) = match edge {
        Edge::Bottom => (columns, 1),
        Edge::Top => (-columns, 1),
        Edge::Left => (1, 0),
        Edge::Right => (-1, 0),
    };
    let degree = patch.basis[across].degree();
    let rule = |node: &usize| {
        let [first, second] = [1, 2].map(|row| node.wrapping_add_signed(row * inwards));
        if degree < 2 {
            return (*node, vec![(first, 1.0)]);
        }
        let at = |i: usize| body.points[i - body.offset];
        let (ahead, behind) = (at(*node) - at(first), at(first) - at(second));
        let share = ahead.dot(&behind) / behind.norm_squared();
        (*node, vec![(first, 1.0 + share), (second, -share)])
    };
    nodes.iter().map(rule).collect()
}
