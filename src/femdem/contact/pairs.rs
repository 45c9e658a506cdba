//! Tetrahedra in contact: who can touch whom, their forces, and how a contact is born.
//!
//! Only tetrahedra with a free face can touch: those at the outside, and those at a crack. Two that share a node around
//! which unbroken faces hold them together do not, unless the face between them has broken.
//!
//! What overlaps when a pair is born does not count, but for the energy that a joint leaves to it: a joint
//! that fails under pressure hands its compression over, and no energy comes from nothing. With p I the energy of the
//! overlap and I_b what does not count of I, the pair has
//!
//!   E = p (sqrt I - sqrt I_b)^2 where I > I_b, and gives the share 1 - sqrt(I_b / I) of the forces of the overlap.
//!
//! The force rises from zero, and for two faces that lie flush, whose I goes with the square of the depth, as steeply as
//! if they had come from outside; no pair is stiffer than that. (With p (I - I_b) the force would jump where I passes
//! I_b, and a crushed body whose pieces rattle there would gain half of force times way in each step that crosses it.)
//! I_b falls with I: pieces that have come apart meet like any others.

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

/// Candidates of one task of the thread pool.
const PIECE: usize = 64;

/// Distance up to which pairs are looked for, over the mean size of the tetrahedra that can touch [-]: a search then
/// lasts for thousands of steps, and few pairs are looked at in vain.
const SKIN: f64 = 0.1;

/// Stiffness along over that across a contact (Xiang, Latham and Farsi 2017) [-].
const TANGENTIAL: f64 = 2.0 / 7.0;

/// Two tetrahedra near each other, with what their contact remembers.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pair {
    tets: [u32; 2],
    penalty: f64,
    law: FrictionLaw,
    /// Overlap, as energy over penalty, that does not count [m3]; `None` before the pair was first looked at.
    born: Option<f64>,
    /// Energy that a joint has left to the pair [J]; what of it the pair does not take is lost.
    left: f64,
    spring: Option<TangentialSpring>,
    forces: Option<[[DVec3; 4]; 2]>,
    /// Energy that would come back [J].
    stored: f64,
    /// Energy that friction took in the last step [J].
    dissipated: f64,
}

/// The contacts of a world.
#[derive(Debug, Clone, Default)]
pub struct Contacts {
    /// Tetrahedra with a free face, in rising order.
    outer: Vec<u32>,
    /// For every copy of a node, the first of those around the node that unbroken faces hold together with it.
    group: Vec<Copy4>,
    pairs: Vec<Pair>,
    /// Tetrahedra whose joint has broken since the last search, and the energy that it leaves to them [J].
    opened: Vec<([u32; 2], f64)>,
    /// Way that a node can have gone since the last search [m].
    travelled: f64,
    skin: f64,
    outdated: bool,
    /// Energy that contacts would give back [J].
    pub stored: f64,
    /// Energy lost by friction so far [J].
    pub friction: f64,
    /// Energy that contacts have taken over from broken joints so far [J].
    pub taken_over: f64,
    /// Pairs that press each other.
    pub touching: usize,
}

