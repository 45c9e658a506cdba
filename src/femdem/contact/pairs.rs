//! Pairs of tetrahedra in contact: which pairs can touch, their forces, and the start of a contact.
//!
//! Only tetrahedra with a free face can touch: on the surface of a body or at a crack. Two tetrahedra do not touch if
//! they share a node around which unbroken faces connect them, unless the face between them has broken.
//!
//! The initial overlap of a new pair does not count, except for the elastic energy of a joint that failed in
//! compression: the pair takes this energy over, so that no energy is created. With the overlap energy p I and the
//! initial part I_b of I that does not count, the pair has
//!
//!   E = p (sqrt I - sqrt I_b)^2 where I > I_b, and the share 1 - sqrt(I_b / I) of the forces of the overlap.
//!
//! The force rises from zero. For flush faces, whose I grows with the square of the depth, it rises as steeply as for
//! two separate bodies; no pair is stiffer. (With p (I - I_b) the force would jump at I = I_b, and fragments that
//! rattle there would gain half of force times displacement in each time step that crosses the jump.) I_b decreases
//! with I, so fragments that separate and meet again are a normal contact.

use glam::DVec3;
use rayon::prelude::*;

mod depth;
pub mod snapshot;
#[cfg(test)]
mod tests;

use super::super::assembly::{Copy4, Tets};
use super::super::setup::Setup;
use super::detection::{Bounds, Detection};
use super::friction::{FrictionLaw, TangentialSpring};
use super::overlap::{Overlap, overlap};
use super::tetrahedron::Tetrahedron;

/// Pairs per task of the thread pool.
const CHUNK: usize = 64;

/// Search distance over the mean size of the tetrahedra that can touch [-]. A search then remains valid for thousands
/// of time steps, and few pairs are evaluated in vain.
const SKIN: f64 = 0.1;

/// Tangential over normal contact stiffness [-] (Xiang, Latham and Farsi 2017).
const TANGENTIAL: f64 = 2.0 / 7.0;

/// Two nearby tetrahedra and the history of their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pair {
    tets: [u32; 2],
    penalty: f64,
    law: FrictionLaw,
    /// Initial overlap I_b (energy over penalty) that does not count [m3]; `None` before the first evaluation.
    born: Option<f64>,
    /// Elastic energy that a broken joint leaves to the pair [J]; the part that the pair cannot take is dissipated.
    left: f64,
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
    /// For every node copy, the first of the copies of its mesh node that unbroken faces connect with it.
    group: Vec<Copy4>,
    pairs: Vec<Pair>,
    /// Tetrahedra whose joint has broken since the last search, and the energy that the joint leaves to them [J].
    opened: Vec<([u32; 2], f64)>,
    /// Upper limit of the distance that any node has moved since the last search [m].
    travelled: f64,
    skin: f64,
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
    /// Creates the contacts between the surfaces of all bodies; `groups` are the connected copies around each node.
    pub fn new<'a>(setup: &Setup, groups: impl Iterator<Item = &'a [Copy4]>) -> Self {
        let group = vec![0; 4 * setup.tets.len()];
        let mut contacts = Self { outer: setup.outer.clone(), group, ..Self::default() };
        groups.for_each(|group| contacts.regroup(group));
        contacts
    }

    /// Sets the copies around a node that are connected now.
    pub fn regroup(&mut self, group: &[Copy4]) {
        group.iter().for_each(|copy| self.group[*copy as usize] = group[0]);
        self.outdated = true;
    }

    /// Allows the tetrahedra at a broken face to touch; the joint leaves them its elastic energy [J].
    pub fn open(&mut self, mut tets: [u32; 2], left: f64) {
        for tet in tets {
            if let Err(index) = self.outer.binary_search(&tet) {
                self.outer.insert(index, tet);
            }
        }
        tets.sort_unstable();
        self.opened.push((tets, left));
        self.outdated = true;
    }

    /// Adds the longest distance that any node has moved since the last call [m].
    pub fn travel(&mut self, distance: f64) {
        self.travelled += distance;
    }

    /// Adds all contact forces to the forces of the tetrahedra [N]. Nodes are at `place` [m], after moving with
    /// `velocity` [m/s] for `dt` [s].
    pub fn press(
        &mut self,
        setup: &Setup,
        tets: &Tets,
        [place, velocity]: [&[DVec3]; 2],
        dt: f64,
        is_broken: impl Fn(usize) -> bool + Sync,
        forces: &mut [[DVec3; 4]],
    ) {
        if self.outdated || self.travelled > self.skin {
            self.search(setup, tets, place, is_broken);
        }
        let corners = |tet: u32| tets.nodes[tet as usize].map(|node| place[node as usize]);
        let moves = |tet: u32| tets.nodes[tet as usize].map(|node| velocity[node as usize] * dt);
        self.pairs.par_chunks_mut(CHUNK).for_each(|pairs| {
            for pair in pairs {
                let tets = pair.tets;
                pair.evaluate(tets.map(corners), || tets.map(moves));
            }
        });
        (self.stored, self.touching) = (0.0, 0);
        for pair in &mut self.pairs {
            self.friction += std::mem::take(&mut pair.dissipated);
            self.taken_over += std::mem::take(&mut pair.left);
            let Some(pair_forces) = pair.forces else { continue };
            self.stored += pair.stored;
            self.touching += 1;
            for (tet, tet_forces) in pair.tets.into_iter().zip(pair_forces) {
                forces[tet as usize].iter_mut().zip(tet_forces).for_each(|(total, force)| *total += force);
            }
        }
    }

    /// Whether tetrahedra of two different bodies are in contact.
    pub fn between_bodies(&self, tets: &Tets) -> bool {
        let body = |tet: u32| tets.body[tet as usize];
        self.touching > 0
            && self.pairs.iter().any(|pair| pair.forces.is_some() && body(pair.tets[0]) != body(pair.tets[1]))
    }

    /// Finds the pairs closer than two skins; pairs that existed before keep their history.
    fn search(&mut self, setup: &Setup, tets: &Tets, place: &[DVec3], is_broken: impl Fn(usize) -> bool + Sync) {
        let size: f64 = self.outer.iter().map(|tet| tets.shape[*tet as usize].volume.cbrt()).sum();
        self.skin = SKIN * size / self.outer.len().max(1) as f64;
        let corners = |tet: &u32| tets.nodes[*tet as usize].map(|node| place[node as usize]);
        let boxes: Vec<Bounds> = self.outer.par_iter().map(|tet| Bounds::about(&corners(tet), self.skin)).collect();
        let tets_of = |pair: [u32; 2]| pair.map(|index| self.outer[index as usize]);
        let keep = |i: u32, j: u32| {
            let [a, b] = tets_of([i, j]);
            self.can_touch([a, b], setup, tets, &is_broken) && !are_apart(&corners(&a), &corners(&b), 2.0 * self.skin)
        };
        let mut detection = Detection::default();
        let recall = |key: [u32; 2]| match self.pairs.binary_search_by_key(&key, |pair| pair.tets) {
            Ok(index) => self.pairs[index],
            Err(_) => Pair::new(key, setup, tets),
        };
        let mut pairs: Vec<Pair> = detection.pairs(&boxes, keep).iter().map(|pair| recall(tets_of(*pair))).collect();
        for (key, left) in self.opened.drain(..) {
            if let Ok(index) = pairs.binary_search_by_key(&key, |pair| pair.tets) {
                // A pair that was evaluated before already counts its overlap.
                pairs[index].left = if pairs[index].born.is_none() { left } else { 0.0 };
            }
        }
        self.pairs = pairs;
        (self.travelled, self.outdated) = (0.0, false);
    }

    /// Whether two tetrahedra are not connected around a shared node, or the face between them has broken.
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

