//! Failures of a time step: cause, position, and advice to the user.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

use super::{Simulation, measures::extremes::Extremes};
use crate::{
    case::{UnitGroup, UnitModel},
    rigid::{BodyState, RigidError},
    sph::{particles::water::Water, solver::backend::DeviceError},
};

/// Relative change of density above which a run fails [-]. DualSPHysics removes particles outside 700 to 1300 kg/m3 by
/// default. In a coarse run of a dam break that hits a unit at Mach 0.17, the density changes by at most 5 %.
pub(super) const LARGEST_COMPRESSION: f64 = 0.3;

/// Usual causes of unstable water.
const UNSTABLE_ADVICE: &str = "likely causes: the time step is too long (lower numerics.cfl), the speed of sound is \
     too low for the flow (raise fluid.sound_speed_factor), or the particles are too coarse for the geometry there \
     (lower domain.dp_m); diagnostics.csv shows whether speeds and densities were already unusual before this time";

/// A water particle in a message; unknown values are NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Number of the particle, the same throughout the run.
    pub id: u32,
    /// Position [m].
    pub place: DVec3,
    /// Speed [m/s].
    pub speed: f64,
    /// Density [kg/m3].
    pub density: f64,
}

impl Particle {
    /// Returns the water particle with this index in the arrays of `water`.
    pub(super) fn of(water: &Water, index: usize) -> Self {
        Self {
            id: water.id[index],
            place: water.position[index],
            speed: water.velocity[index].length(),
            density: water.density[index],
        }
    }
}

impl fmt::Display for Particle {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.place;
        write!(
            out,
            "water particle {} at x = {x:.3}, y = {y:.3}, z = {z:.3} m, with speed {:.2} m/s and density {:.1} kg/m3",
            self.id, self.speed, self.density
        )
    }
}

/// Reason why a flume run failed. Times [s] count from the start of the particles; lengths [m], speeds [m/s].
#[derive(Debug, Error)]
pub enum Failure {
    /// A position, velocity, density or rate of the water is not finite.
    #[error("the water has become unstable after {time:.4} s (step {step}): {what}: {particle}; {UNSTABLE_ADVICE}")]
    Unstable { time: f64, step: u64, what: &'static str, particle: Particle },
    /// The density of the water differs too much from the density at rest.
    #[error(
        "the water has become unstable after {time:.4} s (step {step}): {particle}, {change:+.0} % from the {rho0} \
         kg/m3 of water at rest; {UNSTABLE_ADVICE}"
    )]
    Density { time: f64, step: u64, particle: Particle, change: f64, rho0: f64 },
    /// A particle has left the domain.
    #[error("after {time:.4} s (step {step}) {particle} has left the domain: {advice}")]
    Escaped { time: f64, step: u64, particle: Particle, advice: &'static str },
    /// A unit overlaps another body more than the contact law allows.
    #[error(
        "after {time:.4} s (step {step}) unit {unit} at x = {:.3}, y = {:.3}, z = {:.3} m, with {speed:.2} m/s, \
         overlaps {partner} by {:.3} mm; its rounding radius allows at most {:.3} mm. The contact is too soft for this \
         impact: raise young_modulus_pa of the material or contact.rounding_share, and check in diagnostics.csv \
         whether the water is stable", place.x, place.y, place.z, depth * 1e3, allowed * 1e3
    )]
    TooDeep {
        time: f64,
        step: u64,
        /// Number of the unit, from 1.
        unit: usize,
        place: DVec3,
        speed: f64,
        partner: String,
        depth: f64,
        allowed: f64,
    },
    /// The motion of a unit is not a finite number.
    #[error(
        "after {time:.4} s (step {step}) the motion of unit {unit}, last at x = {:.3}, y = {:.3}, z = {:.3} m with \
         speed {speed:.2} m/s, is no longer a finite number; the water around the unit is probably unstable; \
         {UNSTABLE_ADVICE}",
        place.x, place.y, place.z
    )]
    UnitNotFinite { time: f64, step: u64, unit: usize, place: DVec3, speed: f64 },
    /// A unit has reached the end of the finest region, which is as near to the end of the domain as possible.
    #[error(
        "after {time:.4} s (step {step}): unit {unit} at ({:.3}, {:.3}, {:.3}) has reached the end of the fine water, \
         which cannot follow it further; move domain.x_m outwards, or leave out domain.fine_x_m", place.x, place.y, place.z
    )]
    LeftFineWater { time: f64, step: u64, unit: usize, place: DVec3 },
    /// The regions of different particle spacing cannot move.
    #[error("after {time:.4} s (step {step}) the fine water cannot follow the units: {reason}")]
    Regions { time: f64, step: u64, reason: String },
    /// The device that computes the water has failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The rigid-body solver has failed for another reason.
    #[error("after {time:.4} s (step {step}): {source}")]
    Units { time: f64, step: u64, source: RigidError },
}

