//! One axis: range, round ticks, labels with a common power of ten.

/// A linear axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Value at the start.
    pub min: f64,
    /// Value at the end.
    pub max: f64,
    /// Values of the ticks.
    pub ticks: Vec<f64>,
    /// Labels of the ticks, in units of `10^exponent`.
    pub labels: Vec<String>,
    /// Common power of ten; 0 where plain numbers are short.
    pub exponent: i32,
    /// Whether values are exponents of ten.
    pub logarithmic: bool,
}

impl Axis {
    /// Axis over exactly `[min, max]` with about `count` round ticks.
    pub fn new([min, max]: [f64; 2], count: usize) -> Self {
        let step = tick_step((max - min) / count.max(1) as f64);
        let (first, last) = ((min / step - 1e-9).ceil() as i64, (max / step + 1e-9).floor() as i64);
        let ticks: Vec<f64> = (first..=last).map(|k| k as f64 * step).collect();
        let largest = ticks.iter().fold(0.0_f64, |largest, tick| largest.max(tick.abs()));
        let exponent = common_exponent(largest);
        let unit = 10.0_f64.powi(exponent);
        let decimals = (0..8).find(|d| is_multiple(step / unit, 0.1_f64.powi(*d))).unwrap_or(8) as usize;
        let labels = ticks.iter().map(|tick| label(tick / unit, decimals)).collect();
        Self { min, max, ticks, labels, exponent, logarithmic: false }
    }

    /// Logarithmic axis over the powers of ten with exponents in `[min, max]`: whole decades, with 2 and 5 between few of them.
    pub fn decades([min, max]: [f64; 2]) -> Self {
        let few = max - min < 2.5;
        let stride = ((max - min) / 8.0).ceil().max(1.0) as i32;
        let power = |k: i32| {
            if few && (-3..=3).contains(&k) { plain_power(k) } else { format!("10^{{{}}}", label(f64::from(k), 0)) }
        };
        let (mut ticks, mut labels) = (vec![], vec![]);
        for k in (min.floor() as i32..=max.ceil() as i32).filter(|k| k.rem_euclid(stride) == 0) {
            for factor in [1.0, 2.0, 5.0].into_iter().take(if few { 3 } else { 1 }) {
                let tick = f64::from(k) + f64::log10(factor);
                if (min - 1e-9..=max + 1e-9).contains(&tick) {
                    ticks.push(tick);
                    labels.push(if factor == 1.0 { power(k) } else { power(k).replacen('1', &label(factor, 0), 1) });
                }
            }
        }
        Self { min, max, ticks, labels, exponent: 0, logarithmic: true }
    }

    /// Position of a value as a share of the axis, 0 at the start.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.min) / (self.max - self.min)
    }

    /// Markup of the power of ten, empty where there is none.
    pub fn power(&self) -> String {
        if self.exponent == 0 { String::new() } else { format!("×10^{{{}}}", label(f64::from(self.exponent), 0)) }
    }
}

/// 1, 2 or 5 times a power of ten, nearest by ratio.
fn tick_step(raw: f64) -> f64 {
    let above = round_step(raw);
    // 5 follows 2 by a factor of 2.5, all others follow by 2.
    let leading = above / 10.0_f64.powf((above * (1.0 + 1e-9)).log10().floor());
    let below = above / if (leading - 5.0).abs() < 0.1 { 2.5 } else { 2.0 };
    if raw * raw < above * below { below } else { above }
}

/// 1, 2 or 5 times a power of ten, nearest above.
pub fn round_step(raw: f64) -> f64 {
    let power = 10.0_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| raw <= factor * power * (1.0 + 1e-9));
    factor.unwrap_or(10.0) * power
}

/// A power of ten in plain digits.
fn plain_power(exponent: i32) -> String {
    label(10.0_f64.powi(exponent), exponent.min(0).unsigned_abs() as usize)
}

fn common_exponent(largest: f64) -> i32 {
    if largest == 0.0 || (1e-2..1e4).contains(&(largest * (1.0 + 1e-12))) {
        return 0;
    }
    (largest * (1.0 + 1e-12)).log10().floor() as i32
}

fn is_multiple(value: f64, unit: f64) -> bool {
    let ratio = value / unit;
    (ratio - ratio.round()).abs() < 1e-6 && ratio.round() != 0.0
}

/// Decimal number with a true minus sign.
pub fn label(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let negative = value < 0.0 && text.chars().any(|letter| ('1'..='9').contains(&letter));
    if negative { format!("−{text}") } else { text }
}

/// Smallest range around all finite values, widened by `margin` of its size on both sides; never empty.
pub fn range(values: impl Iterator<Item = f64>, margin: f64) -> [f64; 2] {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return [0.0, 1.0];
    }
    let size = match high - low {
        // A constant, up to round-off: show it in the middle instead of magnifying the noise.
        size if size <= 1e-12 * low.abs().max(high.abs()) => low.abs().max(high.abs()),
        size => return [low - margin * size, high + margin * size],
    };
    let size = if size == 0.0 { 1.0 } else { size };
    [low - 0.5 * size, high + 0.5 * size]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_labels_short() {
        let axis = Axis::new([-0.013, 0.052], 4);
        assert_eq!(axis.labels, ["0.00", "0.02", "0.04"]);
        let axis = Axis::new([0.0, 3.8], 5);
        assert_eq!(axis.labels, ["0", "1", "2", "3"]);
        let axis = Axis::new([-1e-9, 1e-9], 4);
        assert_eq!((axis.labels.join(" ").as_str(), axis.power().as_str()), ("−1.0 −0.5 0.0 0.5 1.0", "×10^{−9}"));
    }

    #[test]
    fn labels_do_not_depend_on_the_unit() {
        let labels = |scale: f64| Axis::new([-0.3 * scale, 4.0 * scale], 5).labels;
        assert_eq!(labels(1e-9), labels(1e9));
    }

    #[test]
    fn decades_are_labelled_by_powers_and_few_of_them_by_numbers() {
        assert_eq!(
            Axis::decades([-4.1, 2.1]).labels,
            ["10^{−4}", "10^{−3}", "10^{−2}", "10^{−1}", "10^{0}", "10^{1}", "10^{2}"]
        );
        assert_eq!(Axis::decades([-2.0, 0.1]).labels, ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(range([].into_iter(), 0.1), [0.0, 1.0]);
        assert_eq!(range([0.0, f64::NAN].into_iter(), 0.1), [-0.5, 0.5]);
        assert_eq!(range([2.0, 2.0].into_iter(), 0.1), [1.0, 3.0]);
    }
}
