//! Flume runs: water, wavemaker, units and contact, coupled.
//!
//! | entry | what it does |
//! | --- | --- |
//! | [`setup`], [`scheme`] | set-up of the simulation, and SPH parameters, from a case |
//! | `water_at_start` | the water at the start |
//! | [`unit_setup`] | the same for the units and the water beside them |
//! | `standing` | fixed bodies that stand on the bed: their surface vectors and those of the bed |
//! | `standing_cuboids` | the same for cuboids that move |
//! | `porous` | the fields of porous parts |
//! | [`step`] | one time step, in the order of the algorithm |
//! | [`run`] | the run of a case: outputs, checkpoints, rest criterion |
//! | [`branch`] | runs that begin at the checkpoint of another run |
//! | `follow` | the regions of different particle spacing move with the units |
//! | [`failure`] | failures of a time step: cause, position, advice |
//! | `diagnostics` | rows of `diagnostics.csv`, and warnings if the water is too fast |
//! | `impermeable` | impermeable surfaces: no water particle flows into a solid |
//! | [`regions`] | regions of different particle spacing, coupled through buffers |
//! | [`wave`] | wave of a case, wavemaker and open ends, damping and relaxation zones |
//! | [`measures`] | energy balance, extremes, mean loads, rest criterion: quantities that a run accumulates |
//! | [`outputs`] | tables, ParaView files, checkpoints, summary |

pub mod branch;
mod diagnostics;
pub mod failure;
mod follow;
mod impermeable;
pub mod measures;
pub mod outputs;
mod porous;
pub mod regions;
pub mod run;
pub mod scheme;
pub mod setup;
mod standing;
mod standing_cuboids;
pub mod step;
pub mod unit_setup;
mod water_at_start;
pub mod wave;

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use crate::{
    case::{Case, Gauge, Motion, UnitGroup, UnitModel, group},
    geometry::{outline::Outline, solid::Solid},
    rigid::{BodyState, Load, RigidWorld},
    sph::{
        pairs::rate::Rate,
        particles::{boundary::Boundary, porosity::PorousField, water::Water},
        solver::backend::{Backend, DeviceError},
    },
    waves::flume_model::record::FlumeRecord,
};
use measures::{
    mean_loads::MeanLoads, part_faces::FacePoint, statistics::Statistics, water_at_impacts::WaterAtImpacts,
};
use regions::buffer::Buffer;
use standing_cuboids::StandingCuboids;
use wave::ends::{MovingEnd, move_ends};

/// State of a flume run. If the case has coarser water far away, this is the state of the finest region, with all
/// units; the other regions are simulations, too.
pub struct Simulation {
    /// The case; for a coarser region, the case of this region.
    pub case: Arc<Case>,
    /// Simulations of the coarser regions, if any.
    pub coarse: Vec<Simulation>,
    /// How far the ends of the finest region have moved with the units since the start [m].
    pub moved: [f64; 2],
    /// Buffers beyond the ends where other regions continue, if any.
    pub buffers: Vec<Buffer>,
    /// Recorded flow of the flume model; `None` if the wave does not come from the flume model.
    pub flume: Option<Arc<FlumeRecord>>,
    /// The water.
    pub water: Water,
    /// Bed, walls, wavemaker and units as particles.
    pub boundary: Boundary,
    /// The armour units; `None` if the case has no units.
    pub units: Option<Units>,
    /// Cuboids that can move, and the walls on which they can stand.
    standing: StandingCuboids,
    /// Time since the particles started [s].
    pub time: f64,
    /// Number of time steps since the particles started.
    pub steps: u64,
    /// Flume time at which the particles started [s].
    pub start: f64,
    /// Time at which, in the flume model, the crest of a solitary wave has passed all units at the start [s]; 0 for
    /// other waves. Like `time`, it counts from the start of the particles.
    pub passing_time: f64,
    /// Extremes and counts since the start of the run.
    pub statistics: Statistics,
    solver: Box<dyn Backend>,
    /// Porosity and drag of porous parts, if there are any.
    porous: Option<Arc<PorousField>>,
    /// Moving ends of the particle domain: none, the wavemaker, or two open ends.
    pub ends: Vec<MovingEnd>,
    /// Identification number of the next water particle that an open end releases.
    next_id: u32,
    /// Outline of bed, mound, end walls and parts that are the same across the flume.
    outline: Outline,
    /// For each part of the structure with a force gauge, points on its faces.
    part_faces: Vec<Vec<FacePoint>>,
    /// For each bin, whether its particles can be near the outline, side walls or obstacles.
    bins_near_surfaces: Vec<bool>,
    /// Box that no particle may leave [m].
    bounds: [DVec3; 2],
}

