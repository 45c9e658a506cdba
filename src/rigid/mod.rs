//! Rigid armour units and their contact.
//!
//! A unit is a set of rounded convex parts, which touch other units, the ground (bed profile and triangle surface) and
//! walls. The contact law includes Coulomb friction; the default is Hertz-Mindlin (Sunday et al. 2020).
//!
//! | part | contents |
//! | --- | --- |
//! | `setup` | input: shape and positions of the bodies, ground, walls, materials |
//! | `world` | time stepping by substeps; the entry point of this module |
//! | `motion` | rotation of a free rigid body |
//! | `rest` | bodies at rest |
//! | `search` | contact points of all bodies |
//! | `contact` | data of a contact: identity, contact point, history |
//! | `law` | contact laws |
//! | `forces` | contact forces and energy balance |
//! | `kinematics` | relative motion of two bodies at a contact point |
//! | `record` | records of all contacts and of the hardest impacts |
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
mod rest;
mod search;
mod setup;
mod snapshot;
mod world;

pub use contact::Feature;
pub use error::RigidError;
pub use forces::Energy;
pub use law::{ContactModel, Material, Resistance, effective_young_modulus, impact_overlap};
pub use motion::{BodyState, Load, REST_BOUND};
pub use record::{ContactEvent, ForceHistory, ForceSample, RecordedContact};
pub use setup::{Body, BodyKind, BodyShape, Cover, Ground, MaterialPair, RigidSetup, Sides, TriangleSurface};
pub use snapshot::RigidSnapshot;
pub use world::{RigidWorld, STEPS_PER_PERIOD};
