//! Wall slip under mDBC: velocity of boundary particles in the water's equations, from the velocity at ghost nodes.

use glam::DVec3;

use super::ghost_velocity::GhostVelocity;

/// Wall slip condition: which velocity a boundary particle has in the equations of the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSlip {
    /// The velocity of the wall (English et al. 2022).
    Original,
    /// No slip: the water's velocity mirrored about the wall's velocity.
    NoSlip,
    /// Free slip: the normal component is mirrored, the tangential component equals that of the water.
    FreeSlip,
}

impl WallSlip {
    /// Returns the velocity [m/s] from the wall's velocity [m/s], the water at the ghost node and the vector to the
    /// surface [m]. A dry node gives the wall's velocity. In thin sheets nothing is mirrored, because a sheet would
    /// bounce off its own mirrored velocity. Where free slip is not allowed ([`Boundary::slides`]), `FreeSlip` keeps
    /// the wall's tangential velocity.
    ///
    /// [`Boundary::slides`]: crate::sph::particles::boundary::Boundary::slides
    pub fn velocity(self, wall: DVec3, ghost: Option<GhostVelocity>, to_surface: DVec3, slides: bool) -> DVec3 {
        let Some(GhostVelocity { velocity, trust }) = ghost else { return wall };
        let relative = velocity - wall;
        match self {
            Self::Original => wall,
            Self::NoSlip => wall - trust * relative,
            Self::FreeSlip => {
                let normal = to_surface.normalize_or_zero();
                let across = relative.dot(normal) * normal;
                let along = if slides { relative - across } else { DVec3::ZERO };
                wall + along - trust * across
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
        let ghost_with = |trust| Some(GhostVelocity { velocity: ghost, trust });
        let mean = |slip: WallSlip| 0.5 * (slip.velocity(wall, ghost_with(1.0), up, true) + ghost);
        assert!((mean(WallSlip::NoSlip) - wall).length() < 1e-15);
        assert!((mean(WallSlip::FreeSlip) - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, None, up, true), wall);
        // A thin sheet has free slip, and the wall mirrors no normal velocity.
        let sliding = WallSlip::FreeSlip.velocity(wall, ghost_with(0.0), up, true);
        assert!((sliding - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, ghost_with(0.0), up, true), wall);
        // At an edge the tangential velocity is the wall's, and the normal velocity is still mirrored.
        let at_edge = WallSlip::FreeSlip.velocity(wall, ghost_with(1.0), up, false);
        assert!((at_edge - DVec3::new(0.1, 0.0, 3.4)).length() < 1e-15);
    }
}
