//! Blocks of water without gravity and walls, and the rates and gradients that the solver computes in them.

use breakwater::sph::particles::{boundary::Boundary, water::Water};
use breakwater::sph::{
    lanes::InstructionSet,
    neighbours::{
        grid::{Bins, Grid},
        lists::{NeighbourLists, SortedPositions, Sources},
        records::record,
    },
    pairs::{gradients::Gradients, pair_loop::PairLoop, rate::Rate},
    parameters::Parameters,
    solver::step::Solver,
    terms::{
        density_diffusion::{DensityDiffusion, Diffusion},
        kernel::Wendland,
        turbulence::Smagorinsky,
        viscosity::Viscosity,
    },
};
use glam::DVec3;

use super::lattice::{gradient_factor, lattice_sum, points};
use super::tanks::{RHO0, parameters};

/// Smoothing length divided by particle spacing, h / dp, as in Mitsui et al. (2023) [-].
pub const USUAL: f64 = 1.2 * 1.732_050_807_568_877_2;

/// Largest shift of jittered points along each axis, as a share of dp [-].
pub const JITTER: f64 = 0.2;

/// Particle spacing of the blocks [m].
pub const DP: f64 = 0.01;

/// Particles along each edge of the blocks.
const EDGE: usize = 20;

/// Returns the parameters of a scheme without viscosity, diffusion and gravity.
pub fn ideal(dp: f64, periodic_width: Option<f64>) -> Parameters {
    let mut parameters = parameters(dp, 0.2, 0.0, periodic_width);
    parameters.viscosity = Viscosity::Artificial { alpha: 0.0, beta: 0.0 };
    parameters.diffusion = Diffusion::none();
    parameters
}

/// Creates water of given density and velocity at points; each particle has the volume dp^3.
pub fn water(points: Vec<DVec3>, dp: f64, density: impl Fn(DVec3) -> f64, velocity: impl Fn(DVec3) -> DVec3) -> Water {
    let density: Vec<f64> = points.iter().map(|&p| density(p)).collect();
    Water {
        velocity: points.iter().map(|&p| velocity(p)).collect(),
        mass: density.iter().map(|rho| rho * dp.powi(3)).collect(),
        id: (0..points.len() as u32).collect(),
        position: points,
        density,
    }
}

/// Creates a block of EDGE^3 particles around the origin.
pub fn block(jitter: f64, density: impl Fn(DVec3) -> f64, velocity: impl Fn(DVec3) -> DVec3) -> Water {
    let corner = DVec3::splat(-0.5 * DP * (EDGE - 1) as f64);
    water(points(DP, [EDGE; 3], corner, jitter), DP, density, velocity)
}

/// Returns the number of axes along which the kernel support around a point is within the block.
pub fn whole_axes(point: DVec3) -> usize {
    let reach = 2.0 * USUAL * DP + 2.0 * JITTER * DP;
    point.to_array().iter().filter(|place| place.abs() + reach < 0.5 * DP * (EDGE - 1) as f64).count()
}

/// Returns true if the whole kernel support around a point is within the block.
pub fn inside(point: DVec3) -> bool {
    whole_axes(point) == 3
}

/// Returns the water as sorted by the solver, and the rates of its particles in the same order.
pub fn rates(parameters: Parameters, water: Water, low: DVec3, high: DVec3) -> (Water, Vec<Rate>) {
    rates_beside(parameters, water, Boundary::new(&[], &[], &[], RHO0), [low, high])
}

/// Returns the same as [`rates`], for water next to boundary particles.
pub fn rates_beside(
    parameters: Parameters,
    mut water: Water,
    mut boundary: Boundary,
    [low, high]: [DVec3; 2],
) -> (Water, Vec<Rate>) {
    let mut solver = Solver::new(parameters, low, high);
    solver.sort(&mut water, &boundary);
    solver.build_neighbour_lists(&water, &boundary);
    solver.boundary_densities(&mut boundary);
    solver.rates();
    let rates = solver.water_rates().to_vec();
    (water, rates)
}

pub fn rates_of_block(water: Water) -> (Water, Vec<Rate>) {
    rates(ideal(DP, None), water, DVec3::splat(-0.15), DVec3::splat(0.15))
}

/// Returns the gradients that the solver computes, and the indices of the particles in the order of the gradients.
pub fn gradients(parameters: Parameters, water: &Water, low: DVec3, high: DVec3) -> (Gradients, Vec<usize>) {
    let grid = Grid::new(low, high, parameters.dp, parameters.periodic_width);
    let mut bins = Bins::default();
    bins.sort(&grid, &water.position);
    let order: Vec<usize> = bins.order.iter().map(|&i| i as usize).collect();
    let sorted: Vec<DVec3> = order.iter().map(|&i| water.position[i]).collect();
    let mut positions = SortedPositions::default();
    positions.set(&grid, &sorted);
    let mut lists = NeighbourLists::new(InstructionSet::best());
    let sources = Sources { bins: &bins, positions: &positions, first_record: 0 };
    lists.build(&grid, &bins, &sorted, &[sources], parameters.kernel.support());
    let record_of = |&i: &usize| {
        record(&grid, &parameters, water.position[i], water.velocity[i], water.density[i], water.mass[i], true)
    };
    let records: Vec<_> = order.iter().map(record_of).collect();
    let mut gradients = Gradients::default();
    gradients.compute(&PairLoop::new(parameters, grid.size.x), &lists, &records, records.len());
    (gradients, order)
}

pub fn gradients_of_block(water: &Water) -> (Gradients, Vec<usize>) {
    let mut parameters = ideal(DP, None);
    parameters.diffusion = Diffusion::new(DensityDiffusion::Antuono, 0.1, parameters.kernel.h, &parameters.tait, 0.0);
    parameters.viscosity = Viscosity::Laminar { nu: 1e-6, turbulence: Some(Smagorinsky::new(DP)) };
    gradients(parameters, water, DVec3::splat(-0.15), DVec3::splat(0.15))
}

pub fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), v| (sum + v * v, count + 1));
    (sum / f64::from(count)).sqrt()
}

/// Returns the error of the first moment of the kernel gradient, summed over a lattice [-]. The exact moment is 1.
/// `factor` is h / dp.
pub fn lattice_error_of_gradient(factor: f64) -> f64 {
    let kernel = Wendland::new(factor);
    lattice_sum(&kernel, |r| -gradient_factor(&kernel, r.length()) * r.x * r.x) - 1.0
}
