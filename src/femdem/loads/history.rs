//! Values that change with time.

/// Time series of `N` values: linear between two times, constant before the first time and after the last time.
#[derive(Debug, Clone, PartialEq)]
pub struct History<const N: usize> {
    /// Times [s], ascending.
    times: Vec<f64>,
    /// Values at these times.
    values: Vec<[f64; N]>,
}

impl<const N: usize> History<N> {
    /// Creates a history with the same values at all times.
    pub fn constant(values: [f64; N]) -> Self {
        Self { times: vec![0.0], values: vec![values] }
    }

    /// Creates a history from rows with a time [s] and `N` values; `None` if there is no row or times do not increase.
    pub fn new(rows: impl IntoIterator<Item = (f64, [f64; N])>) -> Option<Self> {
        let (times, values): (Vec<f64>, Vec<[f64; N]>) = rows.into_iter().unzip();
        let rises = times.windows(2).all(|pair| pair[0] < pair[1]);
        (rises && !times.is_empty()).then_some(Self { times, values })
    }

    /// Returns the largest absolute value of each of the `N` values over all times.
    pub fn largest(&self) -> [f64; N] {
        let larger = |a: [f64; N], b: &[f64; N]| std::array::from_fn(|k| a[k].max(b[k].abs()));
        self.values.iter().fold([0.0; N], larger)
    }

    /// Returns the values at a time [s].
    pub fn at(&self, time: f64) -> [f64; N] {
        let after = self.times.partition_point(|t| *t <= time);
        let Some(before) = after.checked_sub(1) else { return self.values[0] };
        if after == self.times.len() {
            return self.values[before];
        }
        let share = (time - self.times[before]) / (self.times[after] - self.times[before]);
        let (from, to) = (self.values[before], self.values[after]);
        std::array::from_fn(|k| from[k] + share * (to[k] - from[k]))
    }
}

impl From<f64> for History<1> {
    fn from(value: f64) -> Self {
        Self::constant([value])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_linear_between_rows_and_constant_outside() {
        let history = History::new([(1.0, [2.0, 0.0]), (3.0, [6.0, -1.0]), (4.0, [6.0, 3.0])]).unwrap();
        assert_eq!([0.0, 1.0, 2.0, 3.5, 9.0].map(|t| history.at(t)[0]), [2.0, 2.0, 4.0, 6.0, 6.0]);
        assert_eq!(history.at(3.5)[1], 1.0);
        assert_eq!(History::from(7.0).at(-1.0), [7.0]);
        assert!(History::<1>::new([]).is_none() && History::new([(1.0, [0.0]), (1.0, [1.0])]).is_none());
    }
}
