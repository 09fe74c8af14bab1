//! What the figures of a trade come to, in words.

use super::found::{Ending, Found};
use super::norm::QUANTITIES;
use super::waste::{Waste, wastes};
use super::{Aim, Measured, Trade, best_within, cheapest, write_scene};
use crate::output::OutputError;

use std::path::{Path, PathBuf};

/// Errors for which settings are recommended.
pub const TARGETS: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
/// What is recommended for unless something else is asked for.
const USUAL: f64 = 0.01;
/// Errors within this factor are near the one that is aimed at.
const NEAR: f64 = 3.0;
/// Wastes that are listed.
const LISTED: usize = 6;

/// The recommendation.
#[derive(Debug)]
pub struct Advice<'a> {
    trade: &'a Trade,
    found: &'a Found,
    aim: Aim,
}

impl<'a> Advice<'a> {
    /// The recommendation that follows from what was found.
    pub fn new(trade: &'a Trade, found: &'a Found, aim: Aim) -> Self {
        Self { trade, found, aim }
    }

    /// The settings that are recommended for what is aimed at: those asked for, or for 1 %; where that is not reached, the nearest.
    pub fn recommended(&self) -> Option<&'a Measured> {
        let costs = self.found.costs();
        let best = || best_within(&costs, f64::INFINITY);
        let place = match self.aim {
            Aim::Error(target) => cheapest(&costs, target).or_else(best),
            Aim::Front => cheapest(&costs, USUAL).or_else(best),
            Aim::Budget(budget) => best_within(&costs, budget).or_else(|| cheapest(&costs, f64::INFINITY)),
        };
        place.map(|place| &self.found.points[place])
    }

    /// Writes the recommended settings as `recommended.toml` into a folder.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn write_scene(&self, folder: &Path) -> Result<Option<PathBuf>, OutputError> {
        let Some(point) = self.recommended() else { return Ok(None) };
        let path = folder.join("recommended.toml");
        let comment = format!(
            "Recommended by `asperity trade` for {}.\nSettings: {}.\nError {} of the peak ({}), {:.3} s of CPU time without fields and figures.",
            self.purpose(),
            point.words,
            percent(self.found.bound(point)),
            self.names(),
            point.status.cpu_s
        );
        write_scene(self.trade, point, &comment, &path)?;
        Ok(Some(path))
    }

    fn purpose(&self) -> String {
        match self.aim {
            Aim::Error(target) => format!("an error of {}", percent(target)),
            Aim::Front => format!("an error of {}", percent(USUAL)),
            Aim::Budget(budget) => format!("a budget of {budget} s"),
        }
    }

    fn names(&self) -> String {
        self.found.quantities.iter().map(|k| QUANTITIES[*k]).collect::<Vec<_>>().join(", ")
    }

    /// Everything as Markdown.
    pub fn text(&self) -> String {
        let parts = [self.head(), self.targets(), self.answer(), self.given(), self.wasted(), self.other_model()];
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
    }

    fn head(&self) -> String {
        let (found, reference) = (self.found, &self.found.points[self.found.reference]);
        let own = |k: &usize| {
            let estimate = found.estimates[*k];
            format!("- {}: {}, from {}\n", QUANTITIES[*k], percent(estimate.error), estimate.words())
        };
        let failed = found.points.iter().filter(|point| !point.done()).count();
        let ending = match found.ending {
            Ending::Complete => "no change of one choice is left to try",
            Ending::EffortSpent => "the effort is spent",
            Ending::Interrupted => "interrupted, the same command goes on",
        };
        format!(
            "{} settings ({failed} failed), {:.0} s of CPU time; {ending}.\nReference: {}, {:.1} s. Its own error, as a share of the peak:\n\n{}",
            found.points.len(),
            found.spent,
            reference.words,
            reference.status.cpu_s,
            found.quantities.iter().map(own).collect::<String>()
        )
    }

    fn targets(&self) -> String {
        let costs = self.found.costs();
        let mut wanted = TARGETS.to_vec();
        if let Aim::Error(target) = self.aim {
            wanted.push(target);
            wanted.sort_by(|a, b| b.total_cmp(a));
            wanted.dedup();
        }
        let mut text = format!(
            "Cheapest settings for a wanted error (the largest of {}; the reference's own included):\n\n| wanted | found | CPU s | settings |\n|---|---|---|---|\n",
            self.names()
        );
        for target in wanted {
            text += &match cheapest(&costs, target) {
                Some(place) => format!("| {} | {}\n", percent(target), self.row(place)),
                None => format!("| {} | not reached | | {} |\n", percent(target), self.why_not(target)),
            };
        }
        text
    }

    fn row(&self, place: usize) -> String {
        let point = &self.found.points[place];
        format!("{} | {:.3} | {} |", percent(self.found.bound(point)), point.status.cpu_s, point.words)
    }

    fn why_not(&self, target: f64) -> String {
        match self.found.floor() {
            floor if floor > target => format!("below what the reference can tell, {}", percent(floor)),
            _ => "more elements or steps than were tried: a larger --effort, or a finer scene".into(),
        }
    }

    fn answer(&self) -> String {
        let costs = self.found.costs();
        match self.aim {
            Aim::Budget(budget) => match best_within(&costs, budget) {
                Some(place) => format!("Smallest error for {budget} s: {}\n", self.row(place).trim_end_matches(" |")),
                None => format!("No setting that was tried takes less than {budget} s.\n"),
            },
            _ => String::new(),
        }
    }

    fn given(&self) -> String {
        let (found, costs) = (self.found, self.found.costs());
        let Some(point) = found.given.map(|given| &found.points[given]).filter(|point| point.done()) else {
            return String::new();
        };
        let bound = found.bound(point);
        let cheaper =
            cheapest(&costs, bound).map(|place| &found.points[place]).filter(|best| best.folder != point.folder);
        let told = format!("The scene as it is: {} for {:.3} s", percent(bound), point.status.cpu_s);
        match cheaper {
            Some(best) => format!("{told}; as good for {:.3} s: {}.\n", best.status.cpu_s, best.words),
            None => format!("{told}; nothing cheaper is as good.\n"),
        }
    }

    fn wasted(&self) -> String {
        let range = match self.aim {
            Aim::Error(target) => [target / NEAR, target * NEAR],
            _ => [0.0, TARGETS[0]],
        };
        let line =
            |waste: &Waste| format!("- {}: {:.1} times, at {}\n", waste.choice, waste.ratio, percent(waste.error));
        let lines: String = wastes(self.trade, self.found, range).iter().take(LISTED).map(line).collect();
        match lines.is_empty() {
            true => String::new(),
            false => format!(
                "What wastes most: CPU time over that of the cheapest settings of equal or smaller error, where the choice does best\n\n{lines}"
            ),
        }
    }

    fn other_model(&self) -> String {
        let other = self.found.points.iter().find(|point| point.role == super::Role::OtherModel);
        match other {
            Some(point) if point.done() => format!(
                "Another model, not recommended and not in the front: {}: differs by {} for {:.3} s. That is an error of the model.\n",
                point.words,
                percent(self.found.error(point)),
                point.status.cpu_s
            ),
            Some(point) => format!("Another model ({}) failed: {}\n", point.words, point.status.reason),
            None => String::new(),
        }
    }
}

/// A share as per cent with two digits.
fn percent(share: f64) -> String {
    if share.is_nan() {
        return "unknown".into();
    }
    let rounded: f64 = format!("{:.1e}", 100.0 * share).parse().unwrap_or(100.0 * share);
    format!("{rounded} %")
}
