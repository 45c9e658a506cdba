//! The pores of porous media around each water particle.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::sph::{pairs::rate::Rate, particles::porosity::PorousField, terms::porous::Pores};

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
const MIN_CHUNK: usize = 4096;

/// Pores at the water particles for the current records.
#[derive(Debug, Default)]
pub(super) struct WaterPores {
    field: Option<Arc<PorousField>>,
    /// One entry per particle; empty without porous media.
    pores: Vec<Pores>,
}

impl WaterPores {
    /// Creates the pores of a field.
    pub(super) fn of(field: Arc<PorousField>) -> Self {
        Self { field: Some(field), pores: Vec::new() }
    }

    /// Looks up the pores at the positions of all water particles [m].
    pub(super) fn update(&mut self, positions: &[DVec3]) {
        let Some(field) = &self.field else { return };
        self.pores.resize(positions.len(), Pores::NONE);
        let pores = self.pores.par_iter_mut().zip(positions).with_min_len(MIN_CHUNK);
        pores.for_each(|(pores, position)| *pores = field.at(*position));
    }

    /// Porosity at a particle [-]; 1 in open water.
    pub(super) fn porosity(&self, particle: usize) -> f64 {
        self.pores.get(particle).map_or(1.0, |pores| pores.porosity)
    }

    /// Returns the velocity of a particle [m/s] after a time `dt` [s], with the given acceleration [m/s2].
    pub(super) fn velocity_after(&self, particle: usize, dt: f64, velocity: DVec3, acceleration: DVec3) -> DVec3 {
        match self.pores.get(particle) {
            Some(pores) => pores.velocity_after(dt, velocity, acceleration),
            None => velocity + dt * acceleration,
        }
    }

    /// Power per mass that the drag takes from a particle [W/kg].
    pub(super) fn dissipation(&self, particle: usize, velocity: DVec3) -> f64 {
        self.pores.get(particle).map_or(0.0, |pores| pores.dissipation(velocity))
    }

    /// Turns the compression of the bulk volume into that of the water in the pores.
    pub(super) fn add_to(&self, rates: &mut [Rate]) {
        rates.par_iter_mut().zip(&self.pores).with_min_len(MIN_CHUNK).for_each(|(rate, pores)| {
            let compression = (f64::from(rate.compression) / pores.porosity) as f32;
            rate.density += compression - rate.compression;
            rate.compression = compression;
        });
    }

    /// Returns the memory in use [bytes].
    pub(super) fn bytes(&self) -> usize {
        self.pores.capacity() * size_of::<Pores>() + self.field.as_ref().map_or(0, |field| field.bytes())
    }
}
