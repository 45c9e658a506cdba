//! Buffers on a card, and the kernels (compiled shader functions) bound to these buffers.

use super::card::{Card, CardInfo};
use super::constants::{Constants, StepConstants};
use super::shaders::{Bound, MDBC, RATES, RECORDS, STEP, Shader};
use super::sort::Sort;
use super::state::CardState;
use crate::sph::solver::backend::DeviceError;

/// Size of a record [bytes].
const RECORD: usize = 48;

/// Memory per water particle on the card [bytes]: offset, bin, velocity, offset and velocity at the half step, rates,
/// record, sorting and bins. The value assumes that there are as many bins as particles.
const BYTES_PER_PARTICLE: usize = 6 * 16 + RECORD + 3 * 4 + 2 * 2 * 4;

/// Returns the largest number of particles that fits into the memory of a card.
pub fn max_particles(card: &CardInfo) -> u64 {
    let in_one_buffer = card.largest_binding.min(card.largest_buffer) / RECORD as u64;
    // Use at most 90 % of the memory; the rest is for the system.
    card.memory.map_or(in_one_buffer, |bytes| in_one_buffer.min(bytes / 10 * 9 / BYTES_PER_PARTICLE as u64))
}

/// Buffers on the card, and kernels bound to these buffers.
pub(super) struct Memory {
    pub is_periodic: bool,
    pub water: usize,
    pub boundary: usize,
    walls: usize,
    /// Total size of the buffers on the card [bytes].
    pub bytes: usize,
    pub parameters: wgpu::Buffer,
    pub step: wgpu::Buffer,
    pub offset: wgpu::Buffer,
    pub cell: wgpu::Buffer,
    pub motion: wgpu::Buffer,
    pub half_offset: wgpu::Buffer,
    half_motion: wgpu::Buffer,
    /// Rates of the water particles, then of the boundary particles in unsorted order.
    pub rates: wgpu::Buffer,
    pub limits: wgpu::Buffer,
    pub extremes: wgpu::Buffer,
    pub boundary_offset: wgpu::Buffer,
    pub boundary_cell: wgpu::Buffer,
    pub boundary_motion: wgpu::Buffer,
    pub boundary_density: wgpu::Buffer,
    pub to_surface: wgpu::Buffer,
    pub sort: Sort,
    pub boundary_sort: Sort,
    permute: Bound,
    pub water_records: Bound,
    pub half_records: Bound,
    pub boundary_records: Bound,
    pub densities: Bound,
    pub all_rates: Bound,
    /// Writes the rates of the water without viscosity and diffusion to the buffer `half_offset`.
    pub pressure_rates: Bound,
    pub predict: Bound,
    pub correct: Bound,
}

