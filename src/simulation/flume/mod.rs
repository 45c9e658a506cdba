//! Flume runs: water, wavemaker, units and contact, coupled.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`setup`], [`scheme`] | simulation and SPH scheme of a case |
//! | [`incoming`] | wave of a case, from the flume model or a paddle |
//! | [`step`] | one time step, in the order of the algorithm |
//! | `impermeable` | impermeable surfaces of the solids |
//! | `zones` | damping and relaxation zones at the ends of the domain |
//! | `absorb` | active absorption of returning waves by a piston |
//! | [`failure`] | failures of a time step: cause, position, advice |
//! | [`energy`], [`balance`] | energy and energy balance of water and units |
//! | [`extremes`] | extremes of speed and density of the water |
//! | `diagnostics` | rows of `diagnostics.csv` and warnings |
//! | [`mean_loads`] | mean loads on the units over the interval of the series |
//! | [`water_at_impacts`] | water loads on the units at the peaks of their hardest impacts |
//! | [`statistics`] | extremes and counts of a run |
//! | [`rest`] | rest criterion |
//! | [`recorder`] | series, snapshots and checkpoints |
//! | [`snapshots`] | snapshots of water and units for ParaView |
//! | [`checkpoint`] | state of a run in an HDF5 file |
//! | [`run`] | the loop with outputs, checkpoints and stop rules |
//! | [`branch`] | runs that begin at the checkpoint of another run |
//! | [`summary`] | `summary.json` |

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

/// State of a flume run.
pub struct Simulation {
    /// The case.
    pub case: Arc<Case>,
    /// Record of the flume model, if the wave comes from it.
    pub flume: Option<FlumeRecord>,
    /// The water.
    pub water: Water,
    /// Bed, walls, wavemaker and units as particles.
    pub boundary: Boundary,
    /// The units as bodies, if there are any.
    pub units: Option<Units>,
    /// Time since the particles started [s].
    pub time: f64,
    /// Number of time steps made.
    pub steps: u64,
    /// Flume time at which the particles started [s].
    pub start: f64,
    /// Time since the particles started at which the crest of a solitary wave has reached all units in the flume model
    /// [s]; 0 for other waves.
    pub crest: f64,
    /// Extremes and counts of the run.
    pub statistics: Statistics,
    solver: Box<dyn Backend>,
    pub wavemaker: Option<Wavemaker>,
    /// Displacement of the wavemaker by absorption.
    pub absorbed: AbsorptionState,
    /// Bed, mound and end walls.
    outline: Outline,
    /// Box that no particle may leave [m].
    bounds: [DVec3; 2],
}

/// The armour units.
pub struct Units {
    /// Shape of the units.
    pub shape: Arc<ArmourUnit>,
    /// Rigid bodies of the units.
    pub world: RigidWorld,
    /// Poses of the units at the start.
    pub start: Vec<BodyState>,
    /// Force and torque of the water on each unit at the last half step.
    pub fluid_loads: Vec<Load>,
    /// Mean loads for the next row of the series.
    pub mean_loads: MeanLoads,
    /// Water loads at the peaks of the hardest impacts.
    pub water_at_impacts: WaterAtImpacts,
}

impl Simulation {
    /// Moves the particles of wavemaker and units to their present positions.
    pub fn place_boundary(&mut self) {
        let flume_time = self.flume_time();
        move_wavemaker(&mut self.boundary, self.wavemaker.as_ref(), &self.absorbed, flume_time, 0.0);
        if let Some(units) = &self.units {
            units.states().iter().enumerate().for_each(|(k, s)| self.boundary.move_unit(k, s));
        }
    }

    /// Returns the time of the flume model [s].
    pub fn flume_time(&self) -> f64 {
        self.start + self.time
    }

    /// Returns the position of the foremost row of the wavemaker [m], if there is one.
    pub fn wavemaker_front(&self) -> Option<f64> {
        let front = |wavemaker: &Wavemaker| wavemaker.front_m(self.flume_time()) + self.absorbed.displacement_m;
        self.wavemaker.as_ref().map(front)
    }

    /// Returns the present position of a gauge [m].
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

    /// Returns the solver of the water.
    pub fn solver(&self) -> &dyn Backend {
        &*self.solver
    }

    /// Returns the last rates of the water, in the order of its arrays after [`Self::fetch`].
    ///
    /// # Errors
    /// If the device is lost.
    pub fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        self.solver.water_rates()
    }

    /// Updates water and boundary in the host's arrays; allowed between time steps and between their halves.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn fetch(&mut self) -> Result<(), DeviceError> {
        self.solver.fetch(&mut self.water, &mut self.boundary)
    }

    /// Returns whether a device, and not the host, holds the water.
    pub fn is_on_card(&self) -> bool {
        self.solver.keeps_water()
    }

    /// Copies water and boundary from the host's arrays to the device.
    ///
    /// # Errors
    /// If the device has too little memory.
    pub fn load(&mut self) -> Result<(), DeviceError> {
        self.solver.load(&self.water, &self.boundary)
    }
}

impl Units {
    /// Returns the poses and velocities of the units.
    pub fn states(&self) -> &[BodyState] {
        self.world.states()
    }

    /// Returns the horizontal distance of each unit from its start position [m].
    pub fn displacements(&self) -> Vec<f64> {
        let moved = |(now, start): (&BodyState, &BodyState)| (now.position - start.position).truncate().length();
        self.states().iter().zip(&self.start).map(moved).collect()
    }
}
