//! Forces of all contacts at one instant, with the tangential history and the energy balance.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::{ContactKey, Feature, Placements, Touch};
use super::contact_law::ContactLaw;
use super::hertz_mindlin::Material;
use super::motion::{BodyState, Load};
use super::record::{Beginning, ContactBook, Push};
use super::setup::RigidSetup;

/// Energy balance of the world [J]. For constant gravity, kinetic + potential + elastic + friction + damping -
/// load_work is constant, except for time-stepping errors and the coupling of tangential stiffness and overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy of translation and rotation.
    pub kinetic: f64,
    /// Potential energy in gravity, zero at the origin.
    pub potential: f64,
    /// Elastic energy stored in contacts.
    pub elastic: f64,
    /// Energy dissipated by friction since the start.
    pub friction: f64,
    /// Energy dissipated by the dashpots since the start.
    pub damping: f64,
    /// Work of the external loads since the start.
    pub load_work: f64,
}

/// An active contact with its history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Identity of the contact.
    pub key: ContactKey,
    /// Contact normal at the last evaluation.
    pub normal: DVec3,
    /// Tangential spring d_t [m].
    pub spring: DVec3,
    /// Rolling spring [rad].
    pub roll: DVec3,
    /// Overlap [m].
    pub overlap: f64,
    /// Overlap at which the contact force starts [m]: the initial overlap on a triangle surface is subtracted.
    pub sunk: f64,
    /// Nearest point of the partner's core, in the partner's axes [m]: start of the next search.
    pub core: DVec3,
    /// Force on the first body [N].
    pub force: DVec3,
    /// Dashpot part of the normal force [N].
    pub dashpot: f64,
    /// Energy stored in the normal, tangential and rolling springs [J].
    pub elastic: [f64; 3],
}

impl Contact {
    /// Returns the same contact with unloaded springs, for an overlap that does not exceed the initial one.
    fn idle(self, touch: &Touch, step: Step) -> Self {
        let Self { key, sunk, .. } = self;
        Self { key, sunk, ..Self::started(touch, step) }
    }

    /// Returns the contact at its new position; the effective overlap stays the same on another element of a surface.
    fn continued_as(self, touch: &Touch) -> Self {
        let stays = self.key == touch.key || !matches!(touch.key.feature, Feature::Terrain { .. });
        let sunk = if stays { self.sunk } else { (touch.overlap - (self.overlap - self.sunk)).max(0.0) };
        Self { key: touch.key, sunk, ..self }
    }

    /// Creates a contact that has just started.
    ///
    /// On a triangle surface, a part in contact with neighbouring elements can reach another ridge with an overlap.
    /// This overlap is subtracted, because it would create energy. An overlap at the start of the world counts.
    fn started(touch: &Touch, step: Step) -> Self {
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
    /// Velocities of the centres of mass [m/s].
    pub linear: &'a [DVec3],
    /// Angular velocities, world axes [rad/s].
    pub angular: &'a [DVec3],
}

impl Velocities<'_> {
    /// Velocity [m/s] of the material point of `body` at the lever arm r [m] from its centre of mass.
    fn at(&self, body: usize, arm: DVec3) -> DVec3 {
        self.linear[body] + self.angular[body].cross(arm)
    }
}

/// Contact laws of all pairs of surfaces.
#[derive(Debug, Clone, Copy)]
pub struct Laws {
    unit: ContactLaw,
    ground: ContactLaw,
    wall: ContactLaw,
    mass: f64,
    least_inertia: f64,
    least_radius: f64,
}

/// Result of one evaluation of all contacts.
#[derive(Debug, Clone, Default)]
pub struct Evaluation {
    /// Total contact load on each body.
    pub loads: Vec<Load>,
    /// Active contacts, sorted by key.
    pub contacts: Vec<Contact>,
    /// Square of the largest angular frequency of a body on its contacts, an upper bound [1/s2].
    pub frequency_squared: f64,
}

/// Substep over which an evaluation advances the contact history.
#[derive(Debug, Clone, Copy)]
pub struct Step {
    /// Length of the substep [s]; 0 for the first evaluation.
    pub dt: f64,
    /// Time at the end of the substep [s].
    pub time: f64,
    /// Time for which the resulting substep length may be used [s]; contacts that may start within it count.
    pub horizon: f64,
}

