//! Operations of the symplectic position Verlet step (equations 7 to 9). [`crate::simulation::flume`] calls these
//! operations in this order:
//!
//! sort, neighbour lists, boundary densities, rates, size of the time step, predict, rates, correct
//!
//! In Mitsui et al. (2023), equations 8.3, 8.4 and 9.2 have half-step values on their right-hand sides, which would
//! count half a time step twice. As in equation 7.2 and in Parshikov et al. (2000), this code uses the values at the
//! start of the time step (index n):
//!
//!   v^{n+1} = v^n + dt dv^{n+1/2}/dt,   r^{n+1} = r^n + dt (v^n + v^{n+1})/2,   rho^{n+1} = rho^n (2 - eps)/(2 + eps),
//!
//! where eps = -dt (d rho/dt) / rho at the half step (index n+1/2). v is the velocity, r the position, rho the density.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::{group::Group, state::State, time_step::Limits, water_pores::WaterPores};
use crate::mechanics::Load;
use crate::sph::{
    boundary::{ghost_velocity::GhostVelocities, mdbc::GhostNodes},
    lanes::InstructionSet,
    neighbours::{
        grid::{Bins, Grid},
        records::{Record, record},
    },
    pairs::{gap_pressure::Gaps, gradients::Gradients, pair_loop::PairLoop, rate::Rate},
    parameters::{BoundaryCondition, Parameters},
    particles::{boundary::Boundary, porosity::PorousField, water::Water},
    terms::{density_diffusion::Diffusion, shifting::Shifting, viscosity::Viscosity, wall_slip::WallSlip},
};

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
const MIN_CHUNK: usize = 4096;

/// Constants and scratch memory of the solver; scratch memory is kept between time steps only to avoid allocations.
#[derive(Debug)]
pub struct Solver {
    /// Constants of the scheme.
    pub parameters: Parameters,
    /// Grid of the bins.
    pub grid: Grid,
    pairs: PairLoop,
    water: Group,
    walls: Group,
    units: Group,
    gaps: Gaps,
    pores: WaterPores,
    records: Vec<Record>,
    ghosts: GhostNodes,
    /// Water velocities at the ghost nodes; computed only if the wall slip condition needs them.
    ghost_velocities: GhostVelocities,
    gradients: Gradients,
    half: Water,
    half_density: Vec<f64>,
    sorted: Water,
    unit_force: Vec<DVec3>,
}

impl Solver {
    /// Creates a solver for the box from `low` to `high` [m] with the best instruction set of the processor.
    pub fn new(parameters: Parameters, low: DVec3, high: DVec3) -> Self {
        Self::with_instructions(InstructionSet::best(), parameters, low, high)
    }

    /// Creates a solver with a given instruction set.
    pub fn with_instructions(instructions: InstructionSet, parameters: Parameters, low: DVec3, high: DVec3) -> Self {
        let group = || Group::new(instructions);
        let grid = Grid::new(low, high, parameters.dp, parameters.periodic_width);
        let pairs = PairLoop::new(parameters, grid.size.x);
        Self {
            parameters,
            grid,
            pairs,
            water: group(),
            walls: group(),
            units: group(),
            gaps: Gaps::new(instructions),
            pores: WaterPores::default(),
            records: Vec::new(),
            ghosts: GhostNodes::new(instructions),
            ghost_velocities: GhostVelocities::default(),
            gradients: Gradients::default(),
            half: Water::default(),
            half_density: Vec::new(),
            sorted: Water::default(),
            unit_force: Vec::new(),
        }
    }

    /// Lets the water flow through porous media.
    pub fn set_porous(&mut self, field: Arc<PorousField>) {
        self.pores = WaterPores::of(field);
    }

    /// Sorts all particles into bins, and the arrays of `water` into the order of the bins.
    pub fn sort(&mut self, water: &mut Water, boundary: &Boundary) {
        let walls = boundary.walls();
        self.water.sort(&self.grid, &water.position);
        self.permute(water);
        self.walls.sort(&self.grid, &boundary.position[walls.clone()]);
        self.units.sort(&self.grid, &boundary.position[walls.end..]);
        self.walls.first_record = water.len();
        self.units.first_record = water.len() + walls.len();
        self.pairs.water = water.len();
        self.records.resize(water.len() + boundary.len(), Record::default());
        self.fill_water_records(State::from_water(water));
    }

