//! One time step of the coupled run, in the order of the algorithm.
//!
//! The symplectic position Verlet scheme (Mitsui et al. 2023, equations 7 to 9) evaluates the rates of the water twice:
//! at the current state and at the half step. The run writes its outputs after the first evaluation.

use std::ops::{Deref, DerefMut};

use glam::DVec3;

use super::{
    Simulation, Units, failure, failure::Failure, measures::water_at_impacts::RecordedUnits, wave::ends::move_ends,
};
use crate::{
    case::UnitGroup,
    rigid::{BodyState, RigidError, RigidWorld},
    sph::solver::{backend::DeviceError, power::Powers, sampling::Sampler},
};

/// Largest number of time steps of the finest region in one time step of coarser regions, unless its stable time step
/// becomes shorter meanwhile. The stable time step is proportional to the particle spacing, which doubles.
const STEPS_PER_COARSE_STEP: f64 = 2.0;

/// A simulation whose current state is evaluated: outputs can be written, and the next time step can be made.
pub struct PreparedStep<'a> {
    simulation: &'a mut Simulation,
    dt: f64,
    /// True if the arrays in host memory contain the current state.
    is_fetched: bool,
}

impl Deref for PreparedStep<'_> {
    type Target = Simulation;

    fn deref(&self) -> &Simulation {
        self.simulation
    }
}

impl DerefMut for PreparedStep<'_> {
    fn deref_mut(&mut self) -> &mut Simulation {
        self.simulation
    }
}

