//! Which of several measured settings are worth having: Pareto front, cheapest for an error, best for a budget, waste.

/// Cost and error of one setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// CPU time in seconds.
    pub cpu_s: f64,
    /// Error; `nan` or infinite where there is none.
    pub error: f64,
}

impl Cost {
    /// True where both are numbers.
    fn known(&self) -> bool {
        self.cpu_s.is_finite() && self.error.is_finite()
    }

    /// At most as expensive and at most as wrong, and one of them better.
    pub fn dominates(&self, other: &Self) -> bool {
        self.cpu_s <= other.cpu_s && self.error <= other.error && self != other
    }
}

/// Numbers of the settings that no other one dominates, cheap ones first; of equal ones the first.
pub fn front(costs: &[Cost]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..costs.len()).filter(|k| costs[*k].known()).collect();
    order.sort_by(|a, b| {
        let (a, b) = (costs[*a], costs[*b]);
        a.cpu_s.total_cmp(&b.cpu_s).then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    order.retain(|k| {
        let better = costs[*k].error < least;
        least = least.min(costs[*k].error);
        better
    });
    order
}

/// The cheapest setting whose error is at most `target`.
pub fn cheapest(costs: &[Cost], target: f64) -> Option<usize> {
    front(costs).into_iter().find(|k| costs[*k].error <= target)
}

/// The setting of the smallest error that costs at most `cpu_s`.
pub fn best_within(costs: &[Cost], cpu_s: f64) -> Option<usize> {
    front(costs).into_iter().rfind(|k| costs[*k].cpu_s <= cpu_s)
}
