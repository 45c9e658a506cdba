//! Small, coarse tanks of water for the tests, and functions that run them.

use std::sync::Arc;

use breakwater::bench::tank::Tank;
use breakwater::case::Case;
use breakwater::geometry::{armour_unit::ArmourUnit, outline::Outline};
use breakwater::rigid::BodyState;
use breakwater::simulation::flume::{Simulation, step::PreparedStep};
use breakwater::sph::particles::bed::{Across, outline_particles};
use breakwater::sph::particles::boundary::{Boundary, BoundaryParticle};
use breakwater::sph::particles::fill::{Basin, clear_solid};
use breakwater::sph::particles::water::Water;
use breakwater::sph::{
    lanes::InstructionSet,
    parameters::Parameters,
    solver::step::Solver,
    terms::density_diffusion::{DensityDiffusion, Diffusion},
};
use glam::{DQuat, DVec2, DVec3};
use serde_json::{Value, json};

pub const GRAVITY: f64 = 9.81;
pub const RHO0: f64 = 1000.0;

/// Height of the Tetrapods of the Fudo experiment [m].
pub const UNIT_HEIGHT: f64 = 0.077;

/// Creates the simulation of a case given as JSON.
pub fn simulation(case: &Value) -> Simulation {
    let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
    Simulation::new(Arc::new(case)).unwrap()
}

/// Advances until a time [s]; before each time step `observe` gets the prepared state, in which gauges can be read.
pub fn run_until(simulation: &mut Simulation, end: f64, mut observe: impl FnMut(&mut PreparedStep) + Send) {
    // As in `output::driver::drive`, the loop runs on a thread of the rayon pool.
    rayon::scope(|_| {
        while simulation.time < end {
            let mut step = simulation.begin_step().unwrap();
            observe(&mut step);
            step.finish().unwrap();
        }
    });
}

/// Advances by a number of time steps.
pub fn run_steps(simulation: &mut Simulation, steps: u32) {
    for _ in 0..steps {
        simulation.step().unwrap();
    }
}

/// Returns the case of a flat tank of still water with end walls and periodic sides.
pub fn still_tank(length: f64, width: f64, depth: f64, dp: f64, duration: f64) -> Value {
    json!({
        "title": "Still water",
        "flume": { "bed_m": [[0.0, 0.0], [length, 0.0]], "still_water_level_m": depth, "material": "mortar" },
        "domain": {
            "x_m": [0.0, length], "width_m": width, "sides": "periodic", "top_z_m": 1.5 * depth + 0.1, "dp_m": dp
        },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
        "stop": { "duration_s": duration }
    })
}

/// Returns the case of a square tank with a Tetrapod in its middle that is held all the time.
pub fn tank_with_held_unit(length: f64, depth: f64, dp: f64, duration: f64) -> Value {
    let mut case = still_tank(length, length, depth, dp, duration);
    case["units"] = json!({
        "shape": "tetrapod", "height_m": UNIT_HEIGHT, "mass_kg": 0.3, "material": "mortar",
        "count": 1, "pitch_m": length, "x_m": 0.5 * length
    });
    case["numerics"] = json!({ "hold_units_s": duration });
    case
}

/// Returns the case of a dam break (Koshizuka & Oka 1996): a column of water 1 m long and 2 m high, in a tank 4 m long
/// and 10 particles wide.
pub fn dam_break(dp: f64, duration: f64) -> Value {
    json!({
        "title": "Dam break",
        "flume": { "bed_m": [[0.0, 0.0], [4.0, 0.0]], "still_water_level_m": 2.0 },
        "domain": {
            "x_m": [0.0, 4.0], "width_m": 10.0 * dp, "sides": "periodic", "top_z_m": 3.0, "dp_m": dp,
            "water": { "kind": "block", "x_m": [0.0, 1.0], "top_z_m": 2.0 }
        },
        "stop": { "duration_s": duration }
    })
}

/// Returns the parameters of Mitsui et al. (2023); the depth [m] determines the speed of sound.
pub fn parameters(dp: f64, depth: f64, gravity: f64, periodic_width: Option<f64>) -> Parameters {
    let (h, c0) = (1.2 * 3f64.sqrt() * dp, 15.0 * (GRAVITY * depth).sqrt());
    Parameters::published(dp, h, c0, gravity, periodic_width)
}

/// Solver, water and boundary without the coupled simulation.
pub struct BareTank {
    pub solver: Solver,
    pub water: Water,
    pub boundary: Boundary,
}

