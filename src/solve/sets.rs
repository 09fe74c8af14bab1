//! State sets of the iterates: which sites are open, stick or slip; whether they come round again, and where they do.

use std::collections::VecDeque;

use crate::contact::SiteRecord;
use crate::math::checksum;
use crate::model::{ContactStatus, Evaluation, Model};

/// Longest period that is looked for, and sets that are kept.
const LONGEST: usize = 5;

/// The sets of the iterates of one attempt.
///
/// Newton's method for linear bodies depends on the sets alone: one that comes back brings all that followed, and the iteration
/// cycles. For bodies that are not linear it may still drift to the solution, so a cycle has to show twice and without a gain.
#[derive(Default)]
pub struct Sets {
    /// Checksum of each set.
    signatures: Vec<u64>,
    last: VecDeque<Vec<u8>>,
}

impl Sets {
    /// Takes that of the next iterate.
    pub fn take(&mut self, evaluation: &Evaluation) {
        let set: Vec<u8> = sites(evaluation).map(state).collect();
        self.signatures.push(checksum(set.iter().map(|&state| u64::from(state))));
        if self.last.len() > LONGEST {
            self.last.pop_front();
        }
        self.last.push_back(set);
    }

    /// Period with which the sets came round twice while the smallest of the `residuals`, one for each set, was not halved.
    pub fn period(&self, residuals: &[f64]) -> Option<usize> {
        let (sets, end) = (&self.signatures, self.signatures.len());
        let best = |part: &[f64]| part.iter().fold(f64::INFINITY, |m, v| m.min(*v));
        (2..=LONGEST).take_while(|period| 2 * period <= end).find(|period| {
            let (before, now) = (end - 2 * period..end - period, end - period..end);
            let moves = sets[now.clone()].iter().any(|set| *set != sets[end - 1]);
            let gains = best(&residuals[now.clone()]) <= 0.5 * best(&residuals[before.clone()]);
            moves && !gains && sets[before] == sets[now]
        })
    }

    /// The sites whose state still changed in the last iterates, in words that start with a separator; empty where all had settled.
    /// `evaluation` is that of the last iterate.
    pub fn unsettled(&self, model: &Model, evaluation: &Evaluation) -> String {
        let Some(now) = self.last.back() else { return String::new() };
        let changed = |i: usize| self.last.iter().any(|set| set.len() != now.len() || set[i] != now[i]);
        let moving: Vec<&SiteRecord> = sites(evaluation)
            .enumerate()
            .filter(|(i, site)| changed(*i) && site.x.x.is_finite())
            .map(|(_, site)| site)
            .collect();
        let (Some(first), Some(end)) = (moving.first(), moving.last()) else { return String::new() };
        let count = |status| sites(evaluation).filter(|site| site.status == status).count();
        let laws: Vec<&str> = model.pairs.iter().filter_map(|p| Some(p.contact.law()?.typetag_name())).collect();
        format!(
            "; {} of {} contact sites, from ({:.4}, {:.4}) to ({:.4}, {:.4}), did not settle between open, stick and slip (last {} open, \
             {} stick, {} slip; law: {})",
            moving.len(),
            now.len(),
            first.x.x,
            first.x.y,
            end.x.x,
            end.x.y,
            count(ContactStatus::Open),
            count(ContactStatus::Stick),
            count(ContactStatus::Slip),
            if laws.is_empty() { "frictionless".into() } else { laws.join(", ") },
        )
    }
}

fn sites(evaluation: &Evaluation) -> impl Iterator<Item = &SiteRecord> {
    evaluation.interfaces.iter().flat_map(|interface| &interface.sites)
}

/// Open, stick, or slip to either side.
fn state(site: &SiteRecord) -> u8 {
    match site.status {
        ContactStatus::Open => 0,
        ContactStatus::Stick => 1,
        ContactStatus::Slip if site.traction < 0.0 => 2,
        ContactStatus::Slip => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn period(signatures: &[u64], residuals: &[f64]) -> Option<usize> {
        Sets { signatures: signatures.to_vec(), last: VecDeque::new() }.period(residuals)
    }

    #[test]
    fn a_cycle_shows_twice_and_gains_nothing() {
        assert_eq!(period(&[9, 1, 2, 1, 2], &[1.0; 5]), Some(2));
        assert_eq!(period(&[1, 2, 3, 1, 2, 3], &[1.0; 6]), Some(3));
        assert_eq!(period(&[9, 1, 2, 1], &[1.0; 4]), None, "once is no cycle");
        assert_eq!(period(&[1, 1, 1, 1], &[1.0; 4]), None, "settled");
        assert_eq!(period(&[1, 2, 1, 2], &[1.0, 0.9, 0.4, 0.5]), None, "it comes nearer");
    }
}
