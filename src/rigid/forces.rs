//! Forces of all contacts at one instant, with the tangential history and the energy book.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::{ContactKey, Feature, Placements, Touch};
use super::contact_law::ContactLaw;
use super::hertz_mindlin::Material;
use super::motion::{BodyState, Load};
use super::record::{Beginning, ContactBook, Push};
use super::setup::RigidSetup;

/// Energy of the world [J]. For constant gravity, kinetic + potential + elastic + friction + damping - load_work keeps
/// its value up to the error of time stepping and the coupling of tangential stiffness and overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Of translation and rotation.
    pub kinetic: f64,
    /// In gravity, zero at the origin.
    pub potential: f64,
    /// Stored in contacts.
    pub elastic: f64,
    /// Turned into heat by sliding since the start.
    pub friction: f64,
    /// Turned into heat by the dashpots since the start.
    pub damping: f64,
    /// Work of the given loads since the start.
    pub load_work: f64,
}

/// A contact that exists, with its memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Its name.
    pub key: ContactKey,
    /// Normal of the last evaluation.
    pub normal: DVec3,
    /// Tangential spring d_t [m].
    pub spring: DVec3,
    /// Rolling spring [rad].
    pub roll: DVec3,
    /// Overlap [m].
    pub overlap: f64,
    /// Overlap at which it counts as begun [m]; what a triangle surface has at the start does not count.
    pub sunk: f64,
    /// Point of the partner's core that was nearest, in its own axes [m]: where the next search begins.
    pub core: DVec3,
    /// Force on the first body [N].
    pub force: DVec3,
    /// What the dashpot gives to its normal part [N].
    pub dashpot: f64,
    /// Energy stored in overlap, tangential and rolling spring [J].
    pub elastic: [f64; 3],
}

impl Contact {
    /// The same contact with its springs gone: it is not pressed in deeper than it began.
    fn idle(self, touch: &Touch, step: Step) -> Self {
        let Self { key, sunk, .. } = self;
        Self { key, sunk, ..Self::begun(touch, step) }
    }

    /// The same contact now; at another place, it is pressed in no deeper than it was.
    fn moved_on_to(self, touch: &Touch) -> Self {
        let stays = self.key == touch.key || !matches!(touch.key.feature, Feature::Terrain { .. });
        let sunk = if stays { self.sunk } else { (touch.overlap - (self.overlap - self.sunk)).max(0.0) };
        Self { key: touch.key, sunk, ..self }
    }

    /// A contact that has just begun.
    ///
    /// On a triangle surface a part can come to lie over another ridge while it is pressed into its neighbours, and then
    /// starts there with an overlap. That does not count, lest energy come from nothing; an overlap that the bodies
    /// were given at the start of the world does.
    fn begun(touch: &Touch, step: Step) -> Self {
        let on_terrain = matches!(touch.key.feature, Feature::Terrain { .. });
        let sunk = if on_terrain && step.dt > 0.0 { touch.overlap } else { 0.0 };
        Self {
            sunk,
            key: touch.key,
            normal: touch.normal,
            spring: DVec3::ZERO,
            roll: DVec3::ZERO,
            overlap: touch.overlap,
            core: touch.core,
            force: DVec3::ZERO,
            dashpot: 0.0,
            elastic: [0.0; 3],
        }
    }
}

/// Velocities of all bodies at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Velocities<'a> {
    /// Of the centres of mass [m/s].
    pub linear: &'a [DVec3],
    /// Angular, world axes [rad/s].
    pub angular: &'a [DVec3],
}

impl Velocities<'_> {
    /// Velocity of the material point of `body` at the arm r from its centre of mass [m/s].
    fn at(&self, body: usize, arm: DVec3) -> DVec3 {
        self.linear[body] + self.angular[body].cross(arm)
    }
}

/// Laws of the pairs of surfaces.
#[derive(Debug, Clone, Copy)]
pub struct Laws {
    unit: ContactLaw,
    ground: ContactLaw,
    wall: ContactLaw,
    mass: f64,
    least_inertia: f64,
    least_radius: f64,
}

/// One evaluation of all contacts.
#[derive(Debug, Clone, Default)]
pub struct Evaluation {
    /// Sum over the contacts of each body.
    pub loads: Vec<Load>,
    /// Contacts that exist, sorted by key.
    pub contacts: Vec<Contact>,
    /// Square of the largest angular frequency that a body can have on its contacts [1/s2].
    pub frequency_squared: f64,
}

/// Step over which an evaluation carries the history on.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// Its length [s]; 0 for the first evaluation.
    pub dt: f64,
    /// Time at its end [s].
    pub time: f64,
    /// Time for which the step length found here may be used [s]: what will touch within it counts.
    pub horizon: f64,
}

