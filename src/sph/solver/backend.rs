//! The operations of a time step, for the processor ([`Solver`]) and for a graphics card.
//!
//! The processor works on the water arrays of the host. A card keeps the water in its own memory ([`DeviceMemory`]),
//! and executes the queued commands when the host reads a result.

use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use super::{power::Powers, step::Solver, time_step::Limits};
use crate::mechanics::Load;
use crate::sph::{
    neighbours::grid::{Bins, Grid},
    pairs::rate::Rate,
    parameters::{BoundaryCondition, Parameters},
    particles::{boundary::Boundary, porosity::PorousField, water::Water},
    terms::{density_diffusion::DensityDiffusion, viscosity::Viscosity, wall_slip::WallSlip},
};

/// Device name of the processor.
pub const PROCESSOR: &str = "CPU";

/// Reason why a device cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DeviceError {
    /// The device does not exist or cannot be opened.
    #[error("{0}")]
    Missing(String),
    /// The device does not have enough memory.
    #[error("{device} does not have enough memory: {what}; raise domain.dp_m, or run with --device cpu")]
    Memory {
        /// Name of the device.
        device: String,
        /// Reason, for example the requested and the allowed memory.
        what: String,
    },
    /// The device does not support the numerical scheme of the case.
    #[error("the GPU does not support {0}; run with --device cpu")]
    Scheme(&'static str),
    /// The device failed during the computation.
    #[error("{device} failed: {what}; to continue from the last checkpoint, run breakwater resume on any device")]
    Lost {
        /// Name of the device.
        device: String,
        /// Message of the driver.
        what: String,
    },
}

/// Extreme values of all water particles at the end of a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaterExtremes {
    /// Largest speed [m/s].
    pub largest_speed: f64,
    /// Lowest density [kg/m3].
    pub lowest_density: f64,
    /// Highest density [kg/m3].
    pub highest_density: f64,
    /// True if a particle has left the domain, or if its position, velocity or density is not finite.
    pub is_unstable: bool,
}

/// Surfaces that water must not penetrate, at the end of a time step (see [`crate::simulation::flume`]). All lengths in
/// [m].
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// A water particle nearer to a surface than this distance loses its velocity component towards the surface.
    pub min_distance: f64,
    /// x and z of both ends of each segment of the outline of bed and walls.
    pub outline: Vec<[f64; 4]>,
    /// Low and high corner of each obstacle.
    pub obstacles: Vec<[DVec3; 2]>,
    /// Centre and radius of a sphere around each part of the units; the radius includes `min_distance`.
    pub bounding_spheres: Vec<(DVec3, f64)>,
    /// Wavemaker, if any: its x at zero displacement, z of its lowest row, and displacement of each row along x.
    pub wavemaker: Option<(f64, f64, Vec<f64>)>,
    /// Distance between the side walls, if there are any; the first side wall is at y = 0.
    pub sides: Option<f64>,
}

/// The water particles near surfaces.
#[derive(Debug, Clone, Default)]
pub struct NearWater {
    /// Index of each particle in the water arrays of the device, in ascending order.
    pub indices: Vec<u32>,
    /// State of the particles.
    pub water: Water,
}

/// The operations of a time step. An operation fails only if the device is lost.
pub trait Backend: Send {
    /// Returns the name of the device.
    fn name(&self) -> &str;

    /// Returns the constants of the scheme.
    fn parameters(&self) -> &Parameters;

    /// Returns the bins of the cell list.
    fn grid(&self) -> &Grid;

    /// Returns the bins of the sorted water. For a card, only `start` is set, and only by [`DeviceMemory::fetch`].
    fn water_bins(&self) -> &Bins;

    /// Returns the bins of the boundary: first of bed, walls and pistons, then of the units, which count from the first
    /// unit particle. For a card, the bins are empty.
    fn boundary_bins(&self) -> [&Bins; 2];

    /// Returns the interface to the memory of the device; `None` if the device works on the arrays of the host.
    fn device_memory(&mut self) -> Option<&mut dyn DeviceMemory>;

    /// Lets the water flow through porous media.
    ///
    /// # Errors
    /// If the device does not support porous media.
    fn set_porous(&mut self, _field: Arc<PorousField>) -> Result<(), DeviceError> {
        Err(DeviceError::Scheme("porous media"))
    }

    /// Sorts all particles into bins, and the arrays of `water` into the order of the bins.
    fn sort(&mut self, water: &mut Water, boundary: &Boundary);

    /// Builds the neighbour lists for the current time step.
    fn build_neighbour_lists(&mut self, water: &Water, boundary: &Boundary);

    /// Computes the densities of the boundary particles from their ghost nodes.
    fn boundary_densities(&mut self, boundary: &mut Boundary);

    /// Computes the rates of water and units.
    fn rates(&mut self);

    /// Returns the largest acceleration and the largest signal speed of the water, which limit the time step.
    fn limits(&mut self) -> Result<Limits, DeviceError>;

    /// Predictor, equations 8.1, 8.2 and 9.1: computes the state at the half step. `move_boundary` moves the boundary
    /// to its positions at the half step.
    fn predict(
        &mut self,
        dt: f64,
        water: &Water,
        boundary: &mut Boundary,
        move_boundary: &mut dyn FnMut(&mut Boundary),
    );

    /// Corrector, equations 8.3, 8.4 and 9.2: computes the state at the end of the time step.
    fn correct(&mut self, dt: f64, water: &mut Water, boundary: &mut Boundary);

