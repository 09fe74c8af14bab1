//! Numbering of the displacement unknowns and the fixed pattern of the bulk stiffness.

use std::sync::Arc;

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
    /// For each deformable body, element by element and row-major, the place of each entry of the element stiffness in
    /// the values of `pattern`; `u32::MAX` where a row or column is not an unknown.
    pub places: Vec<Vec<u32>>,
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
        let places = lists.iter().map(|body| body.iter().flat_map(|list| places(&pattern, list)).collect()).collect();
        Self { dofs, count, of_motion, pattern: Arc::new(pattern), places }
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
    (0..elements.count())
        .map(|e| elements.nodes(e).iter().flat_map(|&a| dofs[body.offset + a].map(unknown)).collect())
        .collect()
}

fn places(pattern: &Pattern, list: &[Option<usize>]) -> Vec<u32> {
    let place = |i: Option<usize>, j: Option<usize>| {
        let position = pattern.position(i?, j?)?;
        u32::try_from(position).ok()
    };
    list.iter().flat_map(|&i| list.iter().map(move |&j| place(i, j).unwrap_or(u32::MAX))).collect()
}
