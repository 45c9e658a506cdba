//! The operations of a time step, for the processor ([`Solver`]) and for a graphics card.
//!
//! The processor works on the host's water arrays. A card keeps its own arrays and copies them to the host on
//! [`Backend::fetch`]; it executes queued commands when a result is read back.

use glam::DVec3;
use thiserror::Error;

use super::{
    grid::{Bins, Grid},
    parameters::Parameters,
    power::Powers,
    rates::Rate,
    step::Solver,
    time_step::Limits,
};
use crate::sph::particles::{boundary::Boundary, water::Water};

/// Device name of the processor.
pub const PROCESSOR: &str = "CPU";

/// Reason why a device cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DeviceError {
    /// There is no such device, or it does not open.
    #[error("{0}")]
    Missing(String),
    /// It does not have enough memory.
    #[error("{device} does not have enough memory: {what}; raise domain.dp_m, or run with --device cpu")]
    Memory {
        /// Name of the device.
        device: String,
        /// Requested and available memory.
        what: String,
    },
    /// It does not support the numerical scheme of the case.
    #[error("the GPU does not support {0}; run with --device cpu")]
    Scheme(&'static str),
    /// It failed during the computation.
    #[error("{device} failed: {what}; the last checkpoint is intact: run breakwater resume on this or another device")]
    Lost {
        /// Name of the device.
        device: String,
        /// Message of the driver.
        what: String,
    },
}

/// Extremes of the water at the end of a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watched {
    /// Largest speed [m/s].
    pub fastest: f64,
    /// Lowest density [kg/m3].
    pub lightest: f64,
    /// Highest density [kg/m3].
    pub densest: f64,
    /// Whether a particle has left the domain or has a state that is not finite.
    pub astray: bool,
}

/// Surfaces that water must not penetrate, at the end of a time step (see [`crate::simulation::flume`]). Lengths [m].
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// Smallest distance of a particle; nearer particles lose their approach velocity.
    pub nearest: f64,
    /// Segments of the outline of bed and walls, x and z of both ends.
    pub outline: Vec<[f64; 4]>,
    /// Obstacles: low and high corner.
    pub boxes: Vec<[DVec3; 2]>,
    /// Bounding spheres of the units' parts: centre and radius.
    pub balls: Vec<(DVec3, f64)>,
    /// Position of the wavemaker at rest, height of its lowest row, and the displacement of each row.
    pub wavemaker: Option<(f64, f64, Vec<f64>)>,
    /// Width between the side walls; the first one stands at y = 0.
    pub sides: Option<f64>,
}

/// The water particles near surfaces.
#[derive(Debug, Clone, Default)]
pub struct NearWater {
    /// Index of each particle in the arrays of the device, ascending.
    pub places: Vec<u32>,
    /// State of the particles.
    pub water: Water,
}

/// The operations of a time step.
pub trait Backend: Send {
    /// Returns the name of the device.
    fn name(&self) -> &str;

    /// Returns the constants of the scheme.
    fn parameters(&self) -> &Parameters;

    /// Returns the bins of the cell list.
    fn grid(&self) -> &Grid;

    /// Returns where each bin of the water begins, as last sorted and fetched.
    fn water_bins(&self) -> &Bins;

    /// Returns whether the device keeps the water in its own memory instead of the host's arrays.
    fn keeps_water(&self) -> bool;

    /// Copies water and boundary to the device: at the start and after a checkpoint has been read or written.
    ///
    /// # Errors
    /// If the device does not have enough memory.
    fn load(&mut self, water: &Water, boundary: &Boundary) -> Result<(), DeviceError>;

