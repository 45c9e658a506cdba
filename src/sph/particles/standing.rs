//! Surface vectors at fixed bodies that stand on the bed, lean against a wall, or reach into them.
//!
//! Below such a body, the ghost nodes of bed particles would lie in the body, and those of its lowest particles in the
//! bed. Without water around their nodes, both would have the reference density, and water would creep below the body.
//! Therefore all these particles get vectors to the nearest point of the body that water can reach, which is at its foot
//! or above it. See [`cover`](super::obstacle::cover) for boxes.

use glam::DVec3;

use super::boundary::BoundaryParticle;
use crate::geometry::open_space::{OpenSpace, OpenSurface};

/// Widest gap between the bed and a body that touches it, divided by dp [-].
pub const TOUCHING: f64 = 0.1;

/// Changes the surface vectors of the bed and wall particles whose surface points lie in a body or touch it.
/// `distance` returns the distance of a point from the body [m], negative inside; `surface` is the surface of the body
/// that water can reach.
pub fn cover_below(walls: &mut [BoundaryParticle], surface: &OpenSurface, dp: f64, distance: impl Fn(DVec3) -> f64) {
    for particle in walls {
        if distance(particle.position + particle.to_surface) <= TOUCHING * dp {
            particle.to_surface = surface.nearest(particle.position) - particle.position;
        }
    }
}

/// Changes the surface vectors of the particles of a body whose surface points lie in the bed or behind a wall.
pub fn cover_body(body: &mut [BoundaryParticle], surface: &OpenSurface, space: &OpenSpace) {
    for particle in body {
        if !space.contains(particle.position + particle.to_surface) {
            particle.to_surface = surface.nearest(particle.position) - particle.position;
        }
    }
}
