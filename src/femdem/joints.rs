//! All joints of a world as arrays: the bond of each face and the joint forces.
//!
//! Intact joints need no stored state. Joints with damage or plastic slip, and joints released from tied faces, are in
//! a separate list, in the order in which they entered it.

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

/// Bond between two tetrahedra at their common face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// Tied: the tetrahedra share their nodes until the strength is reached.
    Tied,
    /// Intact joint: no damage and no plastic slip.
    Whole,
    /// Damaged joint: with damage or plastic slip, or released from a tied face.
    Worn,
    /// Broken: no joint any more.
    Broken,
}

/// A damaged joint, see [`Bond::Worn`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WornJoint {
    /// Number of the interface.
    pub interface: u32,
    /// State of the integration points.
    pub memory: Memory,
    /// Energy dissipated so far [J].
    pub dissipated: f64,
    /// Elastic energy when the joint was released [J].
    pub freed: f64,
    /// Forces on the corners of side 0 [N].
    pub(super) forces: [DVec3; 3],
    /// Whether the joint breaks after this time step.
    pub failed: bool,
}

/// The joints of a world; faces are numbered like the interfaces of its setup.
#[derive(Debug, Clone, Default)]
pub struct Joints {
    /// Bond of each face.
    pub bond: Vec<Bond>,
    /// Mean edge length h [m] and undeformed area [m2] of each face.
    pub size: Vec<[f64; 2]>,
    /// Forces of each face on the corners of side 0 [N]; side 1 has the negative.
    pub forces: Vec<[DVec3; 3]>,
    /// Damaged joints.
    pub worn: Vec<WornJoint>,
    /// Workspace: intact joints that have reached their strength, per chunk.
    reached: Vec<Vec<u32>>,
}

impl WornJoint {
    /// Creates a damaged joint with a given state that has dissipated nothing yet.
    pub fn new(interface: usize, memory: Memory) -> Self {
        let forces = [DVec3::ZERO; 3];
        Self { interface: interface as u32, memory, dissipated: 0.0, freed: 0.0, forces, failed: false }
    }
}

impl Joints {
    /// Creates the joints in their initial state.
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

    /// Marks the tetrahedra that have, or had, a joint at one of their faces.
    pub fn mark(&self, setup: &Setup, tets: &mut Tets) {
        let jointed = setup.interfaces.iter().zip(&self.bond).filter(|(_, bond)| **bond != Bond::Tied);
        jointed.for_each(|(interface, _)| interface.tets.iter().for_each(|tet| tets.jointed[*tet as usize] = true));
    }

    /// Number of faces.
    pub fn count(&self) -> usize {
        self.bond.len()
    }

    /// Computes all joint forces at the current positions; `dt` [s] is the last time step.
    pub fn pull(&mut self, setup: &Setup, tets: &Tets, nodes: &Nodes, dt: f64) {
        let Self { bond, size, forces, worn, reached } = self;
        let chunks = bond.par_chunks(PIECE).zip(forces.par_chunks_mut(PIECE)).zip(reached.par_iter_mut());
        chunks.enumerate().for_each(|(chunk, ((bond, forces), reached))| {
            let first = chunk * PIECE;
            let size = &size[first..first + bond.len()];
            lanes::dispatch(IntactChunk { first, bond, size, forces, reached, setup, tets, nodes });
        });
        for number in reached.iter_mut().flat_map(|reached| reached.drain(..)) {
            let number = number as usize;
            bond[number] = Bond::Worn;
            // The state before this time step, so that the first slip is counted from there.
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
            // Two of three failed points break a joint, as is usual in the literature.
            joint.failed = answer.failed >= 2;
        });
        worn.iter().for_each(|joint| forces[joint.interface as usize] = joint.forces);
    }

    /// Elastic energy of all joints [J].
    pub fn stored(&self, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        let whole = |number: usize| self.stored_in_whole(number, setup, tets, nodes);
        let worn = |k: usize| self.stored_in(&self.worn[k], setup);
        ordered_sum(self.count(), whole) + ordered_sum(self.worn.len(), worn)
    }

    /// Elastic energy of the joint of a face [J] if it is intact, else zero.
    pub fn stored_in_whole(&self, number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        if self.bond[number] != Bond::Whole {
            return 0.0;
        }
        let [edge, area] = self.size[number];
        let (law, sides) = (cohesion(setup, number).law(edge), faces(number, setup, tets, nodes));
        // Brings a new state to the current positions.
        let mut memory = Memory::default();
        joint::forces(&law, area, &mut memory, &sides);
        joint::stored(&law, area, &memory)
    }

    /// Energy dissipated so far by the damaged joints, without those that have broken [J].
    pub fn dissipated(&self) -> f64 {
        self.worn.iter().fold(0.0, |sum, joint| sum + joint.dissipated)
    }

    /// Elastic energy of a damaged joint in the state of the last force computation [J].
    pub fn stored_in(&self, joint: &WornJoint, setup: &Setup) -> f64 {
        let number = joint.interface as usize;
        let [edge, area] = self.size[number];
        joint::stored(&cohesion(setup, number).law(edge), area, &joint.memory)
    }
}

