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
    /// The boundary particle has the velocity of the wall, and no viscosity acts between water and walls. The
    /// compression of the water by the walls is then the rate at which the particles really move closer together.
    Inviscid,
}

/// Components of the water velocity at its ghost node that a boundary particle mirrors.
///
/// Mirrored velocities of an isolated body, or along a flank, make still water circulate and shrink; docs/methods.md
/// gives the reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mirroring {
    /// All components: beds flatter than 1:4, and walls within 14 degrees of the vertical.
    Full,
    /// Under free slip only the normal component; the tangential velocity is the velocity of the wall. For steeper beds,
    /// the kernel support of convex edges of the bed and, by default, units that are not cuboids.
    Normal,
    /// None; the velocity is the velocity of the wall. For obstacles and cuboids.
    None,
}

impl WallSlip {
    /// Returns the velocity of a boundary particle [m/s]. `wall` is the velocity of the wall [m/s], `ghost` the
    /// velocity of the water at the ghost node (`None` if dry), and `to_surface` the vector from the particle to the
    /// surface [m]. For a dry node, the function returns the velocity of the wall.
    ///
    /// Density and normal velocity come from the same interpolation, also in thin sheets of water. Then the work of the
    /// mirrored density on the water and the compression by the mirrored velocity nearly balance, and a fixed wall
    /// hardly changes the energy of the water.
    pub fn velocity(self, wall: DVec3, ghost: Option<GhostVelocity>, to_surface: DVec3, mirroring: Mirroring) -> DVec3 {
        let Some(GhostVelocity { velocity, .. }) = ghost else { return wall };
        let relative = velocity - wall;
        let across = || {
            let normal = to_surface.normalize_or_zero();
            relative.dot(normal) * normal
        };
        match (self, mirroring) {
            (Self::Original | Self::Inviscid, _) | (_, Mirroring::None) => wall,
            (Self::NoSlip, _) => wall - relative,
            (Self::FreeSlip, Mirroring::Full) => wall + relative - 2.0 * across(),
            (Self::FreeSlip, Mirroring::Normal) => wall - across(),
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
        let mean = |slip: WallSlip| 0.5 * (slip.velocity(wall, at_node, up, Mirroring::Full) + ghost);
        assert!((mean(WallSlip::NoSlip) - wall).length() < 1e-15);
        assert!((mean(WallSlip::FreeSlip) - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, None, up, Mirroring::Full), wall);
        let normal_only = WallSlip::FreeSlip.velocity(wall, at_node, up, Mirroring::Normal);
        assert!((normal_only - DVec3::new(0.1, 0.0, 3.4)).length() < 1e-15);
        assert_eq!(WallSlip::FreeSlip.velocity(wall, at_node, up, Mirroring::None), wall);
    }
}
