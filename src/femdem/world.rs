//! The time step of the combined finite-discrete element method.
//!
//! A time step has four loops: joints, tetrahedra, contacts, nodes. Each loop only writes what it owns (no scatter, no
//! atomics), so results are bitwise equal for any number of threads. Velocities are half a time step before the
//! positions (central differences; eqs. 9 and 10).

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::{self, Copy4, Nodes, Tets};
use super::book::BodyEnergy;
use super::contact::pairs::Contacts;
use super::deformation::{Bodies, Deformation};
use super::element::Moduli;
use super::energy::Ledger;
use super::joints::{Bond, Joints};
use super::loads::CornerForce;
use super::motion::Moved;
use super::rigid_body::RigidBody;
use super::setup::{Body, Setup};
use super::time_step;
use super::watch::{Limits, StepError};

/// Items per task of the thread pool. Sums are taken per task first, so their order does not depend on the threads.
pub(super) const PIECE: usize = 512;

/// A broken face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// Number of the interface.
    pub interface: u32,
    /// Time of breaking [s].
    pub time: f64,
    /// Centroid of the undeformed face [m].
    pub place: DVec3,
    /// Undeformed area [m2].
    pub area: f64,
    /// Whether sliding (mode II) dissipated more energy than opening (mode I).
    pub by_sliding: bool,
    /// Dissipated energy [J].
    pub dissipated: f64,
    /// Part of the dissipated energy that was elastic energy at the release of the tied face [J].
    pub freed: f64,
}

/// A world of deformable bodies, joints and contacts.
#[derive(Debug, Clone)]
pub struct World {
    // Parameters.
    pub(super) setup: Setup,
    pub(super) moduli: Vec<Moduli>,
    /// Least strength of each body [Pa].
    strength: Vec<f64>,
    /// Time step [s].
    pub dt: f64,
    // State.
    /// Time [s].
    pub time: f64,
    /// Nodes.
    pub nodes: Nodes,
    /// Tetrahedra.
    pub tets: Tets,
    /// Joints between tetrahedra of bodies that can crack.
    pub joints: Joints,
    /// Broken faces, in order of time.
    pub failures: Vec<Failure>,
    /// Contacts.
    pub contacts: Contacts,
    /// Rigid bodies.
    pub rigid_bodies: Vec<RigidBody>,
    /// All copies of every mesh node.
    pub(super) around: Vec<Vec<Copy4>>,
    pub(super) lost: Ledger,
    pub(super) gravity_at_start: f64,
    pub(super) limits: Limits,
    // Workspace.
    pub(super) deformation: Deformation,
    pub(super) loaded: Vec<CornerForce>,
    pub(super) moved: Vec<Moved>,
}

impl World {
    /// Creates a world in its initial state; its time step is `share` times the time step limit.
    pub fn new(setup: Setup, share: f64) -> Self {
        let joints = Joints::new(&setup);
        let (nodes, mut tets) = assembly::assemble(&setup, |face| joints.bond[face as usize] == Bond::Tied);
        joints.mark(&setup, &mut tets);
        let rigid_bodies = RigidBody::all(&setup, &nodes, &tets);
        // With zero moduli, tetrahedra of rigid bodies have no forces.
        let moduli_of = |body: &Body| if body.rigid { Moduli::default() } else { Moduli::from(&body.elastic) };
        let moduli = setup.bodies.iter().map(moduli_of).collect();
        let count = setup.tets.len();
        let around = assembly::copies_around(&setup);
        let contacts = contacts(&setup, &tets, &around, &joints);
        let limits = Limits::new(&setup, &nodes);
        let ties = joints.bond.contains(&Bond::Tied);
        let strength = setup.bodies.iter().map(|body| body.cohesion.map_or(f64::MAX, |c| c.strength.least())).collect();
        let mut world = Self {
            moduli,
            strength,
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
            limits,
            deformation: Deformation::new(count, ties),
            loaded: Vec::new(),
            moved: Vec::new(),
            setup,
        };
        world.dt = share * world.longest_step();
        world.gravity_at_start = world.energies(0.0).gravity;
        world
    }

