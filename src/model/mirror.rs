//! Mirror symmetry about vertical axes: the bodies by themselves, and what drives them at two times.

use crate::geometry::Point;

use super::{Body, Control, Model, Motion, State};

/// Positions, weights and courses that differ by less, in units of their largest value, are the same.
const SAME: f64 = 1e-12;

/// The map of a model onto itself under `x -> 2 a - x`, each body about its own axis in the reference configuration.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Reference axis of each body.
    axes: Vec<f64>,
    /// Control point onto which each one is mapped.
    partner: Vec<usize>,
    /// Places that differ by less are the same.
    near: f64,
}

impl Mirror {
    /// `None` where some body, driven edge or contact edge is not its own mirror image.
    pub fn of(model: &Model) -> Option<Self> {
        let mut this = Self { axes: vec![], partner: vec![], near: SAME * model.size() };
        for body in &model.bodies {
            let (axis, partner) = own_axis(body)?;
            this.axes.push(axis);
            this.partner.extend(partner.into_iter().map(|i| body.offset + i));
        }
        let kept = |m: &Motion| m.nodes.iter().all(|&i| m.nodes.contains(&this.partner[i]));
        let turned = |nodes: &[usize]| nodes.iter().zip(nodes.iter().rev()).all(|(&i, &j)| this.partner[i] == j);
        let sides = || model.pairs.iter().flat_map(|pair| [&pair.nonmortar, &pair.mortar]);
        (model.motions.iter().all(kept) && sides().all(|side| turned(&side.nodes))).then_some(this)
    }

    /// The axis about which what drives the bodies at one time is the mirror image of what drives them at another; `None`
    /// where there is none, or where nothing tells where the bodies are.
    pub fn axis(&self, model: &Model, from: f64, to: f64) -> Option<f64> {
        let mut axis = None;
        let held =
            |k: usize| model.bodies[k].is_rigid() && model.motions.iter().all(|m| m.body != k || m.component != 0);
        for k in (0..model.bodies.len()).filter(|&k| held(k)) {
            agree(&mut axis, self.axes[k], self.near)?;
        }
        for motion in &model.motions {
            let table = motion.control.table();
            let sum = table.at(from) + table.at(to);
            match (&motion.control, motion.component) {
                (Control::Displacement(_), 0) => agree(&mut axis, self.axes[motion.body] + 0.5 * sum, self.near)?,
                (Control::Force(_), 0) => (sum.abs() <= SAME * table.largest()).then_some(())?,
                _ => table.agrees(from, to).then_some(())?,
            }
        }
        axis
    }

    /// Displacements and pressures of a state, mirrored about an axis.
    pub fn image(&self, model: &Model, state: &State, axis: f64) -> State {
        let mut image = state.clone();
        for (body, own) in model.bodies.iter().zip(&self.axes) {
            for i in body.nodes() {
                let u = state.u[i];
                image.u[self.partner[i]] = Point::new(2.0 * (axis - own) - u.x, u.y);
            }
        }
        image.pairs.iter_mut().for_each(|pair| pair.pressure.reverse());
        image
    }
}

/// Takes an axis, or compares it with the one that was taken.
fn agree(axis: &mut Option<f64>, found: f64, near: f64) -> Option<()> {
    let known = *axis.get_or_insert(found);
    ((known - found).abs() <= near).then_some(())
}

/// Axis of a body and the control point onto which each is mapped, counted inside the body: rows of the patch, or rigid
/// curves, are run through backwards.
fn own_axis(body: &Body) -> Option<(f64, Vec<usize>)> {
    let (rows, weights): (Vec<usize>, &[f64]) = match body.patch() {
        Some(patch) => (vec![patch.basis[0].len(); patch.basis[1].len()], &patch.weights),
        None => (body.curves().map(|curve| curve.points.len()).collect(), &[]),
    };
    let mut partner = vec![];
    for length in rows {
        let first = partner.len();
        partner.extend((first..first + length).rev());
    }
    let axis = 0.5 * (body.points.first()?.x + body.points[*partner.first()?].x);
    let size = body.points.iter().fold(0.0_f64, |m, x| m.max((x - body.points[0]).amax()));
    let fits = partner.iter().enumerate().all(|(i, &j)| {
        let (x, y) = (body.points[i], body.points[j]);
        let weight = weights.is_empty() || (weights[i] - weights[j]).abs() <= SAME * weights[i];
        weight && (x.x + y.x - 2.0 * axis).abs().max((x.y - y.y).abs()) <= SAME * size
    });
    fits.then_some((axis, partner))
}
