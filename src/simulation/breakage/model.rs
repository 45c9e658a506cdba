//! The units of a run, as far as the breakage analysis needs them.

use glam::{DMat3, DVec3};

use super::blow::Blow;
use crate::case::{Case, DryCase, Handover, UnitKind, UnitShape, Units};
use crate::case::{ContactLawName, Material as CaseMaterial};
use crate::geometry::section::Section;
use crate::output::{Impact, Impacts};
use crate::rigid::{BodyState, Material};

/// The units of a run; SI units.
#[derive(Debug, Clone)]
pub struct Model {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Inertia tensor in body axes over the mass [m2].
    pub gyration: DMat3,
    /// Number of units.
    pub count: usize,
    /// Contact properties of the units.
    pub material: Material,
    /// Contact properties of the bed.
    pub ground: Material,
    /// Contact law.
    pub law: ContactLawName,
    /// Acceleration of gravity [m/s2].
    pub gravity: f64,
}

impl Model {
    /// Returns the units of a flume case; `None` if it has none.
    pub fn of_case(case: &Case) -> Option<Self> {
        let units = case.units.as_ref()?;
        Some(Self::of_units(units, &case.materials, case.contact.law, case.fluid.gravity))
    }

    /// Returns the units of a dry test.
    pub fn of_dry(case: &DryCase) -> Self {
        Self::of_units(&case.units, &case.materials, case.contact.law, case.gravity)
    }

    fn of_units(units: &Units, materials: &[CaseMaterial], law: ContactLawName, gravity: f64) -> Self {
        let material = |index: usize| {
            let CaseMaterial { young_modulus, poisson_ratio, restitution, .. } = materials[index];
            Material { young_modulus, poisson_ratio, restitution }
        };
        Self {
            gyration: units.shape.unit().inertia(1.0),
            shape: units.shape.clone(),
            mass: units.mass,
            count: units.placements.len(),
            material: material(units.material),
            ground: material(units.ground_material),
            law,
            gravity,
        }
    }

    /// Returns whether an impact can belong to these units: all numbers are finite, and the contact point is near the
    /// units.
    pub fn can_have(&self, impact: &Impact) -> bool {
        let event = &impact.event;
        let mut states = [Some(event.before), event.partner_before].into_iter().flatten();
        let on_unit = |state: BodyState| {
            let moves = state.velocity.is_finite() && state.angular_velocity.is_finite();
            // False for NaN.
            let near = (DVec3::from_array(event.point) - state.position).length() < 2.0 * self.shape.height();
            moves && near && state.rotation.is_normalized()
        };
        let numbers = [event.start, event.peak_time, event.peak_force, event.approach_normal, event.approach_energy];
        let vectors = [event.normal, event.peak, event.point_in_body];
        let samples = impact.history.iter().all(|s| (s.start + s.duration).is_finite() && s.impulse.is_finite());
        Role::of(impact).all(|role| role.unit < self.count)
            && states.all(on_unit)
            && numbers.iter().chain(vectors.as_flattened()).all(|number| number.is_finite())
            && samples
    }

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

/// Role of a unit in an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Role {
    /// Number of the unit from 0.
    pub unit: usize,
    /// Contact point in body axes [m].
    pub place: DVec3,
    /// Rotation from space axes to body axes.
    pub to_body: glam::DQuat,
    /// Factor on the recorded force: 1, or -1 for the partner.
    pub sign: f64,
}

impl Role {
    /// Returns the roles of the one or two units in an impact.
    pub fn of(impact: &Impact) -> impl Iterator<Item = Self> {
        let event = &impact.event;
        let body = Self {
            unit: event.body as usize,
            place: DVec3::from_array(event.point_in_body),
            to_body: event.before.rotation.inverse(),
            sign: 1.0,
        };
        let partner = event.partner_unit().zip(event.partner_before).map(|(unit, before)| {
            let to_body = before.rotation.inverse();
            let place = to_body * (DVec3::from_array(event.point) - before.position);
            Self { unit: unit as usize, place, to_body, sign: -1.0 }
        });
        std::iter::once(body).chain(partner)
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
