//! What a rigid world is made of.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::error::RigidError;
use super::hertz_mindlin::Material;
use super::motion::BodyState;
use super::polyhedron_contact::MOST_FEATURES;
use crate::geometry::armour_unit::ArmourUnit;
use crate::geometry::convex_part::ConvexPart;
use crate::geometry::profile::Profile;
use crate::geometry::terrain::Terrain;

/// Convex parts of a body at most: their numbers share 16 bits with those of corners and edges.
pub const MOST_PARTS: usize = 63;

/// Shape and mass of a body, the same for all bodies of a world; body axes with the origin at the centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyShape {
    /// Convex parts for contact.
    pub parts: Vec<ConvexPart>,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia tensor about the centre of mass [kg m2].
    pub inertia: DMat3,
}

impl BodyShape {
    /// Armour unit with the imposed mass [kg] spread evenly over its closed surface's volume.
    pub fn of_unit(unit: &ArmourUnit, mass_kg: f64) -> Self {
        Self { parts: unit.parts().to_vec(), mass: mass_kg, inertia: unit.inertia(mass_kg) }
    }

    /// Ball of the given radius [m] and mass [kg].
    pub fn ball(radius: f64, mass_kg: f64) -> Self {
        let inertia = DMat3::IDENTITY * (0.4 * mass_kg * radius * radius);
        Self { parts: vec![ConvexPart::ball(DVec3::ZERO, radius)], mass: mass_kg, inertia }
    }

    /// Radius of the sphere about the centre of mass that holds the body [m].
    pub fn reach(&self) -> f64 {
        let reach = |part: &ConvexPart| {
            let (centre, radius) = part.bounding_sphere();
            centre.length() + radius
        };
        self.parts.iter().map(reach).fold(0.0, f64::max)
    }
}

/// What the bodies stand on.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Level z(x) of bed and mound, the same across the flume.
    pub profile: Profile,
    /// A triangle surface on or over it.
    pub terrain: Option<Arc<Terrain>>,
    /// Its material.
    pub material: Material,
}

/// What closes the domain across the flume, seen by the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sides {
    /// Nothing.
    Open,
    /// A body also meets the others (and itself) shifted by the width [m].
    Periodic { width: f64 },
    /// Walls at y = 0 and y = width [m].
    Walls { width: f64 },
    /// Nothing, in two dimensions: bodies move along x and z and turn about y, whatever acts on them.
    Layer,
}

/// The law of all contacts; see [`super::contact_law`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactModel {
    /// Hertz and Mindlin with tangential history.
    #[default]
    HertzMindlin,
    /// Linear springs; every [`Resistance`] needs its stiffness.
    Linear,
    /// As Chrono 4.0 has it between meshes.
    Chrono4,
}

/// How a pair of surfaces resists sliding, rolling and, if the pair has values of its own, impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resistance {
    /// Coulomb's coefficient at rest [-].
    pub static_friction: f64,
    /// Coulomb's coefficient while sliding [-].
    pub kinetic_friction: f64,
    /// Coefficient of rolling resistance [-].
    pub rolling: f64,
    /// Coefficient of restitution [-]; without it, the smaller one of the two materials.
    pub restitution: Option<f64>,
    /// Stiffness of the linear law [N/m].
    pub stiffness: Option<f64>,
}

impl From<f64> for Resistance {
    /// One coefficient of friction, and nothing besides.
    fn from(friction: f64) -> Self {
        Self { static_friction: friction, kinetic_friction: friction, rolling: 0.0, restitution: None, stiffness: None }
    }
}

/// Resistance of the pairs of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Between two bodies.
    pub unit_unit: Resistance,
    /// Between a body and the ground.
    pub unit_ground: Resistance,
    /// Between a body and a wall.
    pub unit_wall: Resistance,
}

/// Everything a rigid world is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidSetup {
    /// Shape and mass of every body.
    pub shape: BodyShape,
    /// Place and motion of each body at the start.
    pub bodies: Vec<BodyState>,
    /// Material of the bodies.
    pub material: Material,
    /// Bed, mound and what lies on them.
    pub ground: Option<Ground>,
    /// What closes the domain across the flume.
    pub sides: Sides,
    /// Walls at the seaward and the shoreward end, x [m].
    pub end_walls: Option<[f64; 2]>,
    /// Material of side and end walls.
    pub wall_material: Material,
    /// Resistance of the pairs of surfaces.
    pub friction: Friction,
    /// The law of all contacts.
    pub model: ContactModel,
    /// Acceleration of gravity [m/s2].
    pub gravity: DVec3,
}

