//! The operations of a time step on a card.
//!
//! Operations append commands to a list, which the card executes when the host reads a result. After the first
//! evaluation of the rates, the host reads the limits of the time step. After the corrector, the host reads the rates
//! of the units and the water near surfaces.

use glam::DVec3;

use super::card::{Card, groups};
use super::constants::{Constants, StepConstants};
use super::memory::Memory;
use super::near::NearSearch;
use super::state::CardState;
use crate::mechanics::Load;
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::pairs::rate::Rate;
use crate::sph::parameters::Parameters;
use crate::sph::particles::boundary::Boundary;
use crate::sph::particles::water::Water;
use crate::sph::solver::backend::{
    Backend, DeviceError, DeviceMemory, NearWater, Surfaces, WaterExtremes, unsupported_on_gpu,
};
use crate::sph::solver::power::Powers;
use crate::sph::solver::time_step::Limits;

/// Initial values of the buffer `extremes`; see `step.wgsl`.
const INITIAL_EXTREMES: [u32; 5] = [0, u32::MAX, 0, 0, 0];

/// Factor that increases the search radius for neighbours, because of rounding errors [-].
const ROUNDING: f64 = 1.001;

/// The solver on a card.
pub struct GpuSolver {
    card: Card,
    parameters: Parameters,
    grid: Grid,
    /// Low and high corner of the box in which all particles must stay [m].
    bounds: [DVec3; 2],
    loaded: Option<Loaded>,
    /// Bins of the sorted water; only `start` is set, by the last fetch.
    bins: Bins,
    /// Stands for the bins of the boundary, which stay on the card.
    no_bins: Bins,
    /// Commands that are not submitted yet.
    encoder: Option<wgpu::CommandEncoder>,
    /// Error of an operation that has no return value; the next operation with a result returns this error.
    failure: Option<DeviceError>,
}

/// Buffers and state on the card, created when the numbers of particles are known.
struct Loaded {
    memory: Memory,
    near: NearSearch,
    /// Largest speed of water and of boundary at the start of the time step [m/s].
    largest_speeds: [f64; 2],
    /// Extreme values of the water, as last read from the card.
    extremes: WaterExtremes,
    /// True if the water is already sorted for the next time step, see [`DeviceMemory::sort_ahead`].
    is_sorted: bool,
}

impl Loaded {
    /// Sorts the water into the order of the bins, unless it is sorted already.
    fn sort_water(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if !std::mem::replace(&mut self.is_sorted, true) {
            self.memory.sort.run(encoder);
            self.memory.permute(encoder);
        }
    }
}

impl GpuSolver {
    /// Creates a solver with bins in the box from `low` to `high` [m]. All particles must stay in the box `bounds` [m].
    ///
    /// # Errors
    /// If graphics cards do not support the numerical scheme in `parameters`.
    pub fn new(
        card: Card,
        parameters: Parameters,
        [low, high]: [DVec3; 2],
        bounds: [DVec3; 2],
    ) -> Result<Self, DeviceError> {
        if let Some(what) = unsupported_on_gpu(&parameters) {
            return Err(DeviceError::Scheme(what));
        }
        let grid = Grid::new(low, high, parameters.dp, parameters.periodic_width);
        Ok(Self {
            card,
            parameters,
            grid,
            bounds,
            loaded: None,
            bins: Bins::default(),
            no_bins: Bins::default(),
            encoder: None,
            failure: None,
        })
    }

