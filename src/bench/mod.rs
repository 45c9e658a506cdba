//! Benchmark of the solver on this machine: whole time steps of a block of water in a tank, phase by phase, and of a case.

pub mod block;
#[cfg(feature = "gpu")]
pub mod card;
pub mod coupled;
pub mod machine;
pub mod tank;

use std::time::{Duration, Instant};

use serde::Serialize;

use block::Block;
use machine::Machine;

/// Phases of a time step, in the order of computation.
pub const PHASES: [&str; 6] = ["sort", "list", "boundary densities", "rates", "predict", "correct"];

/// Number of arithmetic operations per pair of particles, for the distance and the terms of equations (1) to (5) in
/// `docs/methods.md`. A fused multiply-add counts as two operations. Operations for pairs outside the kernel support do
/// not count.
pub const FLOPS_PER_PAIR: f64 = 47.0;

/// Result of one measurement.
#[derive(Debug, Clone, Serialize)]
pub struct Measurement {
    /// Motion of the water: `"still"` or `"moving"`.
    pub water: &'static str,
    /// Number of threads; 0 on a graphics card.
    pub threads: usize,
    /// Number of water and boundary particles.
    pub particles: usize,
    /// Number of water particles.
    pub water_particles: usize,
    /// Mean number of neighbours of a water particle within the support of the kernel.
    pub neighbours_mean: f64,
    /// Share of the computed pairs (one per SIMD lane) that are within the kernel support [-]; NaN on a graphics card.
    pub useful_lanes: f64,
    /// Number of measured time steps.
    pub steps: u32,
    /// Number of particle evaluations per second, over whole time steps: two per particle and time step, for water and
    /// boundary. mDBC evaluates a boundary particle only once per time step, but this evaluation counts as two.
    pub full_evaluations_per_s: f64,
    /// Number of evaluations of water particles alone per second, over whole time steps.
    pub water_evaluations_per_s: f64,
    /// Number of particle pairs within the kernel support that the solver evaluates per second, over whole time steps.
    pub pairs_per_s: f64,
    /// Arithmetic operations per second for the pairs within the kernel support over whole time steps, divided by the
    /// measured peak speed with the same number of threads [-].
    pub share_of_peak: f64,
    /// The same ratio as `share_of_peak`, but for the time of the phase "rates" alone [-].
    pub share_of_peak_in_rates: f64,
    /// Lower bound of the memory traffic per second, divided by the measured bandwidth with the same number of threads
    /// [-].
    pub share_of_bandwidth: f64,
    /// Memory of the solver and of the particle state, per particle [bytes].
    pub bytes_per_particle: f64,
    /// Duration of each phase of a time step.
    pub phases: Vec<Phase>,
}

/// Duration of a phase.
#[derive(Debug, Clone, Serialize)]
pub struct Phase {
    /// Name of the phase.
    pub name: &'static str,
    /// Share of the duration of a time step [-].
    pub share: f64,
    /// Duration per particle (water and boundary) and time step [ns].
    pub ns_per_particle: f64,
}

/// Measures whole time steps of a block on `threads` threads for about `seconds`.
///
/// # Errors
/// If the threads cannot be started.
pub fn measure(
    block: &mut Block,
    threads: usize,
    seconds: f64,
    machine: &Machine,
) -> Result<Measurement, rayon::ThreadPoolBuildError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    Ok(pool.install(|| measure_here(block, threads, seconds, machine)))
}

fn measure_here(block: &mut Block, threads: usize, seconds: f64, machine: &Machine) -> Measurement {
    // Two time steps are not measured: the first allocates memory, the second fills the caches.
    let mut times = [Duration::ZERO; PHASES.len()];
    block.step(&mut times);
    block.step(&mut times);
    times = [Duration::ZERO; PHASES.len()];
    let (begin, mut steps) = (Instant::now(), 0);
    while steps < 3 || begin.elapsed().as_secs_f64() < seconds {
        block.step(&mut times);
        steps += 1;
    }
    let total: f64 = times.iter().map(Duration::as_secs_f64).sum();
    let (particles, water_particles) = (block.particles(), block.water_particles());
    let neighbours_mean = block.solver().mean_neighbours();
    let pairs = 2.0 * f64::from(steps) * neighbours_mean * water_particles as f64;
    let evaluations = 2.0 * f64::from(steps) * particles as f64;
    let rates = times[3].as_secs_f64();
    Measurement {
        water: block.motion,
        threads,
        particles,
        water_particles,
        neighbours_mean,
        useful_lanes: neighbours_mean / block.solver().lanes_per_target(),
        steps,
        full_evaluations_per_s: evaluations / total,
        water_evaluations_per_s: 2.0 * f64::from(steps) * water_particles as f64 / total,
        pairs_per_s: pairs / total,
        share_of_peak: FLOPS_PER_PAIR * pairs / total / machine.flops(threads),
        share_of_peak_in_rates: FLOPS_PER_PAIR * pairs / rates / machine.flops(threads),
        share_of_bandwidth: block.min_traffic() * f64::from(steps) / total / machine.bandwidth(threads),
        bytes_per_particle: (block.solver().bytes() + block.state_bytes()) as f64 / particles as f64,
        phases: phases_of(&times, steps, particles),
    }
}

/// Converts the total duration of each phase in `steps` time steps to its share of these time steps, and to its
/// duration per particle and time step.
fn phases_of(times: &[Duration; PHASES.len()], steps: u32, particles: usize) -> Vec<Phase> {
    let total: f64 = times.iter().map(Duration::as_secs_f64).sum();
    let phase = |(name, time): (&&'static str, &Duration)| Phase {
        name,
        share: time.as_secs_f64() / total,
        ns_per_particle: 1e9 * time.as_secs_f64() / (f64::from(steps) * particles as f64),
    };
    PHASES.iter().zip(times).map(phase).collect()
}
