//! When the drives of a march come by again, and by what way.

use std::ops::RangeInclusive;

use crate::model::{Control as Motion, Mirror, Model};

use super::Control;

/// Values that may be kept for later, all steps together: half a gigabyte.
const MAX_KEPT: usize = 1 << 26;
/// Differences of signatures below which drives are compared.
const NEAR: f64 = 1e-9;

/// How a path comes by again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// The drives stand where they stood.
    Back,
    /// They stand at the mirror image.
    Mirrored,
}

impl Way {
    /// All there are.
    pub const ALL: [Self; 2] = [Self::Back, Self::Mirrored];
}

/// Nominal steps of a march at which the drives come by again where nothing rubs; empty where something does, where nothing
/// comes by again, and where it would take too much memory to make use of it.
pub struct Ways<'a> {
    pub(super) model: &'a Model,
    pub(super) mirror: Option<Mirror>,
    nominal: f64,
    size: f64,
    /// One number for the drives of each nominal step until all tables have ended, in increasing order, and the step.
    signatures: Vec<(f64, usize)>,
}

impl<'a> Ways<'a> {
    /// Of a march through these nominal steps. It may be extended later: what counts is how long the tables go on.
    pub fn new(model: &'a Model, control: &Control) -> Self {
        let nominal = control.end / control.steps as f64;
        let none = Self { model, mirror: None, nominal, size: model.size(), signatures: vec![] };
        let ends = model.motions.iter().filter_map(|m| m.control.table().time.last());
        let last = (ends.fold(control.end, |m, t| m.max(*t)) / nominal).round() as usize;
        if !model.forgets() || last > MAX_KEPT / model.nodes().max(1) {
            return none;
        }
        let mut this = Self { mirror: Mirror::of(model), ..none };
        this.signatures = (1..=last).map(|step| (this.signature(Way::Back, step), step)).collect();
        this.signatures.sort_by(|a, b| a.0.total_cmp(&b.0));
        let kept = (1..=last).filter(|&step| this.keeps(step)).count();
        if kept == 0 || kept * model.unknowns() > MAX_KEPT {
            this.signatures.clear();
        }
        this
    }

    /// Whether any state will be needed again.
    pub fn any(&self) -> bool {
        !self.signatures.is_empty()
    }

    /// How many of the first nominal steps come by again from an earlier one.
    pub fn recalled(&self, steps: usize) -> usize {
        (1..=steps).filter(|&step| self.comes_by(step, |other| (other, step), 1..=step - 1)).count()
    }

    /// Whether the drives of a nominal step come by again.
    pub fn keeps(&self, step: usize) -> bool {
        self.comes_by(step, |other| (step, other), step + 1..=usize::MAX)
    }

    /// Whether a step and one of a range are an earlier and a later one of the same drives; what stands still is no way back.
    fn comes_by(&self, step: usize, order: impl Fn(usize) -> (usize, usize), range: RangeInclusive<usize>) -> bool {
        Way::ALL.into_iter().any(|way| {
            self.candidates(way, step).any(|other| {
                let (from, to) = order(other);
                range.contains(&other) && (way == Way::Mirrored || from + 1 < to) && self.leads(way, from, to)
            })
        })
    }

    /// Steps whose drives may be those of this one after a way.
    pub(super) fn candidates(&self, way: Way, step: usize) -> impl Iterator<Item = usize> + '_ {
        let wanted = self.signature(way, step);
        let known = if wanted.is_nan() { &[][..] } else { &self.signatures };
        let first = known.partition_point(|(signature, _)| *signature < wanted - NEAR);
        known[first..].iter().take_while(move |(signature, _)| *signature <= wanted + NEAR).map(|(_, step)| *step)
    }

    /// Whether the drives of one nominal step are those of another after a way.
    pub(super) fn leads(&self, way: Way, from: usize, to: usize) -> bool {
        let [a, b] = [from, to].map(|step| step as f64 * self.nominal);
        match way {
            Way::Back => self.model.motions.iter().all(|m| m.control.table().agrees(a, b)),
            Way::Mirrored => self.mirror.as_ref().is_some_and(|mirror| mirror.agrees(self.model, a, b)),
        }
    }

    /// A number that is the same where the drives are, after a way; `NaN` where there is no such way.
    fn signature(&self, way: Way, step: usize) -> f64 {
        let time = step as f64 * self.nominal;
        let (mut sum, mut weight) = (0.0, 1.0);
        for motion in &self.model.motions {
            let value = match (way, &self.mirror) {
                (Way::Back, _) => motion.control.table().at(time),
                (Way::Mirrored, Some(mirror)) => mirror.drive(motion, time),
                (Way::Mirrored, None) => f64::NAN,
            };
            // weights without common measure, so that hardly anything else adds up to the same
            weight = (weight * 1.618_033_988_749_895_f64).fract() + 0.5;
            let scale = match &motion.control {
                Motion::Displacement(_) => self.size,
                Motion::Force(table) => table.largest().max(f64::MIN_POSITIVE),
            };
            sum += weight * value / scale;
        }
        sum
    }

    /// The nominal step that ends at a time.
    pub(super) fn step_at(&self, time: f64) -> Option<usize> {
        let step = (time / self.nominal).round();
        ((time / self.nominal - step).abs() < 1e-9).then_some(step as usize)
    }
}
