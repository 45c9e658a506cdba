//! Pairs of tetrahedra in contact: which pairs can touch, their forces, and the start of a contact.
//!
//! Only tetrahedra with a free face, on the surface of a body or at a crack, can touch. Two tetrahedra cannot touch if
//! they share a node and unbroken faces connect them around this node, unless the face between them has broken.
//!
//! A new pair may overlap from the start. This initial overlap does not count, with one exception: if a joint failed in
//! compression, the pair takes over the elastic energy of the joint, which would otherwise be dissipated. The energy of
//! the whole overlap is p I, with the contact penalty p [Pa] and the sum I = I_T + I_C of the integrals in the module
//! `overlap` [m3]. I_b is the initial part of I, which does not count. If I exceeds I_b, the energy E and the forces F
//! of the pair are
//!
//!   E = p (sqrt I - sqrt I_b)^2,   F = (1 - sqrt(I_b / I)) times the forces of the whole overlap.
//!
//! The forces rise from zero. In the stiffest pairs, two faces lie flat on each other. I then grows with the square of
//! the overlap depth, so the force rises as steeply as for two separate bodies. (With the energy p (I - I_b), the force
//! would jump at I = I_b. Fragments that vibrate about this point would gain energy in each time step that crosses the
//! jump.) If I falls below I_b, I_b is reduced to I. Fragments that separate and meet again therefore behave like two
//! separate bodies.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

mod depth;
pub mod snapshot;
#[cfg(test)]
mod tests;

use super::detection::{Bounds, intersecting_pairs};
use super::friction::{FrictionLaw, TangentialSpring};
use super::overlap::{Overlap, overlap};
use super::tetrahedron::Tetrahedron;
use crate::femdem::assembly::{nodes::NodeCopy, tets::Tets};
use crate::femdem::setup::Setup;

/// Pairs per task of the thread pool.
const CHUNK: usize = 64;

/// Search distance, divided by the mean size of the tetrahedra that can touch [-]. With this value, a search remains
/// valid for thousands of time steps, and few pairs without contact are evaluated.
const SEARCH_MARGIN: f64 = 0.1;

/// Ratio of tangential to normal contact stiffness [-] (Xiang, Latham and Farsi 2017).
const TANGENTIAL: f64 = 2.0 / 7.0;

/// Two nearby tetrahedra and the history of their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pair {
    tets: [u32; 2],
    penalty: f64,
    law: FrictionLaw,
    /// Initial overlap I_b (energy over penalty) that does not count [m3]; `None` before the first evaluation.
    initial_overlap: Option<f64>,
    /// Elastic energy that the pair takes over from a broken joint [J]. The part that the pair cannot store is
    /// dissipated.
    inherited_energy: f64,
    spring: Option<TangentialSpring>,
    forces: Option<[[DVec3; 4]; 2]>,
    /// Elastic energy of the contact [J].
    stored: f64,
    /// Energy dissipated by friction in the last time step [J].
    dissipated: f64,
}

/// The contacts of a world.
#[derive(Debug, Clone, Default)]
pub struct Contacts {
    /// Tetrahedra with a free face, in ascending order.
    outer: Vec<u32>,
    /// For every node copy, the number of its group. This is the number of the first copy of the same mesh node that
    /// unbroken faces connect with it.
    group: Vec<NodeCopy>,
    pairs: Vec<Pair>,
    /// Pairs of tetrahedra whose joint has broken since the last search, and the elastic energy of this joint [J].
    opened: Vec<([u32; 2], f64)>,
    /// Scalars of the state.
    pub scalars: ContactScalars,
}

/// Scalars of the contacts of a world.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactScalars {
    /// Upper limit of the distance that any node has moved since the last search [m].
    travelled: f64,
    /// Search distance of the last search [m].
    skin: f64,
    /// True if a new search is needed, for example because a face has broken.
    outdated: bool,
    /// Elastic energy of all contacts [J].
    pub stored: f64,
    /// Energy dissipated by friction so far [J].
    pub friction: f64,
    /// Energy that contacts have taken over from broken joints so far [J].
    pub taken_over: f64,
    /// Number of pairs with contact forces.
    pub touching: usize,
}

