//! Units on a bed without water: settling, drops, slope tests.
//!
//! | file | what it does |
//! | --- | --- |
//! | this one | the test: what moves, what is measured |
//! | [`run`] | the loop with outputs, checkpoints and stop rules |
//! | [`recorder`] | tables and surfaces |
//! | [`summary`] | the run in a few numbers |

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

/// Time between two looks at the units [s]; the steps of the contact are far shorter.
const LOOK: f64 = 1e-3;

/// For this long the units stand on the level before it is tilted [s].
const STANDING: f64 = 0.5;

/// A dry case in motion.
pub struct DryTest {
    /// The case.
    pub case: Arc<DryTestCase>,
    /// The units.
    pub world: RigidWorld,
    /// Where they stood at the start.
    pub start: Vec<BodyState>,
    /// What is measured.
    pub measured: Measured,
}

/// What is measured in a dry run besides its series; part of every checkpoint.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Measured {
    /// Slope at which each unit began to slide [rad].
    pub slides_at: Vec<Option<f64>>,
    /// Kinetic, potential and elastic energy at the start and at the last look [J].
    pub energy_start: f64,
    /// The same at the last look [J].
    pub energy: f64,
    /// Largest rise of that energy between two looks, while gravity stays as it is [J].
    pub largest_rise: f64,
    /// Since when all units have been at rest [s].
    pub at_rest_since: Option<f64>,
    /// Contacts that have ended, with the ground and between units.
    pub contacts: [u64; 2],
    /// Largest force of a contact [N].
    pub peak_force: f64,
}

impl DryTest {
    /// The units of a case at its start.
    ///
    /// # Errors
    /// If they start too deep in each other or the ground.
    pub fn new(case: Arc<DryTestCase>) -> Result<Self, RigidError> {
        let setup = Self::setup(&case);
        let start = setup.bodies.clone();
        let world = RigidWorld::new(setup)?;
        let mut measured = Measured { slides_at: vec![None; start.len()], ..Measured::default() };
        measured.energy_start = mechanical(&world);
        measured.energy = measured.energy_start;
        Ok(Self { case, world, start, measured })
    }

    /// What the world of a case is made of.
    pub fn setup(case: &DryTestCase) -> RigidSetup {
        rigid_setup(&case.units, &case.site, &case.materials, case.contact.law, case.gravity)
    }

    /// Time since the start [s].
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Slope of the bed now [rad].
    pub fn slope(&self) -> f64 {
        match self.case.test {
            DryTestKind::Tilt { rate, to, .. } => (rate * (self.time() - STANDING)).clamp(0.0, to),
            DryTestKind::Settle | DryTestKind::Drop => 0.0,
        }
    }

    /// Go on to the next look, or to `until` [s] if that comes before it.
    ///
    /// # Errors
    /// If the units have gone too deep into each other or the ground.
    pub fn advance(&mut self, until: f64) -> Result<(), RigidError> {
        let loads = vec![Load::default(); self.start.len()];
        let dt = LOOK.min(until - self.time()).max(0.0);
        if let DryTestKind::Tilt { .. } = self.case.test {
            let slope = self.slope();
            // Seen from the bed, gravity turns towards the shore.
            self.world.set_gravity(self.case.gravity * DVec3::new(slope.sin(), 0.0, -slope.cos()));
        }
        self.world.advance(dt, &loads)?;
        self.look();
        Ok(())
    }

    fn look(&mut self) {
        let energy = mechanical(&self.world);
        if !matches!(self.case.test, DryTestKind::Tilt { .. }) {
            self.measured.largest_rise = self.measured.largest_rise.max(energy - self.measured.energy);
        }
        self.measured.energy = energy;
        let (slope, time) = (self.slope(), self.time());
        if let DryTestKind::Tilt { slide_speed, .. } = self.case.test
            && slope > 0.0
        {
            for (at, state) in self.measured.slides_at.iter_mut().zip(self.world.states()) {
                if at.is_none() && state.velocity.length() > slide_speed {
                    *at = Some(slope);
                }
            }
        }
        if let Some(rule) = &self.case.stop.at_rest {
            let at_rest = self.fastest() < rule.speed;
            let since = &mut self.measured.at_rest_since;
            *since = if at_rest { since.or(Some(time)) } else { None };
        }
    }

    /// Speed of the fastest unit [m/s], that of its tips if it turns: they are about half its height away.
    pub fn fastest(&self) -> f64 {
        let tips = 0.5 * self.case.units.shape.height();
        let speed = |state: &BodyState| state.velocity.length() + tips * state.angular_velocity.length();
        self.world.states().iter().map(speed).fold(0.0, f64::max)
    }
}

/// Kinetic, potential and elastic energy [J].
fn mechanical(world: &RigidWorld) -> f64 {
    let energy = world.energy();
    energy.kinetic + energy.potential + energy.elastic
}