impl Laws {
    /// Laws of a world; radius R for a plane, R/2 for two equal roundings.
    pub fn new(setup: &RigidSetup) -> Self {
        let RigidSetup { friction, model, material, wall_material, .. } = setup;
        let mass = setup.shape.mass;
        let radius = setup.shape.parts.iter().map(|p| p.rounding()).fold(f64::MAX, f64::min);
        let ground = setup.ground.as_ref().map_or(*material, |g| g.material);
        let fixed = |other: &Material, resistance| ContactLaw::new(*model, material, other, resistance, mass, radius);
        Self {
            unit: ContactLaw::new(*model, material, material, friction.unit_unit, 0.5 * mass, 0.5 * radius),
            ground: fixed(&ground, friction.unit_ground),
            wall: fixed(wall_material, friction.unit_wall),
            mass,
            least_radius: radius,
            // Of a symmetric positive tensor: the smallest eigenvalue is at least det / (trace / 2)^2.
            least_inertia: setup.shape.inertia.determinant()
                / (0.5 * (0..3).map(|i| setup.shape.inertia.col(i)[i]).sum::<f64>()).powi(2),
        }
    }

    fn of(&self, feature: Feature) -> &ContactLaw {
        match feature {
            Feature::Unit { .. } => &self.unit,
            Feature::Ground { .. } | Feature::Terrain { .. } => &self.ground,
            Feature::Wall { .. } => &self.wall,
        }
    }

    /// Forces at the given places; `before` holds the contacts of the previous evaluation and `book` their records, `now`
    /// the velocities at this instant, `over` those over the step (they move the tangential springs and do the work).
    #[allow(clippy::too_many_arguments)]
    pub fn evaluate(
        &self,
        touches: &[Touch],
        before: &[Contact],
        placements: Placements<'_>,
        now: Velocities<'_>,
        over: Velocities<'_>,
        step: Step,
        energy: &mut Energy,
        book: &mut ContactBook,
    ) -> Evaluation {
        let Placements { rotation, position } = placements;
        let mut out = Evaluation { loads: vec![Load::default(); position.len()], ..Default::default() };
        let mut stiffness = vec![0.0; position.len()];
        let mut used = vec![false; before.len()];
        let mut records: Vec<_> = std::mem::take(&mut book.running).into_iter().map(Some).collect();
        book.running.reserve(touches.len());
        out.contacts.reserve(touches.len());
        energy.elastic = 0.0;
        for touch in touches {
            let law = self.of(touch.key.feature);
            let a = touch.key.body as usize;
            let b = if let Feature::Unit { body, .. } = touch.key.feature { Some(body as usize) } else { None };
            let arm_a = touch.point - position[a];
            let arm_b = b.map_or(DVec3::ZERO, |b| touch.point - touch.shift - position[b]);
            let relative = |v: Velocities<'_>| v.at(a, arm_a) - b.map_or(DVec3::ZERO, |b| v.at(b, arm_b));
            let (v, v_over) = (relative(now), relative(over));
            let (v_n, v_n_over) = (v.dot(touch.normal), v_over.dot(touch.normal));
            let (v_t, v_t_over) = (v - touch.normal * v_n, v_over - touch.normal * v_n_over);

            let closing = (-v_n).max(0.0);
            if -touch.overlap <= closing * step.horizon {
                let expected = touch.overlap.max(law.impact_overlap(closing));
                let s_n = law.normal_stiffness(expected);
                let share = |arm: DVec3| s_n * (1.0 + self.mass * arm.length_squared() / self.least_inertia);
                // Two bodies on one spring: the frequency is that of twice the stiffness (Gershgorin's bound).
                stiffness[a] += if b.is_some() { 2.0 } else { 1.0 } * share(arm_a);
                if let Some(b) = b {
                    stiffness[b] += 2.0 * share(arm_b);
                }
            }
            if touch.overlap <= 0.0 {
                continue;
            }

            let memory = find(before, &mut used, touches, touch, self.least_radius);
            let known = memory.is_some();
            let mut contact = memory.map_or_else(|| Contact::begun(touch, step), |i| before[i].moved_on_to(touch));
            let mut record = memory.and_then(|index| records[index].take()).unwrap_or_else(|| {
                let state = |body: usize, shift: DVec3| BodyState {
                    position: position[body] + shift,
                    rotation: rotation[body],
                    velocity: now.linear[body],
                    angular_velocity: now.angular[body],
                };
                let (body, partner) = (state(a, DVec3::ZERO), b.map(|b| state(b, touch.shift)));
                let mass = if b.is_some() { 0.5 } else { 1.0 } * self.mass;
                book.begin(touch, Beginning { time: step.time, body, partner, v_n, v_t, mass })
            });
            let moved = if known { v_t_over * step.dt } else { DVec3::ZERO };
            let kept = if law.remembers() { turned(contact.spring, contact.normal, touch.normal) } else { DVec3::ZERO };
            contact.sunk = contact.sunk.min(touch.overlap);
            let overlap = touch.overlap - contact.sunk;
            if overlap <= 0.0 {
                energy.friction += contact.elastic[1] + contact.elastic[2];
                record.add(Push { step, before: contact.force, now: DVec3::ZERO, v_n });
                book.running.push(record);
                out.contacts.push(contact.idle(touch, step));
                continue;
            }
            let response = law.respond(overlap, v_n, v_t, kept + moved);
            let force = touch.normal * response.normal + response.tangential;

            out.loads[a].force += force;
            out.loads[a].torque += arm_a.cross(force);
            if let Some(b) = b {
                out.loads[b].force -= force;
                out.loads[b].torque -= arm_b.cross(force);
            }

            let across = |v: Velocities<'_>| {
                let omega = v.angular[a] - b.map_or(DVec3::ZERO, |b| v.angular[b]);
                omega - touch.normal * omega.dot(touch.normal)
            };
            let (omega, omega_over) = (across(now), across(over));
            let rolled = if known { omega_over * step.dt } else { DVec3::ZERO };
            let roll = turned(contact.roll, contact.normal, touch.normal) + rolled;
            let rolling = law.roll(overlap, response.normal, omega, roll);
            let mut rolling_energy = 0.0;
            if let Some(rolling) = rolling {
                out.loads[a].torque += rolling.torque;
                if let Some(b) = b {
                    out.loads[b].torque -= rolling.torque;
                }
                rolling_energy = 0.5 * law.rolling_stiffness(overlap) * rolling.spring.length_squared();
                let lost = -rolling.torque.dot(omega_over) * step.dt - (rolling_energy - contact.elastic[2]);
                *(if rolling.rolling { &mut energy.friction } else { &mut energy.damping }) += lost;
                contact.roll = rolling.spring;
            }

            let stored = [law.normal_energy(overlap), law.tangential_energy(overlap, response.spring), rolling_energy];
            // The bodies felt the mean of the forces at both ends of the step.
            let dashpot = response.normal - law.elastic_force(overlap);
            let damped = -0.5 * (contact.dashpot + dashpot) * v_n_over * step.dt;
            let gained = stored[0] + stored[1] - contact.elastic[0] - contact.elastic[1];
            let lost = -0.5 * (contact.force + force).dot(v_over) * step.dt - gained;
            energy.damping += damped;
            *(if response.sliding { &mut energy.friction } else { &mut energy.damping }) += lost - damped;
            energy.elastic += stored.iter().sum::<f64>();

            record.add(Push { step, before: contact.force, now: force, v_n });
            book.running.push(record);
            contact.normal = touch.normal;
            contact.overlap = touch.overlap;
            contact.core = touch.core;
            contact.spring = response.spring;
            contact.force = force;
            contact.dashpot = dashpot;
            contact.elastic = stored;
            out.contacts.push(contact);
        }
        for (old, record) in before.iter().zip(records).filter_map(|(old, record)| Some((old, record?))) {
            energy.friction += old.elastic[1] + old.elastic[2];
            if let Feature::Terrain { .. } = old.key.feature {
                // A part can leave a ridge while it is pressed into it.
                energy.damping += old.elastic[0];
            }
            book.end(record, old.force, step);
        }
        out.frequency_squared = stiffness.iter().fold(0.0, |most: f64, k| most.max(k / self.mass));
        out
    }
}

