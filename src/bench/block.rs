//! The block of water whose time steps the benchmark measures.

use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};

use super::{PHASES, tank::Tank};
#[cfg(feature = "gpu")]
use crate::sph::particles::{boundary::Boundary, water::Water};
use crate::sph::{lanes::InstructionSet, parameters::Parameters, solver::step::Solver, terms::wall_slip::WallSlip};

const GRAVITY: f64 = 9.81;

/// Particle spacing [m]; it does not affect the measured speed.
const DP: f64 = 0.01;

/// A cube of water on a bed between two end walls, periodic in y.
pub struct Block {
    tank: Tank,
    /// Motion of the water: "still" or "moving".
    pub motion: &'static str,
}

impl Block {
    /// Creates a block with about `particles` water particles. If `moving` is true, the water circulates.
    /// `support_per_dp` is the radius 2h of the kernel support, divided by the particle spacing [-].
    pub fn new(instructions: InstructionSet, particles: usize, support_per_dp: f64, moving: bool) -> Self {
        let side = (particles as f64).cbrt().round().max(8.0) * DP;
        let h = 0.5 * support_per_dp * DP;
        let mut parameters = Parameters::published(DP, h, 15.0 * (GRAVITY * side).sqrt(), GRAVITY, Some(side));
        // Use free slip, the default of case files.
        parameters.slip = WallSlip::FreeSlip;
        // Velocity of one eddy that fills the block: the water falls along one wall and rises along the other.
        let speed = if moving { 0.3 * (GRAVITY * side).sqrt() } else { 0.0 };
        let wave = std::f64::consts::PI / side;
        let slosh = |x: f64, z: f64| {
            speed * DVec2::new((wave * x).sin() * (wave * z).cos(), -(wave * x).cos() * (wave * z).sin())
        };
        Self {
            tank: Tank::new(instructions, parameters, [side; 3], &|_| side, &slosh, &[]),
            motion: if moving { "moving" } else { "still" },
        }
    }

    /// Returns the SPH parameters for a graphics card, whose solver supports only the original wall slip.
    #[cfg(feature = "gpu")]
    pub(super) fn parameters_of_cards(&self) -> Parameters {
        Parameters { slip: WallSlip::Original, ..self.tank.solver.parameters }
    }

    /// Returns the water particles and the boundary particles.
    #[cfg(feature = "gpu")]
    pub(super) fn state(&mut self) -> (&mut Water, &mut Boundary) {
        (&mut self.tank.water, &mut self.tank.boundary)
    }

    /// Returns the number of water particles.
    pub fn water_particles(&self) -> usize {
        self.tank.water.len()
    }

    /// Returns the solver.
    pub fn solver(&self) -> &Solver {
        &self.tank.solver
    }

    /// Returns the number of water and boundary particles.
    pub fn particles(&self) -> usize {
        self.tank.water.len() + self.tank.boundary.len()
    }

    /// Computes one time step; adds the time of each phase to `times`.
    pub fn step(&mut self, times: &mut [Duration; PHASES.len()]) {
        let Tank { solver, water, boundary } = &mut self.tank;
        let mut begin = Instant::now();
        let mut end_phase = |phase: usize| {
            let now = Instant::now();
            times[phase] += now - begin;
            begin = now;
        };
        solver.sort(water, boundary);
        end_phase(0);
        solver.build_neighbour_lists(water, boundary);
        end_phase(1);
        solver.boundary_densities(boundary);
        end_phase(2);
        solver.rates();
        end_phase(3);
        let dt = solver.limits().time_step(&solver.parameters);
        solver.predict(dt, water, boundary, |_| ());
        end_phase(4);
        solver.rates();
        end_phase(3);
        solver.correct(dt, water, boundary);
        end_phase(5);
    }

    /// Returns a lower bound of the memory traffic of a time step [bytes]. Both evaluations of the rates read the
    /// neighbour lists and particle records. Sorting, predictor and corrector read and write the state of the water.
    pub fn min_traffic(&self) -> f64 {
        2.0 * self.tank.solver.bytes_read() as f64 + 5.0 * self.tank.water.bytes() as f64
    }

    /// Returns the memory of water and boundary particles [bytes].
    pub fn state_bytes(&self) -> usize {
        // A boundary particle has a position, velocity, vector to the surface, volume and density.
        self.tank.water.bytes() + self.tank.boundary.len() * (3 * size_of::<DVec3>() + 2 * size_of::<f64>())
    }
}
