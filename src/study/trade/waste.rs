//! Which choice costs most without making up for it.

use super::Trade;
use super::advice::TARGETS;
use super::front::{Cost, cheapest};
use super::measure::Measured;
use super::search::Found;

/// Ratios below this are noise of the clock.
const NOISE: f64 = 1.2;

/// Choice, how many times the CPU time of the best settings it takes, and at which error; the worst first. Each choice at the wanted
/// error at which it wastes most, among those that it reaches at all.
pub(super) fn wastes(trade: &Trade, found: &Found) -> Vec<(String, f64, f64)> {
    let costs = found.costs();
    let mut labels: Vec<String> = found.points.iter().flat_map(|point| labels(trade, point)).collect();
    labels.sort();
    labels.dedup();
    let worst = |label: String| {
        let own = |(point, cost): (&Measured, &Cost)| {
            let has = labels_of(trade, point, &label);
            Cost { error: if has { cost.error } else { f64::NAN }, ..*cost }
        };
        let own: Vec<Cost> = found.points.iter().zip(&costs).map(own).collect();
        let ratio =
            |target: f64| Some((own[cheapest(&own, target)?].cpu_s / costs[cheapest(&costs, target)?].cpu_s, target));
        let (ratio, target) = TARGETS.into_iter().filter_map(ratio).max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((label, ratio, target))
    };
    let mut list: Vec<_> = labels.into_iter().filter_map(worst).filter(|(_, ratio, _)| *ratio > NOISE).collect();
    list.sort_by(|a, b| b.1.total_cmp(&a.1));
    list
}

fn labels_of(trade: &Trade, point: &Measured, label: &str) -> bool {
    labels(trade, point).iter().any(|own| own == label)
}

/// Names of the choices of a setting, apart from the number of elements.
fn labels(trade: &Trade, point: &Measured) -> Vec<String> {
    let (setting, scene) = (&point.setting, trade.scene());
    let mut labels = setting.choice_words(scene);
    labels.push(setting.basis_words(scene));
    labels.extend(setting.step_count(scene).map(|steps| format!("{steps} steps")));
    if setting.grading != 0 {
        labels.push(format!("grading x {}", f64::from(setting.grading).exp2()));
    }
    labels
}