    /// Submits all commands and waits until the card has finished, for time measurements.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn finish(&mut self) -> Result<(), DeviceError> {
        let encoder = self.take_encoder();
        self.card.submit(encoder);
        self.card.wait()
    }

    /// Returns the minimum memory traffic of a time step [bytes]. The card must sort, predict and correct the state of
    /// the water, and twice write and read the records and the rates.
    pub fn min_traffic(&self) -> f64 {
        self.loaded.as_ref().map_or(0.0, |loaded| loaded.memory.min_traffic())
    }

    /// Returns the memory in use on the card [bytes].
    pub fn bytes(&self) -> usize {
        self.loaded.as_ref().map_or(0, |loaded| loaded.memory.bytes)
    }

    fn take_encoder(&mut self) -> wgpu::CommandEncoder {
        self.encoder.take().unwrap_or_else(|| self.card.encoder())
    }

    fn loaded(&mut self) -> Result<&mut Loaded, DeviceError> {
        if let Some(failure) = self.failure.clone() {
            return Err(failure);
        }
        self.loaded.as_mut().ok_or_else(|| DeviceError::Missing("no water has been loaded onto the card".to_owned()))
    }

    /// Appends the commands of an operation to the list.
    fn enqueue(&mut self, commands: impl FnOnce(&Card, &mut Loaded, &mut wgpu::CommandEncoder)) {
        let mut encoder = self.take_encoder();
        if let Some(loaded) = &mut self.loaded {
            commands(&self.card, loaded, &mut encoder);
        }
        self.encoder = Some(encoder);
    }

    /// Copies the state of wavemaker and units, which the host moves, to the card.
    fn upload_moving(&mut self, boundary: &Boundary) {
        let moving = boundary.pistons().start..boundary.len();
        let first = moving.start;
        let (state, surfaces) = CardState::of_boundary(&self.grid, self.parameters.tait.rho0, boundary, moving);
        let Some(loaded) = &mut self.loaded else { return };
        let memory = &loaded.memory;
        self.card.write(&memory.boundary_offset, first, &state.offset);
        self.card.write(&memory.boundary_cell, first, &state.cell);
        self.card.write(&memory.boundary_motion, first, &state.motion);
        self.card.write(&memory.to_surface, first, &surfaces);
        let covered = boundary.ever_covered();
        if !covered.is_empty() {
            self.card.write(&memory.to_surface, covered.start, &CardState::surfaces_of(boundary, covered.clone()));
        }
        loaded.largest_speeds[1] = largest(&boundary.velocity[first..]);
    }
}

impl Backend for GpuSolver {
    fn name(&self) -> &str {
        self.card.name()
    }

    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn water_bins(&self) -> &Bins {
        &self.bins
    }

    fn boundary_bins(&self) -> [&Bins; 2] {
        [&self.no_bins; 2]
    }

    fn device_memory(&mut self) -> Option<&mut dyn DeviceMemory> {
        Some(self)
    }

    fn sort(&mut self, _: &mut Water, boundary: &Boundary) {
        self.upload_moving(boundary);
        let reach = self.parameters.kernel.support() as f32;
        self.enqueue(|card, loaded, encoder| {
            loaded.sort_water(encoder);
            let memory = &loaded.memory;
            card.write(&memory.step, 0, &[StepConstants { dt: 0.0, reach }]);
            memory.boundary_sort.run(encoder);
            memory.water_records.run(encoder, groups(memory.water, 64));
        });
    }

    /// Does nothing: on the card, each particle searches the bins around it for its neighbours.
    fn build_neighbour_lists(&mut self, _: &Water, _: &Boundary) {}

    fn boundary_densities(&mut self, _: &mut Boundary) {
        self.enqueue(|_, Loaded { memory, .. }, encoder| {
            memory.densities.run(encoder, groups(memory.boundary, 64));
            memory.boundary_records.run(encoder, groups(memory.boundary, 64));
        });
    }

    fn rates(&mut self) {
        self.enqueue(|_, Loaded { memory, .. }, encoder| {
            encoder.clear_buffer(&memory.limits, 0, None);
            memory.all_rates.run(encoder, groups(memory.water + memory.boundary, 64));
        });
    }

    fn limits(&mut self) -> Result<Limits, DeviceError> {
        let encoder = self.take_encoder();
        let limits = self.loaded()?.memory.limits.clone();
        let values: Vec<f32> = self.card.read(encoder, &limits, 0, 2)?;
        Ok(Limits { acceleration: f64::from(values[0]), signal_speed: f64::from(values[1]) })
    }

    fn predict(&mut self, dt: f64, _: &Water, boundary: &mut Boundary, move_boundary: &mut dyn FnMut(&mut Boundary)) {
        move_boundary(boundary);
        self.upload_moving(boundary);
        let (support, h) = (self.parameters.kernel.support(), self.parameters.kernel.h);
        self.enqueue(|card, Loaded { memory, largest_speeds, .. }, encoder| {
            // Where a moving surface deflects water, the water speed can increase by the speed of the surface.
            let speed = largest_speeds[0] + largest_speeds[1];
            let moved = (0.5 * dt * speed).min(h);
            let reach = (support + moved) * ROUNDING;
            card.write(&memory.step, 0, &[StepConstants { dt: dt as f32, reach: reach as f32 }]);
            card.write(&memory.extremes, 0, &INITIAL_EXTREMES);
            memory.predict.run(encoder, groups(memory.water, 64));
            memory.half_records.run(encoder, groups(memory.water, 64));
            memory.boundary_records.run(encoder, groups(memory.boundary, 64));
        });
    }

