//! The contact search of a world: which parts can be near each other, and the contact points of the parts that are.
//!
//! The list of part pairs includes gaps up to some rounding radii, and is reused until the bodies have moved by this
//! distance. Each pair remembers its last gap. The search computes the gap again only when the bodies have moved so far
//! that the parts can be near. The same holds for each body with ground and walls. The remembered gaps only select what
//! is computed, so they change no result.

use rayon::prelude::*;

use super::part_pair::{PartPair, Travel};
use super::surfaces::Surfaces;
use crate::rigid::contact::{Contact, ContactPoint};
use crate::rigid::error::RigidError;
use crate::rigid::kinematics::Motion;

/// Number of bodies, and of pairs of parts, per task of the thread pool. A task takes at least some tens of
/// microseconds, several times as long as it takes to wake a thread.
const BODIES_PER_TASK: usize = 64;
const PAIRS_PER_TASK: usize = 1024;

/// A gap is computed if it is at most this number of rounding radii [-]; for a larger gap, this value is the bound.
const MEASURED_GAP: f64 = 2.0;
/// Tolerance of the bounds of gaps, divided by the rounding radius [-]. The distance of two cores has a relative error
/// of 5e-8, and cores are less than a thousand rounding radii away.
const TOLERANCE: f64 = 1e-3;

/// Memory of the contact search between substeps.
#[derive(Debug, Clone)]
pub struct ContactSearch {
    /// `pairs` includes all part pairs whose gap was at most this distance when the list was built [m].
    list_distance: f64,
    /// Smallest rounding radius [m].
    rounding: f64,
    path: Vec<f64>,
    tip_speed: Vec<f64>,
    pairs: Vec<PartPair>,
    /// The gap between each body and ground or walls is at least this value minus the path of the body [m].
    clearance: Vec<f64>,
    points: Vec<ContactPoint>,
    tasks: Vec<Found>,
}

/// Contact points that a task has found.
#[derive(Debug, Clone, Default)]
struct Found {
    points: Vec<ContactPoint>,
    error: Option<RigidError>,
}

impl ContactSearch {
    /// Creates the memory for a number of bodies; `rounding` is the smallest rounding radius [m].
    pub fn new(bodies: usize, rounding: f64) -> Self {
        Self {
            list_distance: f64::NEG_INFINITY,
            rounding,
            path: vec![0.0; bodies],
            tip_speed: vec![0.0; bodies],
            pairs: Vec::new(),
            clearance: vec![f64::NEG_INFINITY; bodies],
            points: Vec::new(),
            tasks: Vec::new(),
        }
    }

    /// Adds a body.
    pub fn add_body(&mut self) {
        self.path.push(0.0);
        self.tip_speed.push(0.0);
        self.clearance.push(f64::NEG_INFINITY);
        self.forget();
    }

    /// Makes the next search build its lists, because bodies have changed.
    pub fn forget(&mut self) {
        self.list_distance = f64::NEG_INFINITY;
    }

    /// Number of part pairs in the list, and of contact points found by the last search.
    pub fn size(&self) -> [usize; 2] {
        [self.pairs.len(), self.points.len()]
    }

