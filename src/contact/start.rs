//! Partners at the start of a step.

use std::sync::{Arc, Mutex, PoisonError};

use crate::geometry::Point;

use super::interface::Configuration;
use super::projection::Partner;

/// One entry for each quadrature point.
pub type Partners = Arc<[Option<Partner>]>;

/// Keeps the partners found last, with the positions that they belong to: all evaluations of a step start from the same
/// ones. Whoever asks cannot tell whether an answer was kept.
#[derive(Debug, Default)]
pub struct StartPartners {
    last: Mutex<Option<Found>>,
}

#[derive(Debug)]
struct Found {
    nonmortar: Vec<Point>,
    mortar: Vec<Point>,
    partners: Partners,
}

/// A copy has found nothing yet.
impl Clone for StartPartners {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl StartPartners {
    /// The partners at these positions; `find` looks for them where they are not those found last.
    pub fn at(&self, at: &Configuration, find: impl FnOnce() -> Partners) -> Partners {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = &*last
            && found.nonmortar == at.nonmortar
            && found.mortar == at.mortar
        {
            return found.partners.clone();
        }
        let partners = find();
        *last =
            Some(Found { nonmortar: at.nonmortar.to_vec(), mortar: at.mortar.to_vec(), partners: partners.clone() });
        partners
    }
}
