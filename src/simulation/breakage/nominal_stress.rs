//! Nominal stresses of the units: beam theory in the sections at which a unit breaks.

use glam::DVec3;

use super::blow::Blow;
use super::model::{Model, Role};
use crate::case::{Handover, UnitKind};
use crate::geometry::section::Section;
use crate::output::Impacts;

impl Model {
    /// Returns the sections at which a unit breaks; empty for units from STL.
    pub fn sections(&self) -> Vec<Section> {
        self.shape.kind.sections()
    }

    /// Computes the largest nominal stress of the recorded impacts in each unit, at prototype scale [Pa].
    /// Peak force by Hertz's law, stresses in the sections by beam theory without inertia; 0 for units without impacts.
    pub fn nominal_stresses(&self, handover: &Handover, impacts: &Impacts) -> Vec<f64> {
        let mut stresses = vec![0.0f64; self.count];
        let sections = self.sections();
        for impact in &impacts.impacts {
            for role in Role::of(impact) {
                let force = role.to_body * (role.sign * DVec3::from_array(impact.event.peak));
                let found = sections.iter().filter_map(|section| section.stress(role.place, force)).fold(0.0, f64::max);
                let blow = Blow::new(self, handover, impact);
                let scaled = found * blow.scale.force / handover.scale.powi(2);
                stresses[role.unit] = stresses[role.unit].max(scaled);
            }
        }
        stresses
    }
}

impl UnitKind {
    /// Returns the sections at which a unit breaks; empty for units from STL.
    pub fn sections(&self) -> Vec<Section> {
        use crate::geometry::{core_loc, cuboid, dolos, tetrapod};
        match self {
            Self::Tetrapod { height } => tetrapod::sections(*height),
            Self::Dolos { height, waist } => dolos::sections(*height, *waist),
            Self::CoreLoc { size } => core_loc::sections(*size),
            Self::Cuboid { edges } => cuboid::sections(DVec3::from_array(*edges)),
            // Without the grooves, which take a twentieth of the section.
            Self::GroovedCube { height } => cuboid::sections(DVec3::splat(*height)),
            Self::Stl(_) => Vec::new(),
        }
    }
}