    fn correct(&mut self, _: f64, _: &mut Water, _: &mut Boundary) {
        self.enqueue(|_, Loaded { memory, is_sorted, .. }, encoder| {
            *is_sorted = false;
            memory.correct.run(encoder, groups(memory.water, 64));
        });
    }

    fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Result<Vec<Load>, DeviceError> {
        let encoder = self.take_encoder();
        let first_unit = boundary.walls().end;
        let memory = &self.loaded()?.memory;
        let (rates, first) = (memory.rates.clone(), memory.water + first_unit);
        let rates: Vec<[f32; 4]> = self.card.read(encoder, &rates, first, boundary.len() - first_unit)?;
        let rho0 = self.parameters.tait.rho0;
        Ok(boundary.unit_loads(centres, |i| {
            let [x, y, z, _] = rates[i - first_unit].map(f64::from);
            rho0 * boundary.volume[i] * DVec3::new(x, y, z)
        }))
    }

    fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        let encoder = self.take_encoder();
        let loaded = self.loaded()?;
        let (rates, count) = (loaded.memory.rates.clone(), loaded.memory.water);
        Ok(rates_of(&self.card.read(encoder, &rates, 0, count)?))
    }

    fn host_rates(&self) -> &[Rate] {
        &[]
    }

    fn host_rates_mut(&mut self) -> &mut [Rate] {
        &mut []
    }

    fn powers(&mut self, water: &Water) -> Result<Powers, DeviceError> {
        let all = self.water_rates()?;
        self.enqueue(|_, Loaded { memory, .. }, encoder| memory.pressure_rates.run(encoder, groups(memory.water, 64)));
        let encoder = self.take_encoder();
        let memory = &self.loaded()?.memory;
        // `pressure_rates` writes to the buffer `half_offset`, which is not in use at this time.
        let (rates, count) = (memory.half_offset.clone(), memory.water);
        let pressure_only = rates_of(&self.card.read(encoder, &rates, 0, count)?);
        Ok(Powers::of(water, &self.parameters, &all, &pressure_only))
    }
}

impl DeviceMemory for GpuSolver {
    fn load(&mut self, water: &Water, boundary: &Boundary) -> Result<(), DeviceError> {
        let particles = [water.len(), boundary.len(), boundary.walls().end];
        let constants = Constants::new(&self.parameters, &self.grid, self.bounds, [water.len(), boundary.len()]);
        let rho0 = self.parameters.tait.rho0;
        let state = CardState::of_water(&self.grid, rho0, water);
        let of_boundary = CardState::of_boundary(&self.grid, rho0, boundary, 0..boundary.len());
        let excess: Vec<f32> = boundary.density.iter().map(|density| (density - rho0) as f32).collect();
        let loaded = match self.loaded.take() {
            Some(loaded) if loaded.memory.holds(particles) => loaded,
            _ => {
                let memory = Memory::new(&self.card, &constants, particles, self.grid.bins())?;
                let extremes = WaterExtremes {
                    largest_speed: 0.0,
                    lowest_density: rho0,
                    highest_density: rho0,
                    is_unstable: false,
                };
                let near = NearSearch::new(&self.card, &memory)?;
                Loaded { near, memory, largest_speeds: [0.0; 2], extremes, is_sorted: false }
            }
        };
        let loaded = self.loaded.insert(loaded);
        loaded.memory.fill(&self.card, &state, &of_boundary, &excess);
        loaded.largest_speeds = [largest(&water.velocity), largest(&boundary.velocity)];
        loaded.is_sorted = false;
        self.encoder = None;
        self.failure = None;
        self.card.check()
    }

    fn fetch(&mut self, water: &mut Water, boundary: &mut Boundary) -> Result<(), DeviceError> {
        let encoder = self.take_encoder();
        let bins = self.grid.bins() + 1;
        let Loaded { memory, .. } = self.loaded()?;
        let count = memory.water;
        let [offset, cell, motion, start] =
            [&memory.offset, &memory.cell, &memory.motion, &memory.sort.start].map(Clone::clone);
        let card = &self.card;
        let offset = card.read(encoder, &offset, 0, count)?;
        let cell = card.read(card.encoder(), &cell, 0, count)?;
        let motion = card.read(card.encoder(), &motion, 0, count)?;
        let rho0 = self.parameters.tait.rho0;
        CardState { offset, cell, motion }.write_to(&self.grid, rho0, water);
        self.bins.start = card.read(card.encoder(), &start, 0, bins)?;
        self.fetch_boundary_densities(boundary)
    }

