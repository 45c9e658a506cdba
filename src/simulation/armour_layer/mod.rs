//! Placement of armour layers: units are lowered onto a slope one by one until they touch, then released to settle.
//!
//! Like a crane, the program places the units layer by layer, and row by row from the toe upwards. The number of units
//! is N = phi A / D_n^2, with packing density phi, area A of the slope, and nominal diameter D_n of a unit. The units
//! are lowered at the nodes of a staggered grid; contact forces determine where they come to rest. Units that leave the
//! slope are replaced where the layers are thinnest. Groups without layers are in their places from the start. The units
//! of a heap fall from a box. In a flume case, still water lifts all units at the end, and they settle again.

mod lower;
mod slots;

use std::ops::Range;

use glam::DVec3;
use thiserror::Error;

use crate::{
    case::{Heap, LayerJob, Layers, PlacedGroupFile, PlacementFile, Placing, PoseFile, group},
    random::SplitMix64,
    rigid::{BodyState, RigidError, RigidWorld, STEPS_PER_PERIOD},
    simulation::{
        bodies::rigid_setup,
        settling::{COARSE_STEPS, LONGEST, REST_SPEED, Surroundings, fastest},
    },
};
use lower::lowered;
use slots::{Slot, rows, thinnest};

/// Largest deviation of the packing density from that of the job, divided by it [-].
const TOLERANCE: f64 = 0.03;
/// Number of times that units which left the slope are replaced.
const MOST_ROUNDS: usize = 5;
/// Changes the seed of the layers for the rotations of replaced units.
const REPLACEMENTS: u64 = 0x5eed;
/// Shortest and longest settling time of a row [s].
const ROW_TIME: [f64; 2] = [0.05, 1.0];
/// The next row is placed when all units are slower than this: speed divided by sqrt(g H), with the unit height H [-].
const ROW_SPEED: f64 = 0.15;
/// Before lost units are replaced, all units are slower than this: speed divided by sqrt(g H) [-].
const ROUND_SPEED: f64 = 0.01;
/// Longest settling time before lost units are replaced [s].
const ROUND_TIME: f64 = 2.0;

/// Reason why an armour layer cannot be placed.
#[derive(Debug, Error)]
pub enum PlacementError {
    /// There is no room for a unit.
    #[error(
        "unit {unit} cannot be placed at x = {x:.3}, y = {y:.3} m: there is no room; reduce the packing density or \
         move the walls or the box of the heap"
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

/// Armour layers that have settled.
#[derive(Debug, Clone)]
pub struct ArmourLayers {
    /// The placed groups, in the order of placement.
    pub groups: Vec<PlacedGroup>,
    /// Deepest overlap of a contact at the end, divided by the height of the highest unit [-].
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

/// A group of units that has settled.
#[derive(Debug, Clone)]
pub struct PlacedGroup {
    /// Name of the group.
    pub name: String,
    /// Poses and velocities of the units at the end.
    pub units: Vec<BodyState>,
    /// Packing of layers; `None` for a heap.
    pub packing: Option<Packing>,
}

/// Packing of layers that have settled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packing {
    /// Number of units that left the slope: at the end, their centre is seaward or shoreward of the covered slope.
    pub rolled_off: usize,
    /// Packing density of the units that stayed on the slope: their number divided by A / D_n^2 [-].
    pub density: f64,
    /// Packing density of one unit [-].
    pub of_one: f64,
    /// Packing density of the job [-].
    pub wanted: f64,
}

impl Packing {
    /// Returns true if the packing density is that of the job within 3 %, or within half a unit.
    pub fn is_complete(&self) -> bool {
        (self.density - self.wanted).abs() <= (TOLERANCE * self.wanted).max(0.5 * self.of_one)
    }
}

impl PlacedGroup {
    /// Returns the packing density of layers [-].
    fn density(&self) -> Option<f64> {
        self.packing.map(|packing| packing.density)
    }