    /// Builds the neighbour lists for this time step.
    pub fn build_neighbour_lists(&mut self, water: &Water, boundary: &Boundary) {
        let reach = self.reach(water, boundary);
        let Self { grid, water: w, walls, units, .. } = self;
        let mut lists = std::mem::take(&mut w.lists);
        // Water first, because the pair loop splits the lists into water and boundary particles.
        let everything = [w.sources(), walls.sources(), units.sources()];
        lists.build(grid, &w.bins, &w.sorted, &everything, reach);
        let only_water = [Group::sources(w)];
        units.lists.build(grid, &units.bins, &units.sorted, &only_water, reach);
        if self.parameters.has_gap_pressure() {
            let solids = [walls.sources(), units.sources()];
            self.gaps.build(grid, &units.bins, &units.sorted, solids, boundary.unit_numbers(), reach);
        }
        if self.parameters.boundary == BoundaryCondition::Dynamic {
            walls.lists.build(grid, &walls.bins, &walls.sorted, &only_water, reach);
        }
        w.lists = lists;
    }

    /// Sorts the water's arrays into the order of the bins.
    fn permute(&mut self, water: &mut Water) {
        let order = &self.water.bins.order;
        gather(order, &water.position, &mut self.sorted.position);
        gather(order, &water.velocity, &mut self.sorted.velocity);
        gather(order, &water.density, &mut self.sorted.density);
        gather(order, &water.id, &mut self.sorted.id);
        gather(order, &water.mass, &mut self.sorted.mass);
        std::mem::swap(water, &mut self.sorted);
    }

    /// Returns the kernel support plus the distance by which two particles can approach each other in half a time step
    /// [m].
    fn reach(&self, water: &Water, boundary: &Boundary) -> f64 {
        let largest_speed = |v: &[DVec3]| {
            let squares = v.par_iter().with_min_len(MIN_CHUNK).map(|v| v.length_squared());
            squares.reduce(|| 0.0, f64::max).sqrt()
        };
        let speed = largest_speed(&water.velocity).max(largest_speed(&boundary.velocity));
        let Parameters { kernel, cfl, tait, .. } = &self.parameters;
        // dt is at most cfl h / c, and in a splash c can be 10 % below c0. In half a time step, each of the two
        // particles moves by at most speed * dt / 2, so their distance decreases by at most speed * dt.
        let step = cfl * kernel.h / (0.9 * tait.c0);
        kernel.support() + (speed * step).min(kernel.h)
    }

    /// Fills the records of the water from its state at the start of a time step or at the half step.
    fn fill_water_records(&mut self, water: State) {
        self.pores.update(water.position);
        let (grid, parameters, pores) = (&self.grid, &self.parameters, &self.pores);
        let records = self.records[..water.position.len()].par_iter_mut();
        records.enumerate().with_min_len(MIN_CHUNK).for_each(|(i, out)| {
            let position = water.position[i];
            let diffuses = parameters.own_x[0] <= position.x && position.x < parameters.own_x[1];
            // In pores, the pair sums use the bulk volume and the velocity of seepage through the bulk.
            let n = pores.porosity(i);
            let (velocity, mass) = (n * water.velocity[i], water.mass[i] / n);
            *out = record(grid, parameters, position, velocity, water.density[i], mass, diffuses);
        });
    }

    /// Fills the records of the boundary particles. `density` lists their densities at the start of a time step or at
    /// the half step [kg/m3].
    fn fill_boundary_records(&mut self, boundary: &Boundary, density: &[f64]) {
        let Self { grid, parameters, ghosts, ghost_velocities, records, walls, units, .. } = self;
        let (of_walls, of_units) = records[walls.first_record..].split_at_mut(boundary.walls().len());
        let diffuses = parameters.boundary == BoundaryCondition::ModifiedDynamic;
        let fill = |out: &mut [Record], order: &[u32], offset: usize| {
            out.par_iter_mut().zip(order).with_min_len(MIN_CHUNK).for_each(|(out, &i)| {
                let i = offset + i as usize;
                let mass = parameters.tait.rho0 * boundary.volume[i];
                let ghost = ghost_velocities.at_node_of(i, ghosts);
                let (wall, mirroring) = (boundary.velocity[i], boundary.mirroring[i]);
                let velocity = parameters.slip.velocity(wall, ghost, boundary.to_surface[i], mirroring);
                *out = record(grid, parameters, boundary.position[i], velocity, density[i], mass, diffuses);
                out.add_damping(ghost.map_or(0.0, |ghost| ghost.damping));
            });
        };
        fill(of_walls, &walls.bins.order, 0);
        fill(of_units, &units.bins.order, boundary.walls().len());
    }

