//! Results of the units and of their groups in the summary of a run.

use serde::{Deserialize, Serialize};

use crate::case::{DamageLimits, DamageMeasure};

/// Results for a group of units. Fixed units have no damage.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GroupSummary {
    /// Name.
    pub name: String,
    /// Number of the first and of the last unit, from 1.
    pub units: [u32; 2],
    /// True if the units cannot move.
    #[serde(default)]
    pub fixed: bool,
    /// Number of shapes, which the units have in turn; 0 means 1.
    #[serde(default)]
    pub models: u32,
    /// Nominal diameter D_n = V^(1/3) of a unit of the volume V [m]; for rocks, the median D_n50.
    #[serde(default)]
    pub nominal_diameter_m: f64,
    /// Way that counts for the damage.
    #[serde(default)]
    pub damage_measure: DamageMeasure,
    /// A unit counts as damaged if this way is longer [m].
    pub damage_distance_m: f64,
    /// A unit counts as rotated if its rotation is larger [deg].
    #[serde(default)]
    pub rotation_limit_deg: f64,
    /// A rotation back and forth counts as rocking if it is larger [deg].
    #[serde(default)]
    pub rocking_limit_deg: f64,
    /// Share of damaged units [-].
    pub damage_ratio: f64,
    /// Mean displacement of the units [m].
    pub mean_displacement_m: f64,
    /// Number of displaced units: their centres moved further than D_n in space.
    #[serde(default)]
    pub displaced: u32,
    /// Damage number N_od [-]: number of displaced units in a strip of the width D_n (Van der Meer 1988).
    #[serde(default)]
    pub n_od: f64,
    /// Number of rotated units.
    #[serde(default)]
    pub rotated: u32,
    /// Number of rocking units: they rocked at least once, and are not displaced.
    #[serde(default)]
    pub rocking: u32,
    /// N_or [-]: number of rocking units in a strip of the width D_n.
    #[serde(default)]
    pub n_or: f64,
    /// N_omov = N_od + N_or [-]: number of moving units in a strip of the width D_n.
    #[serde(default)]
    pub n_omov: f64,
    /// Mean settlement of the units [m]: the fall of their centres.
    #[serde(default)]
    pub mean_settlement_m: f64,
}

impl GroupSummary {
    /// Returns the number of shapes.
    pub fn shapes(&self) -> u32 {
        self.models.max(1)
    }

    /// Returns true if the unit with this number belongs to the group.
    pub fn contains(&self, unit: u32) -> bool {
        (self.units[0]..=self.units[1]).contains(&unit)
    }

    /// Computes the results of the group from those of all units, in a flume of the given width [m].
    pub(super) fn count(&mut self, units: &[UnitSummary], width_m: f64) {
        let members: Vec<&UnitSummary> = units.iter().filter(|unit| self.contains(unit.unit)).collect();
        let [ratio, mean] = averages(units, |unit| self.contains(unit)).unwrap_or_default();
        (self.damage_ratio, self.mean_displacement_m) = (ratio, mean);
        let number = |is_counted: &dyn Fn(&UnitSummary) -> bool| members.iter().filter(|unit| is_counted(unit)).count();
        let is_displaced = |unit: &UnitSummary| unit.spatial_displacement_m > self.nominal_diameter_m;
        self.displaced = number(&is_displaced) as u32;
        self.rotated = number(&|unit| unit.rotation_deg > self.rotation_limit_deg) as u32;
        self.rocking = number(&|unit| unit.rocking_movements > 0 && !is_displaced(unit)) as u32;
        let in_strip = |count: u32| f64::from(count) * self.nominal_diameter_m / width_m.max(f64::MIN_POSITIVE);
        (self.n_od, self.n_or) = (in_strip(self.displaced), in_strip(self.rocking));
        self.n_omov = self.n_od + self.n_or;
        let settled: f64 = members.iter().map(|unit| unit.start_m[2] - unit.end_m[2]).sum();
        self.mean_settlement_m = settled / members.len().max(1) as f64;
    }
}

