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

/// Shape and mass of a body. Body axes have their origin at the centre of mass.
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

/// Bodies of one kind have the same shape, mass and material.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyKind {
    /// Shape and mass.
    pub shape: BodyShape,
    /// Material of the surface, an index into [`RigidSetup::materials`].
    pub material: usize,
    /// Fixed bodies stay at their start positions.
    pub is_fixed: bool,
}

/// A body at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Kind of the body, an index into [`RigidSetup::kinds`].
    pub kind: usize,
    /// Position and motion.
    pub state: BodyState,
}

impl Body {
    /// Bodies of the first kind.
    pub fn of_first_kind(states: impl IntoIterator<Item = BodyState>) -> Vec<Self> {
        states.into_iter().map(|state| Self { kind: 0, state }).collect()
    }
}

/// The ground that the bodies rest on. Materials are indices into [`RigidSetup::materials`].
#[derive(Debug, Clone, PartialEq)]
pub struct Ground {
    /// Level z(x) of bed and mound, uniform across the flume.
    pub profile: Profile,
    /// Material of the profile.
    pub material: usize,
    /// Parts of the profile with surfaces of their own. Where parts overlap, the last one is on top.
    pub covers: Vec<Cover>,
}

/// Surface of a part of the profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// Positions x of the two ends [m], two points of the profile.
    pub x: [f64; 2],
    /// Material of the surface.
    pub material: usize,
}

/// A fixed surface of triangles, closed or open, that bodies touch from its outer side. In a periodic flume, a body whose
/// centre is outside 0 <= y < width touches the surface as its image inside does. So a surface near a side continues
/// beyond this side.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleSurface {
    /// The triangles.
    pub terrain: Arc<Terrain>,
    /// Material, an index into [`RigidSetup::materials`].
    pub material: usize,
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

/// Friction and rolling resistance between surfaces of two materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialPair {
    /// The two materials in any order, indices into [`RigidSetup::materials`].
    pub between: [usize; 2],
    /// Friction and rolling resistance.
    pub resistance: Resistance,
}

/// Input of the rigid-body solver.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidSetup {
    /// Kinds of bodies.
    pub kinds: Vec<BodyKind>,
    /// Kind, position and motion of each body at the start.
    pub bodies: Vec<Body>,
    /// Materials of all surfaces.
    pub materials: Vec<Material>,
    /// Friction and rolling resistance of each pair of materials whose surfaces can touch.
    pub pairs: Vec<MaterialPair>,
    /// Bed and mound; `None` without ground.
    pub ground: Option<Ground>,
    /// Further fixed surfaces.
    pub surfaces: Vec<TriangleSurface>,
    /// Side boundaries of the flume.
    pub sides: Sides,
    /// Positions x of the walls at the seaward and the shoreward end [m]; `None` without end walls.
    pub end_walls: Option<[f64; 2]>,
    /// Material of side and end walls, an index into [`RigidSetup::materials`].
    pub wall_material: usize,
    /// Contact law of all pairs.
    pub model: ContactModel,
    /// Acceleration of gravity [m/s2].
    pub gravity: DVec3,
}

impl RigidSetup {
    /// Returns the number of the first element of each triangle surface.
    pub fn first_places(&self) -> impl Iterator<Item = u32> {
        self.surfaces.iter().scan(0, |next, surface| {
            let first = *next;
            *next += surface.terrain.element_count();
            Some(first)
        })
    }

    /// Returns the index in `pairs` of two materials, if they are given.
    pub fn pair(&self, a: usize, b: usize) -> Option<usize> {
        self.pairs.iter().position(|pair| pair.between == [a, b] || pair.between == [b, a])
    }

    /// Returns an error if a value is out of range.
    pub fn check(&self) -> Result<(), RigidError> {
        self.kinds.iter().try_for_each(check_kind)?;
        self.materials.iter().try_for_each(check_material)?;
        self.pairs.iter().try_for_each(|pair| check_resistance(&pair.resistance, self.model))?;
        self.check_pairs()?;
        if let Sides::Periodic { width } | Sides::Walls { width } = self.sides
            && !(width > 0.0 && width.is_finite())
        {
            return reject("the width between the side boundaries [m]", width, "positive");
        }
        self.bodies.iter().enumerate().try_for_each(|(index, body)| self.check_body(index, body))
    }

