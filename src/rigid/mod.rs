//! Rigid armour units and their contact.
//!
//! Contact with Coulomb friction, Hertz-Mindlin by default (Sunday et al. 2020), between rounded convex parts, the
//! ground (the bed profile, the same across the flume, and a triangle surface) and walls.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `contact_law` | the contact law, a pure function |
//! | `hertz_mindlin`, `linear` | its stiffness and damping |
//! | `broad_phase` | which bodies are near each other |
//! | `gap` | distance of two rounded parts |
//! | `polyhedron_contact` | where two rounded polyhedra are near each other |
//! | `ground` | distance to the bed profile and to walls |
//! | `terrain_contact` | distance to a triangle surface |
//! | `contact` | touching places of all bodies |
//! | `forces` | forces of all contacts, their history and energy |
//! | `event` | start, peak and end of each contact |
//! | `history` | the force of a contact against time |
//! | `record` | what is recorded of the contacts while they last |
//! | `impact_log` | the hardest impacts of each unit |
//! | `motion` | motion of a rigid body |
//! | `setup` | what a world is made of |
//! | `world` | substeps: the entry to this module |
//! | `growth` | bodies that join later |
//! | `snapshot` | state for checkpoints |

mod broad_phase;
pub mod contact;
pub mod contact_law;
mod error;
pub mod event;
pub mod forces;
mod gap;
mod ground;
mod growth;
pub mod hertz_mindlin;
pub mod history;
mod impact_log;
pub mod linear;
pub mod motion;
mod polyhedron_contact;
mod record;
mod setup;
mod snapshot;
mod terrain_contact;
mod world;

pub use contact::Feature;
pub use error::RigidError;
pub use event::ContactEvent;
pub use forces::Energy;
pub use hertz_mindlin::{Material, effective_young_modulus, impact_overlap};
pub use history::{ForceHistory, ForceSample};
pub use impact_log::RecordedContact;
pub use motion::{BodyState, Load};
pub use setup::{BodyShape, ContactModel, Friction, Ground, Resistance, RigidSetup, Sides};
pub use snapshot::RigidSnapshot;
pub use world::RigidWorld;