    /// Returns true if the boundary particles need the velocity or the acoustic damping of the water at their ghost
    /// nodes.
    fn needs_ghost_velocities(&self) -> bool {
        self.parameters.boundary == BoundaryCondition::ModifiedDynamic && self.parameters.slip != WallSlip::Original
    }

    /// Under mDBC, computes the boundary densities from the ghost nodes. Under DBC, the densities follow from the
    /// continuity equation and are not changed here. Then fills the records of the boundary particles.
    pub fn boundary_densities(&mut self, boundary: &mut Boundary) {
        if self.parameters.boundary == BoundaryCondition::ModifiedDynamic {
            self.ghosts.densities(&self.grid, &self.parameters, &self.water.sources(), &self.records, boundary);
            if self.needs_ghost_velocities() {
                let Self { ghosts, ghost_velocities, grid, parameters, records, .. } = self;
                ghost_velocities.compute(ghosts, grid, parameters, records, boundary);
            }
        }
        self.fill_boundary_records(boundary, &boundary.density);
    }

    /// Computes the rates of water, units and, under DBC, walls from the current records.
    pub fn rates(&mut self) {
        let Self { pairs, records, water, walls, units, parameters, gaps, gradients, pores, .. } = self;
        if Gradients::are_needed(parameters) {
            gradients.compute(pairs, &water.lists, records, water.rates.len());
        }
        let neighbour_data = gradients.neighbour_data();
        pairs.rates(&water.lists, records, neighbour_data, 0, &mut water.rates);
        pores.add_to(&mut water.rates);
        pairs.rates(&units.lists, records, neighbour_data, units.first_record, &mut units.rates);
        if parameters.boundary == BoundaryCondition::Dynamic {
            pairs.rates(&walls.lists, records, neighbour_data, walls.first_record, &mut walls.rates);
        }
        if parameters.has_gap_pressure() {
            gaps.add_pressure(pairs, records, &mut units.rates);
        }
    }

    /// Computes the measures of the particle distribution around the water particles from the current records.
    pub(super) fn compute_order(&self, gradients: &mut Gradients) {
        gradients.compute_order(&self.pairs, &self.water.lists, &self.records, self.water.rates.len());
    }

    /// Returns the last computed rates of the water, in sorted order.
    pub fn water_rates(&self) -> &[Rate] {
        &self.water.rates
    }

    /// Returns the last computed rates of the water, in sorted order, so that they can be replaced.
    pub fn water_rates_mut(&mut self) -> &mut [Rate] {
        &mut self.water.rates
    }

    /// Computes the rates of the water for the current records, but with the given viscosity and diffusion.
    pub(super) fn rates_with(&self, viscosity: Viscosity, diffusion: Diffusion) -> Vec<Rate> {
        let pairs = self.pairs.with_parameters(Parameters { viscosity, diffusion, ..self.parameters });
        let mut rates = vec![Rate::default(); self.water.rates.len()];
        pairs.rates(&self.water.lists, &self.records, &[], 0, &mut rates);
        self.pores.add_to(&mut rates);
        rates
    }

    /// Returns the largest acceleration and the largest signal speed of the water, which limit the time step.
    pub fn limits(&self) -> Limits {
        Limits::of(&self.records[..self.water.rates.len()], &self.water.rates, self.parameters.gravity)
    }

    /// Predictor, equations 8.1, 8.2 and 9.1: computes the state at the half step without changing `water`.
    /// `move_boundary` moves the boundary to its positions at the half step.
    pub fn predict(
        &mut self,
        dt: f64,
        water: &Water,
        boundary: &mut Boundary,
        move_boundary: impl FnOnce(&mut Boundary),
    ) {
        let (half_dt, gravity) = (0.5 * dt, DVec3::NEG_Z * self.parameters.gravity);
        let n = water.len();
        self.half.position.resize(n, DVec3::ZERO);
        self.half.velocity.resize(n, DVec3::ZERO);
        self.half.density.resize(n, 0.0);
        let (half, pores) = (&mut self.half, &self.pores);
        (&mut half.position, &mut half.velocity, &mut half.density, &self.water.rates)
            .into_par_iter()
            .enumerate()
            .with_min_len(MIN_CHUNK)
            .for_each(|(i, (position, velocity, density, rate))| {
                *position = water.position[i] + half_dt * water.velocity[i];
                *velocity = pores.velocity_after(i, half_dt, water.velocity[i], acceleration(rate) + gravity);
                *density = water.density[i] + half_dt * f64::from(rate.density);
            });
        self.half_boundary_density(half_dt, boundary);
        move_boundary(boundary);
        let half = std::mem::take(&mut self.half);
        self.fill_water_records(State { mass: &water.mass, ..State::from_water(&half) });
        self.half = half;
        self.add_damping_to_water();
        if self.needs_ghost_velocities() {
            // With the velocities of the start, sound waves near walls grow at Courant numbers from 0.3.
            let Self { ghosts, ghost_velocities, grid, parameters, records, .. } = self;
            ghost_velocities.update(ghosts, grid, parameters, records);
        }
        let half_density = std::mem::take(&mut self.half_density);
        let from_nodes = self.parameters.boundary == BoundaryCondition::ModifiedDynamic;
        self.fill_boundary_records(boundary, if from_nodes { &boundary.density } else { &half_density });
        self.half_density = half_density;
    }

