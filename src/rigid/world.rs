//! The rigid bodies of a run, advanced in substeps by the velocity Verlet scheme.
//!
//! A substep has four stages: half of the velocity update (kick), the position update (drift), the contact forces at
//! the new positions, and the second half of the velocity update. The dashpot forces need the velocity at the end of
//! the substep. It is extrapolated with the acceleration at the start, which keeps second-order accuracy.

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};

use super::contact::{Contact, LONGEST_SUBSTEP, Substep};
use super::error::RigidError;
use super::forces::{Energy, Laws};
use super::kinematics::{Motion, Velocities};
use super::motion::{self, BodyState, Load};
use super::record::{ContactEvent, ContactRecords, RecordedContact};
use super::search::{PartPair, Placements, Surfaces};
use super::setup::{Body, BodyKind, BodyShape, RigidSetup, Sides};

/// Number of substeps in the shortest oscillation period of a body on its contact springs [-]. With 80 substeps, the
/// restitution of an impact is accurate to 1e-3 (see the tests). An impact lasts about two thirds of this period.
const STEPS_PER_PERIOD: f64 = 80.0;

/// Safety factor on the distance that a surface moves in a substep [-]. A body can rotate slightly faster at one end of
/// the substep than on average.
const PATH_SAFETY: f64 = 1.01;

/// Value of `search_distance` that makes the next substep rebuild the list of part pairs.
pub(super) const NO_PAIR_LIST: f64 = f64::NEG_INFINITY;

/// Mass and inertia tensor of the bodies of one kind.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inertia {
    /// Mass [kg]; infinite for fixed bodies.
    pub mass: f64,
    /// Inertia tensor about the centre of mass [kg m2], and its inverse; the inverse is zero for fixed bodies.
    pub tensor: DMat3,
    pub inverse: DMat3,
}

impl Inertia {
    fn of(kind: &BodyKind) -> Self {
        let BodyShape { mass, inertia, .. } = kind.shape;
        match kind.is_fixed {
            true => Self { mass: f64::INFINITY, tensor: inertia, inverse: DMat3::ZERO },
            false => Self { mass, tensor: inertia, inverse: inertia.inverse() },
        }
    }

    fn is_fixed(&self) -> bool {
        self.mass == f64::INFINITY
    }
}

/// Rigid bodies with their contacts.
#[derive(Debug, Clone)]
pub struct RigidWorld {
    // Parameters.
    pub(super) surfaces: Surfaces,
    pub(super) laws: Laws,
    pub(super) inertias: Vec<Inertia>,
    pub(super) rounding: f64,
    pub(super) gravity: DVec3,
    /// Two-dimensional motion: bodies translate along x and z and rotate about y only.
    two_dimensional: bool,
    // State.
    pub(super) time: f64,
    /// Kind of each body.
    pub(super) kind: Vec<usize>,
    pub(super) rotation: Vec<DQuat>,
    pub(super) position: Vec<DVec3>,
    pub(super) velocity: Vec<DVec3>,
    pub(super) angular_momentum: Vec<DVec3>,
    pub(super) contact_now: Vec<Load>,
    pub(super) contacts: Vec<Contact>,
    pub(super) frequency_squared: f64,
    pub(super) energy: Energy,
    pub(super) records: ContactRecords,
    // Results for callers.
    pub(super) states: Vec<BodyState>,
    pub(super) contact_mean: Vec<Load>,
    pub(super) substeps: u64,
    // Workspace.
    angular_velocity: Vec<DVec3>,
    pairs: Vec<PartPair>,
    /// Pairs of `pairs` whose parts can be in contact now.
    near: Vec<PartPair>,
    /// `pairs` includes all part pairs whose gap was at most this distance when the list was built [m].
    pub(super) search_distance: f64,
    /// Upper bound of the distance that the surface of each body has moved since `pairs` was built [m].
    pub(super) path: Vec<f64>,
    /// Distance that the surface of each body can move in the longest substep at twice its speed [m].
    pub(super) margin: Vec<f64>,
}

