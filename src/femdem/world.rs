//! Deformable bodies in motion: the step of the combined finite-discrete element method.
//!
//! Joints, tetrahedra, contact, nodes: every loop computes what it owns from what it reads (no scatter, no atomics), so
//! that the bits are the same for any number of threads. Velocities stand half a step before the places (central
//! differences; the paper's eqs. 9 and 10).

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::assembly::{self, Copy4, Nodes, Tets};
use super::book::BodyEnergy;
use super::contact::pairs::Contacts;
use super::element::{self, Moduli};
use super::energy::Ledger;
use super::joint::{self, Memory};
use super::loads::CornerForce;
use super::rigid_body::RigidBody;
use super::setup::{Body, Setup};
use super::time_step;

/// Items of one task of the thread pool; sums are taken over these first, so that they have one order.
pub(super) const PIECE: usize = 512;

/// What holds two tetrahedra together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bond {
    /// They share their nodes until the strength is reached.
    Tied,
    /// A joint.
    Joint,
    /// Nothing any more.
    Broken,
}

/// A face between two tetrahedra.
#[derive(Debug, Clone)]
pub struct Joint {
    /// What holds it.
    pub bond: Bond,
    /// Mean edge length h [m].
    pub(super) edge: f64,
    /// Undeformed area [m2].
    pub area: f64,
    pub(super) memory: Memory,
    /// Energy lost so far [J].
    pub dissipated: f64,
    /// Energy that its spring had when it came free [J].
    pub freed: f64,
    /// It gives way after this step.
    pub(super) failed: bool,
}

/// A face that has failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// Number of the interface.
    pub interface: u32,
    /// When [s].
    pub time: f64,
    /// Middle of the undeformed face [m].
    pub place: DVec3,
    /// Undeformed area [m2].
    pub area: f64,
    /// It slid (mode II) more than it opened (mode I).
    pub by_sliding: bool,
}

/// Why a step cannot be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepError {
    /// A tetrahedron was turned inside out.
    Inverted { tet: usize, time: f64 },
}

/// What the tetrahedra of one piece had to say besides their forces.
#[derive(Debug, Clone, Copy, Default)]
struct PieceSum {
    viscous: f64,
    inverted: Option<usize>,
}

/// Deformable bodies.
#[derive(Debug, Clone)]
pub struct World {
    // Parameters.
    pub(super) setup: Setup,
    pub(super) moduli: Vec<Moduli>,
    /// Step [s].
    pub dt: f64,
    // State.
    /// Time [s].
    pub time: f64,
    /// Nodes.
    pub nodes: Nodes,
    /// Tetrahedra.
    pub tets: Tets,
    /// Faces between tetrahedra of bodies that crack.
    pub joints: Vec<Joint>,
    /// Faces that have failed, in order of time.
    pub failures: Vec<Failure>,
    /// Contacts.
    pub contacts: Contacts,
    /// Bodies that are not deformed.
    pub rigid_bodies: Vec<RigidBody>,
    /// All copies of every node of the mesh.
    pub(super) around: Vec<Vec<Copy4>>,
    pub(super) lost: Ledger,
    pub(super) gravity_at_start: f64,
    // Workspace.
    pub(super) forces: Vec<[DVec3; 4]>,
    pub(super) loaded: Vec<CornerForce>,
    pub(super) joint_forces: Vec<[DVec3; 3]>,
    /// Of every tetrahedron [Pa], where faces are tied.
    pub(super) stresses: Vec<DMat3>,
    sums: Vec<PieceSum>,
    pub(super) moved: Vec<[f64; 2]>,
}

impl World {
    /// World at its start; its step is `share` of the longest stable one.
    pub fn new(setup: Setup, share: f64) -> Self {
        let cohesion_of = |tet: u32| body_of(&setup, tet).cohesion;
        let mut joints: Vec<Joint> = Vec::with_capacity(setup.interfaces.len());
        for interface in &setup.interfaces {
            let corners = interface.nodes[0]
                .map(|k| setup.nodes[setup.tets[interface.tets[0] as usize][usize::from(k)] as usize]);
            let (edge, area) = joint::size(&corners);
            let tied = cohesion_of(interface.tets[0]).is_none_or(|cohesion| cohesion.tied);
            let bond = if tied { Bond::Tied } else { Bond::Joint };
            let memory = Memory::default();
            joints.push(Joint { bond, edge, area, memory, dissipated: 0.0, freed: 0.0, failed: false });
        }
        setup.cracks.iter().for_each(|crack| joints[*crack as usize].bond = Bond::Broken);
        let (nodes, tets) = assembly::assemble(&setup, |face| joints[face as usize].bond == Bond::Tied);
        let rigid_bodies = RigidBody::all(&setup, &nodes, &tets);
        // Without moduli, tetrahedra of rigid bodies have no forces.
        let moduli_of = |body: &Body| if body.rigid { Moduli::default() } else { Moduli::from(&body.elastic) };
        let moduli = setup.bodies.iter().map(moduli_of).collect();
        let count = setup.tets.len();
        let around = assembly::copies_around(&setup);
        let unbroken = |face: u32| joints[face as usize].bond != Bond::Broken;
        let groups: Vec<Vec<Copy4>> =
            around.iter().flat_map(|copies| assembly::held_together(&tets, &setup, copies, &unbroken)).collect();
        let contacts = Contacts::new(&setup, groups.iter().map(Vec::as_slice));
        let ties = joints.iter().any(|joint| joint.bond == Bond::Tied);
        let mut world = Self {
            moduli,
            dt: 0.0,
            time: 0.0,
            nodes,
            tets,
            joints,
            failures: Vec::new(),
            contacts,
            rigid_bodies,
            around,
            lost: Ledger::default(),
            gravity_at_start: 0.0,
            forces: vec![[DVec3::ZERO; 4]; count],
            loaded: Vec::new(),
            joint_forces: vec![[DVec3::ZERO; 3]; setup.interfaces.len()],
            stresses: vec![DMat3::ZERO; if ties { count } else { 0 }],
            sums: vec![PieceSum::default(); count.div_ceil(PIECE)],
            moved: Vec::new(),
            setup,
        };
        world.dt = share * world.longest_step();
        world.gravity_at_start = world.energies(0.0).gravity;
        world
    }