    fn fetch_boundary_densities(&mut self, boundary: &mut Boundary) -> Result<(), DeviceError> {
        let encoder = self.take_encoder();
        let density = self.loaded()?.memory.boundary_density.clone();
        let excess: Vec<f32> = self.card.read(encoder, &density, 0, boundary.len())?;
        let rho0 = self.parameters.tait.rho0;
        boundary.density.iter_mut().zip(excess).for_each(|(density, excess)| *density = rho0 + f64::from(excess));
        Ok(())
    }

    fn fetch_near_water(&mut self, surfaces: &Surfaces) -> Result<NearWater, DeviceError> {
        let encoder = self.take_encoder();
        self.loaded()?;
        let rho0 = self.parameters.tait.rho0;
        let (card, grid, dp) = (&self.card, &self.grid, self.parameters.dp);
        let Some(Loaded { memory, near, largest_speeds, extremes, .. }) = &mut self.loaded else {
            return Ok(NearWater::default());
        };
        let (encoded, found) = near.find(card, memory, grid, dp, surfaces, encoder)?;
        *extremes = decode_extremes(encoded, rho0);
        largest_speeds[0] = extremes.largest_speed;
        let mut water = Water::default();
        found.write_to(grid, rho0, &mut water);
        Ok(NearWater { indices: water.id.clone(), water })
    }

    fn write_near_velocities(&mut self, near: &NearWater) {
        let Some(Loaded { near: search, .. }) = &mut self.loaded else { return };
        let mut encoder = self.encoder.take().unwrap_or_else(|| self.card.encoder());
        if let Err(failure) = search.put(&self.card, near, &mut encoder) {
            self.failure = Some(failure);
        }
        self.encoder = Some(encoder);
    }

    fn sort_ahead(&mut self) {
        self.enqueue(|_, loaded, encoder| loaded.sort_water(encoder));
        let encoder = self.take_encoder();
        self.card.submit(encoder);
    }

    fn water_extremes(&mut self) -> Result<WaterExtremes, DeviceError> {
        Ok(self.loaded()?.extremes)
    }
}

fn rates_of(values: &[[f32; 4]]) -> Vec<Rate> {
    let rate = |&[x, y, z, density]: &[f32; 4]| Rate { acceleration: [x, y, z], density, ..Rate::default() };
    values.iter().map(rate).collect()
}

/// Returns the length of the longest vector; NaN if any vector contains NaN.
fn largest(vectors: &[DVec3]) -> f64 {
    vectors.iter().map(|v| v.length_squared()).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a }).sqrt()
}

/// Converts the values of the buffer `extremes`; see `step.wgsl`.
fn decode_extremes([speed, lowest, highest, unstable, _]: [u32; 5], rho0: f64) -> WaterExtremes {
    let decode_density = |ordered: u32| {
        let bits = if ordered & 0x8000_0000 == 0 { !ordered } else { ordered & 0x7fff_ffff };
        rho0 + f64::from(f32::from_bits(bits))
    };
    WaterExtremes {
        largest_speed: f64::from(f32::from_bits(speed)),
        lowest_density: decode_density(lowest),
        highest_density: decode_density(highest),
        is_unstable: unstable != 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_of_the_shader_are_decoded() {
        // Same encoding as in the function `ordered` of `step.wgsl`.
        let ordered = |value: f32| {
            let bits = value.to_bits();
            if bits & 0x8000_0000 == 0 { bits | 0x8000_0000 } else { !bits }
        };
        assert!(ordered(-2.0) < ordered(-1.0) && ordered(-1.0) < ordered(0.0) && ordered(0.0) < ordered(0.5));
        let extremes = decode_extremes([1.5_f32.to_bits(), ordered(-3.0), ordered(4.25), 0, 9], 1000.0);
        assert_eq!(
            extremes,
            WaterExtremes { largest_speed: 1.5, lowest_density: 997.0, highest_density: 1004.25, is_unstable: false }
        );
    }
}
