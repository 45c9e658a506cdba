//! All joints of a world, as arrays: what holds each face, and the stresses of the joints.
//!
//! Joints without a past need no memory of their own. Those with damage or slip behind them, and those that came free
//! under load, are in a list of their own, in the order in which they came there.

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::{Nodes, Tets};
use super::book::ordered_sum;
use super::cohesive_law::Cohesion;
use super::joint::{self, Memory};
use super::lanes::{self, LANES, Lanes, Vectors, WithLanes};
use super::setup::Setup;
use super::whole_joint::{WholeAnswer, WholeLaw};
use super::world::PIECE;

/// What holds two tetrahedra together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// They share their nodes until the strength is reached.
    Tied,
    /// A joint without a past.
    Whole,
    /// A joint with damage or slip behind it, or one that came free under load.
    Worn,
    /// Nothing any more.
    Broken,
}

/// A joint with a past.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WornJoint {
    /// Number of the interface.
    pub interface: u32,
    /// What it remembers.
    pub memory: Memory,
    /// Energy lost so far [J].
    pub dissipated: f64,
    /// Energy that its spring had when it came free [J].
    pub freed: f64,
    /// On the corners of side 0 [N].
    pub(super) forces: [DVec3; 3],
    /// It gives way after this step.
    pub failed: bool,
}

/// The joints of a world; faces are numbered like the interfaces of its setup.
#[derive(Debug, Clone, Default)]
pub struct Joints {
    /// What holds each face.
    pub bond: Vec<Bond>,
    /// Mean edge length h [m] and undeformed area [m2] of each face.
    pub size: Vec<[f64; 2]>,
    /// Of each face, on the corners of side 0 [N]; side 1 has the negative.
    pub forces: Vec<[DVec3; 3]>,
    /// Joints with a past.
    pub worn: Vec<WornJoint>,
    /// Workspace: whole joints that have reached their strength, by piece.
    reached: Vec<Vec<u32>>,
}

impl WornJoint {
    /// Joint with a memory that has lost nothing yet.
    pub fn new(interface: usize, memory: Memory) -> Self {
        let forces = [DVec3::ZERO; 3];
        Self { interface: interface as u32, memory, dissipated: 0.0, freed: 0.0, forces, failed: false }
    }
}

impl Joints {
    /// Joints at the start.
    pub fn new(setup: &Setup) -> Self {
        let count = setup.interfaces.len();
        let mut joints = Self { forces: vec![[DVec3::ZERO; 3]; count], ..Self::default() };
        joints.reached = vec![Vec::new(); count.div_ceil(PIECE)];
        for number in 0..count {
            let (edge, area) = joint::size(&corners(setup, number));
            joints.size.push([edge, area]);
            joints.bond.push(if cohesion(setup, number).tied { Bond::Tied } else { Bond::Whole });
        }
        setup.cracks.iter().for_each(|crack| joints.bond[*crack as usize] = Bond::Broken);
        joints
    }

    /// Mark the tetrahedra at whose faces joints pull, or have pulled.
    pub fn mark(&self, setup: &Setup, tets: &mut Tets) {
        let jointed = setup.interfaces.iter().zip(&self.bond).filter(|(_, bond)| **bond != Bond::Tied);
        jointed.for_each(|(interface, _)| interface.tets.iter().for_each(|tet| tets.jointed[*tet as usize] = true));
    }

    /// How many faces there are.
    pub fn count(&self) -> usize {
        self.bond.len()
    }

    /// Stresses at the present places, to which the velocities have led over the last step `dt` [s].
    pub fn pull(&mut self, setup: &Setup, tets: &Tets, nodes: &Nodes, dt: f64) {
        let Self { bond, size, forces, worn, reached } = self;
        let pieces = bond.par_chunks(PIECE).zip(forces.par_chunks_mut(PIECE)).zip(reached.par_iter_mut());
        pieces.enumerate().for_each(|(piece, ((bond, forces), reached))| {
            let first = piece * PIECE;
            let size = &size[first..first + bond.len()];
            lanes::dispatch(WholePiece { first, bond, size, forces, reached, setup, tets, nodes });
        });
        for number in reached.iter_mut().flat_map(|reached| reached.drain(..)) {
            let number = number as usize;
            bond[number] = Bond::Worn;
            // Where it was before: its first slip is from there.
            let ([edge, area], mut memory) = (size[number], Memory::default());
            let before = faces_before(number, setup, tets, nodes, dt);
            joint::forces(&cohesion(setup, number).law(edge), area, &mut memory, &before);
            worn.push(WornJoint::new(number, memory));
        }
        worn.par_iter_mut().with_min_len(PIECE / LANES).for_each(|joint| {
            let number = joint.interface as usize;
            let [edge, area] = size[number];
            let sides = faces(number, setup, tets, nodes);
            let answer = joint::forces(&cohesion(setup, number).law(edge), area, &mut joint.memory, &sides);
            joint.forces = answer.forces;
            joint.dissipated += answer.dissipated;
            // Of three points two: the field's use.
            joint.failed = answer.failed >= 2;
        });
        worn.iter().for_each(|joint| forces[joint.interface as usize] = joint.forces);
    }

    /// Energy that the joints would give back [J].
    pub fn stored(&self, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        let whole = |number: usize| self.stored_in_whole(number, setup, tets, nodes);
        let worn = |k: usize| self.stored_in(&self.worn[k], setup);
        ordered_sum(self.count(), whole) + ordered_sum(self.worn.len(), worn)
    }

