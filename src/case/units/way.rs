//! Paths along which gauges and fixed units move.

use glam::DVec3;

use crate::case::reading::check::Checker;

/// A path: rows [t, x, y, z] with the time t from the start of the particle simulation [s] and the displacement from
/// the position at the start [m]. The displacement is linear between rows, and constant before the first and after the
/// last row.
#[derive(Debug, Clone, PartialEq)]
pub struct Way(Vec<[f64; 4]>);

impl Way {
    /// Validates the rows of the key `path`; returns `None` if there are none.
    pub(in crate::case) fn validate(rows: &[[f64; 4]], path: &str, check: &mut Checker) -> Option<Self> {
        let is_increasing = rows.windows(2).all(|pair| pair[1][0] > pair[0][0]);
        let is_finite = rows.iter().flatten().all(|value| value.is_finite());
        if !(is_increasing && is_finite) {
            check.reject(
                path,
                format!("{} rows", rows.len()),
                "rows [t, x, y, z] of finite numbers with increasing times",
                "write times from the start of the particles [s] and displacements [m]",
            );
        }
        (!rows.is_empty()).then(|| Self(rows.to_vec()))
    }

    /// Returns the displacement [m] at a time from the start of the particle simulation [s].
    pub fn displacement(&self, time: f64) -> DVec3 {
        let rows = &self.0;
        let after = rows.partition_point(|row| row[0] <= time);
        let at = |row: usize| DVec3::new(rows[row][1], rows[row][2], rows[row][3]);
        if after == 0 || after == rows.len() {
            return at(after.saturating_sub(1));
        }
        let share = (time - rows[after - 1][0]) / (rows[after][0] - rows[after - 1][0]);
        at(after - 1) + share * (at(after) - at(after - 1))
    }

    /// Time of the last row [s].
    pub fn end(&self) -> f64 {
        self.0[self.0.len() - 1][0]
    }

    /// Displacement in each row [m].
    pub(super) fn places(&self) -> impl Iterator<Item = DVec3> {
        self.0.iter().map(|row| DVec3::new(row[1], row[2], row[3]))
    }

    /// Time of the first row [s].
    pub fn begin(&self) -> f64 {
        self.0[0][0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacements_are_linear_between_the_rows_and_constant_outside() {
        let way = Way(vec![[1.0, 0.0, 0.0, 0.0], [2.0, 4.0, 0.0, 2.0], [3.0, 4.0, 1.0, 0.0]]);
        let expected = [(0.5, [0.0; 3]), (1.25, [1.0, 0.0, 0.5]), (2.5, [4.0, 0.5, 1.0]), (9.0, [4.0, 1.0, 0.0])];
        for (time, place) in expected {
            assert_eq!(way.displacement(time), DVec3::from_array(place));
        }
    }
}
