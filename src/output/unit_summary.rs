//! Results of the units and of their groups in the summary of a run.

use serde::{Deserialize, Serialize};

/// Results for a group of equal units. Fixed units have no damage.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GroupSummary {
    /// Name.
    pub name: String,
    /// Number of the first and of the last unit, from 1.
    pub units: [u32; 2],
    /// True if the units cannot move.
    #[serde(default)]
    pub fixed: bool,
    /// Displacement above which a unit counts as damaged [m].
    pub damage_distance_m: f64,
    /// Share of the units that moved further than `damage_distance_m` [-].
    pub damage_ratio: f64,
    /// Mean displacement of the units [m].
    pub mean_displacement_m: f64,
}

impl GroupSummary {
    /// Returns true if the unit with this number belongs to the group.
    pub fn contains(&self, unit: u32) -> bool {
        (self.units[0]..=self.units[1]).contains(&unit)
    }
}

/// Results for one unit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct UnitSummary {
    /// Number of the unit, from 1.
    pub unit: u32,
    /// Horizontal distance between first and last position of the centre of mass [m].
    pub displacement_m: f64,
    /// True if the displacement exceeds the damage distance.
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
}

impl UnitSummary {
    /// Computes displacement, direction and damage from first and last position [m]. Sets forces and contacts to zero.
    pub fn moved(unit: u32, start_m: [f64; 3], end_m: [f64; 3], rotation_deg: f64, damage_distance_m: f64) -> Self {
        let (dx, dy) = (end_m[0] - start_m[0], end_m[1] - start_m[1]);
        let displacement_m = dx.hypot(dy);
        Self {
            unit,
            displacement_m,
            damaged: displacement_m > damage_distance_m,
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
