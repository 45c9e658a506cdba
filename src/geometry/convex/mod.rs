//! Convex bodies: polyhedra, their union as a closed surface, and the rounded parts for contact.

pub mod convex_part;
pub mod half_space;
pub mod polyhedron;
pub mod union;