    /// Returns the input of the world.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Computes the time step limit [s]; every face counts as a joint, because a tied face may be released.
    pub fn longest_step(&self) -> f64 {
        let limit = |t: usize| {
            let body = &self.setup.bodies[usize::from(self.tets.body[t])];
            let shape = &self.tets.shape[t];
            let mass = 0.25 * body.elastic.density * shape.volume;
            let mut springs = [0.0; 4];
            if let Some(cohesion) = body.cohesion {
                for (face, link) in self.tets.faces[t].into_iter().enumerate() {
                    let Some((number, _)) = link.interface() else { continue };
                    let [edge, area] = self.joints.size[number];
                    let stiffness = cohesion.law(edge).stiffness() * area / 3.0;
                    (0..4).filter(|k| *k != face).for_each(|k| springs[k] += stiffness);
                }
            }
            let contact = time_step::contact_stiffness(shape, body.contact_penalty);
            if body.rigid {
                // Only contact limits the time step. A rigid body moves less than its tetrahedra alone would.
                let touches = contact > 0.0 && self.setup.outer.binary_search(&(t as u32)).is_ok();
                return if touches { time_step::stable_step(2.0 * contact / mass, 0.0) } else { f64::INFINITY };
            }
            let springs = 2.0 * springs.into_iter().fold(contact, f64::max) / mass;
            let frequency_squared = time_step::element_frequency_squared(shape, &body.elastic) + springs;
            time_step::stable_step(frequency_squared, time_step::element_damping_rate(shape, &body.elastic))
        };
        (0..self.tets.nodes.len()).into_par_iter().map(limit).reduce(|| f64::INFINITY, f64::min)
    }

    /// Advances the world by one time step.
    ///
    /// # Errors
    /// If a tetrahedron is inverted, or a node is too fast or not finite.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.advance(false, None).map(|_| ())
    }

    /// Advances the world by one time step and returns the energy balance at its start.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn step_with_ledger(&mut self) -> Result<Ledger, StepError> {
        self.advance(true, None)
    }

    /// Advances the world by one time step and returns the energy balance at its start, total and per body.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn step_with_books(&mut self) -> Result<(Ledger, Vec<BodyEnergy>), StepError> {
        let mut bodies = Vec::new();
        let ledger = self.advance(true, Some(&mut bodies))?;
        Ok((ledger, bodies))
    }

    fn advance(&mut self, with_energies: bool, mut bodies: Option<&mut Vec<BodyEnergy>>) -> Result<Ledger, StepError> {
        self.joints.pull(&self.setup, &self.tets, &self.nodes, self.dt);
        let viscous_power = self.deform_tets()?;
        self.press_contacts();
        self.apply_loads();
        let mut ledger = if with_energies { self.energies(viscous_power) } else { Ledger::default() };
        let before = bodies.as_mut().map(|bodies| {
            **bodies = self.body_energies();
            self.nodes.velocity.clone()
        });
        let power = self.power_of_loads();
        let Moved { kinetic, work, fastest } = self.move_nodes();
        let work = work + 0.5 * self.dt * (power + self.power_of_loads());
        if let (Some(bodies), Some(before)) = (bodies, before) {
            self.add_kinetic_energies(bodies, &before);
        }
        ledger.kinetic = kinetic;
        // Half of the work of this time step belongs to the balance at its start.
        ledger.work += 0.5 * work;
        self.lost.viscous += self.dt * viscous_power;
        self.lost.work += work;
        self.contacts.travel(fastest.sqrt() * self.dt);
        self.release_joints();
        self.time += self.dt;
        self.check_speed(fastest)?;
        Ok(ledger)
    }

    /// Computes the forces of tetrahedra and joints on the vertices. Returns the viscous power [W].
    fn deform_tets(&mut self) -> Result<f64, StepError> {
        let Self { deformation, joints, tets, nodes, moduli, strength, .. } = self;
        let bodies = Bodies { tets, nodes, moduli, strength, joints: &joints.forces };
        deformation.compute(bodies).map_err(|tet| self.why_inverted(tet))
    }

    /// Adds the contact forces at the current positions.
    fn press_contacts(&mut self) {
        let Self { contacts, setup, tets, nodes, joints, deformation, dt, .. } = self;
        let is_broken = |face: usize| joints.bond[face] == Bond::Broken;
        contacts.press(setup, tets, [&nodes.place, &nodes.velocity], *dt, is_broken, &mut deformation.forces);
    }

    /// Undeformed area of all broken faces [m2].
    pub fn crack_area(&self) -> f64 {
        // `sum` of an empty iterator would be -0.
        self.failures.iter().map(|failure| failure.area).fold(0.0, |sum, area| sum + area)
    }

    /// Undeformed position of a node [m].
    pub fn place_at_start(&self, node: usize) -> DVec3 {
        let copy = self.nodes.ties.of(node)[0] as usize;
        self.setup.nodes[self.setup.tets[copy / 4][copy % 4] as usize]
    }
}

/// Creates the contacts; tetrahedra that unbroken faces connect around a node do not touch.
pub(super) fn contacts(setup: &Setup, tets: &Tets, around: &[Vec<Copy4>], joints: &Joints) -> Contacts {
    let unbroken = |face: u32| joints.bond[face as usize] != Bond::Broken;
    let around = around.iter().filter(|copies| !copies.is_empty());
    let groups: Vec<Vec<Copy4>> =
        around.flat_map(|copies| assembly::held_together(tets, setup, copies, &unbroken)).collect();
    Contacts::new(setup, groups.iter().map(Vec::as_slice))
}
