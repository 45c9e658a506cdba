//! Boxes of boundary particles: fixed obstacles and cuboid units.
//!
//! The particles form a lattice of spacing about dp that divides each edge of the box evenly. The outermost particles
//! lie half a spacing behind the faces, as in bed and walls. If two or three faces are equally near, the surface vector
//! of a particle points to their common edge or corner. Its ghost node then lies diagonally beyond this edge or corner
//! (English et al. 2022).

use glam::DVec3;

use super::boundary::BoundaryParticle;
use crate::{geometry::axis_box::AxisBox, sph::terms::wall_slip::Mirroring};

/// Returns the boundary particles of a box. They are about `dp` [m] apart and less than `thickness` [m] behind an open
/// face, which is a face that water can reach.
pub fn box_particles(bounds: &AxisBox, dp: f64, thickness: f64) -> Vec<BoundaryParticle> {
    let count = (bounds.edges() / dp).round().max(DVec3::ONE);
    let spacing = bounds.edges() / count;
    let volume = spacing.element_product();
    let mut particles = Vec::new();
    for i in 0..count.x as u32 {
        for j in 0..count.y as u32 {
            for k in 0..count.z as u32 {
                let lattice = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 0.5;
                let position = bounds.low + lattice * spacing;
                if bounds.depth(position) < thickness {
                    let to_surface = bounds.vector_to_surface(position);
                    particles.push(BoundaryParticle { position, to_surface, volume, mirroring: Mirroring::None });
                }
            }
        }
    }
    particles
}

/// Changes the surface vectors of the bed and wall particles that an obstacle covers. The new vectors point to the foot
/// of the obstacle, because the nearest wetted surface is there.
pub fn cover(particles: &mut [BoundaryParticle], obstacle: &AxisBox) {
    for particle in particles {
        let surface = particle.position + particle.to_surface;
        if obstacle.contains(surface) {
            particle.to_surface += obstacle.vector_to_surface(surface);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_boxes_are_filled_and_thick_boxes_are_hollow() {
        let thin = AxisBox::free(DVec3::ZERO, DVec3::new(0.15, 0.15, 0.1));
        let particles = box_particles(&thin, 0.02, 0.06);
        // An edge of 0.15 m has 8 particles, because 0.15 / 0.02 = 7.5 is rounded to 8.
        assert_eq!(particles.len(), 8 * 8 * 5);
        let total: f64 = particles.iter().map(|p| p.volume).sum();
        assert!((total / thin.volume() - 1.0).abs() < 1e-12);
        let thick = AxisBox::free(DVec3::ZERO, DVec3::splat(0.2));
        assert_eq!(box_particles(&thick, 0.02, 0.06).len(), 1000 - 64);
    }

    #[test]
    fn surface_vector_of_every_particle_ends_on_an_open_face() {
        let open = [[true; 2], [true; 2], [false, true]];
        let on_bed = AxisBox { low: DVec3::ZERO, high: DVec3::splat(0.2), open };
        for particle in box_particles(&on_bed, 0.02, 0.06) {
            let surface = particle.position + particle.to_surface;
            assert!(on_bed.locate(surface).1.abs() < 1e-12 && surface.z > 0.009);
        }
    }

    #[test]
    fn surface_vectors_of_covered_bed_particles_lead_to_the_foot_of_the_obstacle() {
        let open = [[true; 2], [true; 2], [false, true]];
        let obstacle = AxisBox { low: DVec3::ZERO, high: DVec3::splat(0.2), open };
        let below = |x: f64| BoundaryParticle {
            position: DVec3::new(x, 0.1, -0.01),
            to_surface: DVec3::Z * 0.01,
            volume: 8e-6,
            mirroring: Mirroring::Full,
        };
        let mut bed = [below(-0.01), below(0.03)];
        cover(&mut bed, &obstacle);
        assert_eq!(bed[0], below(-0.01));
        assert!((bed[1].position + bed[1].to_surface - DVec3::new(0.0, 0.1, 0.0)).length() < 1e-15);
    }
}
