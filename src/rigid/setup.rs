//! What a rigid world is made of.

use glam::{DMat3, DVec3};

use super::error::RigidError;
use super::hertz_mindlin::Material;
use super::motion::BodyState;
use crate::geometry::armour_unit::ArmourUnit;
use crate::geometry::convex_part::ConvexPart;
use crate::geometry::profile::Profile;

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

/// Bed and mound, the same across the flume.
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Level z(x).
    pub profile: Profile,
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
}

/// Coulomb's coefficients [-].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Between two bodies.
    pub unit_unit: f64,
    /// Between a body and the ground.
    pub unit_ground: f64,
    /// Between a body and a wall.
    pub unit_wall: f64,
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
    /// Bed and mound.
    pub ground: Option<Ground>,
    /// What closes the domain across the flume.
    pub sides: Sides,
    /// Walls at the seaward and the shoreward end, x [m].
    pub end_walls: Option<[f64; 2]>,
    /// Material of side and end walls.
    pub wall_material: Material,
    /// Coulomb's coefficients.
    pub friction: Friction,
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
        let friction = [self.friction.unit_unit, self.friction.unit_ground, self.friction.unit_wall];
        if let Some(bad) = friction.iter().find(|mu| !(**mu >= 0.0 && mu.is_finite())) {
            return refuse("the coefficient of friction", *bad, "0 or greater");
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