impl RigidWorld {
    /// Creates the world at time 0. Returns an error if a value is out of range or a body starts with too large an
    /// overlap.
    pub fn new(setup: RigidSetup) -> Result<Self, RigidError> {
        setup.check()?;
        let count = setup.bodies.len();
        let inertias: Vec<Inertia> = setup.kinds.iter().map(Inertia::of).collect();
        let rotation: Vec<DQuat> = setup.bodies.iter().map(|b| b.state.rotation.normalize()).collect();
        let momentum =
            |(b, q): (&Body, &DQuat)| motion::angular_momentum(*q, &inertias[b.kind].tensor, b.state.angular_velocity);
        let rounding_of = |kind: &BodyKind| kind.shape.parts.iter().map(|p| p.rounding()).fold(f64::MAX, f64::min);
        let mut world = Self {
            surfaces: Surfaces::new(&setup),
            laws: Laws::new(&setup),
            rounding: setup.kinds.iter().map(rounding_of).fold(f64::MAX, f64::min),
            gravity: setup.gravity,
            two_dimensional: setup.sides == Sides::TwoDimensional,
            time: 0.0,
            kind: setup.bodies.iter().map(|b| b.kind).collect(),
            angular_momentum: setup.bodies.iter().zip(&rotation).map(momentum).collect(),
            inertias,
            rotation,
            position: setup.bodies.iter().map(|b| b.state.position).collect(),
            velocity: setup.bodies.iter().map(|b| b.state.velocity).collect(),
            contact_now: vec![Load::default(); count],
            contacts: Vec::new(),
            frequency_squared: 0.0,
            energy: Energy::default(),
            records: ContactRecords::default(),
            states: setup.bodies.iter().map(|b| b.state).collect(),
            contact_mean: vec![Load::default(); count],
            substeps: 0,
            angular_velocity: vec![DVec3::ZERO; count],
            pairs: Vec::new(),
            near: Vec::new(),
            search_distance: NO_PAIR_LIST,
            path: vec![0.0; count],
            margin: vec![0.0; count],
        };
        world.update_contacts(0.0, &vec![DVec3::ZERO; count], &vec![DVec3::ZERO; count])?;
        world.update_results();
        Ok(world)
    }

    /// Current position and motion of each body.
    pub fn states(&self) -> &[BodyState] {
        &self.states
    }

    /// Time [s] since the start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Mean contact force [N] and torque [N m] on each body over the last call of [`advance`](Self::advance).
    pub fn contact_loads(&self) -> &[Load] {
        &self.contact_mean
    }

    /// Energy balance. Kinetic, potential and elastic energy are current values; the others are sums since the start.
    pub fn energy(&self) -> Energy {
        self.energy
    }

    /// Number of active contacts.
    pub fn contact_count(&self) -> usize {
        self.contacts.len()
    }

    /// Largest overlap of the active contacts [m]; 0 without contacts.
    pub fn deepest_overlap(&self) -> f64 {
        self.contacts.iter().map(|contact| contact.overlap).fold(0.0, f64::max)
    }

    /// Number of substeps since the start.
    pub fn substeps(&self) -> u64 {
        self.substeps
    }

    /// Returns and clears the contacts that have ended since the last call, ordered by end time.
    pub fn take_events(&mut self) -> Vec<ContactEvent> {
        std::mem::take(&mut self.records.ended.ended)
    }

    /// Records of the active contacts up to now.
    pub fn running_events(&self) -> impl Iterator<Item = &ContactEvent> {
        self.records.running.iter().map(|contact| &contact.event)
    }

    /// The hardest impacts of each unit since the start, including active contacts, in descending order of peak force.
    pub fn impacts(&self) -> Vec<RecordedContact> {
        self.records.impacts_so_far().into_hardest_first()
    }

    /// Contacts of [`Self::impacts`] whose peak force so far occurred after `time` [s].
    pub fn impacts_with_peak_after(&self, time: f64) -> impl Iterator<Item = &ContactEvent> {
        let impacts = &self.records.impacts;
        let running = self.running_events().filter(|event| impacts.would_keep(event));
        impacts.impacts().map(|impact| &impact.event).chain(running).filter(move |event| event.peak_time > time)
    }

    /// [Numbers](ContactEvent::number) of the contacts that are active or among the hardest impacts, unordered.
    pub fn remembered_contacts(&self) -> impl Iterator<Item = u64> {
        self.records
            .impacts
            .impacts()
            .map(|impact| &impact.event)
            .chain(self.running_events())
            .map(|event| event.number)
    }

