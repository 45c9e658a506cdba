//! An impact at prototype scale: motion before the impact, scale factors, and duration.

use glam::DVec3;

use super::froude::{Froude, ImpactScale};
use super::model::Model;
use crate::case::{BreakageSettings, ContactLawName};
use crate::femdem::mesh::unit_mesh::Pose;
use crate::output::Impact;
use crate::rigid::{BodyState, Material, effective_young_modulus, impact_overlap};

/// A recorded impact, with the factors that scale it to the prototype.
#[derive(Debug, Clone, Copy)]
pub struct ScaledImpact<'a> {
    /// Properties of the units of the run.
    pub model: &'a Model,
    /// Settings of the breakage analysis.
    pub settings: &'a BreakageSettings,
    /// The recorded impact.
    pub impact: &'a Impact,
    /// Scale factors of lengths, velocities and masses.
    pub froude: Froude,
    /// Scale factors of the force and the duration of the impact: by Hertz's law for the contact law Hertz-Mindlin, by
    /// Froude's law for the other contact laws.
    pub scale: ImpactScale,
    /// Duration of the impact in the prototype by Hertz's law [s].
    pub duration: f64,
}

/// Motion of a unit just before the impact, at prototype scale; the origin is the contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitMotion {
    /// Pose of the unit.
    pub pose: Pose,
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
}

/// Mass, momentum and energy of a unit at prototype scale. Each field has two values: rigid body, then mesh.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Balance {
    /// Mass [kg].
    pub mass_kg: [f64; 2],
    /// Momentum [kg m/s].
    pub momentum: [[f64; 3]; 2],
    /// Kinetic energy [J].
    pub kinetic_j: [f64; 2],
}

impl<'a> ScaledImpact<'a> {
    /// Scales an impact of a run to the prototype.
    pub fn new(model: &'a Model, settings: &'a BreakageSettings, impact: &'a Impact) -> Self {
        let froude = Froude { scale: settings.scale };
        let event = &impact.event;
        let on_unit = event.partner_unit().is_some();
        let recorded = effective_young_modulus(&model.material, model.partner(event));
        let [unit, base] = settings.materials();
        let prototype = effective_young_modulus(&unit, if on_unit { &unit } else { &base });
        let scale = match model.law {
            ContactLawName::HertzMindlin => froude.blow(recorded, prototype),
            // The recorded forces of these two contact laws are not Hertz forces: `linear` has a constant stiffness,
            // `chrono4` has a fixed contact radius. Therefore Froude's law scales them.
            ContactLawName::Linear | ContactLawName::Chrono4 => {
                ImpactScale { force: froude.mass(), time: froude.velocity() }
            }
        };
        let duration = hertz_duration(model, settings, event.approach_normal, on_unit, prototype);
        Self { model, settings, impact, froude, scale, duration }
    }

    /// Returns the motion of the recorded unit, and of its partner if the partner is a unit.
    pub fn movers(&self) -> (UnitMotion, Option<UnitMotion>) {
        let event = &self.impact.event;
        (self.mover(&event.before), event.partner_before.as_ref().map(|before| self.mover(before)))
    }

    /// Scales the motion of a unit just before the impact to the prototype.
    fn mover(&self, before: &BodyState) -> UnitMotion {
        let origin = DVec3::from_array(self.impact.event.point);
        let Froude { scale } = self.froude;
        let position = (before.position - origin) * self.froude.length();
        UnitMotion {
            pose: Pose { rotation: before.rotation, position, scale },
            velocity: before.velocity * self.froude.velocity(),
            angular_velocity: before.angular_velocity * self.froude.angular_velocity(),
        }
    }

    /// Returns the mass of a unit in the prototype [kg].
    pub fn mass(&self) -> f64 {
        self.model.mass * self.froude.mass()
    }

    /// Returns the density for which the mesh of the unit has the mass of the unit [kg/m3].
    pub fn density(&self) -> f64 {
        self.model.mass / self.settings.mesh.volume()
    }

    /// Returns the angular velocity for which the mesh has the angular momentum of the rigid unit [rad/s].
    pub fn angular_velocity(&self, mover: &UnitMotion) -> DVec3 {
        self.settings.mesh.angular_velocity(self.model.gyration, mover.pose.rotation, mover.angular_velocity)
    }

    /// Returns mass, momentum and kinetic energy of the rigid body and of the mesh. Mass and momentum are equal; the
    /// kinetic energies can differ slightly.
    pub fn balance(&self, mover: &UnitMotion) -> Balance {
        let mass = self.mass();
        let in_body = mover.pose.rotation.inverse() * mover.angular_velocity;
        let turning = in_body.dot(self.model.gyration * in_body) * self.froude.length().powi(2);
        let rigid = 0.5 * mass * (mover.velocity.length_squared() + turning);
        let of_nodes = self.density() * self.settings.mesh.volume() * self.froude.mass();
        let omega = self.angular_velocity(mover);
        Balance {
            mass_kg: [mass, of_nodes],
            momentum: [mass, of_nodes].map(|mass| (mover.velocity * mass).to_array()),
            kinetic_j: [rigid, self.settings.mesh.kinetic_energy(of_nodes, &mover.pose, mover.velocity, omega)],
        }
    }

    /// Returns the simulated time after first contact [s].
    pub fn time_after(&self) -> f64 {
        let unit = &self.settings.material;
        let celerity = (unit.young_modulus_pa / self.density()).sqrt();
        let waves = WAVE_TRAVELS_AFTER_CONTACT * self.model.shape.height() * self.froude.length() / celerity;
        self.settings.duration.unwrap_or((DURATIONS_AFTER_CONTACT * self.duration).max(waves))
    }
}

/// Simulated time after first contact, divided by the duration of an impact on one foot [-]. An impact on three feet
/// has a shorter duration.
const DURATIONS_AFTER_CONTACT: f64 = 1.5;

/// Smallest simulated time after first contact, divided by the time in which an elastic wave crosses the unit [-].
const WAVE_TRAVELS_AFTER_CONTACT: f64 = 10.0;

/// Lower limit of the approach speed in Hertz's law, divided by sqrt(g H) with the height H of a unit [-]. At zero
/// speed, the duration would be infinite.
const MIN_APPROACH_SPEED: f64 = 1e-3;

/// Duration of an elastic impact by Hertz's law, divided by (largest overlap / approach speed) [-] (Johnson 1985,
/// section 11.4).
const HERTZ_DURATION_FACTOR: f64 = 2.943;

fn hertz_duration(model: &Model, settings: &BreakageSettings, approach: f64, on_unit: bool, modulus: f64) -> f64 {
    let froude = Froude { scale: settings.scale };
    let share = if on_unit { 0.5 } else { 1.0 };
    let speed = approach.max(MIN_APPROACH_SPEED * (model.gravity * model.shape.height()).sqrt()) * froude.velocity();
    let radius = share * model.shape.unit().rounding() * froude.length();
    HERTZ_DURATION_FACTOR * impact_overlap(modulus, radius, share * model.mass * froude.mass(), speed) / speed
}

impl BreakageSettings {
    /// Returns the elastic constants of the units and of the bed in the prototype.
    fn materials(&self) -> [Material; 2] {
        let unit = &self.material;
        let unit = [unit.young_modulus_pa, unit.poisson_ratio];
        let base = self.base.as_ref().map_or(unit, |base| [base.young_modulus_pa, base.poisson_ratio]);
        [unit, base].map(|[young_modulus, poisson_ratio]| Material { young_modulus, poisson_ratio, restitution: 1.0 })
    }
}