impl Memory {
    /// Creates the buffers for `water` water particles and `boundary` boundary particles. Of the boundary particles,
    /// the first `walls` are those of walls, bed and wavemaker.
    pub fn new(
        card: &Card,
        constants: &Constants,
        [water, boundary, walls]: [usize; 3],
        bins: usize,
    ) -> Result<Self, DeviceError> {
        let is_periodic = constants.is_periodic();
        let parameters = card.uniform("parameters", constants);
        let pressure_alone = card.uniform("parameters of pressure alone", &constants.of_pressure_alone());
        let step = card.uniform("step", &StepConstants { dt: 0.0, reach: 0.0 });
        // Create the largest buffer first: if the card allows this buffer, it also allows the smaller buffers.
        let records = card.buffer::<[f32; RECORD / 4]>("particle records", water + boundary)?;
        let offset = card.buffer::<[f32; 4]>("water positions", water)?;
        let cell = card.buffer::<[i32; 4]>("water bins", water)?;
        let motion = card.buffer::<[f32; 4]>("water velocities", water)?;
        let half_offset = card.buffer::<[f32; 4]>("water positions at the half step", water)?;
        let half_motion = card.buffer::<[f32; 4]>("water velocities at the half step", water)?;
        let rates = card.buffer::<[f32; 4]>("rates", water + boundary)?;
        let limits = card.buffer::<u32>("limits", 2)?;
        let unused_limits = card.buffer::<u32>("limits", 2)?;
        let extremes = card.buffer::<u32>("extremes", 5)?;
        let boundary_offset = card.buffer::<[f32; 4]>("boundary positions", boundary)?;
        let boundary_cell = card.buffer::<[i32; 4]>("boundary bins", boundary)?;
        let boundary_motion = card.buffer::<[f32; 4]>("boundary velocities", boundary)?;
        let boundary_density = card.buffer::<f32>("boundary densities", boundary)?;
        let to_surface = card.buffer::<[f32; 4]>("vectors to surfaces", boundary)?;
        let sort = Sort::new(card, &parameters, &cell, water, bins)?;
        let boundary_sort = Sort::new(card, &parameters, &boundary_cell, boundary, bins)?;

        let shader = Shader::new(card, RECORDS);
        let bind = |name, buffers: &[(u32, &wgpu::Buffer)]| shader.kernel(name).bind(card, buffers);
        // `permute` writes to the buffers of the rates and of the half step, which are not in use during sorting.
        let permute = bind(
            "permute",
            &[
                (0, &parameters),
                (1, &offset),
                (2, &cell),
                (3, &motion),
                (4, &sort.order),
                (6, &half_offset),
                (7, &rates),
                (8, &half_motion),
            ],
        );
        let bind_records =
            |offset, motion| bind("of_water", &[(0, &parameters), (1, offset), (2, &cell), (3, motion), (5, &records)]);
        let water_records = bind_records(&offset, &motion);
        let half_records = bind_records(&half_offset, &half_motion);
        let boundary_records = bind(
            "of_boundary",
            &[
                (0, &parameters),
                (1, &boundary_offset),
                (2, &boundary_cell),
                (3, &boundary_motion),
                (4, &boundary_sort.order),
                (5, &records),
                (9, &boundary_density),
            ],
        );
        let densities = Shader::new(card, MDBC).periodic(is_periodic).kernel("densities").bind(
            card,
            &[
                (0, &parameters),
                (1, &records),
                (2, &sort.start),
                (3, &boundary_sort.order),
                (4, &boundary_cell),
                (5, &to_surface),
                (6, &boundary_offset),
                (7, &boundary_density),
            ],
        );
        let rates_kernel = Shader::new(card, RATES).periodic(is_periodic).kernel("rates_of_all");
        let rates_into = |parameters, rates, limits| {
            let sources = [(2, &records), (3, &sort.start), (4, &boundary_sort.start), (5, &boundary_sort.order)];
            let own = [(0, parameters), (1, &step), (6, rates), (7, limits)];
            rates_kernel.bind(card, &[&own[..], &sources[..]].concat())
        };
        let all_rates = rates_into(&parameters, &rates, &limits);
        let pressure_rates = rates_into(&pressure_alone, &half_offset, &unused_limits);
        let shader = Shader::new(card, STEP).periodic(is_periodic);
        let state_of_step = [(0, &parameters), (1, &step), (2, &offset), (4, &motion), (5, &rates), (6, &half_offset)];
        let predict = shader.kernel("predict").bind(card, &[&state_of_step[..], &[(7, &half_motion)]].concat());
        let correct =
            shader.kernel("correct").bind(card, &[&state_of_step[..], &[(3, &cell), (8, &extremes)]].concat());
        card.check()?;

        // A water particle has offset, bin, velocity, offset and velocity at the half step, rates and record. A
        // boundary particle has no half-step data, but a vector to the surface and a density.
        let of_water = water * (6 * 16 + RECORD) + Sort::bytes(water, bins);
        let of_boundary = boundary * (5 * 16 + 4 + RECORD) + Sort::bytes(boundary, bins);
        Ok(Self {
            is_periodic,
            water,
            boundary,
            walls,
            bytes: of_water + of_boundary,
            parameters,
            step,
            offset,
            cell,
            motion,
            half_offset,
            half_motion,
            rates,
            limits,
            extremes,
            boundary_offset,
            boundary_cell,
            boundary_motion,
            boundary_density,
            to_surface,
            sort,
            boundary_sort,
            permute,
            water_records,
            half_records,
            boundary_records,
            densities,
            all_rates,
            pressure_rates,
            predict,
            correct,
        })
    }

    /// Returns true if the buffers were created for these numbers of particles.
    pub fn holds(&self, particles: [usize; 3]) -> bool {
        [self.water, self.boundary, self.walls] == particles
    }

    /// Writes the state of water and boundary, and the boundary's rho - rho0 [kg/m3].
    pub fn fill(
        &self,
        card: &Card,
        state: &CardState,
        (of_boundary, surfaces): &(CardState, Vec<[f32; 4]>),
        excess_density: &[f32],
    ) {
        card.write(&self.offset, 0, &state.offset);
        card.write(&self.cell, 0, &state.cell);
        card.write(&self.motion, 0, &state.motion);
        card.write(&self.boundary_offset, 0, &of_boundary.offset);
        card.write(&self.boundary_cell, 0, &of_boundary.cell);
        card.write(&self.boundary_motion, 0, &of_boundary.motion);
        card.write(&self.boundary_density, 0, excess_density);
        card.write(&self.to_surface, 0, surfaces);
    }

    /// Returns the minimum memory traffic of a time step [bytes].
    pub fn min_traffic(&self) -> f64 {
        // 24 vectors of four numbers are read or written per water particle: twelve to sort and copy back, five in the
        // predictor, seven in the corrector. Records and rates are written and read twice.
        let of_water = self.water * (24 * 16 + 2 * 2 * RECORD + 4 * 16);
        let of_boundary = self.boundary * (2 * 2 * RECORD + 6 * 16);
        (of_water + of_boundary) as f64
    }

    /// Sorts the water's arrays into the order of the bins.
    pub fn permute(&self, encoder: &mut wgpu::CommandEncoder) {
        self.permute.run(encoder, super::card::groups(self.water, 64));
        let size = (self.water * 16) as u64;
        let pairs = [(&self.half_offset, &self.offset), (&self.rates, &self.cell), (&self.half_motion, &self.motion)];
        for (sorted, own) in pairs {
            if size > 0 {
                encoder.copy_buffer_to_buffer(sorted, 0, own, 0, size);
            }
        }
    }
}
