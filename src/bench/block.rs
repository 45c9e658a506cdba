//! The block of water that is timed.

use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};

use super::PHASES;
use crate::{
    particles::{
        bed::{Across, Outline, outline_particles},
        boundary::Boundary,
        fill::Basin,
        water::Water,
    },
    sph::{
        density_diffusion::{DensityDiffusion, Diffusion},
        equation_of_state::Tait,
        kernel::Wendland,
        lanes::InstructionSet,
        parameters::{BoundaryCondition, Parameters},
        step::Solver,
        viscosity::Viscosity,
        wall_slip::WallSlip,
    },
};

const GRAVITY: f64 = 9.81;
const RHO0: f64 = 1000.0;

/// Particle distance [m]; the speed does not depend on it.
const DP: f64 = 0.01;

/// A cube of water on a bed between two end walls, periodic across.
pub struct Block {
    /// The solver.
    pub solver: Solver,
    /// The water.
    pub water: Water,
    /// Bed and walls.
    pub boundary: Boundary,
    /// "still" or "moving".
    pub motion: &'static str,
}

impl Block {
    /// A block of about so many water particles with 2h/dp as given, still or sloshing.
    pub fn new(instructions: InstructionSet, particles: usize, support_per_dp: f64, moving: bool) -> Self {
        let count = (particles as f64).cbrt().round().max(8.0);
        let side = count * DP;
        let (h, c0) = (0.5 * support_per_dp * DP, 15.0 * (GRAVITY * side).sqrt());
        let tait = Tait { rho0: RHO0, c0, gamma: 7.0 };
        let parameters = Parameters {
            dp: DP,
            kernel: Wendland::new(h),
            tait,
            viscosity: Viscosity::Artificial { alpha: 0.04 },
            diffusion: Diffusion::new(DensityDiffusion::Fourtakas, 0.1, h, &tait, GRAVITY),
            gravity: GRAVITY,
            cfl: 0.2,
            boundary: BoundaryCondition::ModifiedDynamic,
            slip: WallSlip::Original,
            shifting: None,
            periodic_width: Some(side),
        };
        let across = Across { width: side, count: count as u32, walls: false };
        // The lowest mode of the tank: water falls along one wall and rises along the other.
        let speed = if moving { 0.3 * (GRAVITY * side).sqrt() } else { 0.0 };
        let wave = std::f64::consts::PI / side;
        let slosh = |x: f64, z: f64| {
            speed * DVec2::new((wave * x).sin() * (wave * z).cos(), -(wave * x).cos() * (wave * z).sin())
        };
        let basin = Basin {
            x: [0.0, side],
            across,
            dp: DP,
            bed: &|_| 0.0,
            surface: &|_| side,
            velocity: &slosh,
            gravity: GRAVITY,
        };
        let corners = [[0.0, 1.2 * side], [0.0, 0.0], [side, 0.0], [side, 1.2 * side]];
        let walls = outline_particles(&Outline::new(corners.map(DVec2::from_array).to_vec()), &across, DP, 3);
        let margin = DVec3::new(5.0 * DP, 0.0, 5.0 * DP);
        Self {
            solver: Solver::with_instructions(
                instructions,
                parameters,
                -margin,
                DVec3::new(side, side, 1.5 * side) + margin,
            ),
            water: basin.fill(&parameters.tait),
            boundary: Boundary::new(&walls, &[], &[], 0, RHO0),
            motion: if moving { "moving" } else { "still" },
        }
    }

    /// Water and boundary particles.
    pub fn particles(&self) -> usize {
        self.water.len() + self.boundary.len()
    }

    /// One step; adds the time of each phase.
    pub fn step(&mut self, times: &mut [Duration; PHASES.len()]) {
        let Self { solver, water, boundary, .. } = self;
        let mut begin = Instant::now();
        let mut end_phase = |phase: usize| {
            let now = Instant::now();
            times[phase] += now - begin;
            begin = now;
        };
        solver.sort(water, boundary);
        end_phase(0);
        solver.list(water, boundary);
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

    /// Bytes that a step must at least move: lists and records for two evaluations, and the state of the water, which
    /// is sorted, predicted and corrected.
    pub fn least_traffic(&self) -> f64 {
        2.0 * self.solver.bytes_read() as f64 + 5.0 * self.water.bytes() as f64
    }

    /// Memory of water and boundary [bytes].
    pub fn state_bytes(&self) -> usize {
        // Position, velocity, vector to the surface, volume, density.
        self.water.bytes() + self.boundary.len() * (3 * size_of::<DVec3>() + 2 * size_of::<f64>())
    }
}
