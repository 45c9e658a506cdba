//! All joints of a world as arrays: the bond of each face and the joint forces.
//!
//! | file | contents |
//! | --- | --- |
//! | `joint` | the joint element between two tetrahedra |
//! | `intact_joint` | forces of intact joints, four joints at a time |
//!
//! Intact joints need no stored state. Damaged joints (with damage or plastic slip, or released from tied faces) are in
//! a separate list, in the order in which they were damaged or released.

use glam::DVec3;
use rayon::prelude::*;

mod intact_joint;
pub mod joint;

use super::assembly::{nodes::Nodes, tets::Tets};
use super::material::cohesive_law::{Cohesion, POINT_STATE_LENGTH, PointState};
use super::parallel::chunks::{CHUNK, ordered_sum};
use super::parallel::lanes::{self, LANES, Lanes, Vectors, WithLanes};
use super::setup::Setup;
use intact_joint::{IntactForces, IntactLaw};
use joint::JointState;

/// Bond between two tetrahedra at their common face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// Tied: the tetrahedra share their nodes until the strength is reached.
    Tied,
    /// Intact joint: no damage and no plastic slip.
    Intact,
    /// Damaged joint: with damage or plastic slip, or released from a tied face.
    Damaged,
    /// Broken: no joint any more.
    Broken,
}

/// Number of values in the stored state of a damaged joint, see [`DamagedJoint::to_array`].
pub const JOINT_STATE_LENGTH: usize = 4 + 3 * POINT_STATE_LENGTH;

/// A damaged joint, see [`Bond::Damaged`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamagedJoint {
    /// Number of the interface.
    pub interface: u32,
    /// State of the integration points.
    pub state: JointState,
    /// Energy dissipated so far [J].
    pub dissipated: f64,
    /// Elastic energy of the joint when it was released from a tied face [J]; zero for a joint that was never tied.
    pub released: f64,
    /// Forces on the corners of side 0 [N].
    forces: [DVec3; 3],
    /// True if the joint breaks at the end of this time step.
    pub failed: bool,
}

/// The joints of a world. Faces have the same numbers as the interfaces of the setup.
#[derive(Debug, Clone, Default)]
pub struct Joints {
    /// Bond of each face.
    pub bond: Vec<Bond>,
    /// Mean edge length h [m] and undeformed area [m2] of each face.
    pub size: Vec<[f64; 2]>,
    /// Forces of each joint on the corners of side 0 of its face [N]; the forces on side 1 are opposite.
    pub forces: Vec<[DVec3; 3]>,
    /// Damaged joints.
    pub damaged: Vec<DamagedJoint>,
    /// Workspace: intact joints that have reached their strength, per chunk.
    reached: Vec<Vec<u32>>,
}

impl DamagedJoint {
    /// Creates a damaged joint with a given state that has dissipated nothing yet.
    pub fn new(interface: usize, state: JointState) -> Self {
        let forces = [DVec3::ZERO; 3];
        Self { interface: interface as u32, state, dissipated: 0.0, released: 0.0, forces, failed: false }
    }

    /// Returns the joint as numbers for a checkpoint: the fields `offset` and `is_damaged` (1 or 0) of its state, the
    /// energies `dissipated` and `released`, and the states of the three integration points.
    pub fn to_array(&self) -> [f64; JOINT_STATE_LENGTH] {
        let JointState { points, offset, is_damaged } = self.state;
        let mut numbers = [0.0; JOINT_STATE_LENGTH];
        numbers[..4].copy_from_slice(&[offset, f64::from(u8::from(is_damaged)), self.dissipated, self.released]);
        numbers[4..].copy_from_slice(points.map(PointState::to_array).as_flattened());
        numbers
    }

