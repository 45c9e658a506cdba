//! An impact at prototype scale.

use glam::DVec3;

use super::froude::{BlowScale, Froude};
use super::model::Model;
use crate::case::{ContactLawName, Handover};
use crate::femdem::mesh::unit_mesh::Pose;
use crate::output::Impact;
use crate::rigid::{BodyState, Material, effective_young_modulus, impact_overlap};

/// A recorded impact with its scale factors to the prototype.
#[derive(Debug, Clone, Copy)]
pub struct Blow<'a> {
    /// The units of the run.
    pub model: &'a Model,
    /// Settings of the breakage analysis.
    pub handover: &'a Handover,
    /// The recorded impact.
    pub impact: &'a Impact,
    /// Scale factors of lengths, velocities and masses.
    pub froude: Froude,
    /// Scale factors of force and duration.
    pub scale: BlowScale,
    /// Duration of the impact in the prototype by Hertz's law [s].
    pub duration: f64,
}

/// Motion of a unit just before the impact, at prototype scale; the origin is the contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mover {
    /// Pose of the unit.
    pub pose: Pose,
    /// Velocity of its centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
}

/// Mass, momentum and energy of a unit: first of the rigid body at prototype scale, second of the nodes of its mesh.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Balance {
    /// Mass [kg].
    pub mass_kg: [f64; 2],
    /// Momentum [kg m/s].
    pub momentum: [[f64; 3]; 2],
    /// Kinetic energy [J].
    pub kinetic_j: [f64; 2],
}

impl<'a> Blow<'a> {
    /// Scales an impact of a run to the prototype.
    pub fn new(model: &'a Model, handover: &'a Handover, impact: &'a Impact) -> Self {
        let froude = Froude { scale: handover.scale };
        let event = &impact.event;
        let on_unit = event.partner_unit().is_some();
        let partner = if on_unit { &model.material } else { &model.ground };
        let recorded = effective_young_modulus(&model.material, partner);
        let [unit, base] = handover.materials();
        let prototype = effective_young_modulus(&unit, if on_unit { &unit } else { &base });
        let scale = match model.law {
            ContactLawName::HertzMindlin => froude.blow(recorded, prototype),
            // These laws have a given stiffness that does not depend on the prototype's material.
            ContactLawName::Linear | ContactLawName::Chrono4 => {
                BlowScale { force: froude.mass(), time: froude.velocity() }
            }
        };
        let duration = hertz_duration(model, handover, event.approach_normal, on_unit, prototype);
        Self { model, handover, impact, froude, scale, duration }
    }

    /// Returns the recorded unit, and its partner if that is a unit.
    pub fn movers(&self) -> (Mover, Option<Mover>) {
        let event = &self.impact.event;
        (self.mover(&event.before), event.partner_before.as_ref().map(|before| self.mover(before)))
    }

    /// Scales the motion of a body to the prototype.
    fn mover(&self, before: &BodyState) -> Mover {
        let origin = DVec3::from_array(self.impact.event.point);
        let Froude { scale } = self.froude;
        let position = (before.position - origin) * self.froude.length();
        Mover {
            pose: Pose { rotation: before.rotation, position, scale },
            velocity: before.velocity * self.froude.velocity(),
            angular_velocity: before.angular_velocity * self.froude.angular_velocity(),
        }
    }

    /// Returns the mass of a unit in the prototype [kg].
    pub fn mass(&self) -> f64 {
        self.model.mass * self.froude.mass()
    }

    /// Returns the density that gives the tetrahedra of a unit its mass [kg/m3].
    pub fn density(&self) -> f64 {
        self.model.mass / self.handover.mesh.volume()
    }

    /// Returns the angular velocity that gives the nodes the angular momentum of the rigid unit [rad/s].
    pub fn angular_velocity(&self, mover: &Mover) -> DVec3 {
        self.handover.mesh.angular_velocity(self.model.gyration, mover.pose.rotation, mover.angular_velocity)
    }

    /// Compares mass, momentum and energy of the rigid body and of the nodes. Only the energy may differ a little.
    pub fn balance(&self, mover: &Mover) -> Balance {
        let mass = self.mass();
        let in_body = mover.pose.rotation.inverse() * mover.angular_velocity;
        let turning = in_body.dot(self.model.gyration * in_body) * self.froude.length().powi(2);
        let rigid = 0.5 * mass * (mover.velocity.length_squared() + turning);
        let of_nodes = self.density() * self.handover.mesh.volume() * self.froude.mass();
        let omega = self.angular_velocity(mover);
        Balance {
            mass_kg: [mass, of_nodes],
            momentum: [mass, of_nodes].map(|mass| (mover.velocity * mass).to_array()),
            kinetic_j: [rigid, self.handover.mesh.kinetic_energy(of_nodes, &mover.pose, mover.velocity, omega)],
        }
    }

    /// Returns the time that is simulated after first contact [s].
    pub fn time_after(&self) -> f64 {
        let unit = &self.handover.material;
        let celerity = (unit.young_modulus_pa / self.density()).sqrt();
        let waves = WAVES * self.model.shape.height() * self.froude.length() / celerity;
        self.handover.duration.unwrap_or((LASTS * self.duration).max(waves))
    }
}

/// Simulated time after first contact over the duration of the impact [-]; three feet share an impact and shorten it.
const LASTS: f64 = 1.5;

/// Simulated time after first contact over the travel time of a wave along the unit, at least [-].
const WAVES: f64 = 10.0;

/// Smallest speed of approach in Hertz's law, over sqrt(g H) [-]: a body that is set down has none.
const SLOWEST: f64 = 1e-3;

/// Duration of a Hertzian impact of elastic bodies at a speed v over overlap / v [-] (Johnson 1985, section 11.4).
const HERTZ: f64 = 2.943;

fn hertz_duration(model: &Model, handover: &Handover, approach: f64, on_unit: bool, modulus: f64) -> f64 {
    let froude = Froude { scale: handover.scale };
    let share = if on_unit { 0.5 } else { 1.0 };
    let speed = approach.max(SLOWEST * (model.gravity * model.shape.height()).sqrt()) * froude.velocity();
    let radius = share * model.shape.unit().rounding() * froude.length();
    HERTZ * impact_overlap(modulus, radius, share * model.mass * froude.mass(), speed) / speed
}

impl Handover {
    /// Returns the elastic constants of the prototype's units and of the bed.
    fn materials(&self) -> [Material; 2] {
        let unit = &self.material;
        let unit = [unit.young_modulus_pa, unit.poisson_ratio];
        let base = self.base.as_ref().map_or(unit, |base| [base.young_modulus_pa, base.poisson_ratio]);
        [unit, base].map(|[young_modulus, poisson_ratio]| Material { young_modulus, poisson_ratio, restitution: 1.0 })
    }
}
