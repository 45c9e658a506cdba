//! An impact in the prototype.

use glam::DVec3;

use super::froude::{BlowScale, Froude};
use super::model::Model;
use crate::case::{ContactLawName, Handover};
use crate::femdem::mesh::unit_mesh::Pose;
use crate::output::Impact;
use crate::rigid::{BodyState, Material, effective_young_modulus, impact_overlap};

/// An impact of the model with what it becomes in the prototype.
#[derive(Debug, Clone, Copy)]
pub struct Blow<'a> {
    /// The units of the run.
    pub model: &'a Model,
    /// What the case asks for.
    pub handover: &'a Handover,
    /// The impact as recorded.
    pub impact: &'a Impact,
    /// Lengths, velocities, masses.
    pub froude: Froude,
    /// Force and duration.
    pub scale: BlowScale,
    /// How long the prototype's blow lasts by Hertz's law [s].
    pub duration: f64,
}

/// A unit just before the impact, in the prototype; the origin is the place of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mover {
    /// Where it is.
    pub pose: Pose,
    /// Velocity of its centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
}

/// What a unit has on both sides of the hand-over: the rigid body at the scale of the prototype, and its nodes.
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
    /// An impact of a run.
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
            // Their stiffness is that of the model, whatever the prototype is made of.
            ContactLawName::Linear | ContactLawName::Chrono4 => {
                BlowScale { force: froude.mass(), time: froude.velocity() }
            }
        };
        let duration = hertz_duration(model, handover, event.approach_normal, on_unit, prototype);
        Self { model, handover, impact, froude, scale, duration }
    }

    /// The unit that was recorded, and its partner if that is a unit.
    pub fn movers(&self) -> (Mover, Option<Mover>) {
        let event = &self.impact.event;
        (self.mover(&event.before), event.partner_before.as_ref().map(|before| self.mover(before)))
    }

    /// A body of the model, in the prototype.
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

    /// Mass of a unit [kg].
    pub fn mass(&self) -> f64 {
        self.model.mass * self.froude.mass()
    }

    /// Density that gives its tetrahedra this mass [kg/m3].
    pub fn density(&self) -> f64 {
        self.model.mass / self.handover.mesh.volume()
    }

    /// Angular velocity of the nodes with the angular momentum of the rigid unit [rad/s].
    pub fn angular_velocity(&self, mover: &Mover) -> DVec3 {
        self.handover.mesh.angular_velocity(self.model.gyration, mover.pose.rotation, mover.angular_velocity)
    }

    /// What is the same on both sides, and what nearly is.
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

    /// How long the fracture computation goes on after the bodies touch [s].
    pub fn time_after(&self) -> f64 {
        let unit = &self.handover.material;
        let celerity = (unit.young_modulus_pa / self.density()).sqrt();
        let waves = WAVES * self.model.shape.height() * self.froude.length() / celerity;
        self.handover.duration.unwrap_or((LASTS * self.duration).max(waves))
    }
}

/// A run ends so many blows after the bodies touch [-]: three feet share a blow, and it is shorter then.
const LASTS: f64 = 1.5;

/// Times that a wave runs along the unit before a run ends [-].
const WAVES: f64 = 10.0;

/// Speed of approach taken at least, over sqrt(g H) [-]: a body set down has no blow.
const SLOWEST: f64 = 1e-3;

/// Duration of a Hertzian impact of elastic bodies at a speed v: 2.943 overlap / v (Johnson 1985, section 11.4).
const HERTZ: f64 = 2.943;

fn hertz_duration(model: &Model, handover: &Handover, approach: f64, on_unit: bool, modulus: f64) -> f64 {
    let froude = Froude { scale: handover.scale };
    let share = if on_unit { 0.5 } else { 1.0 };
    let speed = approach.max(SLOWEST * (model.gravity * model.shape.height()).sqrt()) * froude.velocity();
    let radius = share * model.shape.unit().rounding() * froude.length();
    HERTZ * impact_overlap(modulus, radius, share * model.mass * froude.mass(), speed) / speed
}

impl Handover {
    /// Elastic constants of the prototype's units and of what they fall on.
    fn materials(&self) -> [Material; 2] {
        let unit = &self.material;
        let unit = [unit.young_modulus_pa, unit.poisson_ratio];
        let base = self.base.as_ref().map_or(unit, |base| [base.young_modulus_pa, base.poisson_ratio]);
        [unit, base].map(|[young_modulus, poisson_ratio]| Material { young_modulus, poisson_ratio, restitution: 1.0 })
    }
}