    /// Restores the joint of an interface from the numbers of [`Self::to_array`].
    pub fn from_array(interface: u32, numbers: [f64; JOINT_STATE_LENGTH]) -> Self {
        let [offset, is_damaged, dissipated, released, ref points @ ..] = numbers;
        let points = std::array::from_fn(|k| PointState::from_array(points.as_chunks().0[k]));
        let state = JointState { points, offset, is_damaged: is_damaged != 0.0 };
        Self { dissipated, released, ..Self::new(interface as usize, state) }
    }
}

impl Joints {
    /// Creates the joints in their initial state.
    pub fn new(setup: &Setup) -> Self {
        let count = setup.interfaces.len();
        let mut joints = Self { forces: vec![[DVec3::ZERO; 3]; count], ..Self::default() };
        joints.reached = vec![Vec::new(); count.div_ceil(CHUNK)];
        for number in 0..count {
            let (edge, area) = joint::size(&corners(setup, number));
            joints.size.push([edge, area]);
            joints.bond.push(if cohesion(setup, number).tied { Bond::Tied } else { Bond::Intact });
        }
        setup.cracks.iter().for_each(|crack| joints.bond[*crack as usize] = Bond::Broken);
        joints
    }

    /// Marks the tetrahedra that have, or had, a joint at one of their faces.
    pub fn mark_tetrahedra(&self, setup: &Setup, tets: &mut Tets) {
        let jointed = setup.interfaces.iter().zip(&self.bond).filter(|(_, bond)| **bond != Bond::Tied);
        jointed.for_each(|(interface, _)| interface.tets.iter().for_each(|tet| tets.jointed[*tet as usize] = true));
    }

    /// Returns the number of faces.
    pub fn count(&self) -> usize {
        self.bond.len()
    }

    /// Computes all joint forces at the current positions. `dt` [s] is the length of the last time step.
    pub fn compute_forces(&mut self, setup: &Setup, tets: &Tets, nodes: &Nodes, dt: f64) {
        let Self { bond, size, forces, damaged, reached } = self;
        let chunks = bond.par_chunks(CHUNK).zip(forces.par_chunks_mut(CHUNK)).zip(reached.par_iter_mut());
        chunks.enumerate().for_each(|(chunk, ((bond, forces), reached))| {
            let first = chunk * CHUNK;
            let size = &size[first..first + bond.len()];
            lanes::dispatch(IntactChunk { first, bond, size, forces, reached, setup, tets, nodes });
        });
        for number in reached.iter_mut().flat_map(|reached| reached.drain(..)) {
            let number = number as usize;
            bond[number] = Bond::Damaged;
            // The state one time step earlier is needed first, to find the dissipation in this time step.
            let ([edge, area], mut state) = (size[number], JointState::default());
            let before = faces_before(number, setup, tets, nodes, dt);
            joint::forces(&cohesion(setup, number).law(edge), area, &mut state, &before);
            damaged.push(DamagedJoint::new(number, state));
        }
        damaged.par_iter_mut().with_min_len(CHUNK / LANES).for_each(|joint| {
            let number = joint.interface as usize;
            let [edge, area] = size[number];
            let sides = faces(number, setup, tets, nodes);
            let response = joint::forces(&cohesion(setup, number).law(edge), area, &mut joint.state, &sides);
            joint.forces = response.forces;
            joint.dissipated += response.dissipated;
            // A joint fails when two of its three integration points have failed, as is usual in the literature.
            joint.failed = response.failed >= 2;
        });
        damaged.iter().for_each(|joint| forces[joint.interface as usize] = joint.forces);
    }

    /// Returns the elastic energy of all joints [J].
    pub fn stored(&self, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        let intact = |number: usize| self.intact_energy(number, setup, tets, nodes);
        let damaged = |k: usize| self.damaged_energy(&self.damaged[k], setup);
        ordered_sum(self.count(), intact) + ordered_sum(self.damaged.len(), damaged)
    }

    /// Returns the elastic energy of the joint at a face [J]; zero if the joint is not intact.
    pub fn intact_energy(&self, number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
        if self.bond[number] != Bond::Intact {
            return 0.0;
        }
        let [edge, area] = self.size[number];
        let (law, sides) = (cohesion(setup, number).law(edge), faces(number, setup, tets, nodes));
        // An intact joint has no history, so its state follows from a new state and the current positions.
        let mut state = JointState::default();
        joint::forces(&law, area, &mut state, &sides);
        joint::stored(&law, area, &state)
    }

