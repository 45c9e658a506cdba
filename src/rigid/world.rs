//! The rigid bodies of a run, advanced in substeps by the velocity Verlet scheme.
//!
//! A substep has four stages: half of the velocity update (kick), the position update (drift), the contact forces at
//! the new positions, and the second half of the velocity update. The dashpot forces need the velocity at the end of
//! the substep. It is extrapolated with the acceleration at the start, which keeps second-order accuracy.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::contact::{Contact, LONGEST_SUBSTEP, Substep};
use super::error::RigidError;
use super::forces::{ContactResults, Energy, EvaluationMemory, Laws};
use super::kinematics::{Motion, Placements, Velocities};
use super::motion::{self, BodyState, Inertia, Load};
use super::record::{ContactEvent, ContactRecords, RecordedContact};
use super::search::{ContactSearch, Surfaces};
use super::setup::{Body, BodyKind, RigidSetup, Sides};

/// Number of substeps in the shortest oscillation period of a body on its contact springs [-]. With 80 substeps, the
/// restitution of an impact is accurate to 1e-3 (see the tests). An impact lasts about two thirds of this period.
pub const STEPS_PER_PERIOD: f64 = 80.0;

/// Memory of a substep. Each list has one entry per body.
#[derive(Debug, Clone, Default)]
struct Workspace {
    /// Velocities [m/s] and angular velocities [rad/s] in the middle of the substep.
    linear_mid: Vec<DVec3>,
    angular_mid: Vec<DVec3>,
    /// Angular velocities at the end of the substep [rad/s].
    angular_velocity: Vec<DVec3>,
    /// Accelerations [m/s2] and torques [N m] at the start and at the end of the substep.
    old: Vec<(DVec3, DVec3)>,
    new: Vec<(DVec3, DVec3)>,
    /// Impulse of the contacts during a call of `advance`.
    impulse: Vec<Load>,
}

