//! A world and its time step: all bodies, joints and contacts of a run. This is the entry to the solver.
//!
//! | file | contents |
//! | --- | --- |
//! | `time_step` | the limit of the time step |
//! | `motion` | motion of nodes and rigid bodies |
//! | `release` | tied faces that become joints, joints that break |
//! | `energy_balance`, `body_energy` | the energy balance, total and per body |
//! | `limits` | limits that stop an unstable run |
//! | `snapshot` | saves and restores the state |
//!
//! A time step has four loops: over joints, tetrahedra, contacts and nodes. Each item of a loop writes only its own
//! values, so results are bitwise equal for any number of threads. Velocities refer to half a time step before the time
//! of the positions (central differences; eqs. 9 and 10).

use glam::DVec3;

pub mod body_energy;
pub mod energy_balance;
pub mod limits;
mod motion;
mod release;
pub mod snapshot;
mod time_step;

use super::assembly::{
    nodes::{NodeCopy, Nodes},
    splitting,
    tets::Tets,
};
use super::contact::pairs::Contacts;
use super::deformation::{Bodies, Deformation};
use super::element::Moduli;
use super::joints::{Bond, Joints};
use super::loads::{Configuration, CornerForce};
use super::rigid::body::RigidBody;
use super::setup::{Body, Setup};
use body_energy::BodyEnergy;
use energy_balance::EnergyBalance;
use limits::{Limits, StepError};
use motion::NodeMotion;

/// A broken face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Failure {
    /// Number of the interface.
    pub interface: u32,
    /// Time of breaking [s].
    pub time: f64,
    /// Centroid of the undeformed face [m].
    pub centroid: DVec3,
    /// Undeformed area of the face [m2].
    pub area: f64,
    /// True if sliding (mode II) dissipated more energy than opening (mode I).
    pub by_sliding: bool,
    /// Energy that the joint dissipated [J].
    pub dissipated: f64,
    /// Part of `dissipated` that the joint received as elastic energy when its tied face was released [J].
    pub released: f64,
}

/// A world of deformable bodies, joints and contacts.
#[derive(Debug, Clone)]
pub struct World {
    // Parameters.
    setup: Setup,
    moduli: Vec<Moduli>,
    /// Least stress that can break each body [Pa].
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
    copies_around: Vec<Vec<NodeCopy>>,
    dissipated: EnergyBalance,
    gravity_at_start: f64,
    limits: Limits,
    // Workspace.
    deformation: Deformation,
    loaded: Vec<CornerForce>,
    motion: Vec<NodeMotion>,
}