    /// Energy that the joint of a face would give back [J], if it has no past.
    pub fn stored_in_whole(&self, number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        if self.bond[number] != Bond::Whole {
            return 0.0;
        }
        let [edge, area] = self.size[number];
        let (law, sides) = (cohesion(setup, number).law(edge), faces(number, setup, tets, nodes));
        // Brings an empty memory to the present places.
        let mut memory = Memory::default();
        joint::forces(&law, area, &mut memory, &sides);
        joint::stored(&law, area, &memory)
    }

    /// Energy that joints with a past have lost so far, but for those that have broken [J].
    pub fn dissipated(&self) -> f64 {
        self.worn.iter().fold(0.0, |sum, joint| sum + joint.dissipated)
    }

    /// Energy that a joint with a past would give back where it last pulled [J].
    pub fn stored_in(&self, joint: &WornJoint, setup: &Setup) -> f64 {
        let number = joint.interface as usize;
        let [edge, area] = self.size[number];
        joint::stored(&cohesion(setup, number).law(edge), area, &joint.memory)
    }
}

/// The whole joints of a piece.
struct WholePiece<'a> {
    first: usize,
    bond: &'a [Bond],
    size: &'a [[f64; 2]],
    forces: &'a mut [[DVec3; 3]],
    reached: &'a mut Vec<u32>,
    setup: &'a Setup,
    tets: &'a Tets,
    nodes: &'a Nodes,
}

impl WithLanes for WholePiece<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let mut next = 0;
        loop {
            // The last of fewer than four fills the lanes.
            let (mut of, mut count) = ([0; LANES], 0);
            while next < self.bond.len() && count < LANES {
                if self.bond[next] == Bond::Whole {
                    of[count..].fill(next);
                    count += 1;
                }
                next += 1;
            }
            if count == 0 {
                return;
            }
            let answer: WholeAnswer<L> = self.answer(of);
            let [a, b, c] = answer.forces;
            let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
            let beyond = answer.beyond.to_array();
            for lane in 0..count {
                if beyond[lane] > 0.0 {
                    self.reached.push((self.first + of[lane]) as u32);
                } else {
                    self.forces[of[lane]] = [a[lane], b[lane], c[lane]];
                }
            }
        }
    }
}

impl WholePiece<'_> {
    #[inline(always)]
    fn answer<L: Lanes>(&self, of: [usize; LANES]) -> WholeAnswer<L> {
        let law = WholeLaw::from_fn(|lane| cohesion(self.setup, self.first + of[lane]));
        let edge = L::from_fn(|lane| self.size[of[lane]][0]);
        let area = L::from_fn(|lane| self.size[of[lane]][1]);
        law.forces(edge, area, &[self.side(0, of), self.side(1, of)])
    }

    /// Corners of one side of the interfaces in the lanes [m].
    #[inline(always)]
    fn side<L: Lanes>(&self, side: usize, of: [usize; LANES]) -> [Vectors<L>; 3] {
        let Self { first, setup, tets, nodes, .. } = self;
        let at = [
            corner_nodes(first + of[0], side, setup, tets),
            corner_nodes(first + of[1], side, setup, tets),
            corner_nodes(first + of[2], side, setup, tets),
            corner_nodes(first + of[3], side, setup, tets),
        ];
        [
            Vectors::from_fn(|lane| nodes.place[at[lane][0] as usize]),
            Vectors::from_fn(|lane| nodes.place[at[lane][1] as usize]),
            Vectors::from_fn(|lane| nodes.place[at[lane][2] as usize]),
        ]
    }
}

/// How the joint of an interface holds.
#[inline]
pub fn cohesion(setup: &Setup, number: usize) -> &Cohesion {
    let tet = setup.interfaces[number].tets[0] as usize;
    let body = setup.bodies.iter().find(|body| tet < body.tets.end);
    body.and_then(|body| body.cohesion.as_ref()).expect("interfaces lie in bodies that crack")
}

/// Corners of both sides of an interface [m].
pub fn faces(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> [[DVec3; 3]; 2] {
    faces_before(number, setup, tets, nodes, 0.0)
}

/// Corners of both sides of an interface a time before, over which their nodes had the velocities of now [m].
fn faces_before(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes, time: f64) -> [[DVec3; 3]; 2] {
    let place = |node: u32| nodes.place[node as usize] - nodes.velocity[node as usize] * time;
    [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(place))
}

/// Power that the motion of its faces gives to a joint [W].
pub fn power_on(joint: &WornJoint, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
    let number = joint.interface as usize;
    let [one, other] = [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(|n| nodes.velocity[n as usize]));
    (0..3).map(|k| joint.forces[k].dot(other[k] - one[k])).sum()
}

/// Nodes at the corners of one side of an interface.
#[inline(always)]
fn corner_nodes(number: usize, side: usize, setup: &Setup, tets: &Tets) -> [u32; 3] {
    let interface = &setup.interfaces[number];
    let (at, [a, b, c]) = (&tets.nodes[interface.tets[side] as usize], interface.nodes[side]);
    [at[usize::from(a)], at[usize::from(b)], at[usize::from(c)]]
}

/// Undeformed corners of an interface [m].
pub fn corners(setup: &Setup, number: usize) -> [DVec3; 3] {
    let interface = &setup.interfaces[number];
    let tet = &setup.tets[interface.tets[0] as usize];
    interface.nodes[0].map(|k| setup.nodes[tet[usize::from(k)] as usize])
}