impl Contacts {
    /// Contacts between the outsides of the bodies of a setup; `groups` are the copies that hold together around each
    /// node.
    pub fn new<'a>(setup: &Setup, groups: impl Iterator<Item = &'a [Copy4]>) -> Self {
        let group = vec![0; 4 * setup.tets.len()];
        let mut contacts = Self { outer: setup.outer.clone(), group, ..Self::default() };
        groups.for_each(|group| contacts.regroup(group));
        contacts
    }

    /// Copies around a node that hold together now.
    pub fn regroup(&mut self, group: &[Copy4]) {
        group.iter().for_each(|copy| self.group[*copy as usize] = group[0]);
        self.outdated = true;
    }

    /// The tetrahedra at a broken face can touch from now on; its joint leaves them its elastic energy [J].
    pub fn open(&mut self, mut tets: [u32; 2], left: f64) {
        for tet in tets {
            if let Err(place) = self.outer.binary_search(&tet) {
                self.outer.insert(place, tet);
            }
        }
        tets.sort_unstable();
        self.opened.push((tets, left));
        self.outdated = true;
    }

    /// No node has gone further than this way since the last call [m].
    pub fn travel(&mut self, way: f64) {
        self.travelled += way;
    }

    /// Adds the forces of all contacts to those of the tetrahedra [N]. Nodes are at `place` [m], where `velocity` [m/s]
    /// has brought them over `dt` [s].
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
        self.pairs.par_chunks_mut(PIECE).for_each(|pairs| {
            for pair in pairs {
                let of = pair.tets;
                pair.evaluate(of.map(corners), || of.map(moves));
            }
        });
        (self.stored, self.touching) = (0.0, 0);
        for pair in &mut self.pairs {
            self.friction += std::mem::take(&mut pair.dissipated);
            self.taken_over += std::mem::take(&mut pair.left);
            let Some(of_pair) = pair.forces else { continue };
            self.stored += pair.stored;
            self.touching += 1;
            for (tet, of_tet) in pair.tets.into_iter().zip(of_pair) {
                forces[tet as usize].iter_mut().zip(of_tet).for_each(|(total, force)| *total += force);
            }
        }
    }

    /// Whether tetrahedra of two different bodies press each other.
    pub fn between_bodies(&self, tets: &Tets) -> bool {
        let body = |tet: u32| tets.body[tet as usize];
        self.touching > 0
            && self.pairs.iter().any(|pair| pair.forces.is_some() && body(pair.tets[0]) != body(pair.tets[1]))
    }

    /// Pairs whose boxes are nearer than two skins; those known already keep what they remember.
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
        let known = |of: [u32; 2]| match self.pairs.binary_search_by_key(&of, |pair| pair.tets) {
            Ok(index) => self.pairs[index],
            Err(_) => Pair::new(of, setup, tets),
        };
        let mut pairs: Vec<Pair> = detection.pairs(&boxes, keep).iter().map(|pair| known(tets_of(*pair))).collect();
        for (of, left) in self.opened.drain(..) {
            if let Ok(index) = pairs.binary_search_by_key(&of, |pair| pair.tets) {
                // A pair that was looked at before has its overlap counted already.
                pairs[index].left = if pairs[index].born.is_none() { left } else { 0.0 };
            }
        }
        self.pairs = pairs;
        (self.travelled, self.outdated) = (0.0, false);
    }

    /// Whether nothing holds two tetrahedra together around a node that they share, or the face between them has broken.
    fn can_touch(&self, [a, b]: [u32; 2], setup: &Setup, tets: &Tets, is_broken: impl Fn(usize) -> bool) -> bool {
        let nodes = [a, b].map(|tet| setup.tets[tet as usize]);
        let held = |k: usize| {
            let at = nodes[1].iter().position(|node| *node == nodes[0][k]);
            at.is_some_and(|l| self.group[4 * a as usize + k] == self.group[4 * b as usize + l])
        };
        let broken_between = || {
            let links = tets.faces[a as usize].iter().filter_map(|link| link.interface());
            links.into_iter().any(|(face, side)| setup.interfaces[face].tets[1 - side] == b && is_broken(face))
        };
        !(0..4).any(held) || broken_between()
    }
}

/// Whether a face of one of two tetrahedra has all of the other one further out than a gap [m]. Boxes about tetrahedra
/// that are two apart on the same surface often meet: of pairs of boxes, few are left by this.
fn are_apart(a: &[DVec3; 4], b: &[DVec3; 4], gap: f64) -> bool {
    let beyond_a_face = |of: &[DVec3; 4], other: &[DVec3; 4]| {
        let Some(of) = Tetrahedron::new(of) else { return false };
        let [p, q, r, s] = other.map(|vertex| of.shape_functions(vertex));
        let nearest = p.max(q).max(r.max(s)).to_array();
        // A shape function falls by the length of its gradient to the metre.
        nearest.iter().zip(of.gradients).any(|(nearest, gradient)| *nearest < -gap * gradient.length())
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
            None => self.bear(found.as_ref(), &moves()),
        };
        self.born = Some(born);
        let Some(found) = found.filter(|_| energy > born) else {
            let held = self.spring.take().map_or(0.0, |spring| spring.stored(&self.law));
            (self.forces, self.stored) = (None, 0.0);
            self.dissipated += held;
            return;
        };
        let penalty = self.penalty * (1.0 - (born / energy).sqrt());
        let mut forces = found.forces.map(|of_tet| of_tet.map(|force| force * penalty));
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

    /// The overlap that does not count [m3]. It is such that the pair had the energy left to it when its joint gave way,
    /// half a step ago: with s = sqrt I - sqrt I_b, p s^2 now less half of what the motion of this step does against its
    /// forces, the share s / sqrt I of those of the whole overlap.
    fn bear(&mut self, found: Option<&Overlap>, moves: &[[DVec3; 4]; 2]) -> f64 {
        let left = std::mem::take(&mut self.left);
        let Some(found) = found.filter(|found| found.energy > 0.0) else { return 0.0 };
        let root = found.energy.sqrt();
        let along = found.forces.iter().flatten().zip(moves.iter().flatten()).map(|(force, way)| force.dot(*way));
        // Of the whole overlap, over p sqrt I.
        let work = -0.5 * along.sum::<f64>() / root;
        let counts = (0.5 * (work + (work * work + 4.0 * left / self.penalty).sqrt())).clamp(0.0, root);
        self.left = (self.penalty * counts * (counts - work)).max(0.0);
        (root - counts).powi(2)
    }
}
