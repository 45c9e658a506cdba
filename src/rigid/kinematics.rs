//! Motion of all bodies over a substep, and relative motion of two bodies at a contact point.

use glam::{DQuat, DVec3};

use super::contact::{ContactKey, ContactPoint, Feature, Substep};
use super::motion::{BodyState, Load};
use super::record::ContactStart;

/// Kind, rotation and position of every body.
#[derive(Debug, Clone, Copy)]
pub struct Placements<'a> {
    /// Kinds, indices into `RigidSetup::kinds`.
    pub kind: &'a [usize],
    /// Rotations from body to world axes, unit quaternions.
    pub rotation: &'a [DQuat],
    /// Centres of mass [m].
    pub position: &'a [DVec3],
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
    /// Velocity [m/s] of the material point of `body` at `arm` [m] from the centre of mass.
    fn at(&self, body: usize, arm: DVec3) -> DVec3 {
        self.linear[body] + self.angular[body].cross(arm)
    }
}

/// Motion of all bodies over a substep.
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a> {
    /// Positions and rotations at the end of the substep.
    pub placements: Placements<'a>,
    /// Velocities at the end of the substep.
    pub now: Velocities<'a>,
    /// Mean velocities over the substep, for the elongation of the springs and the work of the forces.
    pub mean: Velocities<'a>,
    /// Bodies that hold their place over the substep.
    pub is_still: &'a [bool],
    /// The substep.
    pub substep: Substep,
}

impl Motion<'_> {
    /// Returns true if neither the body nor its partner moves, so that their contact stays as it is.
    pub fn is_held(&self, key: &ContactKey) -> bool {
        let is_partner_still = || match key.feature {
            Feature::Unit { body, .. } => self.is_still[body as usize],
            Feature::Ground { .. } | Feature::Terrain { .. } | Feature::Wall { .. } => true,
        };
        self.is_still[key.body as usize] && is_partner_still()
    }
}

/// A contact point with the velocity of the first body relative to the second body, the ground or a wall.
pub struct ContactMotion<'a> {
    /// The contact point.
    pub point: &'a ContactPoint,
    /// Index of the first body.
    pub body: usize,
    /// Index of the second body; `None` for a contact with the ground or a wall.
    pub partner: Option<usize>,
    /// Vectors from the centres of mass of both bodies to the contact point [m].
    pub arms: [DVec3; 2],
    /// Normal component of the relative velocity at the end of the substep [m/s], negative when approaching.
    pub v_n: f64,
    /// Tangential part of the relative velocity at the end of the substep [m/s].
    pub v_t: DVec3,
    /// Mean relative velocity over the substep [m/s].
    pub mean: DVec3,
    /// Normal component of the mean relative velocity [m/s].
    pub mean_n: f64,
    /// Tangential part of the mean relative velocity [m/s].
    pub mean_t: DVec3,
    motion: &'a Motion<'a>,
}

impl<'a> ContactMotion<'a> {
    /// Computes the relative motion at a contact point.
    pub fn new(point: &'a ContactPoint, motion: &'a Motion<'a>) -> Self {
        let position = motion.placements.position;
        let body = point.key.body as usize;
        let partner = if let Feature::Unit { body, .. } = point.key.feature { Some(body as usize) } else { None };
        let arms = [
            point.position - position[body],
            partner.map_or(DVec3::ZERO, |b| point.position - point.shift - position[b]),
        ];
        let relative = |v: Velocities<'_>| v.at(body, arms[0]) - partner.map_or(DVec3::ZERO, |b| v.at(b, arms[1]));
        let (v, mean) = (relative(motion.now), relative(motion.mean));
        let (v_n, mean_n) = (v.dot(point.normal), mean.dot(point.normal));
        let (v_t, mean_t) = (v - point.normal * v_n, mean - point.normal * mean_n);
        Self { point, body, partner, arms, v_n, v_t, mean, mean_n, mean_t, motion }
    }

    /// Kinds of both bodies; for a contact with the ground or a wall, the kind of the body twice.
    pub fn kinds(&self) -> [usize; 2] {
        [self.body, self.partner.unwrap_or(self.body)].map(|body| self.motion.placements.kind[body])
    }

    /// Index of each body, its kind, and the vector from its centre of mass to the contact point [m].
    pub fn bodies(&self) -> impl Iterator<Item = (usize, usize, DVec3)> {
        let of = |body: usize, arm: DVec3| (body, self.motion.placements.kind[body], arm);
        let second = self.partner.map(|body| of(body, self.arms[1]));
        std::iter::once(of(self.body, self.arms[0])).chain(second)
    }

    /// Angular velocity of the first body relative to the second, without the component along the normal [rad/s]: at
    /// the end of the substep, and the mean over the substep.
    pub fn rolling_velocities(&self) -> [DVec3; 2] {
        [self.motion.now, self.motion.mean].map(|v| {
            let omega = v.angular[self.body] - self.partner.map_or(DVec3::ZERO, |b| v.angular[b]);
            omega - self.point.normal * omega.dot(self.point.normal)
        })
    }

    /// State of the bodies at the start of the contact; `mass` is the effective mass [kg].
    pub fn start(&self, mass: f64) -> ContactStart {
        let Motion { placements, now, substep, .. } = self.motion;
        let state = |body: usize, shift: DVec3| BodyState {
            position: placements.position[body] + shift,
            rotation: placements.rotation[body],
            velocity: now.linear[body],
            angular_velocity: now.angular[body],
        };
        ContactStart {
            time: substep.time,
            body: state(self.body, DVec3::ZERO),
            partner: self.partner.map(|b| state(b, self.point.shift)),
            v_n: self.v_n,
            v_t: self.v_t,
            mass,
        }
    }

    /// Adds a force [N] on the first body, and the opposite force on the second body, to the loads.
    pub fn add_force(&self, force: DVec3, loads: &mut [Load]) {
        loads[self.body].force += force;
        loads[self.body].torque += self.arms[0].cross(force);
        if let Some(b) = self.partner {
            loads[b].force -= force;
            loads[b].torque -= self.arms[1].cross(force);
        }
    }

    /// Adds a torque [N m] on the first body, and the opposite torque on the second body, to the loads.
    pub fn add_torque(&self, torque: DVec3, loads: &mut [Load]) {
        loads[self.body].torque += torque;
        if let Some(b) = self.partner {
            loads[b].torque -= torque;
        }
    }
}
