//! State of the particles on a card, in single precision. A position is stored as a bin and an offset in this bin.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::sph::neighbours::grid::Grid;
use crate::sph::particles::boundary::Boundary;
use crate::sph::particles::water::Water;

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
const MIN_CHUNK: usize = 4096;

/// Particles in the layout of a card, one entry per particle in every array.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CardState {
    /// Offset in the bin [m], and rho - rho0 [kg/m3].
    pub offset: Vec<[f32; 4]>,
    /// Index of the bin along x, y and z. The fourth number is the identification number of a water particle; for a
    /// boundary particle, it is 0 for bed, walls and wavemaker, and 1 + k for unit k.
    pub cell: Vec<[i32; 4]>,
    /// Velocity [m/s] and mass [kg].
    pub motion: Vec<[f32; 4]>,
}

/// Returns the bin indices of a point along x, y and z, and the offset of the point from the low corner of this bin
/// [m]. Points outside the grid have indices below 0 or above the last bin.
pub fn to_cell(grid: &Grid, point: DVec3) -> ([i32; 3], [f32; 3]) {
    let from_low = grid.wrap(point) - grid.low;
    let cell = (from_low / grid.size).floor();
    ([cell.x as i32, cell.y as i32, cell.z as i32], (from_low - cell * grid.size).as_vec3().to_array())
}

/// Returns the point [m] at an offset [m] in a bin.
pub fn to_point(grid: &Grid, cell: [i32; 4], offset: [f32; 4]) -> DVec3 {
    let [x, y, z, _] = cell.map(f64::from);
    grid.low + DVec3::new(x, y, z) * grid.size + Vec3::from_slice(&offset).as_dvec3()
}

impl CardState {
    /// Converts the water to the layout of the card.
    pub fn of_water(grid: &Grid, rho0: f64, water: &Water) -> Self {
        let particle = |i: usize| {
            let id = water.id[i] as i32;
            to_card(grid, water.position[i], water.velocity[i], water.density[i] - rho0, water.mass[i], id)
        };
        Self::collect(0..water.len(), particle)
    }

    /// Converts boundary particles to the layout of the card, with the vectors to their surfaces [m].
    pub fn of_boundary(
        grid: &Grid,
        rho0: f64,
        boundary: &Boundary,
        particles: std::ops::Range<usize>,
    ) -> (Self, Vec<[f32; 4]>) {
        let particle = |i: usize| {
            let (excess, mass) = (boundary.density[i] - rho0, rho0 * boundary.volume[i]);
            let unit = i.checked_sub(boundary.walls().end).map_or(0, |k| 1 + boundary.unit_numbers()[k] as i32);
            to_card(grid, boundary.position[i], boundary.velocity[i], excess, mass, unit)
        };
        let surfaces = Self::surfaces_of(boundary, particles.clone());
        (Self::collect(particles, particle), surfaces)
    }

    /// Converts the vectors from boundary particles to their surfaces [m] to the layout of the card.
    pub fn surfaces_of(boundary: &Boundary, particles: std::ops::Range<usize>) -> Vec<[f32; 4]> {
        let surface = |i: usize| boundary.to_surface[i].as_vec3().extend(0.0).to_array();
        particles.into_par_iter().with_min_len(MIN_CHUNK).map(surface).collect()
    }

    fn collect(
        particles: std::ops::Range<usize>,
        particle: impl Fn(usize) -> ([f32; 4], [i32; 4], [f32; 4]) + Sync + Send,
    ) -> Self {
        let ((offset, cell), motion) = particles
            .into_par_iter()
            .with_min_len(MIN_CHUNK)
            .map(|i| {
                let (offset, cell, motion) = particle(i);
                ((offset, cell), motion)
            })
            .unzip();
        Self { offset, cell, motion }
    }

    /// Writes the state to the arrays of `water`, which are resized to the number of particles.
    pub fn write_to(&self, grid: &Grid, rho0: f64, water: &mut Water) {
        let count = self.cell.len();
        water.position.resize(count, DVec3::ZERO);
        water.velocity.resize(count, DVec3::ZERO);
        water.density.resize(count, 0.0);
        water.mass.resize(count, 0.0);
        water.id.resize(count, 0);
        (&mut water.position, &mut water.velocity, &mut water.density, &mut water.mass, &mut water.id)
            .into_par_iter()
            .enumerate()
            .with_min_len(MIN_CHUNK)
            .for_each(|(i, (position, velocity, density, mass, id))| {
                *position = to_point(grid, self.cell[i], self.offset[i]);
                *velocity = Vec3::from_slice(&self.motion[i]).as_dvec3();
                *density = rho0 + f64::from(self.offset[i][3]);
                *mass = f64::from(self.motion[i][3]);
                *id = self.cell[i][3] as u32;
            });
    }
}

fn to_card(
    grid: &Grid,
    position: DVec3,
    velocity: DVec3,
    excess: f64,
    mass: f64,
    id: i32,
) -> ([f32; 4], [i32; 4], [f32; 4]) {
    let ([x, y, z], [dx, dy, dz]) = to_cell(grid, position);
    ([dx, dy, dz, excess as f32], [x, y, z, id], velocity.as_vec3().extend(mass as f32).to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_keep_their_precision_in_a_long_flume() {
        let grid = Grid::new(DVec3::new(36.5, 0.0, 0.4), DVec3::new(41.0, 0.16, 1.1), 0.009, Some(0.16));
        for point in
            [DVec3::new(36.499_123_456, 0.012_345_678, 0.712_345_678), DVec3::new(40.987_654_321, 0.159_9, 2.3)]
        {
            let ([x, y, z], [dx, dy, dz]) = to_cell(&grid, point);
            let back = to_point(&grid, [x, y, z, 0], [dx, dy, dz, 0.0]);
            // Limit 1e-9 m: half the last bit of an offset of up to 18 mm, the size of a bin.
            assert!((back - point).abs().max_element() < 1e-9, "{point} {back}");
        }
    }
}