    /// Returns the energy dissipated so far [J] by joints that are damaged but not broken.
    pub fn dissipated(&self) -> f64 {
        self.damaged.iter().fold(0.0, |sum, joint| sum + joint.dissipated)
    }

    /// Returns the elastic energy of a damaged joint at the last computation of its forces [J].
    pub fn damaged_energy(&self, joint: &DamagedJoint, setup: &Setup) -> f64 {
        let number = joint.interface as usize;
        let [edge, area] = self.size[number];
        joint::stored(&cohesion(setup, number).law(edge), area, &joint.state)
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
            // Lanes without a joint of their own repeat the last joint; their results are not used.
            let (mut indices, mut count) = ([0; LANES], 0);
            while next < self.bond.len() && count < LANES {
                if self.bond[next] == Bond::Intact {
                    indices[count..].fill(next);
                    count += 1;
                }
                next += 1;
            }
            if count == 0 {
                return;
            }
            let response: IntactForces<L> = self.lane_forces(indices);
            let [a, b, c] = response.forces;
            let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
            let beyond = response.beyond.to_array();
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
    fn lane_forces<L: Lanes>(&self, indices: [usize; LANES]) -> IntactForces<L> {
        let law = IntactLaw::from_fn(|lane| cohesion(self.setup, self.first + indices[lane]));
        let edge = L::from_fn(|lane| self.size[indices[lane]][0]);
        let area = L::from_fn(|lane| self.size[indices[lane]][1]);
        law.forces(edge, area, &[self.side(0, indices), self.side(1, indices)])
    }

    /// Returns the corners of one side of the interfaces in the SIMD lanes [m].
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
            Vectors::from_fn(|lane| nodes.position[corners[lane][0] as usize]),
            Vectors::from_fn(|lane| nodes.position[corners[lane][1] as usize]),
            Vectors::from_fn(|lane| nodes.position[corners[lane][2] as usize]),
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

/// Returns the current corners of both sides of an interface [m].
pub fn faces(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> [[DVec3; 3]; 2] {
    faces_before(number, setup, tets, nodes, 0.0)
}

/// Returns the corners of both sides of an interface [m] a `time` [s] ago, if nodes moved with their current
/// velocities.
fn faces_before(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes, time: f64) -> [[DVec3; 3]; 2] {
    let position = |node: u32| nodes.position[node as usize] - nodes.velocity[node as usize] * time;
    [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(position))
}

/// Returns the power [W] that a damaged joint receives from the motion of its two faces.
pub fn power_on(joint: &DamagedJoint, setup: &Setup, tets: &Tets, nodes: &Nodes) -> f64 {
    let number = joint.interface as usize;
    let [one, other] = [0, 1].map(|side| corner_nodes(number, side, setup, tets).map(|n| nodes.velocity[n as usize]));
    (0..3).map(|k| joint.forces[k].dot(other[k] - one[k])).sum()
}

/// Returns the node numbers at the corners of one side of an interface.
#[inline(always)]
fn corner_nodes(number: usize, side: usize, setup: &Setup, tets: &Tets) -> [u32; 3] {
    let interface = &setup.interfaces[number];
    let (vertices, [a, b, c]) = (&tets.nodes[interface.tets[side] as usize], interface.nodes[side]);
    [vertices[usize::from(a)], vertices[usize::from(b)], vertices[usize::from(c)]]
}

/// Returns the undeformed corners of an interface [m].
pub fn corners(setup: &Setup, number: usize) -> [DVec3; 3] {
    let interface = &setup.interfaces[number];
    let tet = &setup.tets[interface.tets[0] as usize];
    interface.nodes[0].map(|k| setup.nodes[tet[usize::from(k)] as usize])
}
