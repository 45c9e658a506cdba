//! Rigid bodies and contact compared with exact solutions of mechanics.

mod catalogue;
mod creep;
mod cubes;
mod friction;
mod impact;
mod kinds;
mod linear;
mod pile;
mod records;
mod rest;
mod rolling;
mod rows;
mod sliding;
mod spin;
mod terrain;
mod world;

use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::geometry::profile::Profile;
use breakwater::rigid::{
    Body, BodyKind, BodyShape, BodyState, ContactModel, Ground, Load, Material, MaterialPair, Resistance, RigidSetup,
    RigidWorld, Sides,
};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

const G: f64 = 9.81;
const HEIGHT: f64 = 0.077;
const MASS: f64 = 0.3;
const MORTAR: Material = Material { young_modulus: 1e8, poisson_ratio: 0.2, restitution: 0.5 };

fn level() -> Profile {
    Profile::new(vec![[-5.0, 0.0], [5.0, 0.0]])
}

/// Number of the material of the units.
const UNIT: usize = 0;
/// Number of the material of ground and walls. Its elastic constants are those of the units, its friction differs.
const GROUND: usize = 1;

/// Returns the setup of bodies of one kind on level ground, where they have the coefficient `friction` [-].
fn setup(shape: BodyShape, bodies: Vec<BodyState>, material: Material, friction: f64) -> RigidSetup {
    RigidSetup {
        kinds: vec![kind(shape)],
        bodies: Body::of_first_kind(bodies),
        materials: vec![material; 2],
        pairs: vec![pair(UNIT, 0.65.into()), pair(GROUND, friction.into())],
        ground: Some(ground(level())),
        surfaces: Vec::new(),
        sides: Sides::Open,
        end_walls: None,
        wall_material: GROUND,
        model: ContactModel::HertzMindlin,
        gravity: DVec3::NEG_Z * G,
    }
}

fn kind(shape: BodyShape) -> BodyKind {
    BodyKind { shape, material: UNIT, is_fixed: false }
}

fn pair(other: usize, resistance: Resistance) -> MaterialPair {
    MaterialPair { between: [UNIT, other], resistance }
}

fn ground(profile: Profile) -> Ground {
    Ground { profile, material: GROUND, covers: Vec::new() }
}

fn tetrapod() -> ArmourUnit {
    ArmourUnit::tetrapod(HEIGHT, 0.05).unwrap()
}

/// Returns a Tetrapod on level ground at (x, y). Its overlap with the ground is about the overlap at rest.
fn standing(unit: &ArmourUnit, x: f64, y: f64, azimuth: f64) -> BodyState {
    BodyState::at_rest(DVec3::new(x, y, unit.standing_height() - 3.5e-5), unit.standing_rotation(azimuth))
}

fn run(world: &mut RigidWorld, duration: f64, dt: f64) {
    let loads = vec![Load::default(); world.states().len()];
    for _ in 0..(duration / dt).round() as usize {
        world.advance(dt, &loads).unwrap();
    }
}

/// Returns kinetic, potential and elastic energy plus all dissipated energy, minus the work of loads [J].
fn total_energy(world: &RigidWorld) -> f64 {
    let e = world.energy();
    e.kinetic + e.potential + e.elastic + e.friction + e.damping - e.load_work
}

fn ball(radius: f64, density: f64) -> BodyShape {
    BodyShape::ball(radius, density * 4.0 / 3.0 * PI * radius.powi(3))
}

/// Returns the setup of ten units above each other in a shaft, in various orientations.
fn heap(unit: &ArmourUnit) -> RigidSetup {
    let body = |i: usize| {
        let t = i as f64;
        let place = DVec3::new(0.02 * (2.0 * t).sin(), 0.1 + 0.02 * (3.0 * t).cos(), 0.06 + 0.09 * t);
        BodyState::at_rest(place, DQuat::from_euler(glam::EulerRot::XYZ, t, 2.3 * t, 0.7 * t))
    };
    RigidSetup {
        sides: Sides::Walls { width: 0.2 },
        end_walls: Some([-0.1, 0.1]),
        ..setup(BodyShape::from_unit(unit, MASS), (0..10).map(body).collect(), MORTAR, 0.32)
    }
}
