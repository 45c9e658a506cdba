//! Linear chart axis with round tick values.

use super::short;

/// A linear axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Label of the axis: quantity and unit.
    pub label: String,
    low: f64,
    high: f64,
    step: f64,
}

impl Axis {
    /// Creates an axis with about `ticks` ticks that covers all finite `values`; both ends are round numbers.
    pub fn round(label: &str, values: impl IntoIterator<Item = f64>, ticks: usize) -> Self {
        let (low, high) = range(values);
        let step = round_step((high - low) / ticks.max(1) as f64);
        let (low, high) = ((low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step);
        Self { label: label.to_owned(), low, high: if high > low { high } else { low + step }, step }
    }

    /// Creates an axis that ends exactly at the smallest and the largest finite value.
    pub fn tight(label: &str, values: impl IntoIterator<Item = f64>, ticks: usize) -> Self {
        let (low, high) = range(values);
        Self { label: label.to_owned(), low, high, step: round_step((high - low) / ticks.max(1) as f64) }
    }

    /// Returns the values at both ends of the axis.
    #[cfg(test)]
    fn range(&self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// Relative position of a value on the axis: 0 at the lower end, 1 at the upper end.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Returns the tick values, which are round numbers within the range of the axis.
    pub fn ticks(&self) -> Vec<f64> {
        let first = (self.low / self.step - 1e-6).ceil() as i64;
        let last = (self.high / self.step + 1e-6).floor() as i64;
        (first..=last).map(|i| i as f64 * self.step).collect()
    }

    /// Formats a tick value with as many decimals as the distance between the ticks needs.
    pub fn number(&self, tick: f64) -> String {
        // The tolerance covers the rounding error of the scaled step.
        let decimals = (0..9).find(|d| {
            let scaled = self.step * 10_f64.powi(*d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        });
        let decimals = usize::try_from(decimals.unwrap_or(9)).unwrap_or(0);
        let text = format!("{tick:.decimals$}");
        if tick == 0.0 { short(0.0, 0) } else { text.replace('-', "\u{2212}") }
    }
}

/// Smallest and largest finite value. The range is widened if both are equal. Without values, or if all values are
/// zero, the range is 0 to 1.
fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .into_iter()
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    match (low <= high, high - low <= 1e-12 * high.abs().max(low.abs())) {
        (false, _) => (0.0, 1.0),
        (true, true) if low == 0.0 => (0.0, 1.0),
        (true, true) => (low - 0.5 * low.abs(), high + 0.5 * high.abs()),
        (true, false) => (low, high),
    }
}

/// Rounds `step` up to 1, 2 or 5 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= step * (1.0 - 1e-9)).unwrap_or(10.0);
    factor * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_values() {
        let axis = Axis::round("x [m]", [0.013, 0.198], 5);
        let numbers: Vec<String> = axis.ticks().iter().map(|t| axis.number(*t)).collect();
        assert_eq!(numbers, ["0", "0.05", "0.10", "0.15", "0.20"]);
        let axis = Axis::round("F [N]", [-3.2, 14.0], 5);
        assert_eq!(axis.range(), (-5.0, 15.0));
        let axis = Axis::tight("t [s]", [0.0, 7.3], 8);
        assert_eq!(axis.range(), (0.0, 7.3));
        assert_eq!(axis.ticks().len(), 8);
    }

    #[test]
    fn an_axis_without_values_or_with_one_value_has_a_range() {
        for values in [vec![], vec![f64::NAN], vec![0.0, 0.0], vec![39.0, 39.0], vec![-2.0]] {
            let axis = Axis::round("x", values, 5);
            let (low, high) = axis.range();
            assert!(high > low && axis.ticks().len() >= 2, "{axis:?}");
        }
    }
}
