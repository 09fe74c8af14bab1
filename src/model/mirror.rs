//! Mirror symmetry about vertical axes: the bodies by themselves, and what drives them at two times.

use crate::geometry::Point;

use super::{Body, Control, Model, Motion, State};

/// Positions, weights and courses that differ by less, in units of their largest value, are the same.
const SAME: f64 = 1e-12;

/// The map of a model onto itself under `x -> 2 a - x`, each body about its own axis in the reference configuration. The axis
/// `a` is that of a body that does not move along x.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// `a`.
    pub axis: f64,
    /// Reference axis of each body.
    axes: Vec<f64>,
    /// Control point onto which each one is mapped.
    partner: Vec<usize>,
    /// Places that differ by less are the same.
    near: f64,
}

impl Mirror {
    /// `None` where some body, driven edge or contact edge is not its own mirror image, where every body may move along x, and
    /// where those that do not have different axes.
    pub fn of(model: &Model) -> Option<Self> {
        let mut this = Self { axis: 0.0, axes: vec![], partner: vec![], near: SAME * model.size() };
        for body in &model.bodies {
            let (axis, partner) = own_axis(body)?;
            this.axes.push(axis);
            this.partner.extend(partner.into_iter().map(|i| body.offset + i));
        }
        let kept = |m: &Motion| m.nodes.iter().all(|&i| m.nodes.contains(&this.partner[i]));
        let turned = |nodes: &[usize]| nodes.iter().zip(nodes.iter().rev()).all(|(&i, &j)| this.partner[i] == j);
        let sides = || model.pairs.iter().flat_map(|pair| [&pair.nonmortar, &pair.mortar]);
        if !(model.motions.iter().all(kept) && sides().all(|side| turned(&side.nodes))) {
            return None;
        }
        let held: Vec<f64> = (0..model.bodies.len()).filter_map(|k| this.held(model, k)).collect();
        this.axis = *held.first()?;
        held.iter().all(|axis| (axis - this.axis).abs() <= this.near).then_some(this)
    }

    /// The axis of a body that does not move along x.
    fn held(&self, model: &Model, body: usize) -> Option<f64> {
        let along = |m: &&Motion| m.body == body && m.component == 0;
        let mut motions = model.motions.iter().filter(along).peekable();
        if motions.peek().is_none() {
            return model.bodies[body].is_rigid().then_some(self.axes[body]);
        }
        motions.find_map(|motion| match &motion.control {
            Control::Displacement(table) if table.is_constant() => Some(self.axes[body] + table.at(0.0)),
            _ => None,
        })
    }

    /// What drives the mirror image of a motion at a time.
    pub fn drive(&self, motion: &Motion, time: f64) -> f64 {
        let value = motion.control.table().at(time);
        match (&motion.control, motion.component) {
            (Control::Displacement(_), 0) => 2.0 * (self.axis - self.axes[motion.body]) - value,
            (Control::Force(_), 0) => -value,
            _ => value,
        }
    }

    /// Whether what drives the bodies at one time is the mirror image of what drives them at another.
    pub fn agrees(&self, model: &Model, from: f64, to: f64) -> bool {
        model.motions.iter().all(|motion| {
            let apart = (self.drive(motion, from) - motion.control.table().at(to)).abs();
            apart
                <= match motion.control {
                    Control::Displacement(_) => self.near,
                    Control::Force(_) => SAME * motion.control.table().largest(),
                }
        })
    }

    /// Displacements and pressures of a state, mirrored.
    pub fn image(&self, model: &Model, state: &State) -> State {
        let mut image = state.clone();
        for (body, own) in model.bodies.iter().zip(&self.axes) {
            for i in body.nodes() {
                let u = state.u[i];
                image.u[self.partner[i]] = Point::new(2.0 * (self.axis - own) - u.x, u.y);
            }
        }
        image.pairs.iter_mut().for_each(|pair| pair.pressure.reverse());
        image
    }
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