impl Contacts {
    /// Creates the contacts between the surfaces of all bodies. `groups` are the groups of node copies that unbroken
    /// faces connect.
    pub fn new<'a>(setup: &Setup, groups: impl Iterator<Item = &'a [NodeCopy]>) -> Self {
        let group = vec![0; 4 * setup.tets.len()];
        let mut contacts = Self { outer: setup.outer.clone(), group, ..Self::default() };
        groups.for_each(|group| contacts.regroup(group));
        contacts
    }

    /// Records that unbroken faces connect the node copies of `group` with each other, but not with any other copy.
    pub fn regroup(&mut self, group: &[NodeCopy]) {
        group.iter().for_each(|copy| self.group[*copy as usize] = group[0]);
        self.scalars.outdated = true;
    }

    /// Allows the two tetrahedra at a broken face to touch. Their pair takes over the elastic energy of the joint [J].
    pub fn allow_contact(&mut self, mut tets: [u32; 2], inherited_energy: f64) {
        for tet in tets {
            if let Err(index) = self.outer.binary_search(&tet) {
                self.outer.insert(index, tet);
            }
        }
        tets.sort_unstable();
        self.opened.push((tets, inherited_energy));
        self.scalars.outdated = true;
    }

    /// Adds to `travelled` the longest distance that any node has moved since the last call [m].
    pub fn add_travel(&mut self, distance: f64) {
        self.scalars.travelled += distance;
    }

    /// Adds all contact forces to the forces of the tetrahedra [N]. The nodes have moved to `position` [m] with the
    /// velocity `velocity` [m/s] in the time `dt` [s]. `is_broken(number)` is true for a broken face.
    pub fn add_forces(
        &mut self,
        setup: &Setup,
        tets: &Tets,
        [position, velocity]: [&[DVec3]; 2],
        dt: f64,
        is_broken: impl Fn(usize) -> bool + Sync,
        forces: &mut [[DVec3; 4]],
    ) {
        if self.scalars.outdated || self.scalars.travelled > self.scalars.skin {
            self.search(setup, tets, position, is_broken);
        }
        let corners = |tet: u32| tets.nodes[tet as usize].map(|node| position[node as usize]);
        let moves = |tet: u32| tets.nodes[tet as usize].map(|node| velocity[node as usize] * dt);
        self.pairs.par_chunks_mut(CHUNK).for_each(|pairs| {
            for pair in pairs {
                let tets = pair.tets;
                pair.evaluate(tets.map(corners), || tets.map(moves));
            }
        });
        (self.scalars.stored, self.scalars.touching) = (0.0, 0);
        for pair in &mut self.pairs {
            self.scalars.friction += std::mem::take(&mut pair.dissipated);
            self.scalars.taken_over += std::mem::take(&mut pair.inherited_energy);
            let Some(pair_forces) = pair.forces else { continue };
            self.scalars.stored += pair.stored;
            self.scalars.touching += 1;
            for (tet, tet_forces) in pair.tets.into_iter().zip(pair_forces) {
                forces[tet as usize].iter_mut().zip(tet_forces).for_each(|(total, force)| *total += force);
            }
        }
    }

    /// Returns true if tetrahedra of two different bodies are in contact.
    pub fn touches_other_body(&self, tets: &Tets) -> bool {
        let body = |tet: u32| tets.body[tet as usize];
        self.scalars.touching > 0
            && self.pairs.iter().any(|pair| pair.forces.is_some() && body(pair.tets[0]) != body(pair.tets[1]))
    }

    /// Finds the pairs that are closer than twice the search distance. Pairs that existed before keep their history.
    fn search(&mut self, setup: &Setup, tets: &Tets, position: &[DVec3], is_broken: impl Fn(usize) -> bool + Sync) {
        let size: f64 = self.outer.iter().map(|tet| tets.shape[*tet as usize].volume.cbrt()).sum();
        let skin = SEARCH_MARGIN * size / self.outer.len().max(1) as f64;
        let corners = |tet: &u32| tets.nodes[*tet as usize].map(|node| position[node as usize]);
        let boxes: Vec<Bounds> = self.outer.par_iter().map(|tet| Bounds::about(&corners(tet), skin)).collect();
        let tets_of = |pair: [u32; 2]| pair.map(|index| self.outer[index as usize]);
        let keep = |i: u32, j: u32| {
            let [a, b] = tets_of([i, j]);
            self.can_touch([a, b], setup, tets, &is_broken) && !are_apart(&corners(&a), &corners(&b), 2.0 * skin)
        };
        let recall = |key: [u32; 2]| match self.pairs.binary_search_by_key(&key, |pair| pair.tets) {
            Ok(index) => self.pairs[index],
            Err(_) => Pair::new(key, setup, tets),
        };
        let mut pairs: Vec<Pair> = intersecting_pairs(&boxes, keep).iter().map(|pair| recall(tets_of(*pair))).collect();
        for (key, energy) in self.opened.drain(..) {
            if let Ok(index) = pairs.binary_search_by_key(&key, |pair| pair.tets) {
                // A pair that was evaluated before takes over no energy, because its overlap already counts.
                pairs[index].inherited_energy = if pairs[index].initial_overlap.is_none() { energy } else { 0.0 };
            }
        }
        self.pairs = pairs;
        self.scalars = ContactScalars { travelled: 0.0, skin, outdated: false, ..self.scalars };
    }

    /// Returns true if two tetrahedra are not connected around a shared node, or if the face between them has broken.
    fn can_touch(&self, [a, b]: [u32; 2], setup: &Setup, tets: &Tets, is_broken: impl Fn(usize) -> bool) -> bool {
        let nodes = [a, b].map(|tet| setup.tets[tet as usize]);
        let is_connected = |k: usize| {
            let shared = nodes[1].iter().position(|node| *node == nodes[0][k]);
            shared.is_some_and(|l| self.group[4 * a as usize + k] == self.group[4 * b as usize + l])
        };
        let broken_between = || {
            let links = tets.faces[a as usize].iter().filter_map(|link| link.interface());
            links.into_iter().any(|(face, side)| setup.interfaces[face].tets[1 - side] == b && is_broken(face))
        };
        !(0..4).any(is_connected) || broken_between()
    }
}

