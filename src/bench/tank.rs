//! A minimal tank of water with solver and walls, for benchmarks and tests.

use glam::{DVec2, DVec3};

use crate::geometry::outline::Outline;
use crate::sph::{
    lanes::InstructionSet,
    parameters::Parameters,
    particles::{
        bed::{Across, outline_particles},
        boundary::{Boundary, BoundaryParticle},
        fill::Basin,
        water::Water,
    },
    solver::step::Solver,
};

/// Number of particle layers in bed and walls.
const LAYERS: u32 = 3;

/// Water on a flat bed between two end walls, periodic in y.
pub struct Tank {
    /// The solver.
    pub solver: Solver,
    /// The water.
    pub water: Water,
    /// Boundary particles of bed, walls and unit.
    pub boundary: Boundary,
}

impl Tank {
    /// Creates a tank with the given length, width and mean depth [m]. Its walls are 1.5 times as high as the depth.
    /// `surface` is the initial surface level z(x) [m] and `velocity` the initial velocity v(x, z) [m/s]. `unit` lists
    /// the boundary particles of a unit; it is empty if the tank has no unit.
    pub fn new(
        instructions: InstructionSet,
        parameters: Parameters,
        [length, width, depth]: [f64; 3],
        surface: &dyn Fn(f64) -> f64,
        velocity: &dyn Fn(f64, f64) -> DVec2,
        unit: &[BoundaryParticle],
    ) -> Self {
        let Parameters { dp, gravity, tait, .. } = parameters;
        let across = Across { width, count: (width / dp).round() as u32, walls: false };
        let basin = Basin { x: [0.0, length], across, dp, bed: &|_, _| 0.0, surface, velocity, gravity };
        let top = 1.5 * depth;
        let corners = [[0.0, top], [0.0, 0.0], [length, 0.0], [length, top]];
        let outline = Outline::new(&corners.map(DVec2::from_array));
        let walls = outline_particles(&outline, &across, dp, LAYERS, parameters.kernel.support());
        let margin = DVec3::new(5.0 * dp, 0.0, 5.0 * dp);
        let high = DVec3::new(length, width, top) + margin;
        Self {
            solver: Solver::with_instructions(instructions, parameters, -margin, high),
            water: basin.fill(&tait),
            boundary: Boundary::new(&walls, &[], &vec![unit; usize::from(!unit.is_empty())], tait.rho0),
        }
    }
}
