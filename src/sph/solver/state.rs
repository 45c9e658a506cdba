//! The state of the water that the sums over particle pairs read.

use glam::DVec3;

use crate::sph::particles::water::Water;

/// State of the water at the start of a time step or at the half step.
#[derive(Clone, Copy)]
pub(super) struct State<'a> {
    pub position: &'a [DVec3],
    pub velocity: &'a [DVec3],
    pub density: &'a [f64],
    pub mass: &'a [f64],
}

impl<'a> State<'a> {
    pub fn from_water(water: &'a Water) -> Self {
        Self { position: &water.position, velocity: &water.velocity, density: &water.density, mass: &water.mass }
    }
}
