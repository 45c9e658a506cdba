//! Contact search.
//!
//! | file | contents |
//! | --- | --- |
//! | `surfaces` | contact points of all bodies; the entry point of this module |
//! | `broad_phase` | pairs of bodies near each other |
//! | `nearest_points` | nearest points of two rounded parts |
//! | `polyhedron_contact` | contact points of two rounded polyhedra |
//! | `ground` | distance to the bed profile and to walls |
//! | `terrain_contact` | distance to a triangle surface |

mod broad_phase;
pub(super) mod ground;
mod nearest_points;
mod polyhedron_contact;
mod surfaces;
mod terrain_contact;

pub use surfaces::{PartPair, Placements, Surfaces};