    /// Checks that the setup contains every material, and the resistance of every pair of surfaces that can touch.
    fn check_pairs(&self) -> Result<(), RigidError> {
        let ground = self.ground.as_ref();
        let of_ground = ground.map(|ground| ground.material);
        let of_covers = ground.into_iter().flat_map(|ground| &ground.covers).map(|cover| cover.material);
        let fixed: Vec<usize> = [self.wall_material].into_iter().chain(of_ground).chain(of_covers).collect();
        let of_kinds = self.kinds.iter().map(|kind| kind.material);
        for a in self.kinds.iter().filter(|kind| !kind.is_fixed).map(|kind| kind.material) {
            let surfaces = self.surfaces.iter().map(|surface| surface.material);
            for b in fixed.iter().copied().chain(surfaces).chain(of_kinds.clone()) {
                if let Some(unknown) = [a, b].into_iter().find(|index| *index >= self.materials.len()) {
                    return reject("the number of a material", unknown as f64, "less than the number of materials");
                }
                if self.pair(a, b).is_none() {
                    let what = format!("the friction between the materials {a} and {b}");
                    return reject(&what, f64::NAN, "given in `pairs`");
                }
            }
        }
        Ok(())
    }

    fn check_body(&self, index: usize, body: &Body) -> Result<(), RigidError> {
        let Body { kind, state } = body;
        let number = index + 1;
        let Some(is_fixed) = self.kinds.get(*kind).map(|kind| kind.is_fixed) else {
            let what = format!("the kind of unit {number}");
            return reject(&what, *kind as f64, "less than the number of kinds");
        };
        let length = state.rotation.length();
        // The tolerance 1e-6 accepts quaternions that were written with seven digits.
        if (length - 1.0).abs() > 1e-6 || length.is_nan() {
            return reject(&format!("the length of the rotation quaternion of unit {number}"), length, "1");
        }
        let motion = state.velocity.abs() + state.angular_velocity.abs();
        if !(state.position + motion).is_finite() {
            return reject(&format!("position or motion of unit {number}"), f64::NAN, "finite");
        }
        if is_fixed && motion != DVec3::ZERO {
            return reject(&format!("the motion of the fixed unit {number}"), motion.max_element(), "0");
        }
        Ok(())
    }
}

fn reject<T>(what: &str, value: f64, allowed: &'static str) -> Result<T, RigidError> {
    Err(RigidError::Setup { what: what.into(), value, allowed })
}

fn check_kind(kind: &BodyKind) -> Result<(), RigidError> {
    let shape = &kind.shape;
    if !(shape.mass > 0.0 && shape.mass.is_finite()) {
        return reject("the mass of a unit [kg]", shape.mass, "positive");
    }
    let determinant = shape.inertia.determinant();
    if !(determinant > 0.0 && determinant.is_finite()) {
        return reject("the determinant of the inertia tensor", determinant, "positive");
    }
    if shape.parts.is_empty() {
        return reject("the number of convex parts", 0.0, "at least 1");
    }
    if shape.parts.len() > MAX_PARTS {
        return reject("the number of convex parts", shape.parts.len() as f64, "at most 63");
    }
    let features = |part: &ConvexPart| part.as_polyhedron().map_or(0, |p| p.corners().len() + p.edges().len());
    if let Some(part) = shape.parts.iter().find(|p| features(p) > MAX_FEATURES) {
        return reject("the number of corners and edges of a convex part", features(part) as f64, "at most 1022");
    }
    if let Some(part) = shape.parts.iter().find(|p| p.rounding().is_nan() || p.rounding() <= 0.0) {
        return reject("the rounding radius [m]", part.rounding(), "positive");
    }
    Ok(())
}

fn check_material(material: &Material) -> Result<(), RigidError> {
    if !(material.young_modulus > 0.0 && material.young_modulus.is_finite()) {
        return reject("Young's modulus [Pa]", material.young_modulus, "positive");
    }
    if !(0.0..=0.5).contains(&material.poisson_ratio) {
        return reject("Poisson's ratio", material.poisson_ratio, "between 0 and 0.5");
    }
    if !(0.0..=1.0).contains(&material.restitution) {
        return reject("the coefficient of restitution", material.restitution, "between 0 and 1");
    }
    Ok(())
}

fn check_resistance(pair: &Resistance, model: ContactModel) -> Result<(), RigidError> {
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
    if model == ContactModel::Linear && !(stiffness > 0.0 && stiffness.is_finite()) {
        return reject("the stiffness of a contact [N/m]", stiffness, "positive under the linear law");
    }
    Ok(())
}