impl Simulation {
    /// Evaluates the current state: neighbours, boundary densities, rates and length of the time step. If there are
    /// coarser regions, the time step is as long as they allow, but at most two time steps of the finest region.
    ///
    /// # Errors
    /// If a rate is not finite, or the device is lost.
    pub fn begin_step(&mut self) -> Result<PreparedStep<'_>, Failure> {
        self.evaluate_regions();
        let mut dt = self.longest_step()?;
        if !self.coarse.is_empty() {
            dt *= STEPS_PER_COARSE_STEP;
            for region in &mut self.coarse {
                dt = dt.min(region.longest_step()?);
            }
        }
        if self.steps == 0 {
            // The first row of the tables is written before the first half step: sum the loads at the start for it.
            self.sum_unit_loads(0.0)?;
        }
        Ok(PreparedStep { simulation: self, dt, is_fetched: false })
    }

    /// Evaluates the current state of all regions.
    pub(super) fn evaluate_regions(&mut self) {
        self.for_each_region(|_, region| region.evaluate());
    }

    /// Evaluates the current state: neighbours, boundary densities and rates.
    fn evaluate(&mut self) {
        self.solver.sort(&mut self.water, &self.boundary);
        self.solver.build_neighbour_lists(&self.water, &self.boundary);
        self.solver.boundary_densities(&mut self.boundary);
        self.solver.rates();
    }

    /// Returns the longest stable time step for the current state [s].
    ///
    /// # Errors
    /// If a rate is not finite, or the device is lost.
    fn longest_step(&mut self) -> Result<f64, Failure> {
        let limits = self.solver.limits()?;
        let dt = limits.time_step(self.solver.parameters());
        if !(limits.acceleration.is_finite() && limits.signal_speed.is_finite() && dt > 0.0) {
            self.fetch()?;
            return Err(failure::not_finite(self));
        }
        Ok(dt)
    }

    /// Makes a time step of this region: predictor, rates at the half step, corrector, loads on the units, impermeable
    /// surfaces, motion of the units, flow through open ends. The current state must be evaluated.
    ///
    /// # Errors
    /// As for [`PreparedStep::finish`].
    fn advance(&mut self, dt: f64) -> Result<(), Failure> {
        self.absorb(dt);
        self.predict(dt);
        self.solver.rates();
        self.drive_buffers();
        self.solver.correct(dt, &mut self.water, &mut self.boundary);
        self.relax_in_zones(dt);
        self.sum_unit_loads(dt)?;
        self.remove_velocities_into_solids(dt)?;
        if let Some(memory) = self.solver.device_memory() {
            memory.sort_ahead();
        }
        self.advance_units(dt)?;
        self.time += dt;
        self.steps += 1;
        self.statistics.count_step(dt);
        self.exchange_water();
        self.place_boundary();
        self.watch_water()
    }

    /// Makes one time step; returns the length of the time step [s].
    ///
    /// # Errors
    /// As for [`Self::begin_step`] and [`PreparedStep::finish`].
    pub fn step(&mut self) -> Result<f64, Failure> {
        let step = self.begin_step()?;
        let dt = step.dt();
        step.finish()?;
        Ok(dt)
    }

    /// Makes one time step of the water alone: all boundaries stay where they are, and no surface stops particles. The
    /// benchmark compares its duration with the duration of [`Self::step`].
    pub(crate) fn step_water_alone(&mut self) -> Result<(), Failure> {
        let PreparedStep { simulation, dt, .. } = self.begin_step()?;
        simulation.solver.predict(dt, &simulation.water, &mut simulation.boundary, &mut |_| ());
        simulation.solver.rates();
        simulation.solver.correct(dt, &mut simulation.water, &mut simulation.boundary);
        Ok(())
    }

    /// Advances water, moving ends and units to the half step.
    fn predict(&mut self, dt: f64) {
        let (ends, units) = (&self.ends, &self.units);
        let half_time = self.flume_time() + 0.5 * dt;
        self.solver.predict(dt, &self.water, &mut self.boundary, &mut |boundary| {
            move_ends(boundary, ends, half_time, 0.5 * dt);
            if let Some(units) = units {
                units.states().iter().enumerate().for_each(|(k, s)| boundary.move_unit(k, &drifted(s, 0.5 * dt)));
            }
        });
    }

    /// Sums the forces and torques of the water on the units at the half step.
    fn sum_unit_loads(&mut self, dt: f64) -> Result<(), Failure> {
        let Some(units) = &mut self.units else { return Ok(()) };
        let centres: Vec<DVec3> = units.states().iter().map(|s| drifted(s, 0.5 * dt).position).collect();
        let loads = self.solver.unit_loads(&self.boundary, &centres)?;
        // In two dimensions, the particles represent only one slice of each unit: multiply by the number of slices.
        let slices: Vec<f64> = units.each().map(|(group, _)| group.slices).collect();
        units.fluid_loads = loads.into_iter().zip(slices).map(|(load, slices)| load.map(|sum| slices * sum)).collect();
        Ok(())
    }

    /// Moves the units over a time step under the loads of the water. Units do not move before `numerics.hold_units_s`.
    fn advance_units(&mut self, dt: f64) -> Result<(), Failure> {
        let Some(units) = &mut self.units else { return Ok(()) };
        if self.time >= self.case.numerics.hold_units {
            let Units { world, fluid_loads, water_at_impacts, recorded, groups, start, .. } = units;
            let since = world.time();
            if let Err(error) =
                drive(world, groups, start, [self.time, dt]).and_then(|()| world.advance(dt, fluid_loads))
            {
                return Err(failure::of_units(self, error));
            }
            if world.impacts_with_peak_after(since).next().is_some()
                && let Some(memory) = self.solver.device_memory()
            {
                memory.fetch_boundary_densities(&mut self.boundary)?;
            }
            let units_now = RecordedUnits { world, loads: fluid_loads, recorded: recorded.clone() };
            water_at_impacts.note(&units_now, since, &self.boundary, &self.solver.parameters().tait);
            for (((group, _), state), rocking) in units.each().zip(units.states()).zip(&mut self.statistics.rocking) {
                rocking.add(state.rotation, group.limits.rocking_deg.to_radians());
            }
        } else if self.time >= 0.5 * self.case.numerics.hold_units {
            self.statistics.count_still_loads(&units.fluid_loads);
        }
        units.mean_loads.add(dt, &units.fluid_loads, units.world.contact_loads());
        Ok(())
    }

    /// Returns a sampler of the water. [`Self::begin_step`] must have evaluated the current state, and the arrays in
    /// host memory must contain this state.
    pub fn sampler(&self) -> Sampler<'_> {
        let parameters = self.solver.parameters();
        Sampler {
            grid: self.solver.grid(),
            bins: self.solver.water_bins(),
            water: &self.water,
            boundary: &self.boundary,
            boundary_bins: self.solver.boundary_bins(),
            kernel: parameters.kernel,
            tait: parameters.tait,
            gravity: parameters.gravity,
            porous: self.porous.as_deref(),
        }
    }
}

