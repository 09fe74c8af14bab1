//! The bodies of a model at one state, as the output room draws them.

use nalgebra::Matrix2;

use crate::bulk::Material;
use crate::geometry::{Patch, Point};
use crate::model::{Body, BodyKind, Model};
use crate::output::vtu::{BodyField, CauchySample};

/// Every deformable body, and every contact edge of the rigid ones; `u` is the displacement of all control points.
pub(super) fn bodies<'a>(model: &'a Model, u: &'a [Point]) -> Vec<BodyField<'a>> {
    model.bodies.iter().flat_map(|body| fields(body, &u[body.nodes()])).collect()
}

fn fields<'a>(body: &'a Body, u: &'a [Point]) -> Vec<BodyField<'a>> {
    match &body.kind {
        BodyKind::Deformable { patch, elements, material } => {
            let (deformed, tau) = (moved(patch, u), elements.tau(material.as_ref(), u));
            vec![BodyField::Deformable {
                name: &body.name,
                patch,
                displacement: u,
                stress: Box::new(move |element, uv| {
                    let f = deformation_gradient(patch, &deformed, element, uv);
                    sample(material.as_ref(), f, &|theta| tau.at(element, uv, theta))
                }),
            }]
        }
        BodyKind::Rigid { curves } => {
            let mut first = 0;
            let field = curves.iter().map(|(_, curve)| {
                let nodes = first..first + curve.points.len();
                first = nodes.end;
                BodyField::Rigid { name: &body.name, curve, displacement: &u[nodes] }
            });
            field.collect()
        }
    }
}

fn moved(patch: &Patch, u: &[Point]) -> Patch {
    let points = patch.points.iter().zip(u).map(|(x, u)| x + u).collect();
    Patch { points, ..patch.clone() }
}

/// `F = (dx/dxi) (dX/dxi)^-1`; undefined where the map degenerates (a corner of a disk).
fn deformation_gradient(patch: &Patch, deformed: &Patch, element: [usize; 2], uv: [f64; 2]) -> Option<Matrix2<f64>> {
    let columns = |patch: &Patch| Matrix2::from_columns(&patch.map(element, uv).1);
    columns(patch).try_inverse().map(|inverse| columns(deformed) * inverse)
}

/// Undefined also where the body is inverted.
fn sample(material: &dyn Material, f: Option<Matrix2<f64>>, tau: &dyn Fn(f64) -> f64) -> CauchySample {
    match f.and_then(|f| Some((f, material.cauchy(&f, tau)?))) {
        Some((f, stress)) => CauchySample { stress, det_f: f.determinant() },
        None => CauchySample { stress: [f64::NAN; 4], det_f: f64::NAN },
    }
}