    /// Returns the force of the water on each unit and the torque about its centre of mass. `centres` lists the centres
    /// of mass [m].
    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<Load>, DeviceError>;

    /// Returns the last computed rates of the water in sorted order. Call it before [`DeviceMemory::sort_ahead`], which
    /// overwrites the rates. In the rates from a card, the approach speed is zero.
    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError>;

    /// Returns the last computed rates of the water in the memory of the host, in sorted order; empty if a card
    /// computes them.
    fn host_rates(&self) -> &[Rate];

    /// Like [`Self::host_rates`]; the rates can be replaced before they are used.
    fn host_rates_mut(&mut self) -> &mut [Rate];

    /// Returns the powers that the water receives. `water` must be the last state for which rates were computed; for a
    /// card, fetch it first.
    fn powers(&mut self, water: &Water) -> Result<Powers, DeviceError>;
}

/// A device that keeps the water in its own memory instead of the arrays of the host. The operations fail if the device
/// is lost. [`Self::load`] also fails if the memory of the device is too small.
pub trait DeviceMemory {
    /// Copies water and boundary from the host to the device: at the start, and after a checkpoint was read or written.
    fn load(&mut self, water: &Water, boundary: &Boundary) -> Result<(), DeviceError>;

    /// Copies the water, its bins and the boundary densities from the device to the arrays of the host.
    fn fetch(&mut self, water: &mut Water, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Copies only the boundary densities from the device to the arrays of the host.
    fn fetch_boundary_densities(&mut self, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Returns the water particles near the `surfaces`. The host then removes the velocity components of these
    /// particles towards the surfaces.
    fn fetch_near_water(&mut self, surfaces: &Surfaces) -> Result<NearWater, DeviceError>;

    /// Writes the changed velocities of the water near surfaces back to the device.
    fn write_near_velocities(&mut self, near: &NearWater);

    /// Starts to sort the water by its positions at the end of the time step. Meanwhile, the host moves the units.
    fn sort_ahead(&mut self);

    /// Returns the extreme values of the water at the end of a time step.
    fn water_extremes(&mut self) -> Result<WaterExtremes, DeviceError>;
}

/// Returns the part of a scheme that graphics cards do not support, if any.
pub fn unsupported_on_gpu(parameters: &Parameters) -> Option<&'static str> {
    if parameters.boundary == BoundaryCondition::Dynamic {
        return Some("the dynamic boundary condition (numerics.boundary = \"dbc\")");
    }
    if !matches!(parameters.viscosity, Viscosity::Artificial { .. }) {
        return Some("laminar viscosity (numerics.viscosity)");
    }
    if parameters.diffusion.kind == DensityDiffusion::Antuono {
        return Some("density diffusion with renormalised gradients (numerics.density_diffusion = \"antuono\")");
    }
    if parameters.slip != WallSlip::Original {
        return Some("the slip of these walls (numerics.wall_slip; numerics.scheme = \"mitsui_2023\" gives another)");
    }
    if !parameters.gap_pressure {
        return Some("units without gap pressure (numerics.gap_pressure = false)");
    }
    if parameters.lowest_density.is_some() {
        return Some("a limit of the suction (numerics.suction_limit)");
    }
    if parameters.acoustic_damping.is_some() {
        return Some("acoustic damping (numerics.acoustic_damping)");
    }
    parameters.shifting.map(|_| "particle shifting (numerics.shifting_coefficient)")
}

impl Backend for Solver {
    fn name(&self) -> &str {
        PROCESSOR
    }

    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn water_bins(&self) -> &Bins {
        Self::water_bins(self)
    }

    fn boundary_bins(&self) -> [&Bins; 2] {
        Self::boundary_bins(self)
    }

    fn device_memory(&mut self) -> Option<&mut dyn DeviceMemory> {
        None
    }

    fn set_porous(&mut self, field: Arc<PorousField>) -> Result<(), DeviceError> {
        Self::set_porous(self, field);
        Ok(())
    }

    fn sort(&mut self, water: &mut Water, boundary: &Boundary) {
        Self::sort(self, water, boundary);
    }

    fn build_neighbour_lists(&mut self, water: &Water, boundary: &Boundary) {
        Self::build_neighbour_lists(self, water, boundary);
    }

    fn boundary_densities(&mut self, boundary: &mut Boundary) {
        Self::boundary_densities(self, boundary);
    }

    fn rates(&mut self) {
        Self::rates(self);
    }

    fn limits(&mut self) -> Result<Limits, DeviceError> {
        Ok(Self::limits(self))
    }

    fn predict(
        &mut self,
        dt: f64,
        water: &Water,
        boundary: &mut Boundary,
        move_boundary: &mut dyn FnMut(&mut Boundary),
    ) {
        Self::predict(self, dt, water, boundary, move_boundary);
    }

    fn correct(&mut self, dt: f64, water: &mut Water, boundary: &mut Boundary) {
        Self::correct(self, dt, water, boundary);
    }

    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<Load>, DeviceError> {
        Ok(Self::unit_loads(self, boundary, centres))
    }

    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        Ok(Self::water_rates(self).to_vec())
    }

    fn host_rates(&self) -> &[Rate] {
        Self::water_rates(self)
    }

    fn host_rates_mut(&mut self) -> &mut [Rate] {
        Self::water_rates_mut(self)
    }

    fn powers(&mut self, water: &Water) -> Result<Powers, DeviceError> {
        Ok(Self::powers(self, water))
    }
}
