//! Nominal stresses of the units: beam theory at the cross-sections where a unit is expected to break.

use glam::DVec3;

use super::blow::ScaledImpact;
use super::model::{Model, Role};
use crate::case::{BreakageSettings, UnitKind};
use crate::geometry::armour_unit::section::Section;
use crate::output::Impacts;

impl Model {
    /// Returns the cross-sections where a unit is expected to break; empty for units from STL files.
    pub fn sections(&self) -> Vec<Section> {
        self.shape.kind.sections()
    }

    /// Returns, for each unit, the largest nominal stress of its recorded impacts at prototype scale [Pa]; 0 for units
    /// without impacts. [`ScaledImpact::scale`] scales the peak force. The stresses in the cross-sections follow from
    /// beam theory; the inertia of the unit is neglected.
    pub fn nominal_stresses(&self, settings: &BreakageSettings, impacts: &Impacts) -> Vec<f64> {
        let mut stresses = vec![0.0f64; self.count];
        let sections = self.sections();
        for impact in &impacts.impacts {
            for role in Role::of(impact) {
                let force = role.to_body * (role.sign * DVec3::from_array(impact.event.peak));
                let found = sections.iter().filter_map(|section| section.stress(role.place, force)).fold(0.0, f64::max);
                let blow = ScaledImpact::new(self, settings, impact);
                let scaled = found * blow.scale.force / settings.scale.powi(2);
                stresses[role.unit] = stresses[role.unit].max(scaled);
            }
        }
        stresses
    }
}

impl UnitKind {
    /// Returns the cross-sections where a unit is expected to break; empty for units from STL files.
    pub fn sections(&self) -> Vec<Section> {
        use crate::geometry::armour_unit::{core_loc, cuboid, dolos, tetrapod};
        match self {
            Self::Tetrapod { height } => tetrapod::sections(*height),
            Self::Dolos { height, waist } => dolos::sections(*height, *waist),
            Self::CoreLoc { size } => core_loc::sections(*size),
            Self::Cuboid { edges } => cuboid::sections(DVec3::from_array(*edges)),
            // The full square is used as the cross-section, although the grooves remove a twentieth of its area.
            Self::GroovedCube { height } => cuboid::sections(DVec3::splat(*height)),
            Self::Rock { .. } | Self::Stl(_) => Vec::new(),
        }
    }
}
