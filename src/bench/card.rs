//! The benchmark on a graphics card: speed of the solver, compared with the measured peak speeds of the card.

use std::time::{Duration, Instant};

use super::{FLOPS_PER_PAIR, Measurement, PHASES, block::Block, phases_of};
use crate::sph::{
    gpu::{
        card::{Card, groups},
        shaders::Shader,
        solver::GpuSolver,
    },
    solver::backend::{Backend, DeviceError, DeviceMemory},
};

/// Source of the shader that measures the peak arithmetic speed and the memory bandwidth.
pub const PEAKS: &str = include_str!("card.wgsl");

/// Arithmetic operations per thread of the shader function `multiply_and_add`.
const OPERATIONS: f64 = 2.0 * 16.0 * 1024.0;

/// Base number of threads of the tests; arrays of this length have 16 MiB. The tests use 4 times this number of threads
/// on a card, and 1/64 of this number on a software renderer.
const THREADS: usize = 1 << 20;

/// Measured peak arithmetic speed and memory bandwidth of a graphics card.
#[derive(Debug, Clone, Copy)]
pub struct Peaks {
    /// Number of single-precision operations per second; a fused multiply-add counts as two operations.
    pub flops: f64,
    /// Memory traffic [bytes/s].
    pub bandwidth: f64,
}

impl Peaks {
    /// Measures the peaks of a card.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn measure(card: &Card) -> Result<Self, DeviceError> {
        let threads = if card.info().is_software { THREADS / 64 } else { 4 * THREADS };
        let numbers = vec![[0.999_f32, 0.001, 0.5, 0.25]; threads];
        let [a, b, c] = ["a", "b", "c"].map(|label| card.filled(label, &numbers));
        let (a, b, c) = (a?, b?, c?);
        let shader = Shader::new(card, PEAKS);
        let buffers = [(0, &a), (1, &b), (2, &c)];
        let best = |name, repeats: u32| {
            let kernel = shader.kernel(name).bind(card, &buffers);
            let mut shortest = f64::INFINITY;
            for _ in 0..5 {
                let begin = Instant::now();
                let mut encoder = card.encoder();
                (0..repeats).for_each(|_| kernel.run(&mut encoder, groups(threads, 64)));
                card.submit(encoder);
                card.wait()?;
                shortest = shortest.min(begin.elapsed().as_secs_f64() / f64::from(repeats));
            }
            Ok::<_, DeviceError>(shortest)
        };
        let flops = OPERATIONS * threads as f64 / best("multiply_and_add", 1)?;
        let bandwidth = 48.0 * threads as f64 / best("triad", 20)?;
        Ok(Self { flops, bandwidth })
    }
}

/// Measures whole time steps of a block on a card for about `seconds`.
///
/// # Errors
/// If the card has too little memory or is lost.
pub fn measure_on_card(block: &mut Block, card: &Card, seconds: f64, peaks: Peaks) -> Result<Measurement, DeviceError> {
    // Compute one time step on the processor, to count the neighbours.
    block.step(&mut [Duration::ZERO; PHASES.len()]);
    let neighbours_mean = block.solver().mean_neighbours();
    let (parameters, grid) = (block.parameters_of_cards(), &block.solver().grid);
    let high = grid.low + grid.size * glam::DVec3::from_array(grid.count.map(|n| n as f64));
    let mut solver = GpuSolver::new(card.clone(), parameters, [grid.low, high], [grid.low, high])?;
    let (particles, water_particles, motion) = (block.particles(), block.water_particles(), block.motion);
    let (water, boundary) = block.state();
    solver.load(water, boundary)?;

    let mut step = |times: &mut [Duration; PHASES.len()]| {
        let mut begin = Instant::now();
        let mut end_phase = |solver: &mut GpuSolver, phase: usize| {
            solver.finish()?;
            let now = Instant::now();
            times[phase] += now - begin;
            begin = now;
            Ok::<_, DeviceError>(())
        };
        solver.sort(water, boundary);
        end_phase(&mut solver, 0)?;
        solver.build_neighbour_lists(water, boundary);
        end_phase(&mut solver, 1)?;
        solver.boundary_densities(boundary);
        end_phase(&mut solver, 2)?;
        solver.rates();
        end_phase(&mut solver, 3)?;
        let dt = solver.limits()?.time_step(&parameters);
        solver.predict(dt, water, boundary, &mut |_| ());
        end_phase(&mut solver, 4)?;
        solver.rates();
        end_phase(&mut solver, 3)?;
        solver.correct(dt, water, boundary);
        end_phase(&mut solver, 5)
    };
    // In the first time step the card still compiles shaders, so this time step is not measured.
    let mut times = [Duration::ZERO; PHASES.len()];
    step(&mut times)?;
    times = [Duration::ZERO; PHASES.len()];
    let (begin, mut steps) = (Instant::now(), 0_u32);
    while steps < 3 || begin.elapsed().as_secs_f64() < seconds {
        step(&mut times)?;
        steps += 1;
    }
    let total: f64 = times.iter().map(Duration::as_secs_f64).sum();
    let pairs = 2.0 * f64::from(steps) * neighbours_mean * water_particles as f64;
    Ok(Measurement {
        water: motion,
        threads: 0,
        particles,
        water_particles,
        neighbours_mean,
        useful_lanes: f64::NAN,
        steps,
        full_evaluations_per_s: 2.0 * f64::from(steps) * particles as f64 / total,
        water_evaluations_per_s: 2.0 * f64::from(steps) * water_particles as f64 / total,
        pairs_per_s: pairs / total,
        share_of_peak: FLOPS_PER_PAIR * pairs / total / peaks.flops,
        share_of_peak_in_rates: FLOPS_PER_PAIR * pairs / times[3].as_secs_f64() / peaks.flops,
        share_of_bandwidth: solver.min_traffic() * f64::from(steps) / total / peaks.bandwidth,
        bytes_per_particle: solver.bytes() as f64 / particles as f64,
        phases: phases_of(&times, steps, particles),
    })
}
