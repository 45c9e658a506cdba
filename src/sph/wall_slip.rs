//! Velocity that boundary particles show to the water under mDBC, from the velocity of the water at their ghost nodes.

use glam::DVec3;

/// Which velocity a boundary particle shows to the water.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallSlip {
    /// That of the wall (English et al. 2022).
    Original,
    /// Mirrored about that of the wall: the water sticks.
    NoSlip,
    /// Its part along the normal mirrored, the other as in the water: the water slides.
    FreeSlip,
}

impl WallSlip {
    /// Velocity to be shown [m/s], from that of the wall and of the water at the ghost node [m/s] and the way to the
    /// surface [m]. A dry node leaves the velocity of the wall.
    pub fn velocity(self, wall: DVec3, ghost: Option<DVec3>, to_surface: DVec3) -> DVec3 {
        let Some(ghost) = ghost else { return wall };
        match self {
            Self::Original => wall,
            Self::NoSlip => 2.0 * wall - ghost,
            Self::FreeSlip => {
                let normal = to_surface.normalize_or_zero();
                ghost - 2.0 * (ghost - wall).dot(normal) * normal
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_ghost_and_particle_obeys_the_condition() {
        let (wall, ghost, up) = (DVec3::new(0.1, 0.0, 0.2), DVec3::new(1.0, 2.0, -3.0), DVec3::Z * 0.05);
        let mean = |slip: WallSlip| 0.5 * (slip.velocity(wall, Some(ghost), up) + ghost);
        assert!((mean(WallSlip::NoSlip) - wall).length() < 1e-15);
        assert!((mean(WallSlip::FreeSlip) - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, None, up), wall);
    }
}