/// The armour units.
pub struct Units {
    /// Groups of units.
    pub groups: Vec<UnitGroup>,
    /// Indices of the units whose water pressures are recorded at impacts. They have equal boundary particles.
    pub recorded: Range<usize>,
    /// Solver of the rigid bodies: units, bed and contacts.
    pub world: RigidWorld,
    /// Poses of the units at the start.
    pub start: Vec<BodyState>,
    /// Force [N] and torque [N m] of the water on each unit in the last time step.
    pub fluid_loads: Vec<Load>,
    /// Sums for the mean loads in the next rows of `units.csv`.
    pub mean_loads: MeanLoads,
    /// Water loads at the force peaks of the hardest impacts.
    pub water_at_impacts: WaterAtImpacts,
}

impl Simulation {
    /// Moves the boundary particles of wavemaker and units to their positions at the current time.
    pub fn place_boundary(&mut self) {
        let flume_time = self.flume_time();
        move_ends(&mut self.boundary, &self.ends, flume_time, 0.0);
        if let Some(units) = &self.units {
            self.standing.place(&mut self.boundary, units.states(), &self.case, &self.outline);
            units.states().iter().enumerate().for_each(|(k, s)| self.boundary.move_unit(k, s));
        }
    }

    /// Returns the flume time [s]: the time since the start of the flume model.
    pub fn flume_time(&self) -> f64 {
        self.start + self.time
    }

    /// Returns the range of x between the moving ends [m]; infinite at ends that do not move.
    pub fn between_moving_ends(&self) -> [f64; 2] {
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        for end in self.regions().flat_map(|region| &region.ends) {
            let front = end.wavemaker.rest_x_m() + end.inwards * end.foremost(self.flume_time());
            range[usize::from(end.inwards < 0.0)] = front;
        }
        range
    }

    /// Returns the current position of a gauge [m].
    pub fn gauge_position(&self, gauge: &Gauge) -> DVec3 {
        let at = DVec3::from_array(gauge.at);
        match (&gauge.motion, &self.units) {
            (Motion::OnUnit(unit), Some(units)) => {
                let (now, start) = (&units.states()[*unit], &units.start[*unit]);
                now.position + now.rotation * (start.rotation.inverse() * (at - start.position))
            }
            (Motion::Way(way), _) => at + way.displacement(self.time),
            _ => at,
        }
    }

    /// Returns the region to which the water at x [m] belongs; the finest region if no region does.
    pub fn region_at(&self, x: f64) -> &Self {
        self.regions().find(|region| region.owns(x)).unwrap_or(self)
    }

    /// Returns the solver of the water.
    pub fn solver(&self) -> &dyn Backend {
        &*self.solver
    }

    /// Returns the rates that the solver computed last for the water particles, in the order of [`Self::water`] after
    /// [`Self::fetch`].
    ///
    /// # Errors
    /// If the device is lost.
    pub fn water_rates(&mut self) -> Result<Vec<Rate>, DeviceError> {
        self.solver.water_rates()
    }

    /// Copies water and boundary from a graphics card to the arrays in host memory; does nothing on a processor.
    /// Allowed between time steps and between the two halves of a time step.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn fetch(&mut self) -> Result<(), DeviceError> {
        let Self { solver, water, boundary, .. } = self;
        solver.device_memory().map_or(Ok(()), |memory| memory.fetch(water, boundary))
    }

    /// Returns true if the current water is in the memory of a graphics card, not of the host.
    pub fn is_on_gpu(&mut self) -> bool {
        self.solver.device_memory().is_some()
    }

    /// Copies water and boundary from the arrays in host memory to a graphics card; does nothing on a processor.
    ///
    /// # Errors
    /// If the device has too little memory.
    pub fn load(&mut self) -> Result<(), DeviceError> {
        let Self { solver, water, boundary, .. } = self;
        solver.device_memory().map_or(Ok(()), |memory| memory.load(water, boundary))
    }
}

impl Units {
    /// Returns the poses and velocities of the units.
    pub fn states(&self) -> &[BodyState] {
        self.world.states()
    }

    /// Returns group and model of each unit.
    pub fn each(&self) -> impl Iterator<Item = (&UnitGroup, &UnitModel)> {
        group::each(&self.groups)
    }

    /// Returns the surface and the state of each unit.
    pub fn solids(&self) -> Vec<(&Solid, &BodyState)> {
        self.each().map(|(_, model)| model.shape.unit().solid()).zip(self.states()).collect()
    }

    /// Returns the horizontal distance of each unit from its start position [m].
    pub fn displacements(&self) -> Vec<f64> {
        let moved = |(now, start): (&BodyState, &BodyState)| (now.position - start.position).truncate().length();
        self.states().iter().zip(&self.start).map(moved).collect()
    }
}
