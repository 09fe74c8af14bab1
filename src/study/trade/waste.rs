//! Which choice costs most without making up for it.

use std::collections::BTreeMap;

use super::Trade;
use super::found::Found;
use super::front::cheapest;
use super::measure::Measured;

/// Ratios below this are noise of the clock.
const NOISE: f64 = 1.2;

/// A choice at its best: where it comes nearest to the best settings of equal error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Waste {
    /// The choice.
    pub choice: String,
    /// Its CPU time over that of the cheapest settings of at most the same error.
    pub ratio: f64,
    /// That error.
    pub error: f64,
}

/// Choices that are dear even at their best among the settings with errors in a range; the worst first.
pub(super) fn wastes(trade: &Trade, found: &Found, range: [f64; 2]) -> Vec<Waste> {
    let costs = found.costs();
    let mut best: BTreeMap<String, Waste> = BTreeMap::new();
    for (point, cost) in found.points.iter().zip(&costs) {
        if !(range[0]..=range[1]).contains(&cost.error) {
            continue;
        }
        let Some(rival) = cheapest(&costs, cost.error) else { continue };
        let ratio = cost.cpu_s / costs[rival].cpu_s;
        for choice in labels(trade, point) {
            let waste = Waste { choice: choice.clone(), ratio, error: cost.error };
            let known = best.entry(choice).or_insert_with(|| waste.clone());
            if ratio < known.ratio {
                *known = waste;
            }
        }
    }
    let mut list: Vec<Waste> = best.into_values().filter(|waste| waste.ratio > NOISE).collect();
    list.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    list
}

/// Names of the choices of a setting, apart from the number of elements.
fn labels(trade: &Trade, point: &Measured) -> Vec<String> {
    let (setting, scene) = (&point.setting, trade.scene());
    let mut labels = setting.choice_words(trade);
    labels.push(setting.basis_words(scene));
    labels.extend(setting.step_count(scene).map(|steps| format!("{steps} steps")));
    if setting.grading != 0 {
        labels.push(format!("grading x {}", f64::from(setting.grading).exp2()));
    }
    labels
}
