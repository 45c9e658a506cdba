//! Rigid armour units and their contact.
//!
//! Hertz-Mindlin contact with Coulomb friction (Sunday et al. 2020) between rounded convex parts, the ground (the bed
//! profile, the same across the flume) and walls.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `hertz_mindlin` | the contact law, a pure function |
//! | `gap` | distance of two rounded parts |
//! | `box_contact` | where two rounded boxes are near each other |
//! | `ground` | distance to the bed profile and to walls |
//! | `contact` | touching places of all bodies |
//! | `forces` | forces of all contacts, their history and energy |
//! | `event` | start, peak and end of each contact |
//! | `motion` | motion of a rigid body |
//! | `setup` | what a world is made of |
//! | `world` | substeps: the entry to this module |
//! | `snapshot` | state for checkpoints |

mod box_contact;
pub mod contact;
mod error;
pub mod event;
pub mod forces;
mod gap;
mod ground;
pub mod hertz_mindlin;
pub mod motion;
mod setup;
mod snapshot;
mod world;

pub use contact::Feature;
pub use error::RigidError;
pub use event::ContactEvent;
pub use forces::Energy;
pub use hertz_mindlin::Material;
pub use motion::{BodyState, Load};
pub use setup::{BodyShape, Friction, Ground, RigidSetup, Sides};
pub use snapshot::RigidSnapshot;
pub use world::RigidWorld;
