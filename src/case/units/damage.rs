//! When a unit counts as damaged, rotated or rocking.

use crate::case::file::{DamageMeasure, UnitsFile};
use crate::case::reading::check::{Checker, more_than};

/// Rotation above which a unit counts as rotated, by default [degrees].
const ROTATION: f64 = 15.0;

/// Angle above which a rotation back and forth counts as rocking, by default [degrees]. The far end of a unit that rocks
/// about its edge then moves by 3.5 % of its size, in a model with units of 5 cm by 2 mm.
const ROCKING: f64 = 2.0;

/// Limits above which a unit counts as damaged, rotated or rocking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageLimits {
    /// Way that counts.
    pub measure: DamageMeasure,
    /// A unit counts as damaged if this way is longer [m].
    pub distance: f64,
    /// A unit counts as rotated if its rotation is larger [degrees].
    pub rotation_deg: f64,
    /// A rotation back and forth counts as rocking if it is larger [degrees].
    pub rocking_deg: f64,
}

impl DamageLimits {
    /// Returns the way from the first to the last position of a unit [m].
    pub fn way(&self, start: [f64; 3], end: [f64; 3]) -> f64 {
        let [dx, dy, dz] = std::array::from_fn(|axis| end[axis] - start[axis]);
        match self.measure {
            DamageMeasure::Horizontal => f64::hypot(dx, dy),
            DamageMeasure::Spatial => f64::hypot(dx, dy).hypot(dz),
        }
    }

    /// Returns true if a unit that moved from `start` to `end` [m] is damaged.
    pub fn is_damaged(&self, start: [f64; 3], end: [f64; 3]) -> bool {
        self.way(start, end) > self.distance
    }
}

impl From<f64> for DamageLimits {
    /// Limit of the horizontal displacement [m], as in the experiments of Mitsui et al. (2023).
    fn from(distance: f64) -> Self {
        Self { measure: DamageMeasure::Horizontal, distance, rotation_deg: ROTATION, rocking_deg: ROCKING }
    }
}

/// Validates the limits of a group of units; D_n = `nominal_diameter` [m].
pub(super) fn validate(file: &UnitsFile, nominal_diameter: f64, check: &mut Checker) -> DamageLimits {
    if let Some(distance) = file.damage_distance_m {
        let advice = "the nominal diameter D_n of the unit is usual";
        check.number(".damage_distance_m", distance, more_than(0.0).up_to(1000.0), "m", advice);
    }
    let rotation_deg = file.rotation_limit_deg.unwrap_or(ROTATION);
    let advice = "leave the key out for 15 degrees";
    check.number(".rotation_limit_deg", rotation_deg, more_than(0.0).up_to(180.0), "degrees", advice);
    let rocking_deg = file.rocking_limit_deg.unwrap_or(ROCKING);
    let advice = "leave the key out for 2 degrees";
    check.number(".rocking_limit_deg", rocking_deg, more_than(0.0).up_to(45.0), "degrees", advice);
    let measure = match file.damage_distance_m {
        Some(_) => DamageMeasure::Horizontal,
        None => DamageMeasure::Spatial,
    };
    DamageLimits {
        measure: file.damage_measure.unwrap_or(measure),
        distance: file.damage_distance_m.unwrap_or(nominal_diameter),
        rotation_deg,
        rocking_deg,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fall_counts_in_space_but_not_in_plan() {
        let horizontal = DamageLimits::from(0.06);
        let spatial = DamageLimits { measure: DamageMeasure::Spatial, ..horizontal };
        let (start, end) = ([1.0, 2.0, 3.0], [1.03, 2.04, 2.88]);
        assert!((horizontal.way(start, end) - 0.05).abs() < 1e-12 && !horizontal.is_damaged(start, end));
        assert!((spatial.way(start, end) - 0.13).abs() < 1e-12 && spatial.is_damaged(start, end));
    }
}
