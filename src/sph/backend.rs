//! What a device does in a step: the verbs of [`Solver`], for the processor and for a graphics card.
//!
//! The processor keeps the water in the arrays that it is given. A card keeps its own and hands them out on
//! [`Backend::fetch`]; what it is told is computed when something is to be read back.

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

/// Name of the processor as a device.
pub const PROCESSOR: &str = "CPU";

/// A device that cannot be used, or no longer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DeviceError {
    /// There is none of that kind.
    #[error("{0}")]
    Missing(String),
    /// It lacks memory.
    #[error("{device} has not enough memory: {what}; raise domain.dp_m, or run with --device cpu")]
    Memory {
        /// Its name.
        device: String,
        /// What was asked for.
        what: String,
    },
    /// It does not know the scheme of the case.
    #[error("the GPU does not compute {0}; run with --device cpu")]
    Scheme(&'static str),
    /// It failed while it computed.
    #[error(
        "{device} was lost: {what}; the last checkpoint is not touched: go on from it with breakwater resume, on this or another device"
    )]
    Lost {
        /// Its name.
        device: String,
        /// What the driver says.
        what: String,
    },
}

/// The fastest, the lightest and the densest water [m/s, kg/m3], and whether a particle is outside the domain or not a
/// number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watched {
    /// Largest speed [m/s].
    pub fastest: f64,
    /// Lowest density [kg/m3].
    pub lightest: f64,
    /// Highest density [kg/m3].
    pub densest: f64,
    /// Whether a particle has left the domain or is not a number.
    pub astray: bool,
}

/// Surfaces that water does not go through, as [`crate::simulation::flume`] has them at the end of a step. Lengths [m].
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// Distance at which the approach of a particle ends.
    pub nearest: f64,
    /// Pieces of the outline of bed and walls, x and z of both ends.
    pub outline: Vec<[f64; 4]>,
    /// Obstacles: low and high corner.
    pub boxes: Vec<[DVec3; 2]>,
    /// Balls that hold the parts of the units: centre and radius.
    pub balls: Vec<(DVec3, f64)>,
    /// Place of the wavemaker at rest, height of its lowest row, and the displacement of each.
    pub wavemaker: Option<(f64, f64, Vec<f64>)>,
    /// Width between side walls, which begin at y = 0.
    pub sides: Option<f64>,
}

/// The particles near to surfaces, taken out of the water: their places among all, and they themselves.
#[derive(Debug, Clone, Default)]
pub struct NearWater {
    /// Place of each in the arrays of the device, ascending.
    pub places: Vec<u32>,
    /// Their state.
    pub water: Water,
}

/// The verbs of a step.
pub trait Backend: Send {
    /// Name of the device.
    fn name(&self) -> &str;

    /// Constants of the scheme.
    fn parameters(&self) -> &Parameters;

    /// Bins.
    fn grid(&self) -> &Grid;

    /// Where the bins of the water begin, as last sorted and fetched.
    fn water_bins(&self) -> &Bins;

    /// Whether the water lies with the device and not in the arrays of the host.
    fn keeps_water(&self) -> bool;

    /// Take over water and boundary: at the start and after a checkpoint has been read or written.
    ///
    /// # Errors
    /// If the device has not enough memory.
    fn load(&mut self, water: &Water, boundary: &Boundary) -> Result<(), DeviceError>;

    /// Bring water, its bins and the boundary's densities up to date in the arrays of the host.
    ///
    /// # Errors
    /// If the device is lost.
    fn fetch(&mut self, water: &mut Water, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Bring the boundary's densities alone up to date.
    ///
    /// # Errors
    /// If the device is lost.
    fn fetch_boundary_densities(&mut self, boundary: &mut Boundary) -> Result<(), DeviceError>;

    /// Sort the particles into bins, the water's arrays with them.
    fn sort(&mut self, water: &mut Water, boundary: &Boundary);

    /// Find the neighbours of every target for this step.
    fn list(&mut self, water: &Water, boundary: &Boundary);

    /// Density of the boundary particles from their ghost nodes.
    fn boundary_densities(&mut self, boundary: &mut Boundary);

    /// Rates of water and units.
    fn rates(&mut self);

    /// Largest acceleration and signal speed of the water.
    ///
    /// # Errors
    /// If the device is lost.
    fn limits(&mut self) -> Result<Limits, DeviceError>;

    /// Equations 8.1, 8.2 and 9.1; `move_boundary` puts the boundary where it is half a step on.
    fn predict(
        &mut self,
        dt: f64,
        water: &Water,
        boundary: &mut Boundary,
        move_boundary: &mut dyn FnMut(&mut Boundary),
    );

    /// Equations 8.3, 8.4 and 9.2: the state at the end of the step.
    fn correct(&mut self, dt: f64, water: &mut Water, boundary: &mut Boundary);

    /// Force [N] of the water on each unit and its torque [N m] about the unit's centre [m].
    ///
    /// # Errors
    /// If the device is lost.
    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<(DVec3, DVec3)>, DeviceError>;

    /// The water near to surfaces, to be kept out of them, of a device that keeps the water.
    ///
    /// # Errors
    /// If the device is lost.
    fn take_near(&mut self, surfaces: &Surfaces) -> Result<NearWater, DeviceError>;

    /// Give back the velocities of the water near to surfaces.
    fn put_near(&mut self, near: &NearWater);

    /// Begin to sort the water, whose places at the end of the step are known, while the host moves the units.
    fn sort_ahead(&mut self);

    /// Look over the water at the end of a step; `None` if it lies in the arrays of the host.
    ///
    /// # Errors
    /// If the device is lost.
    fn watch(&mut self) -> Result<Option<Watched>, DeviceError>;

    /// Rates of the water found last, in its order, until [`Self::sort_ahead`]; those of cards lack the speed of approach.
    ///
    /// # Errors
    /// If the device is lost.
    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError>;

    /// Who gives energy to the water and who takes it, at the state whose rates were found last and which has been
    /// fetched.
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