/// Whether a face of one tetrahedron separates it from the other one by more than a gap [m]. This removes most pairs of
/// intersecting boxes: boxes of second neighbours on a surface often intersect.
fn are_apart(a: &[DVec3; 4], b: &[DVec3; 4], gap: f64) -> bool {
    let beyond_a_face = |owner: &[DVec3; 4], other: &[DVec3; 4]| {
        let Some(owner) = Tetrahedron::new(owner) else { return false };
        let [p, q, r, s] = other.map(|vertex| owner.shape_functions(vertex));
        let nearest = p.max(q).max(r.max(s)).to_array();
        // A shape function decreases by the length of its gradient per metre.
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
        let (born, left, stored, dissipated) = (None, 0.0, 0.0, 0.0);
        Self { tets, penalty, law, born, left, spring: None, forces: None, stored, dissipated }
    }

    fn evaluate(&mut self, corners: [[DVec3; 4]; 2], moves: impl Fn() -> [[DVec3; 4]; 2]) {
        let found = overlap(&corners[0], &corners[1]);
        let energy = found.as_ref().map_or(0.0, |found| found.energy);
        let born = match self.born {
            Some(born) => born.min(energy),
            None => self.initial_overlap(found.as_ref(), &moves()),
        };
        self.born = Some(born);
        let Some(found) = found.filter(|_| energy > born) else {
            let spring_energy = self.spring.take().map_or(0.0, |spring| spring.stored(&self.law));
            (self.forces, self.stored) = (None, 0.0);
            self.dissipated += spring_energy;
            return;
        };
        let penalty = self.penalty * (1.0 - (born / energy).sqrt());
        let mut forces = found.forces.map(|tet_forces| tet_forces.map(|force| force * penalty));
        self.stored = self.penalty * (energy.sqrt() - born.sqrt()).powi(2);
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

    /// Returns I_b, the initial overlap that does not count [m3]. It is chosen so that half a time step ago, when the
    /// joint broke, the pair had the energy that the joint leaves. With s = sqrt I - sqrt I_b this is p s^2 now, minus
    /// half the work of this time step against the forces (the share s / sqrt I of the forces of the overlap).
    fn initial_overlap(&mut self, found: Option<&Overlap>, moves: &[[DVec3; 4]; 2]) -> f64 {
        let left = std::mem::take(&mut self.left);
        let Some(found) = found.filter(|found| found.energy > 0.0) else { return 0.0 };
        let root = found.energy.sqrt();
        let works = found.forces.iter().flatten().zip(moves.iter().flatten()).map(|(force, u)| force.dot(*u));
        // For the forces of the whole overlap, divided by p sqrt I.
        let work = -0.5 * works.sum::<f64>() / root;
        let counts = (0.5 * (work + (work * work + 4.0 * left / self.penalty).sqrt())).clamp(0.0, root);
        self.left = (self.penalty * counts * (counts - work)).max(0.0);
        (root - counts).powi(2)
    }
}