/// Results for one unit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct UnitSummary {
    /// Number of the unit, from 1.
    pub unit: u32,
    /// Horizontal distance between first and last position of the centre of mass [m].
    pub displacement_m: f64,
    /// Distance between first and last position of the centre of mass in space [m].
    #[serde(default)]
    pub spatial_displacement_m: f64,
    /// True if the unit moved further than the damage distance of its group.
    pub damaged: bool,
    /// Direction of the displacement in plan view [deg]: 0 is shoreward, positive is towards larger y. 0 without
    /// displacement.
    pub direction_deg: f64,
    /// Centre of mass at the start [m].
    pub start_m: [f64; 3],
    /// Centre of mass at the end [m].
    pub end_m: [f64; 3],
    /// Angle of the rotation from the first to the last orientation of the unit [deg], 0 to 180.
    pub rotation_deg: f64,
    /// Largest water force, after subtraction of the mean force in still water [N]. The forces are averages over
    /// `output.series_interval_s`.
    pub peak_fluid_force_n: f64,
    /// Largest resultant of the contact forces from bed, walls and other units [N]. The forces are averages over
    /// `output.series_interval_s`.
    pub peak_contact_force_n: f64,
    /// Number of contact events with bed and walls.
    pub bed_contacts: u64,
    /// Number of contact events with other units. An event of two units counts for only one of them.
    pub unit_contacts: u64,
    /// Number of rocking movements: rotations back and forth, each way by more than the limit of the group.
    #[serde(default)]
    pub rocking_movements: u64,
    /// Largest rocking angle [deg]: the smaller angle of the two ways of a rocking movement.
    #[serde(default)]
    pub largest_rocking_deg: f64,
}

impl UnitSummary {
    /// Computes displacements, direction and damage from first and last position [m]. Sets forces, contacts and rocking
    /// to zero.
    pub fn moved(
        unit: u32,
        start_m: [f64; 3],
        end_m: [f64; 3],
        rotation_deg: f64,
        limits: impl Into<DamageLimits>,
    ) -> Self {
        let [dx, dy, dz] = std::array::from_fn(|axis| end_m[axis] - start_m[axis]);
        let displacement_m = f64::hypot(dx, dy);
        Self {
            unit,
            displacement_m,
            spatial_displacement_m: displacement_m.hypot(dz),
            damaged: limits.into().is_damaged(start_m, end_m),
            direction_deg: if displacement_m > 0.0 { dy.atan2(dx).to_degrees() } else { 0.0 },
            start_m,
            end_m,
            rotation_deg,
            ..Self::default()
        }
    }
}

/// Returns share of damaged units [-] and mean displacement [m] of the units whose numbers `is_in` accepts; `None`
/// without such units.
pub(super) fn averages(units: &[UnitSummary], is_in: impl Fn(u32) -> bool) -> Option<[f64; 2]> {
    let members: Vec<&UnitSummary> = units.iter().filter(|unit| is_in(unit.unit)).collect();
    let count = members.len() as f64;
    let damaged = members.iter().filter(|unit| unit.damaged).count() as f64;
    let displacement = members.iter().map(|unit| unit.displacement_m).sum::<f64>();
    (!members.is_empty()).then(|| [damaged / count, displacement / count])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_displacements_gives_its_damage_numbers() {
        let mut armour = GroupSummary {
            units: [2, 5],
            nominal_diameter_m: 0.05,
            damage_measure: DamageMeasure::Spatial,
            damage_distance_m: 0.03,
            rotation_limit_deg: 15.0,
            ..GroupSummary::default()
        };
        let limits =
            DamageLimits { measure: DamageMeasure::Spatial, distance: 0.03, rotation_deg: 15.0, rocking_deg: 2.0 };
        let unit = |number, end, turned, rocking_movements| UnitSummary {
            rocking_movements,
            ..UnitSummary::moved(number, [0.0, 0.0, 0.2], end, turned, limits)
        };
        let units = [
            // Not of the group.
            unit(1, [0.0, 0.0, 0.2], 90.0, 4),
            unit(2, [0.0, 0.0, 0.2], 14.0, 0),
            // Falls by less than D_n, and by more than D_n.
            unit(3, [0.0, 0.0, 0.16], 16.0, 1),
            unit(4, [0.03, 0.0, 0.12], 0.0, 0),
            // Displaced units do not count as rocking.
            unit(5, [0.06, 0.08, 0.2], 40.0, 7),
        ];
        armour.count(&units, 0.4);
        assert_eq!((armour.displaced, armour.rotated, armour.damage_ratio), (2, 2, 0.75));
        // Two displaced units in a flume of 0.4 m, which has eight strips of 0.05 m.
        assert!((armour.n_od - 0.25).abs() < 1e-12);
        assert_eq!(armour.rocking, 1);
        assert!((armour.n_or - 0.125).abs() < 1e-12 && (armour.n_omov - 0.375).abs() < 1e-12);
        assert!((armour.mean_displacement_m - 0.0325).abs() < 1e-12);
        assert!((armour.mean_settlement_m - 0.03).abs() < 1e-12);
    }
}
