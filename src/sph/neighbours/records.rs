//! The packed record of a particle, with the data that its neighbours need. The pair loop copies the record of a
//! neighbour to all lanes.

use glam::DVec3;

use super::grid::Grid;
use crate::sph::parameters::Parameters;

/// Data of a particle that its neighbours need, in single precision, 52 bytes.
///
/// x is split into a bin index and an offset in the bin, so that differences keep their precision in flumes of any
/// length. y and z are relative to the middle of the grid.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub struct Record {
    /// Index of the bin along x, an integer stored as f32.
    pub bin_x: f32,
    /// Offset along x from the low end of the bin [m].
    pub x: f32,
    /// y relative to the middle of the grid [m].
    pub y: f32,
    /// z relative to the middle of the grid [m].
    pub z: f32,
    /// Velocity [m/s].
    pub velocity: [f32; 3],
    /// Volume, m / rho [m3].
    pub volume: f32,
    /// rho - rho0 [kg/m3].
    pub excess_density: f32,
    /// Pressure, including the pressure of the acoustic damping [Pa].
    pub pressure: f32,
    /// Pressure of the acoustic damping [Pa].
    pub damping: f32,
    /// Speed of sound [m/s].
    pub sound_speed: f32,
    /// Volume of the particle in the density diffusion [m3]. It is zero for boundary particles under DBC, because their
    /// density is not the density of the water.
    pub diffusive_volume: f32,
}

/// Splits a position [m] into the first four numbers of [`Record`]: bin along x, offset in the bin, y and z.
pub fn split_position(grid: &Grid, point: DVec3) -> [f32; 4] {
    let from_low = point - grid.low;
    let bin = (from_low.x / grid.size.x).floor();
    let middle = |axis: usize| 0.5 * grid.size[axis] * grid.count[axis] as f64;
    [
        bin as f32,
        (from_low.x - bin * grid.size.x) as f32,
        (from_low.y - middle(1)) as f32,
        (from_low.z - middle(2)) as f32,
    ]
}

/// Returns the record of a particle from its double-precision state. `diffuses` is true if the particle takes part in
/// the density diffusion.
pub fn record(
    grid: &Grid,
    parameters: &Parameters,
    position: DVec3,
    velocity: DVec3,
    density: f64,
    mass: f64,
    diffuses: bool,
) -> Record {
    let tait = &parameters.tait;
    let [bin_x, x, y, z] = split_position(grid, position);
    let volume = (mass / density) as f32;
    Record {
        bin_x,
        x,
        y,
        z,
        velocity: velocity.as_vec3().to_array(),
        volume,
        excess_density: (density - tait.rho0) as f32,
        pressure: tait.pressure(density) as f32,
        damping: 0.0,
        sound_speed: tait.sound_speed(density) as f32,
        diffusive_volume: if diffuses { volume } else { 0.0 },
    }
}

impl Record {
    /// Adds a pressure of the acoustic damping [Pa].
    pub fn add_damping(&mut self, pressure: f32) {
        self.damping += pressure;
        self.pressure += pressure;
    }
}