    /// Finds all contact points, sorted by key. They include gaps that can close within the longest substep. Contacts
    /// between bodies that hold their place keep their points.
    /// `before` lists the active contacts of the last search, sorted by key.
    pub fn find(
        &mut self,
        surfaces: &Surfaces,
        motion: &Motion,
        before: &[Contact],
    ) -> Result<&[ContactPoint], RigidError> {
        self.update_list(surfaces, motion);
        let Self { path, tip_speed, tasks, points, pairs, clearance, rounding, .. } = self;
        let travel = Travel { path, velocity: motion.now.linear, tip_speed, tolerance: TOLERANCE * *rounding };
        let measured = MEASURED_GAP * *rounding;
        let (placements, time) = (motion.placements, motion.substep.time);
        points.clear();
        points.extend(before.iter().map(|contact| contact.point).filter(|point| motion.is_held(&point.key)));
        let is_still = motion.is_still;
        in_tasks(clearance, BODIES_PER_TASK, tasks, points, |body, clearance, out| {
            let margin = travel.margin(body);
            if is_still[body] || *clearance > travel.path[body] + margin || surfaces.is_fixed(body, placements) {
                return Ok(());
            }
            let from = out.len();
            surfaces.fixed_contact_points(body, placements, margin, time, out)?;
            if out.len() == from {
                surfaces.fixed_contact_points(body, placements, margin + measured, time, out)?;
                let gap = out.drain(from..).map(|point| -point.overlap).fold(margin + measured, f64::min);
                *clearance = travel.path[body] + gap;
            }
            Ok(())
        })?;
        in_tasks(pairs, PAIRS_PER_TASK, tasks, points, |_, pair, out| {
            if is_still[pair.bodies.first] && is_still[pair.bodies.second] {
                return Ok(());
            }
            let (path, margin) = (travel.pair_path(&pair.bodies), travel.pair_margin(&pair.bodies));
            if pair.clearance <= path + margin {
                let gap = surfaces.part_contact_points(pair, placements, before, [margin, measured], time, out)?;
                pair.clearance = path + gap;
            }
            Ok(())
        })?;
        points.sort_unstable_by_key(|point| point.key);
        Ok(points)
    }

    /// Adds the last substep to the paths, and builds the list of pairs if a pair beyond it can be near.
    fn update_list(&mut self, surfaces: &Surfaces, motion: &Motion) {
        let Motion { placements, now, mean, substep, .. } = *motion;
        for (body, path) in self.path.iter_mut().enumerate() {
            let reach = surfaces.reach(placements.kind[body]);
            Travel::add_to_path(path, substep.dt, mean.linear[body], mean.angular[body], reach);
            self.tip_speed[body] = now.angular[body].length() * reach;
        }
        let tolerance = TOLERANCE * self.rounding;
        let travel = Travel { path: &self.path, velocity: now.linear, tip_speed: &self.tip_speed, tolerance };
        let largest_margin = (0..self.path.len()).map(|body| travel.margin(body)).fold(0.0, f64::max);
        let largest_path = self.path.iter().copied().fold(0.0, f64::max);
        if self.list_distance < 2.0 * (largest_path + largest_margin) {
            self.list_distance = 2.0 * largest_margin + MEASURED_GAP * self.rounding;
            self.path.fill(0.0);
            self.clearance.fill(f64::NEG_INFINITY);
            surfaces.near_parts(placements, self.list_distance, &mut self.pairs);
        }
    }
}

/// Appends the results of `find` for all items to `points`, in the order of the items. Each chunk of `length` items is
/// a task of the thread pool, which uses the memory of one entry of `tasks`.
fn in_tasks<T: Send>(
    items: &mut [T],
    length: usize,
    tasks: &mut Vec<Found>,
    points: &mut Vec<ContactPoint>,
    find: impl Fn(usize, &mut T, &mut Vec<ContactPoint>) -> Result<(), RigidError> + Sync,
) -> Result<(), RigidError> {
    let find_in = |first: usize, items: &mut [T], out: &mut Vec<ContactPoint>| {
        items.iter_mut().enumerate().try_for_each(|(index, item)| find(first + index, item, out))
    };
    if items.len() <= length {
        return find_in(0, items, points);
    }
    let count = items.len().div_ceil(length);
    tasks.resize_with(tasks.len().max(count), Found::default);
    items.par_chunks_mut(length).zip(&mut tasks[..count]).enumerate().for_each(|(number, (items, found))| {
        found.points.clear();
        found.error = find_in(number * length, items, &mut found.points).err();
    });
    for found in &mut tasks[..count] {
        if let Some(error) = found.error.take() {
            return Err(error);
        }
        points.append(&mut found.points);
    }
    Ok(())
}