    /// Sets the gravity vector [m/s2]; a tilt test rotates gravity instead of the ground.
    pub fn set_gravity(&mut self, gravity: DVec3) {
        self.gravity = gravity;
    }

    /// Advances all bodies by `dt` [s] under the given loads (without gravity), which are constant over `dt`.
    pub fn advance(&mut self, dt: f64, loads: &[Load]) -> Result<(), RigidError> {
        if loads.len() != self.position.len() {
            return Err(RigidError::Loads { loads: loads.len(), bodies: self.position.len() });
        }
        if !(dt >= 0.0 && dt.is_finite()) {
            return Err(RigidError::Setup { what: "the time step [s]".into(), value: dt, allowed: "0 or greater" });
        }
        let mut impulse = vec![Load::default(); loads.len()];
        let start = self.time;
        let mut left = dt;
        while left > 0.0 {
            let h = self.substep_length(left);
            self.substep(h, loads)?;
            for (sum, now) in impulse.iter_mut().zip(&self.contact_now) {
                sum.force += now.force * h;
                sum.torque += now.torque * h;
            }
            left = if h < left { left - h } else { 0.0 };
        }
        self.time = start + dt;
        if dt > 0.0 {
            self.contact_mean =
                impulse.iter().map(|sum| Load { force: sum.force / dt, torque: sum.torque / dt }).collect();
        }
        self.update_results();
        Ok(())
    }

    /// Returns a substep length [s] that divides the remaining time `left` [s] evenly and suits the stiffest contact.
    fn substep_length(&self, left: f64) -> f64 {
        let longest = (TAU / self.frequency_squared.sqrt() / STEPS_PER_PERIOD).min(LONGEST_SUBSTEP);
        left / (left / longest).ceil().max(1.0)
    }

    fn substep(&mut self, h: f64, loads: &[Load]) -> Result<(), RigidError> {
        let old = self.accelerations(loads);
        self.kick(&old, 0.5 * h);
        self.drift(h);
        let linear_mid = self.velocity.clone();
        let angular_mid = self.angular_velocities();
        self.add_load_work(loads, &angular_mid, h);
        self.kick(&old, 0.5 * h);
        self.time += h;
        self.check_finite()?;
        self.update_contacts(h, &linear_mid, &angular_mid)?;
        // Replace the extrapolated velocity: the second half of the update uses the new acceleration.
        self.velocity.copy_from_slice(&linear_mid);
        let new = self.accelerations(loads);
        for body in 0..self.position.len() {
            self.angular_momentum[body] += (new[body].1 - old[body].1) * (0.5 * h);
            self.velocity[body] += new[body].0 * (0.5 * h);
        }
        self.substeps += 1;
        Ok(())
    }

    /// Returns an error if the state of a body is not finite, because the contact search needs finite values.
    fn check_finite(&self) -> Result<(), RigidError> {
        let finite = |b: &usize| (self.position[*b] + self.angular_momentum[*b]).is_finite();
        match (0..self.position.len()).find(|b| !finite(b) || !self.rotation[*b].is_finite()) {
            Some(body) => Err(RigidError::NotFinite { time: self.time, body }),
            None => Ok(()),
        }
    }

    /// Acceleration [m/s2] and torque [N m] of each body.
    fn accelerations(&self, loads: &[Load]) -> Vec<(DVec3, DVec3)> {
        let accelerate = |((external, contact), kind): ((&Load, &Load), &usize)| {
            let inertia = &self.inertias[*kind];
            if inertia.is_fixed() {
                return (DVec3::ZERO, DVec3::ZERO);
            }
            let acceleration = self.gravity + (external.force + contact.force) / inertia.mass;
            let torque = external.torque + contact.torque;
            if self.two_dimensional { (acceleration.with_y(0.0), DVec3::Y * torque.y) } else { (acceleration, torque) }
        };
        loads.iter().zip(&self.contact_now).zip(&self.kind).map(accelerate).collect()
    }

    fn kick(&mut self, accelerations: &[(DVec3, DVec3)], dt: f64) {
        for (body, (a, torque)) in accelerations.iter().enumerate() {
            self.velocity[body] += *a * dt;
            self.angular_momentum[body] += *torque * dt;
        }
    }