impl BareTank {
    /// Creates a square tank of still water with end walls, periodic sides and one unit at the origin.
    pub fn new(length: f64, depth: f64, dp: f64, unit: &[BoundaryParticle]) -> Self {
        Self::with_instructions(InstructionSet::best(), length, depth, dp, unit)
    }

    /// Creates the tank of [`Self::new`] for an instruction set.
    pub fn with_instructions(
        instructions: InstructionSet,
        length: f64,
        depth: f64,
        dp: f64,
        unit: &[BoundaryParticle],
    ) -> Self {
        let parameters = parameters(dp, depth, GRAVITY, Some(length));
        Self::of(instructions, parameters, [length, length, depth], &|_| depth, unit)
    }

    /// Creates a tank of a length, width and mean depth [m] with the surface z(x) [m].
    pub fn of(
        instructions: InstructionSet,
        parameters: Parameters,
        [length, width, depth]: [f64; 3],
        surface: &dyn Fn(f64) -> f64,
        unit: &[BoundaryParticle],
    ) -> Self {
        let still = |_, _| DVec2::ZERO;
        let size = [length, width, depth];
        let Tank { solver, water, boundary } = Tank::new(instructions, parameters, size, surface, &still, unit);
        Self { solver, water, boundary }
    }

    /// Creates a box, square in x and z and periodic in y, full of water without gravity. A `unit` with particles is at
    /// the origin; `adjust` changes the scheme.
    pub fn closed(
        [side, width]: [f64; 2],
        dp: f64,
        c0: f64,
        unit: &[BoundaryParticle],
        adjust: impl FnOnce(&mut Parameters),
    ) -> Self {
        let mut parameters = parameters(dp, side, 0.0, Some(width));
        parameters.tait.c0 = c0;
        parameters.diffusion =
            Diffusion::new(DensityDiffusion::Fourtakas, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
        adjust(&mut parameters);
        let across = Across { width, count: (width / dp).round() as u32, walls: false };
        let basin = Basin {
            x: [0.0, side],
            across,
            dp,
            bed: &|_, _| 0.0,
            surface: &|_| side,
            velocity: &|_, _| DVec2::ZERO,
            gravity: 0.0,
        };
        // The outline follows all four walls, from the middle of the top.
        let (middle, s) = (0.5 * side, side);
        let corners = [[middle, s], [0.0, s], [0.0, 0.0], [s, 0.0], [s, s], [middle, s]];
        let outline = Outline::new(&corners.map(DVec2::from_array));
        let fixed = outline_particles(&outline, &across, dp, 3, parameters.kernel.support());
        let margin = DVec3::new(5.0 * dp, 0.0, 5.0 * dp);
        Self {
            solver: Solver::new(parameters, -margin, DVec3::new(side, width, side) + margin),
            water: basin.fill(&parameters.tait),
            boundary: Boundary::new(&fixed, &[], &vec![unit; usize::from(!unit.is_empty())], RHO0),
        }
    }

    /// Moves the centre of mass of the unit to `centre` [m] and removes the water inside the unit.
    pub fn hold(&mut self, unit: &ArmourUnit, centre: DVec3, rotation: DQuat) {
        let (solid, back) = (unit.solid(), rotation.inverse());
        clear_solid(&mut self.water, self.solver.parameters.dp, |point| {
            let (nearest, distance) = solid.project(back * (point - centre));
            (rotation * nearest + centre, distance)
        });
        self.boundary.move_unit(0, &BodyState::at_rest(centre, rotation));
    }

    /// Advances by one time step and returns the time step [s]. `observe` gets the state before the predictor.
    pub fn step(&mut self, observe: impl FnOnce(&mut Self) + Send) -> f64 {
        // As in `output::driver::drive`, the time step runs on a thread of the rayon pool.
        rayon::scope(|_| self.step_in_the_pool(observe))
    }

    fn step_in_the_pool(&mut self, observe: impl FnOnce(&mut Self)) -> f64 {
        self.solver.sort(&mut self.water, &self.boundary);
        self.solver.build_neighbour_lists(&self.water, &self.boundary);
        self.solver.boundary_densities(&mut self.boundary);
        self.solver.rates();
        let dt = self.solver.limits().time_step(&self.solver.parameters);
        observe(self);
        self.solver.predict(dt, &self.water, &mut self.boundary, |_| ());
        self.solver.rates();
        self.solver.correct(dt, &mut self.water, &mut self.boundary);
        dt
    }
}
