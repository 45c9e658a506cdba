//! Computes the velocity that a boundary particle has in the equations of the water under mDBC (wall slip). This
//! velocity follows from the water velocity at the ghost node and the velocity of the wall.

use glam::DVec3;

/// Velocity and damping of the water at a ghost node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GhostVelocity {
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Pressure of the acoustic damping [Pa].
    pub damping: f32,
}

/// Wall slip condition, which sets the velocity of a boundary particle in the equations of the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSlip {
    /// The boundary particle has the velocity of the wall (English et al. 2022).
    Original,
    /// No slip: the mean of the velocities of boundary particle and ghost node is the velocity of the wall.
    NoSlip,
    /// Free slip: the normal component is mirrored as for no slip, and the tangential component equals the tangential
    /// velocity at the ghost node.
    FreeSlip,
}

impl WallSlip {
    /// Returns the velocity of a boundary particle [m/s]. `wall` is the velocity of the wall [m/s], `ghost` the
    /// velocity of the water at the ghost node (`None` if dry), and `to_surface` the vector from the particle to the
    /// surface [m]. For a dry node, the function returns the velocity of the wall. If `free_slip` is false (see
    /// [`Boundary::allows_free_slip`]), `FreeSlip` uses the tangential velocity of the wall.
    ///
    /// Density and normal velocity come from the same interpolation, also in thin sheets of water. Then the work of the
    /// mirrored density on the water and the compression by the mirrored velocity nearly balance, and a fixed wall
    /// hardly changes the energy of the water.
    ///
    /// [`Boundary::allows_free_slip`]: crate::sph::particles::boundary::Boundary::allows_free_slip
    pub fn velocity(self, wall: DVec3, ghost: Option<GhostVelocity>, to_surface: DVec3, free_slip: bool) -> DVec3 {
        let Some(GhostVelocity { velocity, .. }) = ghost else { return wall };
        let relative = velocity - wall;
        match self {
            Self::Original => wall,
            Self::NoSlip => wall - relative,
            Self::FreeSlip => {
                let normal = to_surface.normalize_or_zero();
                let across = relative.dot(normal) * normal;
                let along = if free_slip { relative - across } else { DVec3::ZERO };
                wall + along - across
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_of_ghost_and_boundary_velocity_satisfies_the_slip_condition() {
        let (wall, ghost, up) = (DVec3::new(0.1, 0.0, 0.2), DVec3::new(1.0, 2.0, -3.0), DVec3::Z * 0.05);
        let at_node = Some(GhostVelocity { velocity: ghost, damping: 0.0 });
        let mean = |slip: WallSlip| 0.5 * (slip.velocity(wall, at_node, up, true) + ghost);
        assert!((mean(WallSlip::NoSlip) - wall).length() < 1e-15);
        assert!((mean(WallSlip::FreeSlip) - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, None, up, true), wall);
        // At an edge, the tangential velocity is the velocity of the wall, and the normal velocity is still mirrored.
        let at_edge = WallSlip::FreeSlip.velocity(wall, at_node, up, false);
        assert!((at_edge - DVec3::new(0.1, 0.0, 3.4)).length() < 1e-15);
    }
}
