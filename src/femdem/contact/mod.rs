//! Contact between deformable linear tetrahedra.
//!
//! | file | contents |
//! | --- | --- |
//! | `detection` | contact detection: pairs of intersecting boxes |
//! | `tetrahedron` | shape functions of a tetrahedron |
//! | `polygon` | convex polygons: clipping and integrals |
//! | `overlap` | contact potential: overlap energy of a pair and its gradient |
//! | `friction` | tangential spring of a pair |
//! | `pairs` | all contacts of a world: the entry to this module |

pub mod detection;
pub mod friction;
pub mod overlap;
#[cfg(test)]
mod overlap_tests;
pub mod pairs;
pub mod polygon;
#[cfg(test)]
mod samples;
pub mod tetrahedron;