/// Rigid bodies with their contacts.
#[derive(Debug, Clone)]
pub struct RigidWorld {
    // Parameters.
    pub(super) surfaces: Surfaces,
    pub(super) laws: Laws,
    pub(super) inertias: Vec<Inertia>,
    pub(super) gravity: DVec3,
    /// Two-dimensional motion: bodies translate along x and z and rotate about y only.
    two_dimensional: bool,
    steps_per_period: f64,
    pub(super) rest_bound: f64,
    // State.
    pub(super) time: f64,
    /// Kind of each body.
    pub(super) kind: Vec<usize>,
    pub(super) rotation: Vec<DQuat>,
    pub(super) position: Vec<DVec3>,
    pub(super) velocity: Vec<DVec3>,
    pub(super) angular_momentum: Vec<DVec3>,
    /// Bodies at rest, and fixed bodies without velocity.
    pub(super) is_still: Vec<bool>,
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
    pub(super) search: ContactSearch,
    evaluation: EvaluationMemory,
    workspace: Workspace,
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
        let is_still = |b: &Body| setup.kinds[b.kind].is_fixed && b.state.velocity == DVec3::ZERO;
        let rounding_of = |kind: &BodyKind| kind.shape.parts.iter().map(|p| p.rounding()).fold(f64::MAX, f64::min);
        let mut world = Self {
            surfaces: Surfaces::new(&setup),
            laws: Laws::new(&setup),
            gravity: setup.gravity,
            two_dimensional: setup.sides == Sides::TwoDimensional,
            steps_per_period: STEPS_PER_PERIOD,
            rest_bound: motion::REST_BOUND,
            time: 0.0,
            kind: setup.bodies.iter().map(|b| b.kind).collect(),
            angular_momentum: setup.bodies.iter().zip(&rotation).map(momentum).collect(),
            is_still: setup.bodies.iter().map(is_still).collect(),
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
            search: ContactSearch::new(count, setup.kinds.iter().map(rounding_of).fold(f64::MAX, f64::min)),
            evaluation: EvaluationMemory::default(),
            workspace: Workspace::default(),
        };
        let at_rest = vec![DVec3::ZERO; count];
        let mut workspace = Workspace { linear_mid: at_rest.clone(), angular_mid: at_rest, ..Workspace::default() };
        world.update_contacts(0.0, &mut workspace)?;
        world.update_results();
        Ok(world)
    }

    /// Current position and motion of each body.
    pub fn states(&self) -> &[BodyState] {
        &self.states
    }

    /// Kind of each body, an index into the kinds of the set-up.
    pub fn kinds(&self) -> &[usize] {
        &self.kind
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
        self.contacts.iter().map(|contact| contact.point.overlap).fold(0.0, f64::max)
    }

    /// Size of the last contact search: number of part pairs in its list, and number of contact points found.
    pub fn search_size(&self) -> [usize; 2] {
        self.search.size()
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
        self.records.running.iter().map(|contact| &contact.record().event)
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

    /// Sets the velocity of a fixed body [m/s], with which it moves until the next call.
    ///
    /// # Errors
    /// If forces move this body.
    pub fn drive(&mut self, body: usize, velocity: DVec3) -> Result<(), RigidError> {
        let Inertia { mass, .. } = self.inertias[self.kind[body]];
        if mass.is_finite() {
            let what = "the mass of a driven body [kg]".into();
            return Err(RigidError::Setup { what, value: mass, allowed: "infinite" });
        }
        self.velocity[body] = velocity;
        self.is_still[body] = velocity == DVec3::ZERO;
        Ok(())
    }

    /// Sets the number of substeps in the shortest oscillation period [-]; [`STEPS_PER_PERIOD`] at the start. Fewer
    /// substeps save time where the restitution of impacts does not matter. The scheme is stable above pi substeps.
    pub fn set_steps_per_period(&mut self, steps: f64) {
        self.steps_per_period = steps;
    }

    /// Advances all bodies by `dt` [s] under the given loads (without gravity), which are constant over `dt`.
    pub fn advance(&mut self, dt: f64, loads: &[Load]) -> Result<(), RigidError> {
        if loads.len() != self.position.len() {
            return Err(RigidError::Loads { loads: loads.len(), bodies: self.position.len() });
        }
        if !(dt >= 0.0 && dt.is_finite()) {
            return Err(RigidError::Setup { what: "the time step [s]".into(), value: dt, allowed: "0 or greater" });
        }
        let mut workspace = std::mem::take(&mut self.workspace);
        workspace.impulse.clear();
        workspace.impulse.resize(loads.len(), Load::default());
        let start = self.time;
        let mut left = dt;
        while left > 0.0 {
            self.accelerations(loads, &mut workspace.old);
            self.hold_or_wake(&mut workspace.old);
            let h = self.substep_length(left);
            self.substep(h, loads, &mut workspace)?;
            for (sum, now) in workspace.impulse.iter_mut().zip(&self.contact_now) {
                sum.force += now.force * h;
                sum.torque += now.torque * h;
            }
            left = if h < left { left - h } else { 0.0 };
        }
        self.time = start + dt;
        self.records.complete(&mut self.contacts, self.time);
        if dt > 0.0 {
            for (mean, sum) in self.contact_mean.iter_mut().zip(&workspace.impulse) {
                *mean = Load { force: sum.force / dt, torque: sum.torque / dt };
            }
        }
        self.workspace = workspace;
        self.update_results();
        Ok(())
    }

    /// Returns a substep length [s] that divides the remaining time `left` [s] evenly and suits the stiffest contact.
    /// While no body moves, nothing changes: one substep is enough.
    fn substep_length(&self, left: f64) -> f64 {
        if self.is_still.iter().all(|still| *still) {
            return left;
        }
        let longest = (TAU / self.frequency_squared.sqrt() / self.steps_per_period).min(LONGEST_SUBSTEP);
        left / (left / longest).ceil().max(1.0)
    }

    /// Advances all bodies by a substep `h` [s]; `workspace` holds the accelerations at its start.
    fn substep(&mut self, h: f64, loads: &[Load], workspace: &mut Workspace) -> Result<(), RigidError> {
        self.kick(&workspace.old, 0.5 * h);
        self.drift(h);
        workspace.linear_mid.clone_from(&self.velocity);
        self.angular_velocities(&mut workspace.angular_mid);
        self.add_load_work(loads, &workspace.angular_mid, h);
        self.kick(&workspace.old, 0.5 * h);
        self.time += h;
        self.check_finite()?;
        self.update_contacts(h, workspace)?;
        // Replace the extrapolated velocity: the second half of the update uses the new acceleration.
        self.velocity.copy_from_slice(&workspace.linear_mid);
        self.accelerations(loads, &mut workspace.new);
        self.hold_or_wake(&mut workspace.new);
        for (body, (new, old)) in workspace.new.iter().zip(&workspace.old).enumerate() {
            self.angular_momentum[body] += (new.1 - old.1) * (0.5 * h);
            self.velocity[body] += new.0 * (0.5 * h);
        }
        self.come_to_rest(&workspace.new);
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

    /// Computes the acceleration [m/s2] and torque [N m] of each body.
    fn accelerations(&self, loads: &[Load], out: &mut Vec<(DVec3, DVec3)>) {
        let accelerate = |((external, contact), kind): ((&Load, &Load), &usize)| {
            let inertia = &self.inertias[*kind];
            if inertia.is_fixed() {
                return (DVec3::ZERO, DVec3::ZERO);
            }
            let acceleration = self.gravity + (external.force + contact.force) / inertia.mass;
            let torque = external.torque + contact.torque;
            if self.two_dimensional { (acceleration.with_y(0.0), DVec3::Y * torque.y) } else { (acceleration, torque) }
        };
        out.clear();
        out.extend(loads.iter().zip(&self.contact_now).zip(&self.kind).map(accelerate));
    }

    fn kick(&mut self, accelerations: &[(DVec3, DVec3)], dt: f64) {
        for (body, (a, torque)) in accelerations.iter().enumerate() {
            self.velocity[body] += *a * dt;
            self.angular_momentum[body] += *torque * dt;
        }
    }

    fn drift(&mut self, h: f64) {
        for body in (0..self.position.len()).filter(|body| !self.is_still[*body]) {
            self.position[body] += self.velocity[body] * h;
            let (q, l) = (self.rotation[body], self.angular_momentum[body]);
            self.rotation[body] = motion::rotated(q, &self.inertias[self.kind[body]].inverse, l, h);
        }
    }

    pub(super) fn angular_velocity_of(&self, body: usize) -> DVec3 {
        let inverse = &self.inertias[self.kind[body]].inverse;
        motion::angular_velocity(self.rotation[body], inverse, self.angular_momentum[body])
    }

    fn angular_velocities(&self, out: &mut Vec<DVec3>) {
        out.clear();
        out.extend((0..self.position.len()).map(|body| self.angular_velocity_of(body)));
    }

    fn add_load_work(&mut self, loads: &[Load], angular_mid: &[DVec3], h: f64) {
        for (body, load) in loads.iter().enumerate() {
            let power = if self.inertias[self.kind[body]].is_fixed() {
                // A driven body does work on those that it touches.
                -self.contact_now[body].force.dot(self.velocity[body])
            } else {
                load.force.dot(self.velocity[body]) + load.torque.dot(angular_mid[body])
            };
            self.energy.load_work += power * h;
        }
    }

    /// Finds the contacts at the current positions and computes their forces.
    fn update_contacts(&mut self, h: f64, workspace: &mut Workspace) -> Result<(), RigidError> {
        self.angular_velocities(&mut workspace.angular_velocity);
        let Workspace { linear_mid, angular_mid, angular_velocity, .. } = &*workspace;
        let motion = Motion {
            placements: Placements { kind: &self.kind, rotation: &self.rotation, position: &self.position },
            now: Velocities { linear: &self.velocity, angular: angular_velocity },
            mean: Velocities { linear: linear_mid, angular: angular_mid },
            is_still: &self.is_still,
            substep: Substep { dt: h, time: self.time },
        };
        let contact_points = self.search.find(&self.surfaces, &motion, &self.contacts)?;
        let results = ContactResults {
            loads: &mut self.contact_now,
            contacts: &mut self.contacts,
            energy: &mut self.energy,
            records: &mut self.records,
        };
        self.frequency_squared = self.laws.evaluate(contact_points, &motion, results, &mut self.evaluation);
        Ok(())
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
