//! Fills an armour unit with boundary particles.

use glam::DVec3;

use super::boundary::BoundaryParticle;
use crate::sph::terms::wall_slip::Mirroring;

/// Smallest depth of a boundary particle below the surface of the unit, as a share of dp. Shallower particles are moved
/// inwards to this depth, so that no water particle touches them.
pub const MIN_DEPTH: f64 = 0.35;

/// Number of lattice offsets that [`unit_particles`] tries along each axis.
const OFFSETS: u32 = 4;

/// Number of particles of a solid above which [`unit_particles`] tries one lattice only: the count of so many particles
/// depends little on the offset.
const MANY: f64 = 1e5;

/// Returns boundary particles that fill a solid on a cubic lattice with spacing `dp` [m], in the axes of the solid.
///
/// `locate` returns the surface point nearest to a given point and the distance between them [m], negative inside the
/// solid. `low` and `high` are the corners of a box around the solid [m]. The function tries 64 lattice offsets, for a
/// large solid only one, and uses the offset whose particle count is nearest to `volume` / dp^3. Each particle has an
/// equal share of `volume` [m3].
pub fn unit_particles(
    locate: impl Fn(DVec3) -> (DVec3, f64),
    low: DVec3,
    high: DVec3,
    volume: f64,
    dp: f64,
) -> Vec<BoundaryParticle> {
    let wanted = volume / dp.powi(3);
    let tries = if wanted > MANY { 1 } else { OFFSETS.pow(3) };
    let origins = (0..tries).map(|n| {
        let offset = |divisor: u32| f64::from(n / divisor % OFFSETS) / f64::from(OFFSETS);
        low + dp * (DVec3::new(offset(1), offset(OFFSETS), offset(OFFSETS * OFFSETS)) - 1.0)
    });
    let fillings = origins.map(|origin| points_inside(&locate, origin, high, dp));
    let count_error = |points: &Vec<DVec3>| (points.len() as f64 - wanted).abs();
    let points = fillings.min_by(|a, b| count_error(a).total_cmp(&count_error(b))).unwrap_or_default();
    let share = volume / points.len().max(1) as f64;
    let to_particle = |point: DVec3| {
        let (nearest, distance) = locate(point);
        let depth = -distance;
        let position = if depth < MIN_DEPTH * dp && depth > 1e-9 * dp {
            nearest + (point - nearest) * (MIN_DEPTH * dp / depth)
        } else {
            point
        };
        BoundaryParticle {
            position,
            to_surface: locate(position).0 - position,
            volume: share,
            mirroring: Mirroring::Normal,
        }
    };
    points.into_iter().map(to_particle).collect()
}

/// Returns the points of a cubic lattice that lie inside the solid. The lattice has the spacing `dp` [m] and extends
/// from `origin` to `high` [m].
fn points_inside(locate: &impl Fn(DVec3) -> (DVec3, f64), origin: DVec3, high: DVec3, dp: f64) -> Vec<DVec3> {
    let count = ((high - origin) / dp).ceil();
    let mut points = Vec::new();
    for i in 0..count.x as u32 + 1 {
        for j in 0..count.y as u32 + 1 {
            for k in 0..count.z as u32 + 1 {
                let point = origin + dp * DVec3::new(f64::from(i), f64::from(j), f64::from(k));
                if locate(point).1 < 0.0 {
                    points.push(point);
                }
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn particles_of_a_ball_fill_its_volume_and_store_their_depth() {
        let ball = |p: DVec3| (p.normalize_or(DVec3::X) * 0.05, p.length() - 0.05);
        let volume = 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
        let particles = unit_particles(ball, DVec3::splat(-0.05), DVec3::splat(0.05), volume, 0.01);
        let total: f64 = particles.iter().map(|p| p.volume).sum();
        assert!((total / volume - 1.0).abs() < 1e-12);
        // With the best of the 64 offsets, the particle count differs from volume / dp^3 by less than 1 %.
        assert!((particles[0].volume / 1e-6 - 1.0).abs() < 0.01);
        for particle in &particles {
            let depth = 0.05 - particle.position.length();
            assert!((particle.to_surface.length() - depth).abs() < 1e-12 && depth > 0.3 * 0.01);
        }
    }
}