impl Laws {
    /// Creates the contact laws of a world: effective radius R against a plane, R/2 for two equal rounding radii.
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
            // The smallest eigenvalue of a symmetric positive tensor is at least det / (trace / 2)^2.
            least_inertia: setup.shape.inertia.determinant()
                / (0.5 * (0..3).map(|i| setup.shape.inertia.col(i)[i]).sum::<f64>()).powi(2),
        }
    }

    fn law_of(&self, feature: Feature) -> &ContactLaw {
        match feature {
            Feature::Unit { .. } => &self.unit,
            Feature::Ground { .. } | Feature::Terrain { .. } => &self.ground,
            Feature::Wall { .. } => &self.wall,
        }
    }

    /// Computes the forces at the contact points. `before` are the previous contacts and `book` their records. `now`
    /// are the current velocities; `over`, the mean velocities of the substep, stretch the springs and do the work.
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
            let law = self.law_of(touch.key.feature);
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
                let stiffness_at = |arm: DVec3| s_n * (1.0 + self.mass * arm.length_squared() / self.least_inertia);
                // Two bodies on one spring: twice the stiffness bounds the frequency (Gershgorin).
                stiffness[a] += if b.is_some() { 2.0 } else { 1.0 } * stiffness_at(arm_a);
                if let Some(b) = b {
                    stiffness[b] += 2.0 * stiffness_at(arm_b);
                }
            }
            if touch.overlap <= 0.0 {
                continue;
            }

            let previous = find(before, &mut used, touches, touch, self.least_radius);
            let known = previous.is_some();
            let mut contact = previous.map_or_else(|| Contact::started(touch, step), |i| before[i].continued_as(touch));
            let mut record = previous.and_then(|index| records[index].take()).unwrap_or_else(|| {
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
            let kept = if law.remembers() { rotate(contact.spring, contact.normal, touch.normal) } else { DVec3::ZERO };
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

            let tangential_spin = |v: Velocities<'_>| {
                let omega = v.angular[a] - b.map_or(DVec3::ZERO, |b| v.angular[b]);
                omega - touch.normal * omega.dot(touch.normal)
            };
            let (omega, omega_over) = (tangential_spin(now), tangential_spin(over));
            let rolled = if known { omega_over * step.dt } else { DVec3::ZERO };
            let roll = rotate(contact.roll, contact.normal, touch.normal) + rolled;
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
            // The mean of the forces at both ends of the substep acted on the bodies.
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
                // A part can leave a ridge while it still overlaps it.
                energy.damping += old.elastic[0];
            }
            book.end(record, old.force, step);
        }
        out.frequency_squared = stiffness.iter().fold(0.0, |most: f64, k| most.max(k / self.mass));
        out
    }
}

/// Index of the previous contact that continues as `touch`: the same contact, or that of the same part on a
/// neighbouring ground element that it has just left.
fn find(before: &[Contact], used: &mut [bool], touches: &[Touch], touch: &Touch, least_radius: f64) -> Option<usize> {
    let key = touch.key;
    let index = before.binary_search_by_key(&key, |c| c.key).ok().or_else(|| {
        let touching =
            |k: &ContactKey| touches.binary_search_by_key(k, |t| t.key).is_ok_and(|i| touches[i].overlap > 0.0);
        let left = |(c, used): (&Contact, &bool)| {
            let same_part = (c.key.body, c.key.part) == (key.body, key.part);
            let next = same_part && !*used && are_neighbours(c.key.feature, key.feature) && !touching(&c.key);
            // Ground elements join continuously, so a foot point that changes element moves only a short distance.
            next.then(|| c.core.distance(touch.core)).filter(|path| *path < least_radius)
        };
        let paths = before.iter().zip(used.iter()).map(left).enumerate();
        paths.filter_map(|(index, p)| Some((index, p?))).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    })?;
    used[index] = true;
    Some(index)
}

/// Whether a part can move from one ground element to the other within a substep.
fn are_neighbours(old: Feature, new: Feature) -> bool {
    match (old, new) {
        (Feature::Ground { place: old, .. }, Feature::Ground { place: new, .. }) => old.abs_diff(new) <= 1,
        (Feature::Terrain { .. }, Feature::Terrain { .. }) => true,
        _ => false,
    }
}

/// Rotates a tangential spring with the contact normal and keeps its length.
fn rotate(spring: DVec3, old_normal: DVec3, normal: DVec3) -> DVec3 {
    if old_normal == normal || spring == DVec3::ZERO {
        return spring;
    }
    let rotated = DQuat::from_rotation_arc(old_normal, normal) * spring;
    let tangential = rotated - normal * rotated.dot(normal);
    tangential.normalize_or_zero() * spring.length()
}
