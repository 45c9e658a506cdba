//! The coupled loop: water, wavemaker, units, contact.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`setup`], [`scheme`] | make a simulation of a case |
//! | [`incoming`] | make its wave, in the flume model or by a paddle |
//! | [`step`] | one time step, in the order of the algorithm |
//! | `impermeable` | keeping water out of solids |
//! | `zones` | water that goes over to a velocity of its own at the ends of the domain |
//! | `absorb` | a piston that takes up the waves that come back |
//! | [`failure`] | what can go wrong in a step, and finding out where |
//! | [`energy`], [`balance`] | energy of water and units, and where it goes |
//! | [`extremes`] | the fastest, the lightest and the densest water |
//! | `diagnostics` | whether the run is sound |
//! | [`mean_loads`] | loads on the units as the series show them |
//! | [`water_at_impacts`] | the water at the units when their impacts are hardest |
//! | [`statistics`] | what is kept of a run besides its series |
//! | [`rest`] | whether the units have come to rest |
//! | [`recorder`] | writes the series and snapshots |
//! | [`snapshots`] | moments of water and units for ParaView |
//! | [`checkpoint`] | state to and from HDF5 |
//! | [`run`] | the loop with outputs, checkpoints and stop rules |
//! | [`branch`] | runs that begin where another one stands |
//! | [`summary`] | the run in a few numbers |

mod absorb;
pub mod balance;
pub mod branch;
pub mod checkpoint;
mod diagnostics;
pub mod energy;
pub mod extremes;
pub mod failure;
mod impermeable;
pub mod incoming;
pub mod mean_loads;
pub mod recorder;
pub mod recorder_state;
pub mod rest;
pub mod run;
pub mod scheme;
pub mod setup;
pub mod snapshots;
pub mod statistics;
pub mod step;
pub mod summary;
pub mod water_at_impacts;
mod zones;

use std::sync::Arc;

use glam::DVec3;

use crate::{
    case::{Case, Gauge, Motion},
    geometry::armour_unit::ArmourUnit,
    rigid::{BodyState, Load, RigidWorld},
    sph::{
        backend::{Backend, DeviceError},
        particles::{bed::Outline, boundary::Boundary, water::Water},
        rates::Rate,
    },
    waves::{absorption::AbsorptionState, record::FlumeRecord, wavemaker::Wavemaker},
};
use absorb::move_wavemaker;
use mean_loads::MeanLoads;
use statistics::Statistics;
use water_at_impacts::WaterAtImpacts;

/// A case in motion.
pub struct Simulation {
    /// The case.
    pub case: Arc<Case>,
    /// The flume model's run, if the wave comes from it.
    pub flume: Option<FlumeRecord>,
    /// The water.
    pub water: Water,
    /// Bed, walls, wavemaker and units as particles.
    pub boundary: Boundary,
    /// The units as bodies, if there are any.
    pub units: Option<Units>,
    /// Time since the particles started [s].
    pub time: f64,
    /// Steps made.
    pub steps: u64,
    /// Flume time at which the particles started [s].
    pub start: f64,
    /// Time since the particles started at which the crest of a solitary wave stands over all units, by the flume
    /// model [s]; 0 for other waves.
    pub crest: f64,
    /// What is kept of the run.
    pub statistics: Statistics,
    solver: Box<dyn Backend>,
    pub wavemaker: Option<Wavemaker>,
    /// Where absorption has carried it.
    pub absorbed: AbsorptionState,
    /// Bed, mound and end walls.
    outline: Outline,
    /// Box that no particle may leave [m].
    bounds: [DVec3; 2],
}

/// The armour units.
pub struct Units {
    /// Their shape.
    pub shape: Arc<ArmourUnit>,
    /// Their bodies.
    pub world: RigidWorld,
    /// Where they stood at the start.
    pub start: Vec<BodyState>,
    /// Force and torque of the water on each, at the last half step.
    pub fluid_loads: Vec<Load>,
    /// What the next row of the series will show of the loads.
    pub mean_loads: MeanLoads,
    /// The water when their impacts were hardest.
    pub water_at_impacts: WaterAtImpacts,
}

impl Simulation {
    /// Put wavemaker and units where they are now.
    pub fn place_boundary(&mut self) {
        let flume_time = self.flume_time();
        move_wavemaker(&mut self.boundary, self.wavemaker.as_ref(), &self.absorbed, flume_time, 0.0);
        if let Some(units) = &self.units {
            units.states().iter().enumerate().for_each(|(k, s)| self.boundary.move_unit(k, s));
        }
    }

    /// Time of the flume model [s].
    pub fn flume_time(&self) -> f64 {
        self.start + self.time
    }

    /// Place of the foremost row of the wavemaker [m], if there is one.
    pub fn wavemaker_front(&self) -> Option<f64> {
        let front = |wavemaker: &Wavemaker| wavemaker.front_m(self.flume_time()) + self.absorbed.displacement_m;
        self.wavemaker.as_ref().map(front)
    }

    /// Where a gauge is now [m].
    pub fn place_of(&self, gauge: &Gauge) -> DVec3 {
        let at = DVec3::from_array(gauge.at);
        match (&gauge.motion, &self.units) {
            (Motion::OnUnit(unit), Some(units)) => {
                let (now, start) = (&units.states()[*unit], &units.start[*unit]);
                now.position + now.rotation * (start.rotation.inverse() * (at - start.position))
            }
            _ => at + DVec3::from_array(gauge.displacement(self.time)),
        }
    }

    /// What computes the water.
    pub fn solver(&self) -> &dyn Backend {
        &*self.solver
    }

    /// Rates of the water found last, in the order of its arrays once they are fetched.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        self.solver.water_rates()
    }

    /// Bring water and boundary up to date in the host's arrays; between two steps and between their halves.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn fetch(&mut self) -> Result<(), DeviceError> {
        self.solver.fetch(&mut self.water, &mut self.boundary)
    }

    /// Whether the water lies with a device and not in the host's arrays.
    pub fn is_on_card(&self) -> bool {
        self.solver.keeps_water()
    }

    /// Give water and boundary of the host's arrays to the device.
    ///
    /// # Errors
    /// If it has not enough memory.
    pub fn load(&mut self) -> Result<(), DeviceError> {
        self.solver.load(&self.water, &self.boundary)
    }
}

impl Units {
    /// Places and motions.
    pub fn states(&self) -> &[BodyState] {
        self.world.states()
    }

    /// Horizontal distance of each unit from where it stood [m].
    pub fn displacements(&self) -> Vec<f64> {
        let moved = |(now, start): (&BodyState, &BodyState)| (now.position - start.position).truncate().length();
        self.states().iter().zip(&self.start).map(moved).collect()
    }
}