/// Returns the failure for a particle whose state is not finite. Prefers a particle whose position is still finite. If
/// all states are finite and only a rate is not, the failure names the fastest particle.
pub(super) fn not_finite(simulation: &Simulation) -> Failure {
    let water = &simulation.water;
    let first = |bad: &dyn Fn(usize) -> bool| (0..water.len()).find(|&i| bad(i));
    let bad =
        first(&|i| !is_finite(water, i) && water.position[i].is_finite()).or_else(|| first(&|i| !is_finite(water, i)));
    let speed = |i: usize| water.velocity[i].length_squared();
    let (what, index) = match bad {
        Some(i) => ("position, velocity or density is no longer a finite number", Some(i)),
        None => (
            "an acceleration or a density rate is no longer a finite number; fastest particle",
            (0..water.len()).max_by(|&a, &b| speed(a).total_cmp(&speed(b))),
        ),
    };
    let unknown = Particle { id: 0, place: DVec3::NAN, speed: f64::NAN, density: f64::NAN };
    let particle = index.map_or(unknown, |i| Particle::of(water, i));
    Failure::Unstable { time: simulation.time, step: simulation.steps, what, particle }
}

fn is_finite(water: &Water, i: usize) -> bool {
    water.position[i].is_finite() && water.velocity[i].is_finite() && water.density[i].is_finite()
}

/// Returns the failure for the first particle that is outside the domain or whose state is not finite; `None` if there
/// is no such particle.
pub(super) fn find_escape(simulation: &Simulation) -> Option<Failure> {
    use rayon::prelude::*;
    let [low, high] = simulation.bounds;
    let water = &simulation.water;
    let inside = |p: DVec3| p.cmpge(low).all() && p.cmple(high).all();
    let particles = (0..water.len()).into_par_iter().with_min_len(4096);
    let i = particles.find_first(|&i| !inside(water.position[i]) || !is_finite(water, i))?;
    if !is_finite(water, i) {
        return Some(not_finite(simulation));
    }
    let advice = if water.position[i].z > high.z {
        "the splash is higher than the walls: raise domain.top_z_m"
    } else {
        "the particle went through a wall or the bed: lower domain.dp_m, raise numerics.boundary_layers, or check \
         that the walls reach above the water"
    };
    let (time, step) = (simulation.time, simulation.steps);
    Some(Failure::Escaped { time, step, particle: Particle::of(water, i), advice })
}

/// Returns the failure for the first unit that has reached the end of the finest region; `None` if there is no such
/// unit.
pub(super) fn find_unit_outside(simulation: &Simulation) -> Option<Failure> {
    let units = simulation.units.as_ref()?;
    let [from, to] = simulation.own_x();
    let is_outside = |((_, model), state): ((&UnitGroup, &UnitModel), &BodyState)| {
        let tips = 0.5 * model.shape.height() + simulation.case.numerics.h;
        state.position.x - tips < from || state.position.x + tips > to
    };
    let unit = units.each().zip(units.states()).position(is_outside)?;
    let (time, step, place) = (simulation.time, simulation.steps, units.states()[unit].position);
    Some(Failure::LeftFineWater { time, step, unit: unit + 1, place })
}

/// Returns the failure for the particle of highest or lowest density, if this density differs too much from the density
/// of water at rest; otherwise `None`.
pub(super) fn find_wrong_density(simulation: &Simulation, extremes: &Extremes) -> Option<Failure> {
    let rho0 = simulation.case.fluid.rho0;
    let change = |density: f64| density / rho0 - 1.0;
    let (density, i) =
        [extremes.densest, extremes.lightest].into_iter().find(|(rho, _)| change(*rho).abs() > LARGEST_COMPRESSION)?;
    Some(Failure::Density {
        time: simulation.time,
        step: simulation.steps,
        particle: Particle::of(&simulation.water, i),
        change: 100.0 * change(density),
        rho0,
    })
}