    fn poses(&self) -> Vec<PoseFile> {
        let pose = |state: &BodyState| PoseFile {
            centre_m: state.position.to_array(),
            quaternion_xyzw: state.rotation.to_array(),
        };
        self.units.iter().map(pose).collect()
    }
}

impl ArmourLayers {
    /// Returns the poses of the units as a placement file; `all` is the number of groups of the case.
    pub fn file(&self, title: &str, all: usize) -> PlacementFile {
        let title = title.to_owned();
        if let ([group], 1) = (&self.groups[..], all) {
            let packing_density = group.density();
            return PlacementFile { title, packing_density, poses: group.poses(), groups: Vec::new() };
        }
        let of_group = |group: &PlacedGroup| PlacedGroupFile {
            name: group.name.clone(),
            packing_density: group.density(),
            poses: group.poses(),
        };
        PlacementFile {
            title,
            packing_density: None,
            poses: Vec::new(),
            groups: self.groups.iter().map(of_group).collect(),
        }
    }
}

/// Places the layers of a job. After each unit, calls `report` with the number of placed units and simulated time [s].
///
/// # Errors
/// If there is no room for a unit, or the contact solver becomes unstable.
pub fn place(job: &LayerJob, report: impl FnMut(usize, f64) + Send) -> Result<ArmourLayers, PlacementError> {
    // As in `output::driver::drive`, the loop runs on a thread of the rayon pool.
    rayon::scope(|_| place_layers(job, report))
}

fn place_layers(job: &LayerJob, mut report: impl FnMut(usize, f64)) -> Result<ArmourLayers, PlacementError> {
    let setup = rigid_setup(&job.units, &job.site, &job.materials, job.contact.law, job.gravity);
    let world = RigidWorld::new(setup)?;
    let first = world.states().len();
    let around = Surroundings { units: &job.units, gravity: job.gravity, water: None };
    let mut yard = Yard { job, potential: world.energy().potential, world, first, begin: first, around };
    yard.world.set_steps_per_period(COARSE_STEPS);
    let mut members = Vec::new();
    for placing in &job.placings {
        yard.begin = yard.world.states().len();
        match placing {
            Placing::Layers(layers) => {
                for row in rows(job, layers) {
                    for slot in &row {
                        yard.lower(layers, slot, &mut report)?;
                    }
                    yard.settle_row(layers)?;
                }
                yard.replace_lost(layers, &mut report)?;
            }
            Placing::Heap(heap) => yard.drop_heap(heap, &mut report)?,
        }
        members.push(yard.begin..yard.world.states().len());
    }
    yard.settle(REST_SPEED, LONGEST)?;
    yard.around.water = job.still_water;
    yard.settle(REST_SPEED, LONGEST)?;
    yard.world.set_steps_per_period(STEPS_PER_PERIOD);
    yard.settle(REST_SPEED, LONGEST)?;
    let Yard { world, potential, .. } = yard;
    let energy = world.energy();
    let group = |(placing, members): (&Placing, Range<usize>)| {
        let units = world.states()[members].to_vec();
        let packing = match placing {
            Placing::Layers(layers) => {
                let rolled_off = units.iter().filter(|unit| !is_on_slope(layers, unit)).count();
                let of_one = 1.0 / job.area(layers);
                let density = (units.len() - rolled_off) as f64 * of_one;
                Some(Packing { rolled_off, density, of_one, wanted: layers.armour.packing_density })
            }
            Placing::Heap(_) => None,
        };
        PlacedGroup { name: job.units.groups[placing.group()].name.clone(), units, packing }
    };
    Ok(ArmourLayers {
        groups: job.placings.iter().zip(members).map(group).collect(),
        deepest_overlap: world.deepest_overlap() / job.units.tallest(),
        unrest: energy.kinetic / (potential - energy.potential).max(f64::MIN_POSITIVE),
        fastest: fastest(&world, job.units.tallest()),
        time: world.time(),
        substeps: world.substeps(),
        contacts: world.contact_count(),
    })
}

/// Returns true if the centre of a unit is above the slope that the layers cover.
fn is_on_slope(layers: &Layers, unit: &BodyState) -> bool {
    let [x0, x1] = layers.armour.x;
    (x0..=x1).contains(&unit.position.x)
}

/// The units during the placement.
struct Yard<'a> {
    job: &'a LayerJob,
    world: RigidWorld,
    /// Sum of the potential energies of all units at their release [J].
    potential: f64,
    /// Number of units that were in place at the start.
    first: usize,
    /// Number of the first unit of the group that is being placed.
    begin: usize,
    around: Surroundings<'a>,
}