    /// Adds the pressure of the acoustic damping to the records of the water, from the rates at the start of the time
    /// step.
    fn add_damping_to_water(&mut self) {
        let Some(damping) = self.parameters.acoustic_damping else { return };
        let pairs = self.records.par_iter_mut().zip(&self.water.rates).with_min_len(MIN_CHUNK);
        pairs.for_each(|(record, rate)| record.add_damping(damping.pressure(rate.compression)));
    }

    /// Under DBC, computes the half-step densities of the boundary particles by equation 9.1.
    fn half_boundary_density(&mut self, half_dt: f64, boundary: &Boundary) {
        if self.parameters.boundary == BoundaryCondition::ModifiedDynamic {
            return;
        }
        self.half_density.resize(boundary.len(), 0.0);
        for (particle, rate) in self.boundary_rates() {
            self.half_density[particle] = boundary.density[particle] + half_dt * rate;
        }
    }

    /// Returns the index of each boundary particle and its d rho / dt [kg/(m3 s)].
    fn boundary_rates(&self) -> Vec<(usize, f64)> {
        let rates = |group: &Group, offset: usize| {
            let pairs = group.bins.order.iter().zip(&group.rates);
            pairs.map(|(&i, rate)| (offset + i as usize, f64::from(rate.density))).collect::<Vec<_>>()
        };
        let mut all = rates(&self.walls, 0);
        all.extend(rates(&self.units, self.walls.rates.len()));
        all
    }

    /// Corrector, equations 8.3, 8.4 and 9.2: computes the state at the end of the time step.
    pub fn correct(&mut self, dt: f64, water: &mut Water, boundary: &mut Boundary) {
        let gravity = DVec3::NEG_Z * self.parameters.gravity;
        if self.parameters.shifting.is_some() && !Gradients::are_needed(&self.parameters) {
            let mut gradients = std::mem::take(&mut self.gradients);
            self.compute_order(&mut gradients);
            self.gradients = gradients;
        }
        let (half, grid, gradients, pores) = (&self.half, &self.grid, &self.gradients, &self.pores);
        let Parameters { shifting, lowest_density, own_x: [from, to], .. } = self.parameters;
        let lowest_density = lowest_density.unwrap_or(0.0);
        (&mut water.position, &mut water.velocity, &mut water.density, &self.water.rates)
            .into_par_iter()
            .enumerate()
            .with_min_len(MIN_CHUNK)
            .for_each(|(i, (position, velocity, density, rate))| {
                let end_velocity = pores.velocity_after(i, dt, *velocity, acceleration(rate) + gravity);
                let mut moved = 0.5 * dt * (*velocity + end_velocity);
                *density = end_density(*density, half.density[i], f64::from(rate.density), dt);
                // Particles in the buffer of another region follow its water.
                let is_own = from <= position.x && position.x < to;
                if let Some(shifting) = shifting.filter(|_| is_own) {
                    let disorder = shifting.disorder(&gradients.order(i));
                    let shift = shifting.shift(dt, shifting.velocity(f64::from(rate.approach), disorder));
                    moved += shift;
                    *density *= 1.0 + Shifting::density_change(shift, disorder);
                }
                *position = grid.wrap(*position + moved);
                *velocity = end_velocity;
                // Not `max`, which would hide NaN.
                if *density < lowest_density {
                    *density = lowest_density;
                }
            });
        if self.parameters.boundary == BoundaryCondition::Dynamic {
            for (particle, rate) in self.boundary_rates() {
                let end = end_density(boundary.density[particle], self.half_density[particle], rate, dt);
                // Walls exert no suction on the water (Crespo et al. 2007).
                boundary.density[particle] = end.max(self.parameters.tait.rho0);
            }
        }
    }

