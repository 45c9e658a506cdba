//! Time steps of a whole case: water, units, contact, surfaces and ends, compared with the water alone.

use std::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::case::Case;
use crate::simulation::flume::Simulation;

/// Result of one measurement.
#[derive(Debug, Clone, Serialize)]
pub struct CoupledMeasurement {
    /// Number of threads.
    pub threads: usize,
    /// Number of water and boundary particles.
    pub particles: usize,
    /// Number of water particles.
    pub water_particles: usize,
    /// Number of units.
    pub units: usize,
    /// Number of measured time steps.
    pub steps: u32,
    /// Number of particle evaluations per second: two per particle and time step.
    pub full_evaluations_per_s: f64,
    /// The same for time steps of the water alone, with the same particles.
    pub water_alone_per_s: f64,
}

/// Measures time steps of a case from its start, on `threads` threads for about `seconds`.
///
/// # Errors
/// If the threads cannot be started, the case cannot be set up, or the water becomes unstable.
pub fn measure(
    case: Arc<Case>,
    threads: usize,
    seconds: f64,
) -> Result<CoupledMeasurement, Box<dyn Error + Send + Sync>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    pool.install(|| {
        let mut simulation = Simulation::new(case)?;
        // Two time steps are not measured: the first allocates memory, the second fills the caches.
        simulation.step()?;
        simulation.step()?;
        let [mut coupled, mut alone] = [Duration::ZERO; 2];
        let mut steps = 0;
        // Both kinds of time step alternate, so that other programs slow both down.
        while steps < 3 || (coupled + alone).as_secs_f64() < seconds {
            let begin = Instant::now();
            simulation.step_water_alone()?;
            alone += begin.elapsed();
            let begin = Instant::now();
            simulation.step()?;
            coupled += begin.elapsed();
            steps += 1;
        }
        let particles = simulation.water.len() + simulation.boundary.len();
        let evaluations = 2.0 * f64::from(steps) * particles as f64;
        Ok(CoupledMeasurement {
            threads,
            particles,
            water_particles: simulation.water.len(),
            units: simulation.units.as_ref().map_or(0, |units| units.states().len()),
            steps,
            full_evaluations_per_s: evaluations / coupled.as_secs_f64(),
            water_alone_per_s: evaluations / alone.as_secs_f64(),
        })
    })
}