impl Yard<'_> {
    /// Adds the units of a heap in their box, layer by layer, and lets all of them fall.
    fn drop_heap(&mut self, heap: &Heap, report: &mut impl FnMut(usize, f64)) -> Result<(), PlacementError> {
        let [along, across, _] = self.job.lattice(heap);
        let pitch = self.job.pitch(heap);
        let mut random = SplitMix64::new(heap.seed);
        for number in 0..heap.count {
            let place = [number % along, number / along % across, number / (along * across)].map(|k| k as f64 + 0.5);
            let at = heap.bounds[0] + pitch * DVec3::from_array(place);
            let (unit, kind, mass) = self.next(heap.group);
            let state = BodyState::at_rest(at, random.next_rotation());
            if self.world.overlap_at(kind, at, state.rotation) > 0.0 {
                return Err(PlacementError::NoRoom { unit, x: at.x, y: at.y });
            }
            self.release(kind, mass, state);
            report(unit, self.world.time());
        }
        self.settle(ROUND_SPEED, LONGEST)?;
        Ok(())
    }

    /// Returns the number of the next unit, from 1, its kind, and its mass [kg].
    fn next(&self, group: usize) -> (usize, usize, f64) {
        let (groups, count) = (&self.job.units.groups, self.world.states().len());
        let model = groups[group].model_of(count - self.begin);
        (count + 1 - self.first, group::first_model(groups, group) + model, groups[group].models[model].mass)
    }

    /// Lowers a unit until it touches, and releases it.
    fn lower(
        &mut self,
        layers: &Layers,
        slot: &Slot,
        report: &mut impl FnMut(usize, f64),
    ) -> Result<(), PlacementError> {
        let Slot { x, y, rotation } = *slot;
        let (site, group) = (&self.job.site, self.job.group(layers));
        let (unit, kind, mass) = self.next(layers.group);
        let from = DVec3::new(x, y, self.highest(x) + 2.0 * self.job.units.tallest());
        let ground = site.level(x, y.rem_euclid(site.width));
        let state = lowered(&self.world, kind, from, rotation, ground, group.height())
            .ok_or(PlacementError::NoRoom { unit, x, y })?;
        self.release(kind, mass, state);
        report(unit, self.world.time());
        Ok(())
    }

    /// Adds a unit at rest.
    fn release(&mut self, kind: usize, mass: f64, state: BodyState) {
        self.potential += mass * self.job.gravity * state.position.z;
        self.world.add(kind, state);
    }

    /// Returns the level of the highest unit centre, or that of the ground at `x` if the ground is higher [m].
    fn highest(&self, x: f64) -> f64 {
        self.world.states().iter().map(|state| state.position.z).fold(self.job.site.highest_at(x), f64::max)
    }

    /// Waits until the units of a row are slow.
    fn settle_row(&mut self, layers: &Layers) -> Result<(), PlacementError> {
        let height = self.job.group(layers).height();
        let slow = ROW_SPEED * (self.job.gravity * height).sqrt();
        let begun = self.world.time();
        while self.world.time() - begun < ROW_TIME[0]
            || (fastest(&self.world, height) > slow && self.world.time() - begun < ROW_TIME[1])
        {
            self.around.advance(&mut self.world)?;
        }
        Ok(())
    }

    /// Waits until all units are slower than `speed` times sqrt(g H) [-], at most for the time `longest` [s].
    fn settle(&mut self, speed: f64, longest: f64) -> Result<bool, RigidError> {
        self.around.settle(&mut self.world, speed, longest)
    }

    /// Lowers further units where the layers are thinnest, for the units of the group that left the slope.
    fn replace_lost(&mut self, layers: &Layers, report: &mut impl FnMut(usize, f64)) -> Result<(), PlacementError> {
        let wanted = self.job.count(layers);
        let mut random = SplitMix64::new(layers.armour.seed ^ REPLACEMENTS);
        for _ in 0..MOST_ROUNDS {
            self.settle(ROUND_SPEED, ROUND_TIME)?;
            let on_slope = |unit: &&BodyState| is_on_slope(layers, unit);
            let stayed = self.world.states()[self.begin..].iter().filter(on_slope).count();
            if stayed >= wanted {
                break;
            }
            for _ in stayed..wanted {
                let slot = thinnest(self.job, layers, &self.world.states()[self.begin..], &mut random);
                self.lower(layers, &slot, report)?;
                self.settle_row(layers)?;
            }
        }
        Ok(())
    }
}
