//! Rigid bodies of tetrahedra.
//!
//! | file | contents |
//! | --- | --- |
//! | `body` | mass, motion and forces of a rigid body |
//! | `constraint` | impulse that gives points of a body their prescribed velocities |
//! | `principal_axes` | principal axes of a symmetric matrix |

pub mod body;
mod constraint;
mod principal_axes;
