//! State of the rigid bodies for checkpoints. A restored world continues bit-identically.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::ContactKey;
use super::error::RigidError;
use super::event::EventLog;
use super::forces::{Contact, Energy};
use super::impact_log::{ImpactLog, RecordedContact};
use super::motion::Load;
use super::record::ContactBook;
use super::world::{RigidWorld, UNSEEN};

/// State of all bodies and contacts. Angular momentum and current contact forces are stored, because recomputing them
/// would change their last bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RigidSnapshot {
    time_s: f64,
    substeps: u64,
    frequency_squared: f64,
    bodies: Vec<BodySnapshot>,
    contacts: Vec<ContactSnapshot>,
    energy: Energy,
    ended: EventLog,
    impacts: ImpactLog,
    begun: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct BodySnapshot {
    position: [f64; 3],
    /// x, y, z, w.
    rotation: [f64; 4],
    velocity: [f64; 3],
    angular_momentum: [f64; 3],
    /// Force and torque of the contacts now, and their mean over the last `advance`.
    contact_now: [[f64; 3]; 2],
    contact_mean: [[f64; 3]; 2],
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct ContactSnapshot {
    key: ContactKey,
    normal: [f64; 3],
    spring: [f64; 3],
    roll: [f64; 3],
    overlap: f64,
    sunk: f64,
    core: [f64; 3],
    force: [f64; 3],
    dashpot: f64,
    elastic: [f64; 3],
    record: RecordedContact,
}

fn to_arrays(load: &Load) -> [[f64; 3]; 2] {
    [load.force.to_array(), load.torque.to_array()]
}

fn from_arrays([force, torque]: [[f64; 3]; 2]) -> Load {
    Load { force: DVec3::from_array(force), torque: DVec3::from_array(torque) }
}

impl RigidWorld {
    /// Returns the state for a restart.
    pub fn snapshot(&self) -> RigidSnapshot {
        let body = |b: usize| BodySnapshot {
            position: self.position[b].to_array(),
            rotation: self.rotation[b].to_array(),
            velocity: self.velocity[b].to_array(),
            angular_momentum: self.angular_momentum[b].to_array(),
            contact_now: to_arrays(&self.contact_now[b]),
            contact_mean: to_arrays(&self.contact_mean[b]),
        };
        let contact = |(c, record): (&Contact, &RecordedContact)| ContactSnapshot {
            key: c.key,
            normal: c.normal.to_array(),
            spring: c.spring.to_array(),
            roll: c.roll.to_array(),
            core: c.core.to_array(),
            force: c.force.to_array(),
            dashpot: c.dashpot,
            overlap: c.overlap,
            sunk: c.sunk,
            elastic: c.elastic,
            record: record.clone(),
        };
        RigidSnapshot {
            time_s: self.time,
            substeps: self.substeps,
            frequency_squared: self.frequency_squared,
            bodies: (0..self.position.len()).map(body).collect(),
            contacts: self.contacts.iter().zip(self.book.running.iter().map(Box::as_ref)).map(contact).collect(),
            energy: self.energy,
            ended: self.book.ended.clone(),
            impacts: self.book.impacts.clone(),
            begun: self.book.begun,
        }
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
            self.contact_now[b] = from_arrays(body.contact_now);
            self.contact_mean[b] = from_arrays(body.contact_mean);
        }
        let contact = |c: &ContactSnapshot| Contact {
            key: c.key,
            normal: DVec3::from_array(c.normal),
            spring: DVec3::from_array(c.spring),
            roll: DVec3::from_array(c.roll),
            core: DVec3::from_array(c.core),
            force: DVec3::from_array(c.force),
            dashpot: c.dashpot,
            overlap: c.overlap,
            sunk: c.sunk,
            elastic: c.elastic,
        };
        self.contacts = snapshot.contacts.iter().map(contact).collect();
        self.time = snapshot.time_s;
        self.substeps = snapshot.substeps;
        self.frequency_squared = snapshot.frequency_squared;
        self.energy = snapshot.energy;
        self.book = ContactBook {
            running: snapshot.contacts.iter().map(|contact| Box::new(contact.record.clone())).collect(),
            ended: snapshot.ended.clone(),
            impacts: snapshot.impacts.clone(),
            begun: snapshot.begun,
        };
        self.seen = UNSEEN;
        self.publish();
        Ok(())
    }
}
