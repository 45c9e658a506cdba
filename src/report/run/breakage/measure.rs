//! Units of measurement for the forces and areas of a table, chosen by the largest value. For example, impact forces
//! are shown in meganewtons for an armour unit of 40 t, but in newtons for a model unit in the flume.

/// A unit of measurement, such as kN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// Name of the unit of measurement, for the table.
    pub name: &'static str,
    /// Value of the unit of measurement in SI units.
    size: f64,
}

impl Measure {
    /// Returns the unit of measurement for a table with these forces [N].
    pub fn of_forces(forces: impl Iterator<Item = f64>) -> Self {
        Self::holding(forces, [("N", 1.0), ("kN", 1e3), ("MN", 1e6)])
    }

    /// Returns the unit of measurement for a table with these areas [m2].
    pub fn of_areas(areas: impl Iterator<Item = f64>) -> Self {
        // The factor 10 selects square centimetres for areas below 0.1 m2.
        Self::holding(areas.map(|area| 10.0 * area), [("cm\u{b2}", 1e-4), ("m\u{b2}", 1.0)])
    }

    /// Returns the largest of the `units` that does not exceed the largest value, or the first unit if all exceed it.
    fn holding<const N: usize>(values: impl Iterator<Item = f64>, units: [(&'static str, f64); N]) -> Self {
        let largest = values.fold(0.0, f64::max);
        let fitting = units.iter().rev().find(|(_, size)| *size <= largest).unwrap_or(&units[0]);
        Self { name: fitting.0, size: fitting.1 }
    }

    /// Formats an SI value in this unit of measurement, without a minus sign before zero.
    pub fn show(self, value: f64) -> String {
        format!("{:.3}", value / self.size + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_suits_the_largest_value() {
        let forces = Measure::of_forces([3.0, 2.5e6].into_iter());
        assert_eq!((forces.name, forces.show(2.5e6).as_str()), ("MN", "2.500"));
        assert_eq!(Measure::of_forces([970.0].into_iter()).name, "N");
        let areas = Measure::of_areas([-0.0].into_iter());
        assert_eq!((areas.name, areas.show(-0.0).as_str()), ("cm\u{b2}", "0.000"));
        assert_eq!(Measure::of_areas([0.2].into_iter()).name, "m\u{b2}");
    }
}
