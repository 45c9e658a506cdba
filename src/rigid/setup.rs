//! Input of the rigid-body solver.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::contact::MAX_FEATURES;
use super::error::RigidError;
use super::law::{ContactModel, Material, Resistance};
use super::motion::BodyState;
use crate::geometry::armour_unit::ArmourUnit;
use crate::geometry::convex::convex_part::ConvexPart;
use crate::geometry::profile::Profile;
use crate::geometry::terrain::Terrain;

/// Largest number of convex parts of a body; it is limited because part number and feature number share 16 bits.
pub const MAX_PARTS: usize = 63;

/// Shape and mass, equal for all bodies. Body axes have their origin at the centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyShape {
    /// Rounded convex parts that form the contact surface.
    pub parts: Vec<ConvexPart>,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia tensor about the centre of mass [kg m2].
    pub inertia: DMat3,
}

impl BodyShape {
    /// Armour unit of the given mass [kg] with uniform density.
    pub fn from_unit(unit: &ArmourUnit, mass_kg: f64) -> Self {
        Self { parts: unit.parts().to_vec(), mass: mass_kg, inertia: unit.inertia(mass_kg) }
    }

    /// Ball of the given radius [m] and mass [kg].
    pub fn ball(radius: f64, mass_kg: f64) -> Self {
        let inertia = DMat3::IDENTITY * (0.4 * mass_kg * radius * radius);
        Self { parts: vec![ConvexPart::ball(DVec3::ZERO, radius)], mass: mass_kg, inertia }
    }

    /// Radius of the sphere about the centre of mass that encloses the body [m].
    pub fn reach(&self) -> f64 {
        let reach = |part: &ConvexPart| {
            let (centre, radius) = part.bounding_sphere();
            centre.length() + radius
        };
        self.parts.iter().map(reach).fold(0.0, f64::max)
    }
}

/// The ground that the bodies rest on.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Level z(x) of bed and mound, uniform across the flume.
    pub profile: Profile,
    /// Optional triangle surface on or above the profile.
    pub terrain: Option<Arc<Terrain>>,
    /// Material of the profile and the triangle surface.
    pub material: Material,
    /// A part of the profile with a surface of its own.
    pub cover: Option<Cover>,
}

/// Surface of a part of the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// Positions x of the two ends [m], two points of the profile.
    pub x: [f64; 2],
    /// Material of the surface.
    pub material: Material,
    /// Friction and rolling resistance between a body and the surface.
    pub resistance: Resistance,
}

/// Side boundaries of the flume for the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sides {
    /// No side boundaries.
    Open,
    /// Periodic: a body also touches the images of all bodies, which are shifted by multiples of the width [m].
    Periodic { width: f64 },
    /// Walls at y = 0 and y = width [m].
    Walls { width: f64 },
    /// Two-dimensional, without side boundaries: bodies translate along x and z and rotate about y only.
    TwoDimensional,
}

/// Friction and rolling resistance of each pair of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Between two bodies.
    pub unit_unit: Resistance,
    /// Between a body and the ground outside of its cover.
    pub unit_ground: Resistance,
    /// Between a body and a wall.
    pub unit_wall: Resistance,
}

/// Input of the rigid-body solver.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidSetup {
    /// Shape and mass of every body.
    pub shape: BodyShape,
    /// Position and motion of each body at the start.
    pub bodies: Vec<BodyState>,
    /// Material of the bodies.
    pub material: Material,
    /// Bed, mound and triangle surface; `None` without ground.
    pub ground: Option<Ground>,
    /// Side boundaries of the flume.
    pub sides: Sides,
    /// Positions x of the walls at the seaward and the shoreward end [m]; `None` without end walls.
    pub end_walls: Option<[f64; 2]>,
    /// Material of side and end walls.
    pub wall_material: Material,
    /// Friction and rolling resistance of each pair of surfaces.
    pub friction: Friction,
    /// Contact law of all pairs.
    pub model: ContactModel,
    /// Acceleration of gravity [m/s2].
    pub gravity: DVec3,
}