    /// What the world is made of.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The longest stable step [s]; every face counts as a joint that could come free.
    pub fn longest_step(&self) -> f64 {
        let step = |t: usize| {
            let body = &self.setup.bodies[usize::from(self.tets.body[t])];
            let shape = &self.tets.shape[t];
            let mass = 0.25 * body.elastic.density * shape.volume;
            let mut springs = [0.0; 4];
            if let Some(cohesion) = body.cohesion {
                for (face, link) in self.tets.faces[t].into_iter().enumerate() {
                    let Some((number, _)) = link.interface() else { continue };
                    let joint = &self.joints[number];
                    let stiffness = cohesion.law(joint.edge).stiffness() * joint.area / 3.0;
                    (0..4).filter(|k| *k != face).for_each(|k| springs[k] += stiffness);
                }
            }
            let pressed = time_step::contact_stiffness(shape, body.contact_penalty);
            if body.rigid {
                // Only what can touch counts. Nodes that move as one answer less than those of a tetrahedron alone.
                let touches = pressed > 0.0 && self.setup.outer.binary_search(&(t as u32)).is_ok();
                return if touches { time_step::stable_step(2.0 * pressed / mass, 0.0) } else { f64::INFINITY };
            }
            let springs = 2.0 * springs.into_iter().fold(pressed, f64::max) / mass;
            let frequency_squared = time_step::element_frequency_squared(shape, &body.elastic) + springs;
            time_step::stable_step(frequency_squared, time_step::element_damping_rate(shape, &body.elastic))
        };
        (0..self.tets.nodes.len()).into_par_iter().map(step).reduce(|| f64::INFINITY, f64::min)
    }

