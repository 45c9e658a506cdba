//! Contact search.
//!
//! | file | contents |
//! | --- | --- |
//! | `contact_search` | contact points of all bodies; the entry point of this module |
//! | `part_pair` | pairs of parts near each other |
//! | `surfaces` | contact points of two parts, or of a body with ground and walls |
//! | `broad_phase` | pairs of bodies near each other |
//! | `nearest_points` | nearest points of two rounded parts |
//! | `polyhedron_contact` | contact points of two rounded polyhedra |
//! | `ground` | distance to the bed profile and to walls |
//! | `terrain_contact` | distance to a triangle surface |

mod broad_phase;
mod contact_search;
pub(super) mod ground;
mod nearest_points;
mod part_pair;
mod polyhedron_contact;
mod surfaces;
mod terrain_contact;

pub use contact_search::ContactSearch;
pub use surfaces::Surfaces;
