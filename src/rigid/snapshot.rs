//! State of the rigid bodies for checkpoints. A restored run gives bit-identical results.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::error::RigidError;
use super::forces::Energy;
use super::motion::Load;
use super::record::{ContactRecords, EventLog, ImpactLog, RecordedContact, RunningRecord};
use super::world::RigidWorld;

/// State of all bodies and contacts. It includes angular momentum and current contact forces, because recomputed values
/// would differ in their last bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RigidSnapshot {
    time_s: f64,
    substeps: u64,
    frequency_squared: f64,
    bodies: Vec<BodySnapshot>,
    /// Active contacts with their records.
    contacts: Vec<(Contact, RecordedContact)>,
    energy: Energy,
    ended: EventLog,
    impacts: ImpactLog,
    begun: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct BodySnapshot {
    position: [f64; 3],
    /// Quaternion: x, y, z, w.
    rotation: [f64; 4],
    velocity: [f64; 3],
    angular_momentum: [f64; 3],
    is_still: bool,
    /// Current contact force and torque.
    contact_now: Load,
    /// Mean contact force and torque over the last call of `advance`.
    contact_mean: Load,
}

impl RigidWorld {
    /// Returns the state for a restart.
    pub fn snapshot(&self) -> RigidSnapshot {
        let body = |b: usize| BodySnapshot {
            position: self.position[b].to_array(),
            rotation: self.rotation[b].to_array(),
            velocity: self.velocity[b].to_array(),
            angular_momentum: self.angular_momentum[b].to_array(),
            is_still: self.is_still[b],
            contact_now: self.contact_now[b],
            contact_mean: self.contact_mean[b],
        };
        RigidSnapshot {
            time_s: self.time,
            substeps: self.substeps,
            frequency_squared: self.frequency_squared,
            bodies: (0..self.position.len()).map(body).collect(),
            contacts: self.contacts.iter().zip(&self.records.running).map(|(c, r)| (*c, r.record().clone())).collect(),
            energy: self.energy,
            ended: self.records.ended.clone(),
            impacts: self.records.impacts.clone(),
            begun: self.records.begun,
        }
    }

    /// Takes springs and forces of the contacts from another world with the same bodies at the same places. Bodies that
    /// are fixed in the other world keep their forces.
    pub fn adopt_contacts(&mut self, other: &Self) {
        for contact in &mut self.contacts {
            if let Some(same) = other.contacts.iter().find(|same| same.point.key == contact.point.key) {
                *contact = *same;
            }
        }
        for (body, kind) in other.kind.iter().enumerate() {
            if !other.inertias[*kind].is_fixed() {
                self.contact_now[body] = other.contact_now[body];
            }
        }
        self.energy.elastic = other.energy.elastic;
    }

    /// Restores the state from a snapshot of a world with the same setup.
    pub fn restore(&mut self, snapshot: &RigidSnapshot) -> Result<(), RigidError> {
        if snapshot.bodies.len() != self.position.len() {
            return Err(RigidError::Snapshot { snapshot: snapshot.bodies.len(), world: self.position.len() });
        }
        for (b, body) in snapshot.bodies.iter().enumerate() {
            self.position[b] = DVec3::from_array(body.position);
            self.rotation[b] = DQuat::from_array(body.rotation);
            self.velocity[b] = DVec3::from_array(body.velocity);
            self.angular_momentum[b] = DVec3::from_array(body.angular_momentum);
            self.is_still[b] = body.is_still;
            self.contact_now[b] = body.contact_now;
            self.contact_mean[b] = body.contact_mean;
        }
        self.contacts = snapshot.contacts.iter().map(|(contact, _)| *contact).collect();
        self.time = snapshot.time_s;
        self.substeps = snapshot.substeps;
        self.frequency_squared = snapshot.frequency_squared;
        self.energy = snapshot.energy;
        self.records = ContactRecords {
            running: snapshot.contacts.iter().map(|(_, record)| RunningRecord::new(record.clone())).collect(),
            ended: snapshot.ended.clone(),
            impacts: snapshot.impacts.clone(),
            begun: snapshot.begun,
        };
        self.search.forget();
        self.update_results();
        Ok(())
    }
}
