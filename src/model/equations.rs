//! Numbering of the displacement unknowns and the fixed pattern of the bulk stiffness.

use std::sync::Arc;

use crate::bulk::{Elements, Material};
use crate::geometry::Point;
use crate::math::Pattern;

use super::body::{Body, BodyKind};
use super::motion::{Control, Motion};

/// Where one displacement component comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dof {
    /// Unknown of this number; several components share one where an edge moves as one piece.
    Unknown(usize),
    /// Follows a motion.
    Prescribed(usize),
    /// A rigid body without motion in this component.
    Fixed,
}

/// Numbering of a model.
#[derive(Clone, Debug)]
pub struct Equations {
    /// For each control point, its two components.
    pub dofs: Vec<[Dof; 2]>,
    /// Number of displacement unknowns.
    pub count: usize,
    /// Unknown that belongs to each force-controlled motion.
    pub of_motion: Vec<Option<usize>>,
    /// Pattern of the bulk stiffness.
    pub pattern: Arc<Pattern>,
    /// Where the element stiffness of each body goes.
    pub scatter: Vec<Scatter>,
    /// Lower half of the stiffness of the bodies of linear material, on `pattern`; empty where there are none.
    pub constant: Vec<f64>,
}

/// Where the entries of the element stiffnesses of a body belong in the lower half of the bulk stiffness.
#[derive(Clone, Debug, Default)]
pub struct Scatter {
    /// Place in the element stiffness and in the values of the pattern, element by element.
    entries: Vec<(u32, u32)>,
    /// Where the entries of each element end.
    ends: Vec<usize>,
}

impl Scatter {
    /// For the unknowns of every element.
    fn new(pattern: &Pattern, lists: &[Vec<Option<usize>>]) -> Self {
        let mut this = Self::default();
        for list in lists {
            let known = || list.iter().enumerate().filter_map(|(k, e)| Some((k, (*e)?)));
            for (j, column) in known() {
                for (i, row) in known().filter(|(_, row)| *row >= column) {
                    let target = pattern.position(row, column).expect("elements are cliques of the pattern");
                    let place = u32::try_from(Elements::place(i, j)).expect("far fewer than 2^32 entries");
                    this.entries.push((place, u32::try_from(target).expect("fewer than 2^32 entries")));
                }
            }
            this.ends.push(this.entries.len());
        }
        this
    }

    /// Adds the stiffness of element `e` to the values of the pattern.
    pub fn add(&self, e: usize, stiffness: &[f64], values: &mut [f64]) {
        let start = if e == 0 { 0 } else { self.ends[e - 1] };
        for &(from, to) in &self.entries[start..self.ends[e]] {
            values[to as usize] += stiffness[from as usize];
        }
    }
}

impl Equations {
    /// Numbers the unknowns. Where two displacement motions meet at a control point the later one holds.
    pub fn new(bodies: &[Body], motions: &[Motion]) -> Self {
        let nodes = bodies.last().map_or(0, |b| b.offset + b.points.len());
        let mut dofs: Vec<[Option<Dof>; 2]> = vec![[None; 2]; nodes];
        for body in bodies.iter().filter(|b| b.is_rigid()) {
            body.nodes().for_each(|i| dofs[i] = [Some(Dof::Fixed); 2]);
        }
        let mut count = 0;
        let mut of_motion = vec![None; motions.len()];
        for (k, motion) in motions.iter().enumerate() {
            if let Control::Force(_) = motion.control {
                of_motion[k] = Some(count);
                motion.nodes.iter().for_each(|&i| dofs[i][motion.component] = Some(Dof::Unknown(count)));
                count += 1;
            }
        }
        for (k, motion) in motions.iter().enumerate() {
            if let Control::Displacement(_) = motion.control {
                motion.nodes.iter().for_each(|&i| dofs[i][motion.component] = Some(Dof::Prescribed(k)));
            }
        }
        let mut number = |dof: Option<Dof>| {
            dof.unwrap_or_else(|| {
                count += 1;
                Dof::Unknown(count - 1)
            })
        };
        let dofs: Vec<[Dof; 2]> = dofs.into_iter().map(|pair| pair.map(&mut number)).collect();
        let lists = bodies.iter().map(|body| element_unknowns(body, &dofs)).collect::<Vec<_>>();
        let known = |list: &[Option<usize>]| list.iter().flatten().copied().collect();
        let diagonal = (0..count).map(|i| vec![i]);
        let pattern = Pattern::from_cliques(count, lists.iter().flatten().map(|l| known(l)).chain(diagonal));
        let scatter: Vec<Scatter> = lists.iter().map(|lists| Scatter::new(&pattern, lists)).collect();
        let linear = |body: &Body| body.material().filter(|m| m.linear()).cloned();
        let constant = at_rest(bodies, &pattern, &scatter, linear);
        Self { dofs, count, of_motion, pattern: Arc::new(pattern), scatter, constant }
    }

    /// Unknown behind a displacement component.
    pub fn unknown(&self, node: usize, component: usize) -> Option<usize> {
        match self.dofs[node][component] {
            Dof::Unknown(e) => Some(e),
            _ => None,
        }
    }
}

/// Unknowns of every element of a body, `None` for components that are given.
fn element_unknowns(body: &Body, dofs: &[[Dof; 2]]) -> Vec<Vec<Option<usize>>> {
    let BodyKind::Deformable { elements, .. } = &body.kind else { return vec![] };
    let unknown = |dof: Dof| match dof {
        Dof::Unknown(e) => Some(e),
        _ => None,
    };
    (0..elements.cliques())
        .map(|e| elements.nodes(e).iter().flat_map(|&a| dofs[body.offset + a].map(unknown)).collect())
        .collect()
}

/// Stiffness at rest, lower half, of the bodies that have a `material` here; empty where none has.
pub(super) fn at_rest(
    bodies: &[Body],
    pattern: &Pattern,
    scatter: &[Scatter],
    material: impl Fn(&Body) -> Option<Arc<dyn Material>>,
) -> Vec<f64> {
    let mut values = Vec::new();
    for (body, scatter) in bodies.iter().zip(scatter) {
        if let (BodyKind::Deformable { elements, .. }, Some(material)) = (&body.kind, material(body)) {
            values.resize(pattern.rows.len(), 0.0);
            let rest = vec![Point::zeros(); body.points.len()];
            let add = |e: usize, found: crate::bulk::BulkForces| scatter.add(e, found.stiffness, &mut values);
            elements.integrate(material.as_ref(), &rest, true, add).expect("every material has a state at rest");
        }
    }
    values
}
