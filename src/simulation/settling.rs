//! Units that settle in still water: the buoyancy relieves their contacts, and the tangential springs take up load.

use glam::DVec3;

use crate::{
    case::{StillWater, Units, group},
    geometry::solid::Solid,
    rigid::{BodyState, Load, RigidError, RigidWorld},
};

/// Time between two checks of the speeds of the units [s].
const CHECK_INTERVAL: f64 = 1e-3;
/// Shortest time of settling [s]: units at rest need it to start to move.
const SHORTEST: f64 = 0.05;
/// Longest time of settling [s].
pub const LONGEST: f64 = 10.0;
/// Units slower than this are at rest: speed divided by sqrt(g H), with the height H of the highest unit [-].
pub const REST_SPEED: f64 = 1e-4;
/// Number of substeps in the shortest oscillation period while units settle [-]. The equilibrium of the units does not
/// depend on the length of the substeps, and a rebound need not be exact.
pub const COARSE_STEPS: f64 = 20.0;

/// Units in a world of rigid bodies, perhaps in still water.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The units of the case. The kinds of the bodies are their models.
    pub units: &'a Units,
    /// Gravitational acceleration, positive [m/s2].
    pub gravity: f64,
    /// The water, if any.
    pub water: Option<StillWater>,
}

impl Surroundings<'_> {
    /// Advances the world by a millisecond.
    ///
    /// # Errors
    /// If the contact solver becomes unstable.
    pub fn advance(&self, world: &mut RigidWorld) -> Result<(), RigidError> {
        let loads = match self.water {
            Some(water) => self.buoyancy(world, water),
            None => vec![Load::default(); world.states().len()],
        };
        world.advance(CHECK_INTERVAL, &loads)
    }

    /// Advances the world at least 0.05 s, until all units are slower than `speed` times sqrt(g H) [-], and at most for
    /// the time `longest` [s]. Returns true if all units are as slow.
    ///
    /// # Errors
    /// If the contact solver becomes unstable.
    pub fn settle(&self, world: &mut RigidWorld, speed: f64, longest: f64) -> Result<bool, RigidError> {
        let slow = speed * (self.gravity * self.units.tallest()).sqrt();
        let begun = world.time();
        let is_slow = |world: &RigidWorld| fastest(world, self.units.tallest()) <= slow;
        while world.time() - begun < SHORTEST || (!is_slow(world) && world.time() - begun < longest) {
            self.advance(world)?;
        }
        Ok(is_slow(world))
    }

    /// Returns the buoyancy of each unit.
    fn buoyancy(&self, world: &RigidWorld, water: StillWater) -> Vec<Load> {
        let solids: Vec<&Solid> =
            group::models(&self.units.groups).map(|(_, model)| model.shape.unit().solid()).collect();
        let of_unit = |(state, kind): (&BodyState, &usize)| {
            let up = state.rotation.inverse() * DVec3::Z;
            let (volume, centre) = solids[*kind].below(up, water.level - state.position.z);
            let force = water.density * self.gravity * volume;
            Load::of_force(DVec3::Z * force, state.rotation * centre)
        };
        world.states().iter().zip(world.kinds()).map(of_unit).collect()
    }
}

/// Returns the largest speed of any unit [m/s]: the speed of the centre plus the speed of the tips by rotation.
pub fn fastest(world: &RigidWorld, height: f64) -> f64 {
    let speed = |state: &BodyState| state.velocity.length() + 0.5 * height * state.angular_velocity.length();
    world.states().iter().map(speed).fold(0.0, f64::max)
}
