//! Rigid armour units and their contact.
//!
//! Rounded convex parts touch each other, the ground (bed profile and triangle surface) and walls. The contact law
//! includes Coulomb friction; the default is Hertz-Mindlin (Sunday et al. 2020).
//!
//! | part | contents |
//! | --- | --- |
//! | `setup` | input of a rigid world |
//! | `world` | time stepping by substeps; the entry point of this module |
//! | `motion` | motion of a rigid body |
//! | `search` | contact points of all bodies |
//! | `contact` | the data of a contact |
//! | `law` | contact laws |
//! | `forces` | contact forces and energy balance |
//! | `kinematics` | relative motion of the two sides of a contact |
//! | `record` | records of contacts and the hardest impacts |
//! | `add_body` | adding bodies during a run |
//! | `snapshot` | state for checkpoints |

mod add_body;
mod contact;
mod error;
mod forces;
mod kinematics;
mod law;
mod motion;
mod record;
mod search;
mod setup;
mod snapshot;
mod world;

pub use contact::Feature;
pub use error::RigidError;
pub use forces::Energy;
pub use law::{ContactModel, Material, Resistance, effective_young_modulus, impact_overlap};
pub use motion::{BodyState, Load};
pub use record::{ContactEvent, ForceHistory, ForceSample, RecordedContact};
pub use setup::{BodyShape, Friction, Ground, RigidSetup, Sides};
pub use snapshot::RigidSnapshot;
pub use world::RigidWorld;