/// The intact joints of a chunk.
struct IntactChunk<'a> {
    first: usize,
    bond: &'a [Bond],
    size: &'a [[f64; 2]],
    forces: &'a mut [[DVec3; 3]],
    reached: &'a mut Vec<u32>,
    setup: &'a Setup,
    tets: &'a Tets,
    nodes: &'a Nodes,
}

impl WithLanes for IntactChunk<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let mut next = 0;
        loop {
            // The last joint fills unused lanes.
            let (mut indices, mut count) = ([0; LANES], 0);
            while next < self.bond.len() && count < LANES {
                if self.bond[next] == Bond::Whole {
                    indices[count..].fill(next);
                    count += 1;
                }
                next += 1;
            }
            if count == 0 {
                return;
            }
            let answer: WholeAnswer<L> = self.lane_forces(indices);
            let [a, b, c] = answer.forces;
            let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
            let beyond = answer.beyond.to_array();
            for lane in 0..count {
                if beyond[lane] > 0.0 {
                    self.reached.push((self.first + indices[lane]) as u32);
                } else {
                    self.forces[indices[lane]] = [a[lane], b[lane], c[lane]];
                }
            }
        }
    }
}

impl IntactChunk<'_> {
    #[inline(always)]
    fn lane_forces<L: Lanes>(&self, indices: [usize; LANES]) -> WholeAnswer<L> {
        let law = WholeLaw::from_fn(|lane| cohesion(self.setup, self.first + indices[lane]));
        let edge = L::from_fn(|lane| self.size[indices[lane]][0]);
        let area = L::from_fn(|lane| self.size[indices[lane]][1]);
        law.forces(edge, area, &[self.side(0, indices), self.side(1, indices)])
    }

    /// Corners of one side of the interfaces in the lanes [m].
    #[inline(always)]
    fn side<L: Lanes>(&self, side: usize, indices: [usize; LANES]) -> [Vectors<L>; 3] {
        let Self { first, setup, tets, nodes, .. } = self;
        let corners = [
            corner_nodes(first + indices[0], side, setup, tets),
            corner_nodes(first + indices[1], side, setup, tets),
            corner_nodes(first + indices[2], side, setup, tets),
            corner_nodes(first + indices[3], side, setup, tets),
        ];
        [
            Vectors::from_fn(|lane| nodes.place[corners[lane][0] as usize]),
            Vectors::from_fn(|lane| nodes.place[corners[lane][1] as usize]),
            Vectors::from_fn(|lane| nodes.place[corners[lane][2] as usize]),
        ]
    }
}

/// Returns the cohesive parameters of the joint at an interface.
#[inline]
pub fn cohesion(setup: &Setup, number: usize) -> &Cohesion {
    let tet = setup.interfaces[number].tets[0] as usize;
    let body = setup.bodies.iter().find(|body| tet < body.tets.end);
    body.and_then(|body| body.cohesion.as_ref()).expect("interfaces lie in bodies that crack")
}

/// Current corners of both sides of an interface [m].
pub fn faces(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> [[DVec3; 3]; 2] {
    faces_before(number, setup, tets, nodes, 0.0)
}

/// Corners of both sides of an interface [m] a `time` [s] ago, if the nodes moved with their current velocities.
fn faces_before(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes, time: f64) -> [[DVec3; 3]; 2] {
    let position = |node: u32| nodes.place[node as usize] - nodes.velocity[node as usize] * time;
    [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(position))
}

/// Power that the motion of its faces supplies to a joint [W].
pub fn power_on(joint: &WornJoint, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
    let number = joint.interface as usize;
    let [one, other] = [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(|n| nodes.velocity[n as usize]));
    (0..3).map(|k| joint.forces[k].dot(other[k] - one[k])).sum()
}

/// Nodes at the corners of one side of an interface.
#[inline(always)]
fn corner_nodes(number: usize, side: usize, setup: &Setup, tets: &Tets) -> [u32; 3] {
    let interface = &setup.interfaces[number];
    let (vertices, [a, b, c]) = (&tets.nodes[interface.tets[side] as usize], interface.nodes[side]);
    [vertices[usize::from(a)], vertices[usize::from(b)], vertices[usize::from(c)]]
}

/// Undeformed corners of an interface [m].
pub fn corners(setup: &Setup, number: usize) -> [DVec3; 3] {
    let interface = &setup.interfaces[number];
    let tet = &setup.tets[interface.tets[0] as usize];
    interface.nodes[0].map(|k| setup.nodes[tet[usize::from(k)] as usize])
}
