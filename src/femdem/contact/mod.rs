//! Contact between deformable linear tetrahedra.
//!
//! | file | concept |
//! | --- | --- |
//! | `detection` | which pairs of boxes meet |
//! | `tetrahedron` | shape functions of a tetrahedron |
//! | `polygon` | a convex polygon: cut by a plane, integrals |
//! | `overlap` | energy of a pair and its gradient |
//! | `friction` | tangential spring of a pair |
//! | `pairs` | the contacts of a world: the entry |

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