    /// Returns the power per mass that the drag of porous media takes from a particle with this velocity [W/kg].
    pub(super) fn dissipation(&self, particle: usize, velocity: DVec3) -> f64 {
        self.pores.dissipation(particle, velocity)
    }

    /// Returns the force of the water on each unit and the torque about its centre of mass. `centres` lists the centres
    /// of mass [m].
    pub fn unit_loads(&mut self, boundary: &Boundary, centres: &[DVec3]) -> Vec<Load> {
        let first_unit = boundary.walls().end;
        self.unit_force.resize(boundary.len() - first_unit, DVec3::ZERO);
        for (&i, rate) in self.units.bins.order.iter().zip(&self.units.rates) {
            let mass = self.parameters.tait.rho0 * boundary.volume[first_unit + i as usize];
            self.unit_force[i as usize] = mass * acceleration(rate);
        }
        boundary.unit_loads(centres, |i| self.unit_force[i - first_unit])
    }

    /// Returns the mean number of pairs that are computed per water particle, including pairs in unused lanes and pairs
    /// outside the kernel support.
    pub fn lanes_per_target(&self) -> f64 {
        self.water.lists.lanes_per_target()
    }

    /// Returns the mean number of neighbours of a water particle within the kernel support.
    pub fn mean_neighbours(&self) -> f64 {
        self.pairs.count_within_support(&self.water.lists, &self.records) as f64 / self.water.rates.len().max(1) as f64
    }

    /// Returns the size of the neighbour lists of the water and of the records [bytes]. Every evaluation of the rates
    /// reads these data.
    pub fn bytes_read(&self) -> usize {
        self.water.lists.bytes() + self.records.len() * size_of::<Record>()
    }

    /// Returns the memory that the solver uses in addition to the state of water and boundary [bytes].
    pub fn bytes(&self) -> usize {
        let groups: usize = [&self.water, &self.walls, &self.units].map(Group::bytes).iter().sum();
        let records = self.records.capacity() * size_of::<Record>();
        groups
            + self.gaps.bytes()
            + self.pores.bytes()
            + records
            + self.ghosts.bytes()
            + self.ghost_velocities.bytes()
            + self.gradients.bytes()
            + self.half.bytes()
            + self.sorted.bytes()
    }

    /// Returns the bins of the sorted water. The gauges search their neighbours in these bins.
    pub fn water_bins(&self) -> &Bins {
        &self.water.bins
    }

    /// Returns the bins of the boundary: first of bed, walls and pistons, then of the units.
    pub fn boundary_bins(&self) -> [&Bins; 2] {
        [&self.walls.bins, &self.units.bins]
    }
}

/// Returns the acceleration without gravity [m/s2].
fn acceleration(rate: &Rate) -> DVec3 {
    DVec3::from_array(rate.acceleration.map(f64::from))
}

/// Returns the density at the end of a time step [kg/m3] (equation 9.2): rho (2 - eps) / (2 + eps) with `rho` at the
/// start of the time step, and eps = -dt (d rho/dt) / rho at the half step.
fn end_density(rho: f64, half_rho: f64, rate: f64, dt: f64) -> f64 {
    let epsilon = -dt * rate / half_rho;
    rho * (2.0 - epsilon) / (2.0 + epsilon)
}

/// Permutes values: `out[i] = values[order[i]]`.
fn gather<T: Copy + Send + Sync + Default>(order: &[u32], values: &[T], out: &mut Vec<T>) {
    out.resize(values.len(), T::default());
    out.par_iter_mut().zip(order).with_min_len(MIN_CHUNK).for_each(|(out, &i)| *out = values[i as usize]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn density_update_is_second_order() {
        // For d rho / dt = -rho, the function returns the error of one time step, compared with the exact factor
        // exp(-dt).
        let error = |dt: f64| {
            let half = 1000.0 * (1.0 - 0.5 * dt);
            (end_density(1000.0, half, -half, dt) / 1000.0 - (-dt).exp()).abs()
        };
        // If dt is halved, the error of one time step decreases by a factor of eight. The error per time step is thus
        // of third order, and the error over a fixed time is of second order.
        let ratio = error(0.02) / error(0.01);
        assert!((ratio - 8.0).abs() < 0.2, "{ratio}");
    }
}
