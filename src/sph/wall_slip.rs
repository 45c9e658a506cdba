//! Velocity that boundary particles show to the water under mDBC, from the velocity of the water at their ghost nodes.

use glam::DVec3;

use super::ghost_velocity::GhostVelocity;

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
    /// Velocity to be shown [m/s], from that of the wall [m/s], the water at the ghost node and the way to the surface
    /// [m]. A dry node leaves the velocity of the wall; where water is thin, nothing is mirrored, for a sheet that is
    /// met by what it does itself bounces. Where it does not slide ([`Boundary::slides`]) free slip keeps the wall's
    /// velocity along the surface.
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
    fn the_mean_of_ghost_and_particle_obeys_the_condition() {
        let (wall, ghost, up) = (DVec3::new(0.1, 0.0, 0.2), DVec3::new(1.0, 2.0, -3.0), DVec3::Z * 0.05);
        let of_water = |trust| Some(GhostVelocity { velocity: ghost, trust });
        let mean = |slip: WallSlip| 0.5 * (slip.velocity(wall, of_water(1.0), up, true) + ghost);
        assert!((mean(WallSlip::NoSlip) - wall).length() < 1e-15);
        assert!((mean(WallSlip::FreeSlip) - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, None, up, true), wall);
        // A thin sheet slides, and meets a wall that does not answer.
        let sliding = WallSlip::FreeSlip.velocity(wall, of_water(0.0), up, true);
        assert!((sliding - DVec3::new(1.0, 2.0, 0.2)).length() < 1e-15);
        assert_eq!(WallSlip::NoSlip.velocity(wall, of_water(0.0), up, true), wall);
        // At an edge the wall holds what goes along it, and still answers what comes.
        let at_edge = WallSlip::FreeSlip.velocity(wall, of_water(1.0), up, false);
        assert!((at_edge - DVec3::new(0.1, 0.0, 3.4)).length() < 1e-15);
    }
}