    /// Updates water, its bins and the boundary densities in the arrays of the host.
    ///
    /// # Errors
    /// If the device is lost.
    fn fetch(&mut self, water: &mut Water, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Updates only the boundary densities in the arrays of the host.
    ///
    /// # Errors
    /// If the device is lost.
    fn fetch_boundary_densities(&mut self, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Sorts the particles into bins and the water's arrays into the order of the bins.
    fn sort(&mut self, water: &mut Water, boundary: &Boundary);

    /// Builds the neighbour lists of this time step.
    fn list(&mut self, water: &Water, boundary: &Boundary);

    /// Computes the densities of the boundary particles from their ghost nodes.
    fn boundary_densities(&mut self, boundary: &mut Boundary);

    /// Computes the rates of water and units.
    fn rates(&mut self);

    /// Returns the largest acceleration and signal speed of the water.
    ///
    /// # Errors
    /// If the device is lost.
    fn limits(&mut self) -> Result<Limits, DeviceError>;

    /// Predictor, equations 8.1, 8.2 and 9.1; `move_boundary` moves the boundary to the half step.
    fn predict(
        &mut self,
        dt: f64,
        water: &Water,
        boundary: &mut Boundary,
        move_boundary: &mut dyn FnMut(&mut Boundary),
    );

    /// Corrector, equations 8.3, 8.4 and 9.2: computes the state at the end of the time step.
    fn correct(&mut self, dt: f64, water: &mut Water, boundary: &mut Boundary);

    /// Returns the force [N] of the water on each unit and its torque [N m] about the unit's centre [m].
    ///
    /// # Errors
    /// If the device is lost.
    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<(DVec3, DVec3)>, DeviceError>;

    /// Returns the water near surfaces, which the host keeps out of them; empty if the host holds the water.
    ///
    /// # Errors
    /// If the device is lost.
    fn take_near(&mut self, surfaces: &Surfaces) -> Result<NearWater, DeviceError>;

    /// Writes the velocities of the water near surfaces back to the device.
    fn put_near(&mut self, near: &NearWater);

    /// Starts sorting the water at its positions at the end of the time step, while the host moves the units.
    fn sort_ahead(&mut self);

    /// Returns the extremes of the water at the end of a time step; `None` if the host holds the water.
    ///
    /// # Errors
    /// If the device is lost.
    fn watch(&mut self) -> Result<Option<Watched>, DeviceError>;

    /// Returns the last computed rates of the water in its order, valid until [`Self::sort_ahead`]. Rates from cards
    /// do not include the approach speed.
    ///
    /// # Errors
    /// If the device is lost.
    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError>;

    /// Returns the powers that act on the water, at the fetched state whose rates were computed last.
    ///
    /// # Errors
    /// If the device is lost.
    fn powers(&mut self, water: &Water) -> Result<Powers, DeviceError>;
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

    fn keeps_water(&self) -> bool {
        false
    }

    fn load(&mut self, _: &Water, _: &Boundary) -> Result<(), DeviceError> {
        Ok(())
    }

    fn fetch(&mut self, _: &mut Water, _: &mut Boundary) -> Result<(), DeviceError> {
        Ok(())
    }

    fn fetch_boundary_densities(&mut self, _: &mut Boundary) -> Result<(), DeviceError> {
        Ok(())
    }

    fn sort(&mut self, water: &mut Water, boundary: &Boundary) {
        Self::sort(self, water, boundary);
    }

    fn list(&mut self, water: &Water, boundary: &Boundary) {
        Self::list(self, water, boundary);
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

    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<(DVec3, DVec3)>, DeviceError> {
        Ok(Self::unit_loads(self, boundary, centres))
    }

    fn take_near(&mut self, _: &Surfaces) -> Result<NearWater, DeviceError> {
        Ok(NearWater::default())
    }

    fn put_near(&mut self, _: &NearWater) {}

    fn sort_ahead(&mut self) {}

    fn watch(&mut self) -> Result<Option<Watched>, DeviceError> {
        Ok(None)
    }

    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        Ok(Self::water_rates(self).to_vec())
    }

    fn powers(&mut self, water: &Water) -> Result<Powers, DeviceError> {
        Ok(Self::powers(self, water))
    }
}
