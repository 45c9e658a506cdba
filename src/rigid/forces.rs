//! Forces of all contacts at one instant, with the tangential history and the energy balance.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::{Contact, ContactKey, ContactPoint, Feature, Substep};
use super::law::{ContactLaw, Material};
use super::motion::{BodyState, Load};
use super::record::{ContactRecords, ContactStart, ForceStep};
use super::search::Placements;
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

    /// Computes the forces at the contact points. `before` are the previous contacts and `records` their records. `now`
    /// are the current velocities; `over`, the mean velocities of the substep, stretch the springs and do the work.
    #[allow(clippy::too_many_arguments)]
    pub fn evaluate(
        &self,
        contact_points: &[ContactPoint],
        before: &[Contact],
        placements: Placements<'_>,
        now: Velocities<'_>,
        over: Velocities<'_>,
        substep: Substep,
        energy: &mut Energy,
        records: &mut ContactRecords,
    ) -> Evaluation {
        let Placements { rotation, position } = placements;
        let mut out = Evaluation { loads: vec![Load::default(); position.len()], ..Default::default() };
        let mut stiffness = vec![0.0; position.len()];
        let mut used = vec![false; before.len()];
        let mut old_records: Vec<_> = std::mem::take(&mut records.running).into_iter().map(Some).collect();
        records.running.reserve(contact_points.len());
        out.contacts.reserve(contact_points.len());
        energy.elastic = 0.0;
        for point in contact_points {
            let law = self.law_of(point.key.feature);
            let a = point.key.body as usize;
            let b = if let Feature::Unit { body, .. } = point.key.feature { Some(body as usize) } else { None };
            let arm_a = point.position - position[a];
            let arm_b = b.map_or(DVec3::ZERO, |b| point.position - point.shift - position[b]);
            let relative = |v: Velocities<'_>| v.at(a, arm_a) - b.map_or(DVec3::ZERO, |b| v.at(b, arm_b));
            let (v, v_over) = (relative(now), relative(over));
            let (v_n, v_n_over) = (v.dot(point.normal), v_over.dot(point.normal));
            let (v_t, v_t_over) = (v - point.normal * v_n, v_over - point.normal * v_n_over);

            let closing = (-v_n).max(0.0);
            if -point.overlap <= closing * substep.horizon {
                let expected = point.overlap.max(law.impact_overlap(closing));
                let s_n = law.normal_stiffness(expected);
                let stiffness_at = |arm: DVec3| s_n * (1.0 + self.mass * arm.length_squared() / self.least_inertia);
                // Two bodies on one spring: twice the stiffness bounds the frequency (Gershgorin).
                stiffness[a] += if b.is_some() { 2.0 } else { 1.0 } * stiffness_at(arm_a);
                if let Some(b) = b {
                    stiffness[b] += 2.0 * stiffness_at(arm_b);
                }
            }
            if point.overlap <= 0.0 {
                continue;
            }

            let previous = find(before, &mut used, contact_points, point, self.least_radius);
            let known = previous.is_some();
            let mut contact =
                previous.map_or_else(|| Contact::started(point, substep), |i| before[i].continued_as(point));
            let mut record = previous.and_then(|index| old_records[index].take()).unwrap_or_else(|| {
                let state = |body: usize, shift: DVec3| BodyState {
                    position: position[body] + shift,
                    rotation: rotation[body],
                    velocity: now.linear[body],
                    angular_velocity: now.angular[body],
                };
                let (body, partner) = (state(a, DVec3::ZERO), b.map(|b| state(b, point.shift)));
                let mass = if b.is_some() { 0.5 } else { 1.0 } * self.mass;
                records.begin(point, ContactStart { time: substep.time, body, partner, v_n, v_t, mass })
            });
            let moved = if known { v_t_over * substep.dt } else { DVec3::ZERO };
            let kept =
                if law.keeps_spring() { rotate(contact.spring, contact.normal, point.normal) } else { DVec3::ZERO };
            contact.initial_overlap = contact.initial_overlap.min(point.overlap);
            let overlap = point.overlap - contact.initial_overlap;
            if overlap <= 0.0 {
                energy.friction += contact.elastic[1] + contact.elastic[2];
                record.add(ForceStep { substep, before: contact.force, now: DVec3::ZERO, v_n });
                records.running.push(record);
                out.contacts.push(contact.idle(point, substep));
                continue;
            }
            let forces = law.forces(overlap, v_n, v_t, kept + moved);
            let force = point.normal * forces.normal + forces.tangential;

            out.loads[a].force += force;
            out.loads[a].torque += arm_a.cross(force);
            if let Some(b) = b {
                out.loads[b].force -= force;
                out.loads[b].torque -= arm_b.cross(force);
            }

            let tangential_spin = |v: Velocities<'_>| {
                let omega = v.angular[a] - b.map_or(DVec3::ZERO, |b| v.angular[b]);
                omega - point.normal * omega.dot(point.normal)
            };
            let (omega, omega_over) = (tangential_spin(now), tangential_spin(over));
            let rolled = if known { omega_over * substep.dt } else { DVec3::ZERO };
            let rolling_spring = rotate(contact.rolling_spring, contact.normal, point.normal) + rolled;
            let rolling = law.rolling_resistance(overlap, forces.normal, omega, rolling_spring);
            let mut rolling_energy = 0.0;
            if let Some(rolling) = rolling {
                out.loads[a].torque += rolling.torque;
                if let Some(b) = b {
                    out.loads[b].torque -= rolling.torque;
                }
                rolling_energy = 0.5 * law.rolling_stiffness(overlap) * rolling.spring.length_squared();
                let lost = -rolling.torque.dot(omega_over) * substep.dt - (rolling_energy - contact.elastic[2]);
                *(if rolling.rolling { &mut energy.friction } else { &mut energy.damping }) += lost;
                contact.rolling_spring = rolling.spring;
            }

            let stored = [law.normal_energy(overlap), law.tangential_energy(overlap, forces.spring), rolling_energy];
            // The mean of the forces at both ends of the substep acted on the bodies.
            let dashpot = forces.normal - law.elastic_force(overlap);
            let damped = -0.5 * (contact.dashpot + dashpot) * v_n_over * substep.dt;
            let gained = stored[0] + stored[1] - contact.elastic[0] - contact.elastic[1];
            let lost = -0.5 * (contact.force + force).dot(v_over) * substep.dt - gained;
            energy.damping += damped;
            *(if forces.sliding { &mut energy.friction } else { &mut energy.damping }) += lost - damped;
            energy.elastic += stored.iter().sum::<f64>();

            record.add(ForceStep { substep, before: contact.force, now: force, v_n });
            records.running.push(record);
            contact.normal = point.normal;
            contact.overlap = point.overlap;
            contact.core = point.core;
            contact.spring = forces.spring;
            contact.force = force;
            contact.dashpot = dashpot;
            contact.elastic = stored;
            out.contacts.push(contact);
        }
        for (old, record) in before.iter().zip(old_records).filter_map(|(old, record)| Some((old, record?))) {
            energy.friction += old.elastic[1] + old.elastic[2];
            if let Feature::Terrain { .. } = old.key.feature {
                // A part can leave a ridge while it still overlaps it.
                energy.damping += old.elastic[0];
            }
            records.end(record, old.force, substep);
        }
        out.frequency_squared = stiffness.iter().fold(0.0, |most: f64, k| most.max(k / self.mass));
        out
    }
}

/// Index of the previous contact that continues as `point`: the same contact, or that of the same part on a
/// neighbouring ground element that it has just left.
fn find(
    before: &[Contact],
    used: &mut [bool],
    contact_points: &[ContactPoint],
    point: &ContactPoint,
    least_radius: f64,
) -> Option<usize> {
    let key = point.key;
    let index = before.binary_search_by_key(&key, |c| c.key).ok().or_else(|| {
        let touching = |k: &ContactKey| {
            contact_points.binary_search_by_key(k, |t| t.key).is_ok_and(|i| contact_points[i].overlap > 0.0)
        };
        let left = |(c, used): (&Contact, &bool)| {
            let same_part = (c.key.body, c.key.part) == (key.body, key.part);
            let next = same_part && !*used && are_neighbours(c.key.feature, key.feature) && !touching(&c.key);
            // Ground elements join continuously, so a foot point that changes element moves only a short distance.
            next.then(|| c.core.distance(point.core)).filter(|path| *path < least_radius)
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