impl RigidSetup {
    /// Returns an error if a value is out of range.
    pub fn check(&self) -> Result<(), RigidError> {
        let reject = |what: &str, value: f64, allowed| Err(RigidError::Setup { what: what.into(), value, allowed });
        if !(self.shape.mass > 0.0 && self.shape.mass.is_finite()) {
            return reject("the mass of a unit [kg]", self.shape.mass, "positive");
        }
        let determinant = self.shape.inertia.determinant();
        if !(determinant > 0.0 && determinant.is_finite()) {
            return reject("the determinant of the inertia tensor", determinant, "positive");
        }
        if self.shape.parts.is_empty() {
            return reject("the number of convex parts", 0.0, "at least 1");
        }
        if self.shape.parts.len() > MAX_PARTS {
            return reject("the number of convex parts", self.shape.parts.len() as f64, "at most 63");
        }
        let features = |part: &ConvexPart| part.as_polyhedron().map_or(0, |p| p.corners().len() + p.edges().len());
        if let Some(part) = self.shape.parts.iter().find(|p| features(p) > MAX_FEATURES) {
            return reject("the number of corners and edges of a convex part", features(part) as f64, "at most 1022");
        }
        if let Some(part) = self.shape.parts.iter().find(|p| p.rounding().is_nan() || p.rounding() <= 0.0) {
            return reject("the rounding radius [m]", part.rounding(), "positive");
        }
        let ground = self.ground.as_ref().map(|g| &g.material);
        let cover = self.ground.as_ref().and_then(|g| g.cover.as_ref());
        let materials = [Some(&self.material), ground, cover.map(|c| &c.material), Some(&self.wall_material)];
        for material in materials.into_iter().flatten() {
            if !(material.young_modulus > 0.0 && material.young_modulus.is_finite()) {
                return reject("Young's modulus [Pa]", material.young_modulus, "positive");
            }
            if !(0.0..=0.5).contains(&material.poisson_ratio) {
                return reject("Poisson's ratio", material.poisson_ratio, "between 0 and 0.5");
            }
            if !(0.0..=1.0).contains(&material.restitution) {
                return reject("the coefficient of restitution", material.restitution, "between 0 and 1");
            }
        }
        let Friction { unit_unit, unit_ground, unit_wall } = self.friction;
        let pairs = [Some(unit_unit), Some(unit_ground), Some(unit_wall), cover.map(|c| c.resistance)];
        for pair in pairs.into_iter().flatten() {
            let coefficients = [pair.static_friction, pair.kinetic_friction, pair.rolling];
            if let Some(bad) = coefficients.iter().find(|mu| !(**mu >= 0.0 && mu.is_finite())) {
                return reject("a coefficient of friction or rolling resistance", *bad, "0 or greater");
            }
            if pair.kinetic_friction > pair.static_friction {
                return reject("the kinetic friction coefficient", pair.kinetic_friction, "at most the static value");
            }
            if let Some(e) = pair.restitution.filter(|e| !(0.0..=1.0).contains(e)) {
                return reject("the coefficient of restitution", e, "between 0 and 1");
            }
            let stiffness = pair.stiffness.unwrap_or_default();
            if self.model == ContactModel::Linear && !(stiffness > 0.0 && stiffness.is_finite()) {
                return reject("the stiffness of a contact [N/m]", stiffness, "positive under the linear law");
            }
        }
        if let Sides::Periodic { width } | Sides::Walls { width } = self.sides
            && !(width > 0.0 && width.is_finite())
        {
            return reject("the width between the side boundaries [m]", width, "positive");
        }
        for (index, body) in self.bodies.iter().enumerate() {
            let length = body.rotation.length();
            // The tolerance 1e-6 accepts quaternions that were written with seven digits.
            if (length - 1.0).abs() > 1e-6 || length.is_nan() {
                return reject(&format!("the length of the rotation quaternion of unit {}", index + 1), length, "1");
            }
            let values = body.position + body.velocity + body.angular_velocity;
            if !values.is_finite() {
                return reject(&format!("position or motion of unit {}", index + 1), f64::NAN, "finite");
            }
        }
        Ok(())
    }
}