impl World {
    /// Creates a world in its initial state. Its time step is `share` times the limit of the time step.
    pub fn new(setup: Setup, share: f64) -> Self {
        let joints = Joints::new(&setup);
        let (nodes, mut tets) = splitting::assemble(&setup, |face| joints.bond[face as usize] == Bond::Tied);
        joints.mark_tetrahedra(&setup, &mut tets);
        let rigid_bodies = RigidBody::all(&setup, &nodes, &tets);
        // With zero moduli, the tetrahedra of rigid bodies exert no forces.
        let moduli_of = |body: &Body| if body.rigid { Moduli::default() } else { Moduli::from(&body.elastic) };
        let moduli = setup.bodies.iter().map(moduli_of).collect();
        let count = setup.tets.len();
        let copies_around = splitting::copies_around(&setup);
        let contacts = contacts(&setup, &tets, &copies_around, &joints);
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
            copies_around,
            dissipated: EnergyBalance::default(),
            gravity_at_start: 0.0,
            limits,
            deformation: Deformation::new(count, ties),
            loaded: Vec::new(),
            motion: Vec::new(),
            setup,
        };
        world.dt = share * world.time_step_limit();
        world.gravity_at_start = world.energies(0.0).gravity;
        world
    }

    /// Returns the input of the world.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Advances the world by one time step.
    ///
    /// # Errors
    /// If a tetrahedron is inverted, a node is too fast, or the position of a node is not finite.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.advance(false, None).map(|_| ())
    }

    /// Advances the world by one time step and returns the energy balance at the start of the time step.
    ///
    /// # Errors
    /// Same as for [`Self::step`].
    pub fn step_with_energies(&mut self) -> Result<EnergyBalance, StepError> {
        self.advance(true, None)
    }

    /// Advances the world by one time step. Returns the energies at the start of the time step, in total and per body.
    ///
    /// # Errors
    /// Same as for [`Self::step`].
    pub fn step_with_body_energies(&mut self) -> Result<(EnergyBalance, Vec<BodyEnergy>), StepError> {
        let mut bodies = Vec::new();
        Ok((self.advance(true, Some(&mut bodies))?, bodies))
    }

    fn advance(
        &mut self,
        with_energies: bool,
        mut bodies: Option<&mut Vec<BodyEnergy>>,
    ) -> Result<EnergyBalance, StepError> {
        self.joints.compute_forces(&self.setup, &self.tets, &self.nodes, self.dt);
        let viscous_power = self.deform_tets()?;
        self.add_contact_forces();
        self.apply_loads();
        let mut balance = if with_energies { self.energies(viscous_power) } else { EnergyBalance::default() };
        let before = bodies.as_mut().map(|bodies| {
            **bodies = self.body_energies();
            self.nodes.velocity.clone()
        });
        let power = self.power_of_loads();
        let NodeMotion { kinetic, work, fastest } = self.move_nodes();
        let work = work + 0.5 * self.dt * (power + self.power_of_loads());
        if let (Some(bodies), Some(before)) = (bodies, before) {
            self.add_kinetic_energies(bodies, &before);
        }
        balance.kinetic = kinetic;
        // `work` is done from half a time step before the start of this time step to half a time step after it. The
        // balance at the start includes only the first half.
        balance.work += 0.5 * work;
        self.dissipated.viscous += self.dt * viscous_power;
        self.dissipated.work += work;
        self.contacts.add_travel(fastest.sqrt() * self.dt);
        self.release_joints();
        self.time += self.dt;
        self.check_speed(fastest)?;
        Ok(balance)
    }

    /// Computes the forces of tetrahedra and joints on the vertices. Returns the viscous power [W].
    fn deform_tets(&mut self) -> Result<f64, StepError> {
        let Self { deformation, joints, tets, nodes, moduli, strength, .. } = self;
        let bodies = Bodies { tets, nodes, moduli, strength, joints: &joints.forces };
        deformation.compute(bodies).map_err(|tet| self.inversion_error(tet))
    }

    /// Adds the contact forces at the current positions to the forces of the tetrahedra.
    fn add_contact_forces(&mut self) {
        let Self { contacts, setup, tets, nodes, joints, deformation, dt, .. } = self;
        let is_broken = |face: usize| joints.bond[face] == Bond::Broken;
        contacts.add_forces(setup, tets, [&nodes.position, &nodes.velocity], *dt, is_broken, &mut deformation.forces);
    }

    /// Returns the nodes and tetrahedra on which loads act.
    pub fn configuration(&self) -> Configuration<'_> {
        configuration(&self.setup, &self.nodes, &self.tets)
    }

    /// Adds the loads to the forces of the tetrahedra, and stores the loads to compute their work.
    fn apply_loads(&mut self) {
        let Self { setup, nodes, tets, loaded, deformation, time, .. } = self;
        loaded.clear();
        let configuration = configuration(setup, nodes, tets);
        setup.loads.iter().for_each(|load| load.forces(&configuration, *time, loaded));
        for CornerForce { tet, corner, force } in loaded {
            deformation.forces[*tet as usize][usize::from(*corner)] += *force;
        }
    }

    /// Returns the power of the loads at the current velocities [W].
    fn power_of_loads(&self) -> f64 {
        let power = |load: &CornerForce| {
            let node = self.tets.nodes[load.tet as usize][usize::from(load.corner)];
            load.force.dot(self.nodes.velocity[node as usize])
        };
        self.loaded.iter().map(power).sum()
    }

    /// Returns the total undeformed area of all broken faces [m2].
    pub fn crack_area(&self) -> f64 {
        // `sum` of an empty iterator would be -0.
        self.failures.iter().map(|failure| failure.area).fold(0.0, |sum, area| sum + area)
    }

    /// Returns the undeformed position of a node [m].
    pub fn initial_position(&self, node: usize) -> DVec3 {
        let copy = self.nodes.copies_of(node)[0] as usize;
        self.setup.nodes[self.setup.tets[copy / 4][copy % 4] as usize]
    }
}

/// Returns the initial and current vertices on which the loads of a setup act.
fn configuration<'a>(setup: &'a Setup, nodes: &'a Nodes, tets: &'a Tets) -> Configuration<'a> {
    Configuration { initial: (&setup.nodes, &setup.tets), current: (&nodes.position, &tets.nodes) }
}

/// Creates the contacts. Tetrahedra cannot touch if they share a node and unbroken faces connect them around this node.
fn contacts(setup: &Setup, tets: &Tets, copies_around: &[Vec<NodeCopy>], joints: &Joints) -> Contacts {
    let unbroken = |face: u32| joints.bond[face as usize] != Bond::Broken;
    let used = copies_around.iter().filter(|copies| !copies.is_empty());
    let groups: Vec<Vec<NodeCopy>> =
        used.flat_map(|copies| splitting::connected_groups(tets, setup, copies, &unbroken)).collect();
    Contacts::new(setup, groups.iter().map(Vec::as_slice))
}