impl RigidSetup {
    /// Refuses values that the solver cannot work with.
    pub fn check(&self) -> Result<(), RigidError> {
        let refuse = |what: &str, value: f64, allowed| Err(RigidError::Setup { what: what.into(), value, allowed });
        if !(self.shape.mass > 0.0 && self.shape.mass.is_finite()) {
            return refuse("the mass of a unit", self.shape.mass, "positive");
        }
        let determinant = self.shape.inertia.determinant();
        if !(determinant > 0.0 && determinant.is_finite()) {
            return refuse("the determinant of the inertia tensor", determinant, "positive");
        }
        if self.shape.parts.is_empty() {
            return refuse("the number of convex parts", 0.0, "at least 1");
        }
        if self.shape.parts.len() > MOST_PARTS {
            return refuse("the number of convex parts", self.shape.parts.len() as f64, "at most 63");
        }
        let features = |part: &ConvexPart| part.as_polyhedron().map_or(0, |p| p.corners().len() + p.edges().len());
        if let Some(part) = self.shape.parts.iter().find(|p| features(p) > MOST_FEATURES) {
            return refuse("the number of corners and edges of a convex part", features(part) as f64, "at most 1022");
        }
        if let Some(part) = self.shape.parts.iter().find(|p| p.rounding().is_nan() || p.rounding() <= 0.0) {
            return refuse("the rounding radius", part.rounding(), "positive");
        }
        let ground = self.ground.as_ref().map(|g| &g.material);
        for material in [Some(&self.material), ground, Some(&self.wall_material)].into_iter().flatten() {
            if !(material.young_modulus > 0.0 && material.young_modulus.is_finite()) {
                return refuse("Young's modulus [Pa]", material.young_modulus, "positive");
            }
            if !(0.0..=0.5).contains(&material.poisson_ratio) {
                return refuse("Poisson's ratio", material.poisson_ratio, "between 0 and 0.5");
            }
            if !(0.0..=1.0).contains(&material.restitution) {
                return refuse("the coefficient of restitution", material.restitution, "between 0 and 1");
            }
        }
        for pair in [self.friction.unit_unit, self.friction.unit_ground, self.friction.unit_wall] {
            let coefficients = [pair.static_friction, pair.kinetic_friction, pair.rolling];
            if let Some(bad) = coefficients.iter().find(|mu| !(**mu >= 0.0 && mu.is_finite())) {
                return refuse("a coefficient of friction or rolling resistance", *bad, "0 or greater");
            }
            if pair.kinetic_friction > pair.static_friction {
                return refuse("kinetic friction", pair.kinetic_friction, "at most static friction");
            }
            if let Some(e) = pair.restitution.filter(|e| !(0.0..=1.0).contains(e)) {
                return refuse("the coefficient of restitution", e, "between 0 and 1");
            }
            let stiffness = pair.stiffness.unwrap_or_default();
            if self.model == ContactModel::Linear && !(stiffness > 0.0 && stiffness.is_finite()) {
                return refuse("the stiffness of a contact [N/m]", stiffness, "positive under the linear law");
            }
        }
        if let Sides::Periodic { width } | Sides::Walls { width } = self.sides
            && !(width > 0.0 && width.is_finite())
        {
            return refuse("the width between the sides [m]", width, "positive");
        }
        for (index, body) in self.bodies.iter().enumerate() {
            let length = body.rotation.length();
            // 1e-6: a quaternion that was written with seven digits.
            if (length - 1.0).abs() > 1e-6 || length.is_nan() {
                return refuse(&format!("the length of the rotation quaternion of unit {}", index + 1), length, "1");
            }
            let values = body.position + body.velocity + body.angular_velocity;
            if !values.is_finite() {
                return refuse(&format!("place or motion of unit {}", index + 1), f64::NAN, "a finite number");
            }
        }
        Ok(())
    }
}
