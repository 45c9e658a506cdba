//! Dry tests: units on a bed without water (settling test, drop test, tilt test).
//!
//! | file | what it does |
//! | --- | --- |
//! | this file | state, time step and measurements |
//! | [`run`] | the loop with outputs, checkpoints and stop criteria |
//! | [`recorder`] | tables and surfaces |
//! | [`summary`] | `summary.json` |

pub mod recorder;
pub mod run;
pub mod summary;

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::{
    case::{DryTestCase, DryTestKind},
    rigid::{BodyState, Load, RigidError, RigidSetup, RigidWorld},
    simulation::bodies::rigid_setup,
};

/// Time between two measurements of the units [s]; the substeps of the contact solver are much shorter.
const MEASUREMENT_INTERVAL: f64 = 1e-3;

/// Time for which the bed stays level before it is tilted [s].
const LEVEL_TIME: f64 = 0.5;

/// A dry test: case, bodies and measurements.
pub struct DryTest {
    /// The case.
    pub case: Arc<DryTestCase>,
    /// Solver of the rigid bodies: units, bed and contacts.
    pub world: RigidWorld,
    /// Poses of the units at the start.
    pub start: Vec<BodyState>,
    /// Measurements since the start.
    pub measured: Measured,
}

/// Measurements that the tables do not contain; part of every checkpoint.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Measured {
    /// Slope of the bed at which each unit began to slide [rad]; `None` for a unit that has not begun to slide.
    pub slides_at: Vec<Option<f64>>,
    /// Mechanical energy at the start: sum of kinetic, potential and elastic energy [J].
    pub energy_start: f64,
    /// Mechanical energy at the last measurement [J].
    pub energy: f64,
    /// Largest rise of the mechanical energy between two successive measurements [J]; 0 in a tilt test, which does not
    /// measure this rise.
    pub largest_rise: f64,
    /// Time at which all units came to rest [s]; `None` while a unit moves or if the case has no rest criterion.
    pub at_rest_since: Option<f64>,
    /// Number of recorded contacts: first those with bed and walls, then those between units.
    pub contacts: [u64; 2],
    /// Largest force of any recorded contact [N].
    pub peak_force: f64,
    /// Wall time of all sessions of the run [s].
    pub wall_s: f64,
}

impl DryTest {
    /// Places the units of a case at their start positions.
    ///
    /// # Errors
    /// If units overlap each other or the ground too much.
    pub fn new(case: Arc<DryTestCase>) -> Result<Self, RigidError> {
        let world = RigidWorld::new(Self::setup(&case))?;
        let start = world.states().to_vec();
        let mut measured = Measured { slides_at: vec![None; start.len()], ..Measured::default() };
        measured.energy_start = mechanical_energy(&world);
        measured.energy = measured.energy_start;
        Ok(Self { case, world, start, measured })
    }

    /// Returns the set-up of the rigid-body solver for a case.
    pub fn setup(case: &DryTestCase) -> RigidSetup {
        rigid_setup(&case.units, &case.site, &case.materials, case.contact.law, case.gravity)
    }

    /// Returns the time since the start [s].
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Returns the current slope of the bed [rad].
    pub fn slope(&self) -> f64 {
        match self.case.test {
            DryTestKind::Tilt { rate, to, .. } => (rate * (self.time() - LEVEL_TIME)).clamp(0.0, to),
            DryTestKind::Settle | DryTestKind::Drop => 0.0,
        }
    }

    /// Advances to the next measurement, or to the time `until` [s] if this time is earlier.
    ///
    /// # Errors
    /// If units overlap each other or the ground too much.
    pub fn advance(&mut self, until: f64) -> Result<(), RigidError> {
        let loads = vec![Load::default(); self.start.len()];
        let left = until - self.time();
        // Rounding errors of the time must not shorten the last step, so that a resumed run makes the same steps.
        let is_shorter = left < (1.0 - 1e-6) * MEASUREMENT_INTERVAL;
        let dt = if is_shorter { left.max(0.0) } else { MEASUREMENT_INTERVAL };
        if let DryTestKind::Tilt { .. } = self.case.test {
            let slope = self.slope();
            // The axes are fixed to the bed. Instead of the bed, the direction of gravity is tilted, towards the shore.
            self.world.set_gravity(self.case.gravity * DVec3::new(slope.sin(), 0.0, -slope.cos()));
        }
        self.world.advance(dt, &loads)?;
        self.measure();
        Ok(())
    }

    fn measure(&mut self) {
        let energy = mechanical_energy(&self.world);
        if !matches!(self.case.test, DryTestKind::Tilt { .. }) {
            self.measured.largest_rise = self.measured.largest_rise.max(energy - self.measured.energy);
        }
        self.measured.energy = energy;
        let (slope, time) = (self.slope(), self.time());
        if let DryTestKind::Tilt { slide_speed, .. } = self.case.test
            && slope > 0.0
        {
            for (slides_at, state) in self.measured.slides_at.iter_mut().zip(self.world.states()) {
                if slides_at.is_none() && state.velocity.length() > slide_speed {
                    *slides_at = Some(slope);
                }
            }
        }
        if let Some(rule) = &self.case.stop.at_rest {
            let at_rest = self.fastest() < rule.speed;
            let since = &mut self.measured.at_rest_since;
            *since = if at_rest { since.or(Some(time)) } else { None };
        }
    }

    /// Returns the speed of the fastest unit [m/s]: the speed of the centre plus the speed of the tips by rotation. The
    /// tips are half a unit height from the centre.
    pub fn fastest(&self) -> f64 {
        let tips = 0.5 * self.case.units.tallest();
        let speed = |state: &BodyState| state.velocity.length() + tips * state.angular_velocity.length();
        self.world.states().iter().map(speed).fold(0.0, f64::max)
    }
}

/// Returns the sum of kinetic, potential and elastic energy [J].
fn mechanical_energy(world: &RigidWorld) -> f64 {
    let energy = world.energy();
    energy.kinetic + energy.potential + energy.elastic
}
