//! The instants worth a picture, chosen from the history of forces.

use crate::model::Record;

/// Forces below this share of their largest magnitude do not count as contact.
pub const CONTACT_THRESHOLD: f64 = 0.02;
/// Most instants chosen.
const MOST: usize = 6;
/// Fewest instants, if the history has that many rows in contact.
const FEWEST: usize = 4;
/// A horizontal force below this share of the largest resultant is round-off, or as good as.
const FELT: f64 = 1e-6;

/// A row of the history with the reason it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Index into the records.
    pub index: usize,
    /// Panel letter: a, b, c ... in the order of the history.
    pub letter: char,
    /// Markup that says what is special, e.g. `max *F*_x`, or which step it is.
    pub label: String,
}

/// First contact, largest Fx, apex, largest Fy, smallest Fx and last contact, as far as they exist and differ; filled up
/// with evenly spaced instants to four or six, so that no panel stays empty. Only converged rows are chosen; empty without contact.
pub fn choose(records: &[Record]) -> Vec<Instant> {
    let contact = in_contact(records);
    let mut chosen: Vec<(usize, &str)> = Vec::new();
    let nearest = (contact.len() / 40).max(1);
    for (position, label) in special(records, &contact) {
        match chosen.iter_mut().find(|(other, _)| other.abs_diff(position) < nearest) {
            None => chosen.push((position, label)),
            Some((_, known)) if known.is_empty() => *known = label,
            Some(_) => {}
        }
    }
    fill(&mut chosen, contact.len());
    chosen.truncate(MOST);
    chosen.sort_unstable_by_key(|(position, _)| *position);
    let lettered = chosen.into_iter().zip('a'..='z');
    lettered
        .map(|((position, label), letter)| {
            let index = contact[position];
            let label = if label.is_empty() { format!("step {}", records[index].step) } else { label.into() };
            Instant { index, letter, label }
        })
        .collect()
}

/// Rows whose resultant exceeds the threshold.
fn in_contact(records: &[Record]) -> Vec<usize> {
    let size = |record: &Record| record.force[0].hypot(record.force[1]);
    let converged = || records.iter().enumerate().filter(|(_, record)| record.converged && size(record).is_finite());
    let largest = converged().fold(0.0_f64, |largest, (_, record)| largest.max(size(record)));
    let felt = |record: &Record| largest > 0.0 && size(record) >= CONTACT_THRESHOLD * largest;
    converged().filter(|(_, record)| felt(record)).map(|(index, _)| index).collect()
}

/// Positions in `contact` with their labels, the most telling first.
fn special<'a>(records: &[Record], contact: &[usize]) -> Vec<(usize, &'a str)> {
    let Some(last) = contact.len().checked_sub(1) else { return Vec::new() };
    let fx = |position: usize| records[contact[position]].force[0];
    let fy = |position: usize| records[contact[position]].force[1];
    let best = |value: &dyn Fn(usize) -> f64| (0..=last).max_by(|a, b| value(*a).total_cmp(&value(*b)));
    let mut found: Vec<(usize, &str)> = Vec::new();
    let largest = (0..=last).map(|k| fx(k).hypot(fy(k))).fold(0.0, f64::max);
    let felt = |k: &usize| fx(*k).abs() > FELT * largest;
    found.extend(best(&fx).filter(felt).map(|k| (k, "max *F*_x")));
    found.extend(best(&fy).map(|k| (k, "max *F*_y")));
    found.extend(apex(records, contact).map(|k| (k, "apex")));
    found.extend(best(&|k| -fx(k)).filter(|k| fx(*k) < 0.0 && felt(k)).map(|k| (k, "min *F*_x")));
    found.extend([(0, "first contact"), (last, "last contact")]);
    found
}

/// Where the mean contact angle changes from climbing to descending.
fn apex(records: &[Record], contact: &[usize]) -> Option<usize> {
    let angle = |position: usize| records[contact[position]].contact_angle;
    let largest = (0..contact.len()).map(|k| angle(k).abs()).fold(0.0, f64::max);
    // Round-off on flat surfaces changes its sign all the time.
    let steep = |k: usize| angle(k) > 0.05 * largest;
    let before = (0..contact.len()).rev().find(|k| largest > 1e-3 && steep(*k))?;
    let after = (before + 1..contact.len()).find(|k| angle(*k) <= 0.0)?;
    (before..=after).min_by(|a, b| angle(*a).abs().total_cmp(&angle(*b).abs()))
}

/// Adds the middle of the widest gap until the panels of the figure are full.
fn fill(chosen: &mut Vec<(usize, &str)>, available: usize) {
    let wanted = if chosen.len() > FEWEST { MOST } else { FEWEST };
    while chosen.len() < wanted.min(available) {
        chosen.sort_unstable_by_key(|(position, _)| *position);
        let widest = chosen.windows(2).max_by_key(|pair| pair[1].0 - pair[0].0);
        let Some([a, b]) = widest.map(|pair| [pair[0].0, pair[1].0]).filter(|[a, b]| b - a > 1) else { return };
        chosen.push((a.midpoint(b), ""));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::figures::synthetic::{history, pass};

    #[test]
    fn a_pass_shows_its_six_events_in_order() {
        let records = pass(76, 0.3);
        let chosen = choose(&records);
        let labels: Vec<_> = chosen.iter().map(|instant| instant.label.as_str()).collect();
        assert_eq!(labels, ["first contact", "max *F*_x", "apex", "max *F*_y", "min *F*_x", "last contact"]);
        assert!(chosen.windows(2).all(|pair| pair[0].index < pair[1].index && pair[0].letter < pair[1].letter));
    }

    #[test]
    fn no_contact_no_instants_and_few_rows_no_panic() {
        assert!(choose(&[]).is_empty());
        assert!(choose(&history(10, |_| [0.0, 0.0])).is_empty());
        assert_eq!(choose(&history(1, |_| [0.1, 1.0])).len(), 1);
        assert_eq!(choose(&history(30, |t| [0.0, t])).len(), 4);
    }
}