/// Converts an error of the rigid-body solver to a failure of the run. The failure states the time of the run. The time
/// in the error is different, because the time of the rigid-body solver starts at the release of the units.
pub(super) fn of_units(simulation: &Simulation, error: RigidError) -> Failure {
    let (time, step) = (simulation.time, simulation.steps);
    let last = |body: usize| {
        let state = simulation.units.as_ref().and_then(|units| units.states().get(body));
        state.map_or((DVec3::NAN, f64::NAN), |state| (state.position, state.velocity.length()))
    };
    match error {
        RigidError::TooDeep { body, partner, depth, allowed, .. } => {
            let (place, speed) = last(body);
            Failure::TooDeep { time, step, unit: body + 1, place, speed, partner, depth, allowed }
        }
        RigidError::NotFinite { body, .. } => {
            let (place, speed) = last(body);
            Failure::UnitNotFinite { time, step, unit: body + 1, place, speed }
        }
        source => Failure::Units { time, step, source },
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::sync::Arc;

    use serde_json::{Value, json};

    use super::*;
    use crate::case::Case;

    /// Returns the case of a tank of still water with 25 x 10 x 10 particles.
    fn tank_case() -> Value {
        json!({
            "title": "Still water",
            "flume": { "bed_m": [[0.0, 0.0], [0.5, 0.0]], "still_water_level_m": 0.2, "material": "mortar" },
            "domain": { "x_m": [0.0, 0.5], "width_m": 0.2, "sides": "periodic", "top_z_m": 0.4, "dp_m": 0.02 },
            "numerics": { "hold_units_s": 0.0 },
            "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
            "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
            "stop": { "duration_s": 1.0 }
        })
    }

    fn simulation(case: &Value) -> Simulation {
        let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
        Simulation::new(Arc::new(case)).unwrap()
    }

    pub fn tank() -> Simulation {
        simulation(&tank_case())
    }

    /// Returns the tank with a Tetrapod that is free to move from the start.
    fn tank_with_unit() -> Simulation {
        let mut case = tank_case();
        case["units"] = json!({
            "shape": "tetrapod", "height_m": 0.16, "mass_kg": 2.5, "material": "mortar",
            "count": 1, "pitch_m": 0.2, "x_m": 0.25
        });
        simulation(&case)
    }

    /// Makes up to three time steps, of which one must fail; returns the error message.
    fn failure(simulation: &mut Simulation) -> String {
        for _ in 0..3 {
            let done = simulation.step();
            if let Err(failure) = done {
                return failure.to_string();
            }
        }
        panic!("the run does not fail");
    }

    fn assert_names(message: &str, parts: &[&str]) {
        parts.iter().for_each(|part| assert!(message.contains(part), "\"{part}\" is missing:\n{message}"));
    }

    #[test]
    fn a_state_that_is_not_finite_stops_the_run() {
        let mut simulation = tank();
        simulation.step().unwrap();
        let (id, place) = (simulation.water.id[400], simulation.water.position[400]);
        let named = format!("water particle {id} at x = {:.3}, y = {:.3}, z = {:.3} m", place.x, place.y, place.z);
        // One particle has no valid velocity, another no valid position: the message names the particle with a valid
        // position.
        simulation.water.velocity[400].x = f64::NAN;
        simulation.water.position[100].y = f64::NAN;
        let message = simulation.watch_water().unwrap_err().to_string();
        assert_names(&message, &["after 0.0", "(step 1)", &named, "speed NaN m/s", "lower numerics.cfl"]);
    }

    #[test]
    fn a_rate_that_is_not_finite_stops_the_run() {
        let mut simulation = tank();
        simulation.water.density[400] = f64::INFINITY;
        let id = simulation.water.id[400];
        let message = failure(&mut simulation);
        assert_names(
            &message,
            &["(step 0)", &format!("water particle {id} at x = "), "density inf kg/m3", "lower domain.dp_m"],
        );
    }

    #[test]
    fn a_particle_above_the_walls_stops_the_run() {
        let mut simulation = tank();
        simulation.water.position[0].z = 2.0;
        let id = simulation.water.id[0];
        let message = failure(&mut simulation);
        assert_names(&message, &[&format!("water particle {id} at x = "), "z = 2.000 m", "raise domain.top_z_m"]);
    }

    #[test]
    fn a_particle_below_the_bed_stops_the_run() {
        let mut simulation = tank();
        simulation.water.position[0].z = -1.0;
        let message = find_escape(&simulation).unwrap().to_string();
        assert_names(&message, &["z = -1.000 m", "through a wall or the bed", "lower domain.dp_m"]);
    }

    #[test]
    fn an_impossible_density_stops_the_run() {
        for (density, change) in [(1500.0, "+50 %"), (600.0, "-40 %")] {
            let mut simulation = tank();
            let id = simulation.water.id[30];
            simulation.water.density[30] = density;
            let message = simulation.watch_water().unwrap_err().to_string();
            let particle = format!("water particle {id} at x = ");
            let has = format!("speed 0.00 m/s and density {density:.1} kg/m3, {change} from the 1000 kg/m3");
            assert_names(&message, &["after 0.0000 s (step 0)", &particle, &has, "raise fluid.sound_speed_factor"]);
        }
    }

    #[test]
    fn a_unit_that_overlaps_the_bed_too_much_stops_the_run() {
        let mut simulation = tank_with_unit();
        // Accelerate the unit into the bed with 1e5 times gravity.
        let units = simulation.units.as_mut().unwrap();
        units.world.set_gravity(DVec3::NEG_Z * 1e6);
        let message = failure(&mut simulation);
        assert_names(&message, &["unit 1 at x = 0.250", "overlaps the ground by ", "raise young_modulus_pa"]);
    }

    #[test]
    fn a_load_that_is_not_finite_stops_the_run() {
        let mut simulation = tank_with_unit();
        simulation.units.as_mut().unwrap().world.set_gravity(DVec3::NAN);
        let message = failure(&mut simulation);
        assert_names(&message, &["the motion of unit 1, last at x = 0.250", "no longer a finite number"]);
    }
}
