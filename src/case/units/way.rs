//! Paths along which gauges and fixed units move.

use glam::DVec3;

use super::{Surroundings, UnitPose};
use crate::case::file::{Sides, UnitsFile};
use crate::case::flume::site::Site;
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

    /// Validates the path of fixed units.
    pub(super) fn of_units(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Self> {
        let way = Self::validate(&file.way, ".way", check)?;
        let Some(water) = &around.water else {
            check.reject(".way", "given", "left out in a dry test", "only flume cases move units along a path");
            return None;
        };
        if !file.fixed {
            let advice = "write \"fixed\": true; forces move other units";
            check.reject(".way", "given", "left out without `fixed`", advice);
        }
        let [time, displacement @ ..] = way.0[0];
        if time < water.hold || displacement != [0.0; 3] {
            let (first, allowed) = (format!("{:?}", way.0[0]), format!("[at least {}, 0, 0, 0]", water.hold));
            check.reject(".way[0]", first, allowed, "units stand still until then; begin with a row [t, 0, 0, 0]");
        }
        Some(way)
    }

    /// Checks that the centres of units with these poses stay in the domain.
    pub(super) fn check_inside(&self, poses: &[UnitPose], site: &Site, check: &mut Checker) {
        let [x0, x1] = site.x;
        for (number, &[_, x, y, z]) in self.0.iter().enumerate() {
            let path = format!(".way[{number}]");
            if site.sides == Sides::TwoDimensional && y != 0.0 {
                check.reject(&path, y, "0 m across the flume", "units move in the plane of the flume");
            }
            let by = DVec3::new(x, y, z);
            let leaves = |pose: &UnitPose| {
                let at = pose.centre + by;
                !(x0..=x1).contains(&at.x) || (site.sides == Sides::Walls && !(0.0..=site.width).contains(&at.y))
            };
            if poses.iter().any(leaves) {
                let advice = "the centres of all units must stay in the domain";
                check.reject(&path, format!("{by} m"), "a displacement inside the domain", advice);
            }
        }
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
