//! Bodies at rest.
//!
//! A body in contact comes to rest when it is slow and its forces balance, both within small bounds. At rest, it keeps
//! its place, and contacts between bodies at rest keep their forces: they need no search and no contact law. A body
//! leaves its rest when its forces are out of balance by more than the bound, because its load or another contact has
//! changed. No state changes at rest. A body therefore moves on as if it had just come to rest, to the last bit.

use glam::DVec3;

use super::motion::{self, Inertia, Load};
use super::world::RigidWorld;

/// Largest speed of a body that comes to rest, divided by sqrt(g R) [-] and by the bound of its acceleration, with its
/// radius R. On contact springs with an angular frequency of 1000/s, a body of 0.1 m with this speed swings with an
/// acceleration of about the bound.
const REST_SPEED: f64 = 1e-2;

impl RigidWorld {
    /// Sets the largest acceleration of a body at rest, divided by gravity [-]; [`motion::REST_BOUND`] at the start. With
    /// 0, no body comes to rest, and those at rest leave it.
    pub fn set_rest_bound(&mut self, bound: f64) {
        self.rest_bound = bound;
    }

    /// Number of bodies that forces can move and that are at rest.
    pub fn count_at_rest(&self) -> usize {
        self.is_still
            .iter()
            .zip(&self.kind)
            .filter(|(still, kind)| **still && !self.inertias[**kind].is_fixed())
            .count()
    }

    /// Returns true if the acceleration [m/s2] and the torque [N m] of a body are within the bound of a body at rest.
    fn is_balanced(&self, body: usize, (linear, torque): &(DVec3, DVec3)) -> bool {
        let bound = self.rest_bound * self.gravity.length();
        let inverse = &self.inertias[self.kind[body]].inverse;
        let spin = motion::angular_velocity(self.rotation[body], inverse, *torque);
        let reach = self.surfaces.reach(self.kind[body]);
        linear.length_squared() < bound * bound && spin.length_squared() * reach * reach < bound * bound
    }

    /// Ends the rest of bodies whose forces do not balance; sets the accelerations of the others at rest to zero.
    pub(super) fn hold_or_wake(&mut self, accelerations: &mut [(DVec3, DVec3)]) {
        for (body, acceleration) in accelerations.iter_mut().enumerate() {
            if self.is_still[body] {
                self.is_still[body] = self.inertias[self.kind[body]].is_fixed() || self.is_balanced(body, acceleration);
                if self.is_still[body] {
                    *acceleration = (DVec3::ZERO, DVec3::ZERO);
                }
            }
        }
    }

    /// Brings slow bodies in contact, whose forces balance, to rest. Their kinetic energy counts as damped.
    pub(super) fn come_to_rest(&mut self, accelerations: &[(DVec3, DVec3)]) {
        let gravity = self.gravity.length();
        for (body, acceleration) in accelerations.iter().enumerate() {
            let Inertia { mass, .. } = self.inertias[self.kind[body]];
            let reach = self.surfaces.reach(self.kind[body]);
            let fastest = REST_SPEED * self.rest_bound * (gravity * reach).sqrt();
            let velocity = self.velocity[body];
            if self.is_still[body] || velocity.length_squared() >= fastest * fastest || mass.is_infinite() {
                continue;
            }
            let spin = self.angular_velocity_of(body);
            let is_slow = spin.length() * reach < fastest;
            if is_slow && self.contact_now[body] != Load::default() && self.is_balanced(body, acceleration) {
                self.energy.damping += 0.5 * (mass * velocity.length_squared() + self.angular_momentum[body].dot(spin));
                self.velocity[body] = DVec3::ZERO;
                self.angular_momentum[body] = DVec3::ZERO;
                self.is_still[body] = true;
            }
        }
    }
}