/// Returns true if a face of one tetrahedron separates it from the other one by more than a gap [m]. This test removes
/// most pairs with intersecting boxes: on a surface, the boxes of tetrahedra that do not touch often intersect.
fn are_apart(a: &[DVec3; 4], b: &[DVec3; 4], gap: f64) -> bool {
    let beyond_a_face = |owner: &[DVec3; 4], other: &[DVec3; 4]| {
        let Some(owner) = Tetrahedron::new(owner) else { return false };
        let [p, q, r, s] = other.map(|vertex| owner.shape_functions(vertex));
        let nearest = p.max(q).max(r.max(s)).to_array();
        // Per metre of distance from the face, a shape function decreases by the length of its gradient.
        nearest.iter().zip(owner.gradients).any(|(nearest, gradient)| *nearest < -gap * gradient.length())
    };
    beyond_a_face(a, b) || beyond_a_face(b, a)
}

impl Pair {
    fn new(tets: [u32; 2], setup: &Setup, all: &Tets) -> Self {
        let bodies = tets.map(|tet| usize::from(all.body[tet as usize]));
        let penalty = bodies.map(|body| setup.bodies[body].contact_penalty).into_iter().fold(f64::MAX, f64::min);
        let size = tets.map(|tet| (6.0 * all.shape[tet as usize].volume).cbrt()).into_iter().fold(f64::MAX, f64::min);
        let law = FrictionLaw { stiffness: TANGENTIAL * penalty * size, coefficient: setup.friction(bodies) };
        let (initial_overlap, inherited_energy, stored, dissipated) = (None, 0.0, 0.0, 0.0);
        Self { tets, penalty, law, initial_overlap, inherited_energy, spring: None, forces: None, stored, dissipated }
    }

    fn evaluate(&mut self, corners: [[DVec3; 4]; 2], moves: impl Fn() -> [[DVec3; 4]; 2]) {
        let found = overlap(&corners[0], &corners[1]);
        let energy = found.as_ref().map_or(0.0, |found| found.energy);
        let initial = match self.initial_overlap {
            Some(initial) => initial.min(energy),
            None => self.find_initial_overlap(found.as_ref(), &moves()),
        };
        self.initial_overlap = Some(initial);
        let Some(found) = found.filter(|_| energy > initial) else {
            let spring_energy = self.spring.take().map_or(0.0, |spring| spring.stored(&self.law));
            (self.forces, self.stored) = (None, 0.0);
            self.dissipated += spring_energy;
            return;
        };
        let penalty = self.penalty * (1.0 - (initial / energy).sqrt());
        let mut forces = found.forces.map(|tet_forces| tet_forces.map(|force| force * penalty));
        self.stored = self.penalty * (energy.sqrt() - initial.sqrt()).powi(2);
        if self.law.coefficient > 0.0 {
            let spring = self.spring.get_or_insert_with(|| TangentialSpring::new(found.resultant()));
            let moves = moves();
            let friction =
                spring.advance(&self.law, &found, penalty, [&corners[0], &corners[1]], [&moves[0], &moves[1]]);
            forces.iter_mut().flatten().zip(friction.forces.into_iter().flatten()).for_each(|(f, t)| *f += t);
            self.dissipated += friction.dissipated;
            self.stored += spring.stored(&self.law);
        }
        self.forces = Some(forces);
    }

    /// Returns I_b, the initial overlap that does not count [m3]. With this I_b, the pair had the elastic energy of the
    /// joint half a time step ago, when the joint broke. With s = sqrt I - sqrt I_b, this energy is the current energy
    /// p s^2 minus half the work of this time step against the contact forces. The contact forces are the share
    /// s / sqrt I of the forces of the whole overlap.
    fn find_initial_overlap(&mut self, found: Option<&Overlap>, moves: &[[DVec3; 4]; 2]) -> f64 {
        let inherited = std::mem::take(&mut self.inherited_energy);
        let Some(found) = found.filter(|found| found.energy > 0.0) else { return 0.0 };
        let root = found.energy.sqrt();
        let works = found.forces.iter().flatten().zip(moves.iter().flatten()).map(|(force, u)| force.dot(*u));
        // `work` is half the work against the forces of the whole overlap in this time step, divided by p sqrt I.
        let work = -0.5 * works.sum::<f64>() / root;
        let counts = (0.5 * (work + (work * work + 4.0 * inherited / self.penalty).sqrt())).clamp(0.0, root);
        self.inherited_energy = (self.penalty * counts * (counts - work)).max(0.0);
        (root - counts).powi(2)
    }
}