    /// Take one step.
    ///
    /// # Errors
    /// If a tetrahedron is turned inside out.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.advance(false, None).map(|_| ())
    }

    /// Take one step, and tell the energy book at its start.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn step_with_ledger(&mut self) -> Result<Ledger, StepError> {
        self.advance(true, None)
    }

    /// Take one step, and tell the energy book at its start with each body's part of it.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn step_with_books(&mut self) -> Result<(Ledger, Vec<BodyEnergy>), StepError> {
        let mut bodies = Vec::new();
        let ledger = self.advance(true, Some(&mut bodies))?;
        Ok((ledger, bodies))
    }

    fn advance(&mut self, book: bool, mut bodies: Option<&mut Vec<BodyEnergy>>) -> Result<Ledger, StepError> {
        self.pull_joints();
        let viscous_power = self.deform_tets()?;
        self.press_contacts();
        self.apply_loads();
        let mut ledger = if book { self.energies(viscous_power) } else { Ledger::default() };
        let before = bodies.as_mut().map(|bodies| {
            **bodies = self.body_energies();
            self.nodes.velocity.clone()
        });
        let power = self.power_of_loads();
        let [kinetic, work] = self.move_nodes();
        let work = work + 0.5 * self.dt * (power + self.power_of_loads());
        if let (Some(bodies), Some(before)) = (bodies, before) {
            self.add_kinetic_energies(bodies, &before);
        }
        ledger.kinetic = kinetic;
        // Half of the work of this step is done after its start.
        ledger.work += 0.5 * work;
        self.lost.viscous += self.dt * viscous_power;
        self.lost.work += work;
        self.release_joints();
        self.time += self.dt;
        Ok(ledger)
    }

    /// Stresses of the joints at the present places.
    fn pull_joints(&mut self) {
        let Self { joints, joint_forces, tets, nodes, setup, .. } = self;
        let of = |number: usize, joint: &mut Joint, forces: &mut [DVec3; 3]| {
            if joint.bond != Bond::Joint {
                return;
            }
            let Some(cohesion) = body_of(setup, setup.interfaces[number].tets[0]).cohesion else { return };
            let sides = faces(number, setup, tets, nodes);
            let answer = joint::forces(&cohesion.law(joint.edge), joint.area, &mut joint.memory, &sides);
            *forces = answer.forces;
            joint.dissipated += answer.dissipated;
            // Of three points two: the field's use.
            joint.failed = answer.failed >= 2;
        };
        let pieces = joints.par_chunks_mut(PIECE).zip(joint_forces.par_chunks_mut(PIECE)).enumerate();
        pieces.for_each(|(piece, (joints, forces))| {
            let each = joints.iter_mut().zip(forces).enumerate();
            each.for_each(|(k, (joint, forces))| of(piece * PIECE + k, joint, forces));
        });
    }

    /// Forces of the tetrahedra on their vertices, with those of the joints at their faces; the power of viscosity [W].
    fn deform_tets(&mut self) -> Result<f64, StepError> {
        let Self { forces, joint_forces, stresses, sums, tets, nodes, moduli, .. } = self;
        let tet = |t: usize, out: &mut [DVec3; 4], stress: Option<&mut DMat3>, sum: &mut PieceSum| {
            let at = tets.nodes[t].map(|n| n as usize);
            let (x, v) = (at.map(|n| nodes.place[n]), at.map(|n| nodes.velocity[n]));
            let moduli = &moduli[usize::from(tets.body[t])];
            let answer = element::forces(&tets.shape[t], moduli, &x, &v);
            let [a, b, c] = answer.forces;
            *out = [-(a + b + c), a, b, c];
            sum.viscous += answer.viscous_power;
            // Not a number counts, too.
            if answer.ratio.is_nan() || answer.ratio <= 0.0 {
                sum.inverted = sum.inverted.or(Some(t));
            }
            if let Some(stress) = stress {
                *stress = element::stress(&tets.shape[t], moduli, &x);
            }
            for link in tets.faces[t] {
                let Some((number, side)) = link.interface() else { continue };
                let sign = if side == 0 { 1.0 } else { -1.0 };
                for (k, force) in link.nodes.into_iter().zip(joint_forces[number]) {
                    out[usize::from(k)] += force * sign;
                }
            }
        };
        let with_stress = !stresses.is_empty();
        let pieces = forces.par_chunks_mut(PIECE).zip(sums.par_iter_mut()).enumerate();
        if with_stress {
            pieces.zip(stresses.par_chunks_mut(PIECE)).for_each(|((piece, (forces, sum)), stresses)| {
                *sum = PieceSum::default();
                for (k, (out, stress)) in forces.iter_mut().zip(stresses).enumerate() {
                    tet(piece * PIECE + k, out, Some(stress), sum);
                }
            });
        } else {
            pieces.for_each(|(piece, (forces, sum))| {
                *sum = PieceSum::default();
                for (k, out) in forces.iter_mut().enumerate() {
                    tet(piece * PIECE + k, out, None, sum);
                }
            });
        }
        if let Some(tet) = self.sums.iter().find_map(|sum| sum.inverted) {
            return Err(StepError::Inverted { tet, time: self.time });
        }
        Ok(self.sums.iter().map(|sum| sum.viscous).sum())
    }

    /// Contact forces at the present places.
    fn press_contacts(&mut self) {
        let Self { contacts, setup, tets, nodes, joints, forces, dt, .. } = self;
        let is_broken = |face: usize| joints[face].bond == Bond::Broken;
        contacts.press(setup, tets, [&nodes.place, &nodes.velocity], *dt, is_broken, forces);
    }

    /// Energy that a joint would give back [J].
    pub(super) fn stored_in(&self, number: usize) -> f64 {
        let joint = &self.joints[number];
        let cohesion = body_of(&self.setup, self.setup.interfaces[number].tets[0]).cohesion;
        let (Bond::Joint, Some(cohesion)) = (joint.bond, cohesion) else { return 0.0 };
        let sides = faces(number, &self.setup, &self.tets, &self.nodes);
        joint::stored(&cohesion.law(joint.edge), joint.area, &joint.memory, &sides)
    }

    /// Undeformed place of a node [m].
    pub fn place_at_start(&self, node: usize) -> DVec3 {
        let copy = self.nodes.ties.of(node)[0] as usize;
        self.setup.nodes[self.setup.tets[copy / 4][copy % 4] as usize]
    }

    /// Undeformed corners of an interface [m].
    pub fn corners(&self, number: usize) -> [DVec3; 3] {
        let interface = &self.setup.interfaces[number];
        let tet = &self.setup.tets[interface.tets[0] as usize];
        interface.nodes[0].map(|k| self.setup.nodes[tet[usize::from(k)] as usize])
    }
}

pub(super) fn body_of(setup: &Setup, tet: u32) -> &super::setup::Body {
    let number = setup.bodies.partition_point(|body| body.tets.end <= tet as usize);
    &setup.bodies[number]
}

/// Corners of both sides of an interface [m].
#[inline]
pub(super) fn faces(number: usize, setup: &Setup, tets: &Tets, nodes: &Nodes) -> [[DVec3; 3]; 2] {
    let interface = &setup.interfaces[number];
    [0, 1].map(|side| {
        let at = &tets.nodes[interface.tets[side] as usize];
        interface.nodes[side].map(|k| nodes.place[at[usize::from(k)] as usize])
    })
}
