//! A group of units: one shape for all of them, or the shapes of rocks.

use std::ops::Range;

use super::damage::DamageLimits;
use super::shape::{UnitKind, UnitShape};
use super::way::Way;

/// Shape and mass of units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitModel {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
}

/// A group of units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitGroup {
    /// Name in reports.
    pub name: String,
    /// Shapes and masses of the units, at least one. Rocks have several. Units get them in turn, see
    /// [`Self::model_of`].
    pub models: Vec<UnitModel>,
    /// Mass of a unit [kg]; for rocks, the mass of a rock of the size D_n50.
    pub mass: f64,
    /// Nominal diameter D_n of a unit [m]; for rocks, the median nominal diameter D_n50.
    pub nominal_diameter: f64,
    /// Indices of the units of this group in [`Units::placements`](super::Units::placements).
    pub members: Range<usize>,
    /// Forces do not move fixed units.
    pub is_fixed: bool,
    /// True if `breakwater place` has placed the units, in layers or in a heap.
    pub is_placed: bool,
    /// Path of fixed units, if they move.
    pub way: Option<Way>,
    /// In two dimensions, width of a unit / thickness of the particle layer [-]; 1 in three dimensions.
    pub slices: f64,
    /// Limits above which a unit counts as damaged, rotated or rocking.
    pub limits: DamageLimits,
    /// Material of the units, an index into `Case::materials`.
    pub material: usize,
}

impl UnitGroup {
    /// Returns the index in [`Self::models`] of a unit; `member` counts the units of the group from 0.
    pub fn model_of(&self, member: usize) -> usize {
        member % self.models.len()
    }

    /// Returns true if the units can move.
    pub fn moves(&self) -> bool {
        !self.is_fixed || self.way.is_some()
    }

    /// Returns the model of each unit.
    pub fn model_of_each(&self) -> impl Iterator<Item = &UnitModel> {
        (0..self.members.len()).map(|member| &self.models[self.model_of(member)])
    }

    /// Returns the shape of the first unit: of all units, except for rocks.
    pub fn shape(&self) -> &UnitShape {
        &self.models[0].shape
    }

    /// Returns the height of the highest unit [m].
    pub fn height(&self) -> f64 {
        self.models.iter().map(|model| model.shape.height()).fold(0.0, f64::max)
    }

    /// Returns the largest distance of the surface of a unit from its centre of mass [m].
    pub fn reach(&self) -> f64 {
        let corners = self.models.iter().flat_map(|model| model.shape.unit().solid().vertices());
        corners.map(|vertex| vertex.length()).fold(0.0, f64::max)
    }

    /// Returns name and content of the STL files of the shape.
    pub(super) fn files(&self) -> &[(String, Vec<u8>)] {
        if let UnitKind::Stl(unit) = &self.shape().kind { unit.files() } else { &[] }
    }
}

/// Returns group and model of each unit.
pub fn each(groups: &[UnitGroup]) -> impl Iterator<Item = (&UnitGroup, &UnitModel)> {
    groups.iter().flat_map(|group| group.model_of_each().map(move |model| (group, model)))
}

/// Returns the models of all groups, one after the other.
pub fn models(groups: &[UnitGroup]) -> impl Iterator<Item = (&UnitGroup, &UnitModel)> {
    groups.iter().flat_map(|group| group.models.iter().map(move |model| (group, model)))
}

/// Returns the index of the first model of a group in [`models`].
pub fn first_model(groups: &[UnitGroup], group: usize) -> usize {
    groups[..group].iter().map(|group| group.models.len()).sum()
}

/// Returns the model of each unit, an index into [`models`].
pub fn model_of_each(groups: &[UnitGroup]) -> impl Iterator<Item = usize> {
    let of_group = |(index, group): (usize, &UnitGroup)| {
        let first = first_model(groups, index);
        let of_each: Vec<usize> = (0..group.members.len()).map(|member| first + group.model_of(member)).collect();
        of_each
    };
    groups.iter().enumerate().flat_map(of_group)
}
