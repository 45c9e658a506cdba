//! Filling an armour unit with boundary particles.

use glam::DVec3;

use super::boundary::BoundaryParticle;

/// Particles nearer to the surface than this share of dp are moved in to it, so that a water particle never meets one
/// on the surface itself.
pub const LEAST_DEPTH: f64 = 0.35;

/// Places of the lattice that are tried along each axis.
const PLACES: u32 = 4;

/// Particles of a cubic lattice of spacing `dp` [m] inside a solid, in the solid's axes.
///
/// `locate` gives the nearest point of the surface [m] and the distance to it [m], negative inside; `low` and `high`
/// bound the solid [m]. Of several places of the lattice the one whose particle count comes nearest to `volume` / dp^3
/// is taken, and the particles share the volume [m3] exactly.
pub fn unit_particles(
    locate: impl Fn(DVec3) -> (DVec3, f64),
    low: DVec3,
    high: DVec3,
    volume: f64,
    dp: f64,
) -> Vec<BoundaryParticle> {
    let wanted = volume / dp.powi(3);
    let places = (0..PLACES.pow(3)).map(|n| {
        let place = |divisor: u32| f64::from(n / divisor % PLACES) / f64::from(PLACES);
        low + dp * (DVec3::new(place(1), place(PLACES), place(PLACES * PLACES)) - 1.0)
    });
    let fillings = places.map(|origin| inside(&locate, origin, high, dp));
    let miss = |points: &Vec<DVec3>| (points.len() as f64 - wanted).abs();
    let points = fillings.min_by(|a, b| miss(a).total_cmp(&miss(b))).unwrap_or_default();
    let share = volume / points.len().max(1) as f64;
    let place = |point: DVec3| {
        let (nearest, distance) = locate(point);
        let depth = -distance;
        let position = if depth < LEAST_DEPTH * dp && depth > 1e-9 * dp {
            nearest + (point - nearest) * (LEAST_DEPTH * dp / depth)
        } else {
            point
        };
        BoundaryParticle { position, to_surface: locate(position).0 - position, volume: share, slides: false }
    };
    points.into_iter().map(place).collect()
}

/// Lattice points inside the solid.
fn inside(locate: &impl Fn(DVec3) -> (DVec3, f64), origin: DVec3, high: DVec3, dp: f64) -> Vec<DVec3> {
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
    fn a_ball_keeps_its_volume_and_its_distances() {
        let ball = |p: DVec3| (p.normalize_or(DVec3::X) * 0.05, p.length() - 0.05);
        let volume = 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
        let particles = unit_particles(ball, DVec3::splat(-0.05), DVec3::splat(0.05), volume, 0.01);
        let total: f64 = particles.iter().map(|p| p.volume).sum();
        assert!((total / volume - 1.0).abs() < 1e-12);
        // The best of 64 places: the count misses volume / dp^3 by less than one in a hundred.
        assert!((particles[0].volume / 1e-6 - 1.0).abs() < 0.01);
        for particle in &particles {
            let depth = 0.05 - particle.position.length();
            assert!((particle.to_surface.length() - depth).abs() < 1e-12 && depth > 0.3 * 0.01);
        }
    }
}
