//! Properties of the units of a run that the breakage analysis needs.

use std::ops::Range;

use glam::{DMat3, DVec3};

use crate::case::{Case, DryTestCase, Part, PartShape, Site, UnitShape, Units};
use crate::case::{ContactLawName, Material as CaseMaterial};
use crate::output::{Impact, Impacts};
use crate::rigid::{BodyState, ContactEvent, Feature, Material};

/// A contact point nearer than this to a part is on this part, divided by the height of the unit [-]: the deepest
/// overlap is smaller.
const AT_PART: f64 = 0.05;

/// Properties of the units of the analysed group.
#[derive(Debug, Clone)]
pub struct Model {
    /// Shape of a unit.
    pub shape: UnitShape,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Inertia tensor of a unit in body axes, divided by its mass [m2].
    pub gyration: DMat3,
    /// Number of units of the run.
    pub count: usize,
    /// Indices of the units of the analysed group.
    pub members: Range<usize>,
    /// Contact properties of the units.
    pub material: Material,
    /// Contact properties of the bed.
    pub ground: Material,
    /// x of both ends of each part of the ground with a surface of its own [m], and its contact properties.
    pub covers: Vec<([f64; 2], Material)>,
    /// Parts of the structure that are not part of the bed, and their contact properties.
    pub parts: Vec<(Part, Material)>,
    /// Contact law.
    pub law: ContactLawName,
    /// Acceleration of gravity [m/s2].
    pub gravity: f64,
}

impl Model {
    /// Returns the properties of the units of a flume case; `None` if the case has no units.
    pub fn of_case(case: &Case) -> Option<Self> {
        let units = case.units.as_ref()?;
        let group = case.breakage.as_ref().map_or(0, |settings| settings.group);
        Some(Self::of_units(units, group, &case.site(), &case.materials, case.contact.law, case.fluid.gravity))
    }

    /// Returns the properties of the units of a dry test.
    pub fn of_dry(case: &DryTestCase) -> Self {
        let group = case.breakage.as_ref().map_or(0, |settings| settings.group);
        Self::of_units(&case.units, group, &case.site, &case.materials, case.contact.law, case.gravity)
    }

    fn of_units(
        units: &Units,
        group: usize,
        site: &Site,
        materials: &[CaseMaterial],
        law: ContactLawName,
        gravity: f64,
    ) -> Self {
        let material = |index: usize| {
            let CaseMaterial { young_modulus, poisson_ratio, restitution, .. } = materials[index];
            Material { young_modulus, poisson_ratio, restitution }
        };
        let group = &units.groups[group];
        let in_water = site.parts.iter().filter(|part| !matches!(part.surface(), PartShape::Bed(_)));
        Self {
            gyration: group.shape().unit().inertia(1.0),
            shape: group.shape().clone(),
            mass: group.models[0].mass,
            count: units.count(),
            members: group.members.clone(),
            material: material(group.material),
            ground: material(units.ground_material),
            covers: site.covers.iter().map(|cover| (cover.x, material(cover.material))).collect(),
            parts: in_water
                .map(|part| (part.clone(), material(part.material.unwrap_or(units.ground_material))))
                .collect(),
            law,
            gravity,
        }
    }

    /// Keeps the impacts of units of the group on each other, on bed, walls and parts.
    pub fn keep_own(&self, impacts: &mut Impacts) {
        impacts.impacts.retain(|impact| Role::of(impact).all(|role| self.members.contains(&role.unit)));
    }

    /// Returns the contact properties of the surface that a unit hits.
    pub fn partner(&self, event: &ContactEvent) -> &Material {
        let within = |x: &[f64; 2]| (x[0]..=x[1]).contains(&event.point[0]);
        match event.partner {
            Feature::Unit { .. } => &self.material,
            Feature::Ground { .. } => {
                self.covers.iter().rfind(|(x, _)| within(x)).map_or(&self.ground, |(_, material)| material)
            }
            Feature::Terrain { .. } => {
                let distance = |(part, _): &(Part, Material)| part.distance(event.point.into()).abs();
                let touched = self.parts.iter().filter(|part| distance(part) < AT_PART * self.shape.height());
                let nearest = touched.min_by(|a, b| distance(a).total_cmp(&distance(b)));
                nearest.map_or(&self.ground, |(_, material)| material)
            }
            Feature::Wall { .. } => &self.ground,
        }
    }

    /// Returns true if an impact can belong to these units: the units exist, the checked values are finite, and the
    /// contact point is less than two unit heights from the centre of each unit.
    pub fn is_plausible(&self, impact: &Impact) -> bool {
        let event = &impact.event;
        let mut states = [Some(event.before), event.partner_before].into_iter().flatten();
        let on_unit = |state: BodyState| {
            let moves = state.velocity.is_finite() && state.angular_velocity.is_finite();
            // This comparison is false if a position is NaN.
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
}

/// A unit of an impact, as the recorded unit or as its partner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Role {
    /// Index of the unit, from 0.
    pub unit: usize,
    /// Contact point in body axes [m].
    pub place: DVec3,
    /// Rotation from world axes to body axes just before the impact.
    pub to_body: glam::DQuat,
    /// Factor of the recorded force that gives the force on this unit: 1 for the recorded unit, -1 for its partner.
    pub sign: f64,
}

impl Role {
    /// Returns one item for the recorded unit, and one for its partner if the partner is a unit.
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