/// Where the memory of a contact is: its own, or that of the same part at the neighbouring place of the ground, which it
/// has left.
fn find(before: &[Contact], used: &mut [bool], touches: &[Touch], touch: &Touch, least_radius: f64) -> Option<usize> {
    let key = touch.key;
    let index = before.binary_search_by_key(&key, |c| c.key).ok().or_else(|| {
        let touching =
            |k: &ContactKey| touches.binary_search_by_key(k, |t| t.key).is_ok_and(|i| touches[i].overlap > 0.0);
        let left = |(c, used): (&Contact, &bool)| {
            let same_part = (c.key.body, c.key.part) == (key.body, key.part);
            let next = same_part && !*used && are_neighbours(c.key.feature, key.feature) && !touching(&c.key);
            // Places meet without a step: a foot that has moved on is near where it was.
            next.then(|| c.core.distance(touch.core)).filter(|way| *way < least_radius)
        };
        let ways = before.iter().zip(used.iter()).map(left).enumerate();
        ways.filter_map(|(index, way)| Some((index, way?))).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    })?;
    used[index] = true;
    Some(index)
}

/// Whether a part can go from one place of the ground to the other in a step.
fn are_neighbours(old: Feature, new: Feature) -> bool {
    match (old, new) {
        (Feature::Ground { place: old, .. }, Feature::Ground { place: new, .. }) => old.abs_diff(new) <= 1,
        (Feature::Terrain { .. }, Feature::Terrain { .. }) => true,
        _ => false,
    }
}

/// The tangential spring turned with the contact's normal; its length stays.
fn turned(spring: DVec3, old_normal: DVec3, normal: DVec3) -> DVec3 {
    if old_normal == normal || spring == DVec3::ZERO {
        return spring;
    }
    let turned = DQuat::from_rotation_arc(old_normal, normal) * spring;
    let flat = turned - normal * turned.dot(normal);
    flat.normalize_or_zero() * spring.length()
}