    fn drift(&mut self, h: f64) {
        for body in 0..self.position.len() {
            self.position[body] += self.velocity[body] * h;
            let (q, l) = (self.rotation[body], self.angular_momentum[body]);
            self.rotation[body] = motion::rotated(q, &self.inertias[self.kind[body]].inverse, l, h);
        }
    }

    fn angular_velocity_of(&self, body: usize) -> DVec3 {
        let inverse = &self.inertias[self.kind[body]].inverse;
        motion::angular_velocity(self.rotation[body], inverse, self.angular_momentum[body])
    }

    fn angular_velocities(&self) -> Vec<DVec3> {
        (0..self.position.len()).map(|body| self.angular_velocity_of(body)).collect()
    }

    fn add_load_work(&mut self, loads: &[Load], angular_mid: &[DVec3], h: f64) {
        for (body, load) in loads.iter().enumerate() {
            let power = load.force.dot(self.velocity[body]) + load.torque.dot(angular_mid[body]);
            self.energy.load_work += power * h;
        }
    }

    /// Finds the contacts at the current positions and computes their forces.
    fn update_contacts(&mut self, h: f64, linear: &[DVec3], angular: &[DVec3]) -> Result<(), RigidError> {
        self.angular_velocity = self.angular_velocities();
        self.update_near_pairs(h, linear, angular);
        let placements = Placements { kind: &self.kind, rotation: &self.rotation, position: &self.position };
        let contact_points =
            self.surfaces.contact_points(&self.near, placements, &self.contacts, &self.margin, self.time)?;
        let motion = Motion {
            placements,
            now: Velocities { linear: &self.velocity, angular: &self.angular_velocity },
            mean: Velocities { linear, angular },
            substep: Substep { dt: h, time: self.time },
        };
        let evaluation =
            self.laws.evaluate(&contact_points, &self.contacts, &motion, &mut self.energy, &mut self.records);
        self.contact_now = evaluation.loads;
        self.contacts = evaluation.contacts;
        self.frequency_squared = evaluation.frequency_squared;
        Ok(())
    }

    /// Updates the list of part pairs that can be in contact after a substep `h` [s] with the given mean velocities.
    fn update_near_pairs(&mut self, h: f64, linear: &[DVec3], angular: &[DVec3]) {
        for body in 0..self.position.len() {
            let reach = self.surfaces.reach(self.kind[body]);
            self.path[body] += PATH_SAFETY * h * (linear[body].length() + angular[body].length() * reach);
            // The search covers everything that the body can reach in the longest substep at twice its speed.
            let speed = self.velocity[body].length() + self.angular_velocity[body].length() * reach;
            self.margin[body] = 2.0 * speed * LONGEST_SUBSTEP;
        }
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let margin = 2.0 * largest(&self.margin);
        if self.search_distance < 2.0 * largest(&self.path) + margin {
            self.search_distance = margin + self.rounding;
            self.path.fill(0.0);
            let placements = Placements { kind: &self.kind, rotation: &self.rotation, position: &self.position };
            self.pairs = self.surfaces.near_parts(placements, self.search_distance);
        }
        let within: Vec<f64> = self.path.iter().zip(&self.margin).map(|(path, margin)| path + margin).collect();
        self.near.clear();
        self.near.extend(self.pairs.iter().filter(|pair| pair.can_be_near(&within)));
    }

    /// Updates the results that callers read: body states, kinetic and potential energy.
    pub(super) fn update_results(&mut self) {
        self.energy.kinetic = 0.0;
        self.energy.potential = 0.0;
        for body in 0..self.position.len() {
            let state = BodyState {
                position: self.position[body],
                rotation: self.rotation[body],
                velocity: self.velocity[body],
                angular_velocity: self.angular_velocity_of(body),
            };
            self.states[body] = state;
            let Inertia { mass, .. } = self.inertias[self.kind[body]];
            if mass.is_finite() {
                let spin = self.angular_momentum[body].dot(state.angular_velocity);
                self.energy.kinetic += 0.5 * (mass * state.velocity.length_squared() + spin);
                self.energy.potential -= mass * self.gravity.dot(state.position);
            }
        }
    }
}
