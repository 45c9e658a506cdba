//! Motion and load of a rigid body: the data that water, contact and outputs exchange.

use std::ops::AddAssign;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Position and motion of a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BodyState {
    /// Position of the centre of mass [m]. At periodic sides, y is not wrapped into the domain.
    pub position: DVec3,
    /// Rotation from body to world axes, a unit quaternion.
    pub rotation: DQuat,
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity in world axes [rad/s].
    pub angular_velocity: DVec3,
}

impl BodyState {
    /// Returns the state of a body at rest.
    pub fn at_rest(position: DVec3, rotation: DQuat) -> Self {
        Self { position, rotation, velocity: DVec3::ZERO, angular_velocity: DVec3::ZERO }
    }
}

/// Force and torque on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(from = "[[f64; 3]; 2]", into = "[[f64; 3]; 2]")]
pub struct Load {
    /// Force [N].
    pub force: DVec3,
    /// Torque about the centre of mass in world axes [N m].
    pub torque: DVec3,
}

impl Load {
    /// Returns the load of a force [N] that acts at the point `arm` [m], a vector from the centre of mass.
    pub fn of_force(force: DVec3, arm: DVec3) -> Self {
        Self { force, torque: arm.cross(force) }
    }

    /// Returns a load with the force `f(force)` and the torque `f(torque)`.
    pub fn map(self, f: impl Fn(DVec3) -> DVec3) -> Self {
        Self { force: f(self.force), torque: f(self.torque) }
    }
}

impl AddAssign for Load {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl From<Load> for [[f64; 3]; 2] {
    fn from(load: Load) -> Self {
        [load.force.to_array(), load.torque.to_array()]
    }
}

impl From<[[f64; 3]; 2]> for Load {
    fn from([force, torque]: [[f64; 3]; 2]) -> Self {
        Self { force: DVec3::from_array(force), torque: DVec3::from_array(torque) }
    }
}
