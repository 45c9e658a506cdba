//! Rigid armour units and their contact.
//!
//! Rounded convex parts touch each other, the ground (bed profile and triangle surface) and walls. The contact law
//! includes Coulomb friction; the default is Hertz-Mindlin (Sunday et al. 2020).
//!
//! | file | contents |
//! | --- | --- |
//! | `contact_law` | the contact law of a pair of surfaces, a pure function |
//! | `hertz_mindlin`, `linear` | stiffness and damping of the contact laws |
//! | `broad_phase` | pairs of bodies near each other |
//! | `gap` | distance between two rounded parts |
//! | `polyhedron_contact` | contact points of two rounded polyhedra |
//! | `ground` | distance to the bed profile and to walls |
//! | `terrain_contact` | distance to a triangle surface |
//! | `contact` | contact points of all bodies |
//! | `forces` | contact forces, contact history and energy balance |
//! | `event` | start, peak and end of each contact |
//! | `history` | contact force against time |
//! | `record` | records of active contacts |
//! | `impact_log` | the hardest impacts of each unit |
//! | `motion` | motion of a rigid body |
//! | `setup` | input of a rigid world |
//! | `world` | time stepping by substeps; the entry point of this module |
//! | `growth` | adding bodies during a run |
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
