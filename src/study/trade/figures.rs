//! Work-precision diagrams: of the largest error, and of each quantity.

use std::path::Path;

use super::found::Found;
use super::front::{Cost, front};
use super::norm::QUANTITIES;
use super::setting::Setting;
use super::{Role, Trade};
use crate::output::figures::precision::{Family, Precision};
use crate::output::{OutputError, RunFolder};

/// Draws `work-precision` and, with several quantities, `work-precision-<quantity>` into the folder `figures`.
///
/// # Errors
/// A file that cannot be written.
pub fn write_figures(trade: &Trade, found: &Found, folder: &Path) -> Result<(), OutputError> {
    let target = RunFolder::create(folder)?.figures()?;
    let largest = figure(trade, found, "largest error, share of the peak", &found.quantities);
    largest.write(&target, "work-precision")?;
    for k in found.quantities.iter().filter(|_| found.quantities.len() > 1) {
        let label = format!("error of {}, share of the peak", QUANTITIES[*k].replace('_', " "));
        figure(trade, found, &label, &[*k]).write(&target, &format!("work-precision-{}", QUANTITIES[*k]))?;
    }
    Ok(())
}

fn figure(trade: &Trade, found: &Found, y_label: &str, quantities: &[usize]) -> Precision {
    let family_of = |setting: &Setting| setting.basis_words(trade.scene());
    let mut labels: Vec<String> = found.points.iter().map(|point| family_of(&point.setting)).collect();
    labels.sort();
    labels.dedup();
    let costs: Vec<Cost> = found
        .points
        .iter()
        .map(|point| {
            let error = quantities.iter().map(|k| point.errors[*k]).fold(0.0, f64::max);
            let drawn = point.role == Role::Candidate && point.done() && error > 0.0 && error < 1.0;
            Cost { cpu_s: point.status.cpu_s, error: if drawn { error } else { f64::NAN } }
        })
        .collect();
    let families = labels.into_iter().map(|label| {
        let member = |k: usize| family_of(&found.points[k].setting) == label;
        let own = |(k, cost): (usize, &Cost)| Cost { error: if member(k) { cost.error } else { f64::NAN }, ..*cost };
        let own: Vec<Cost> = costs.iter().enumerate().map(own).collect();
        let (line, at) = (front(&own), |k: &usize| [own[*k].cpu_s, own[*k].error]);
        let others = (0..own.len()).filter(|k| own[*k].error.is_finite() && !line.contains(k));
        Family { label, line: line.iter().map(at).collect(), dots: others.map(|k| at(&k)).collect() }
    });
    Precision {
        y_label: y_label.to_owned(),
        families: families.filter(|family| !family.line.is_empty()).collect(),
        front: front(&costs).iter().map(|k| [costs[*k].cpu_s, costs[*k].error]).collect(),
        floor: quantities.iter().map(|k| found.estimates[*k].error).fold(0.0, f64::max),
    }
}
