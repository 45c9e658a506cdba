//! Placement of armour layers: units are lowered onto a slope one by one until they touch, then released to settle.
//!
//! Like a crane, the program places the units layer by layer, and row by row from the toe upwards. The number of units
//! is N = phi A / D_n^2, with packing density phi, area A of the slope, and nominal diameter D_n of a unit. The units
//! are lowered at the nodes of a staggered grid; contact forces determine where they come to rest.

mod lower;
mod slots;

use glam::DVec3;
use thiserror::Error;

use crate::{
    case::{LayerJob, PlacementFile, PoseFile, Site},
    rigid::{BodyState, Load, RigidError, RigidSetup, RigidWorld},
    simulation::bodies::rigid_setup,
};
use lower::lowered;
use slots::{Slot, rows};

/// Time between two checks of the unit speeds [s].
const CHECK_INTERVAL: f64 = 1e-3;
/// Shortest and longest settling time of a row [s].
const ROW_TIME: [f64; 2] = [0.05, 1.0];
/// The next row is placed when all units are slower than this: speed divided by sqrt(g H), with the unit height H [-].
const ROW_SPEED: f64 = 0.15;
/// Longest settling time after the last row [s].
const LAST_TIME: f64 = 10.0;
/// Units slower than this are at rest: speed divided by sqrt(g H), with the unit height H [-].
const REST_SPEED: f64 = 1e-4;

/// Reason why an armour layer cannot be placed.
#[derive(Debug, Error)]
pub enum PlacementError {
    /// There is no room for a unit.
    #[error(
        "unit {unit} cannot be placed at x = {x:.3}, y = {y:.3} m: there is no room; reduce the packing density or \
         move the walls"
    )]
    NoRoom {
        /// Number of the unit, from 1.
        unit: usize,
        /// x at which the unit was lowered [m].
        x: f64,
        /// y at which the unit was lowered [m].
        y: f64,
    },
    /// The contact solver became unstable.
    #[error(transparent)]
    Rigid(#[from] RigidError),
}

/// An armour layer that has settled.
#[derive(Debug, Clone)]
pub struct ArmourLayer {
    /// Poses and velocities of the units at the end.
    pub units: Vec<BodyState>,
    /// Number of units that left the slope: at the end, their centre is seaward or shoreward of the covered slope.
    pub rolled_off: usize,
    /// Packing density of the units that stayed on the slope: their number divided by A / D_n^2 [-].
    pub packing_density: f64,
    /// Deepest overlap of a contact at the end, divided by the height of a unit [-].
    pub deepest_overlap: f64,
    /// Kinetic energy at the end, divided by the potential energy that the units lost since their release [-].
    pub unrest: f64,
    /// Speed of the fastest unit at the end [m/s].
    pub fastest: f64,
    /// Simulated time [s].
    pub time: f64,
    /// Number of substeps of the contact solver.
    pub substeps: u64,
    /// Number of contacts at the end.
    pub contacts: usize,
}

impl ArmourLayer {
    /// Returns the poses of the units as a placement file.
    pub fn file(&self, title: &str) -> PlacementFile {
        let pose = |state: &BodyState| PoseFile {
            centre_m: state.position.to_array(),
            quaternion_xyzw: state.rotation.to_array(),
        };
        PlacementFile {
            title: title.to_owned(),
            packing_density: Some(self.packing_density),
            poses: self.units.iter().map(pose).collect(),
        }
    }
}

/// Places the layers of a job. After each unit, calls `report` with the number of placed units and simulated time [s].
///
/// # Errors
/// If there is no room for a unit, or the contact solver becomes unstable.
pub fn place(job: &LayerJob, report: impl FnMut(usize, f64) + Send) -> Result<ArmourLayer, PlacementError> {
    // As in `output::driver::drive`, the loop runs on a thread of the rayon pool.
    rayon::scope(|_| place_rows(job, report))
}

fn place_rows(job: &LayerJob, mut report: impl FnMut(usize, f64)) -> Result<ArmourLayer, PlacementError> {
    let setup = rigid_setup(&job.units, &job.site, &job.materials, job.contact.law, job.gravity);
    let mut world = RigidWorld::new(RigidSetup { bodies: Vec::new(), ..setup })?;
    let height = job.group().shape.height();
    let scale = (job.gravity * height).sqrt();
    let mut potential_at_release = 0.0;
    for row in rows(job) {
        for slot in &row {
            let unit = world.states().len() + 1;
            let Slot { x, y, rotation } = *slot;
            let from = DVec3::new(x, y, highest(&world, &job.site, x) + 2.0 * height);
            let state = lowered(&world, from, rotation, job.site.profile.z(x), height)
                .ok_or(PlacementError::NoRoom { unit, x, y })?;
            potential_at_release += job.group().mass * job.gravity * state.position.z;
            world.add(0, state);
            report(unit, world.time());
        }
        let begun = world.time();
        while world.time() - begun < ROW_TIME[0]
            || (fastest(&world, height) > ROW_SPEED * scale && world.time() - begun < ROW_TIME[1])
        {
            advance(&mut world)?;
        }
    }
    let begun = world.time();
    while fastest(&world, height) > REST_SPEED * scale && world.time() - begun < LAST_TIME {
        advance(&mut world)?;
    }
    let units = world.states().to_vec();
    let [x0, x1] = job.armour.x;
    let rolled_off = units.iter().filter(|unit| !(x0..=x1).contains(&unit.position.x)).count();
    let energy = world.energy();
    Ok(ArmourLayer {
        rolled_off,
        packing_density: (units.len() - rolled_off) as f64 / job.area(),
        deepest_overlap: world.deepest_overlap() / height,
        unrest: energy.kinetic / (potential_at_release - energy.potential).max(f64::MIN_POSITIVE),
        fastest: fastest(&world, height),
        time: world.time(),
        substeps: world.substeps(),
        contacts: world.contact_count(),
        units,
    })
}

fn advance(world: &mut RigidWorld) -> Result<(), RigidError> {
    let loads = vec![Load::default(); world.states().len()];
    world.advance(CHECK_INTERVAL, &loads)
}

/// Returns the largest speed of any unit [m/s]: the speed of the centre plus the speed of the tips by rotation.
fn fastest(world: &RigidWorld, height: f64) -> f64 {
    let speed = |state: &BodyState| state.velocity.length() + 0.5 * height * state.angular_velocity.length();
    world.states().iter().map(speed).fold(0.0, f64::max)
}

/// Returns the level of the highest unit centre, or the level of the ground at `x` if the ground is higher [m].
fn highest(world: &RigidWorld, site: &Site, x: f64) -> f64 {
    world.states().iter().map(|state| state.position.z).fold(site.highest_at(x), f64::max)
}