impl PreparedStep<'_> {
    /// Returns the length of the next time step [s].
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Copies water and boundary from a graphics card to the arrays in host memory, once per time step.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn fetch(&mut self) -> Result<(), DeviceError> {
        if !self.is_fetched {
            self.simulation.fetch()?;
            self.is_fetched = true;
        }
        Ok(())
    }

    /// Returns a sampler of pressure, velocity and free surface at any point.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn sampler(&mut self) -> Result<Sampler<'_>, DeviceError> {
        self.fetch()?;
        Ok(self.simulation.sampler())
    }

    /// Returns the current powers that the water of all regions receives from boundaries, viscosity and density
    /// diffusion [W].
    ///
    /// # Errors
    /// If the device is lost.
    pub fn powers(&mut self) -> Result<Powers, DeviceError> {
        self.fetch()?;
        let Simulation { solver, water, coarse, .. } = &mut *self.simulation;
        let mut powers = solver.powers(water)?;
        for region in coarse {
            powers.add(region.solver.powers(&region.water)?);
        }
        Ok(powers)
    }

    /// Makes the time step in all regions; the finest region makes several shorter time steps. Before, the fine water
    /// follows the units; afterwards, particles enter and leave the buffers between the regions.
    ///
    /// # Errors
    /// If a particle has left the domain or has an impossible density, if units overlap each other or the bed too much,
    /// if a unit has reached the end of the finest region, or if the device is lost.
    pub fn finish(self) -> Result<(), Failure> {
        let (simulation, dt) = (self.simulation, self.dt);
        simulation.sum_gauge_values(dt);
        if simulation.coarse.is_empty() {
            return simulation.advance(dt);
        }
        let (time, step) = (simulation.time, simulation.steps);
        simulation.follow_units().map_err(|error| Failure::Regions { time, step, reason: error.to_string() })?;
        // Not before the outputs: a checkpoint must not contain buffers that are already set.
        simulation.couple();
        let end = simulation.time + dt;
        for region in &mut simulation.coarse {
            region.advance(dt)?;
            simulation.statistics.add_region(&mut region.statistics);
        }
        loop {
            let left = end - simulation.time;
            let steps = (left / simulation.longest_step()?).ceil();
            simulation.advance(left / steps)?;
            if steps <= 1.0 {
                break;
            }
            simulation.evaluate();
            simulation.drive_buffers();
        }
        simulation.for_each_region(|_, region| region.time = end);
        simulation.exchange_between_regions(dt);
        failure::find_unit_outside(simulation).map_or(Ok(()), Err)
    }
}

/// Gives fixed units with a path the velocities with which they follow it over a time step `dt` from `time` [s] on.
fn drive(
    world: &mut RigidWorld,
    groups: &[UnitGroup],
    start: &[BodyState],
    [time, dt]: [f64; 2],
) -> Result<(), RigidError> {
    for group in groups {
        let Some(way) = &group.way else { continue };
        for unit in group.members.clone() {
            let to = start[unit].position + way.displacement(time + dt);
            let velocity = (to - world.states()[unit].position) / dt;
            world.drive(unit, velocity)?;
        }
    }
    Ok(())
}

/// Returns the state of a body after a time `dt` [s] at constant velocity and angular velocity.
fn drifted(state: &BodyState, dt: f64) -> BodyState {
    let turn = glam::DQuat::from_scaled_axis(state.angular_velocity * dt);
    BodyState {
        position: state.position + dt * state.velocity,
        rotation: (turn * state.rotation).normalize(),
        ..*state
    }
}
