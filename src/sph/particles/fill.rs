//! Fills the flume with water particles.
//!
//! The particles form columns from the bed to the free surface. Each column is divided into equal parts about dp high,
//! with one particle in the middle of each part. A particle has the mass of the water in its part, so the total volume
//! is exact and no gap remains above a sloping bed. Water that falls into such a gap would drive particles into the
//! bed, because mDBC alone does not stop them. The initial density is hydrostatic.

use glam::{DVec2, DVec3};

use super::{bed::Across, unit::MIN_DEPTH, water::Water};
use crate::sph::terms::equation_of_state::Tait;

/// The region to be filled with water.
pub struct Basin<'a> {
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Arrangement of the particles across the flume.
    pub across: Across,
    /// Particle spacing along x and z [m].
    pub dp: f64,
    /// Bed level z(x, y) [m].
    pub bed: &'a dyn Fn(f64, f64) -> f64,
    /// Level of the free surface z(x) [m].
    pub surface: &'a dyn Fn(f64) -> f64,
    /// Velocity of the water along x and z at (x, z) [m/s].
    pub velocity: &'a dyn Fn(f64, f64) -> DVec2,
    /// Gravitational acceleration [m/s2].
    pub gravity: f64,
}

/// Returns the x positions of the columns between two `x`, and their spacing, about `dp` [m].
pub fn columns(x: [f64; 2], dp: f64) -> (Vec<f64>, f64) {
    let length = x[1] - x[0];
    let count = (length / dp).round().max(1.0);
    let spacing = length / count;
    ((0..count as u32).map(|i| x[0] + (f64::from(i) + 0.5) * spacing).collect(), spacing)
}

/// Returns the z levels of the particles in a column from the level `bed` to the level `top`, and their spacing, about
/// `dp` [m]. A column lower than dp / 2 has no particles.
pub fn column(bed: f64, top: f64, dp: f64) -> (impl Iterator<Item = f64>, f64) {
    let count = ((top - bed) / dp).round().max(0.0);
    let spacing = (top - bed) / count.max(1.0);
    ((0..count as u32).map(move |k| bed + (f64::from(k) + 0.5) * spacing), spacing)
}

impl Basin<'_> {
    /// Returns points (x, z) on the wetted face of the side wall at y = 0, from the bed up to the level `top` [m], each with the
    /// area that it represents [m2].
    pub fn side_section(&self, top: f64) -> Vec<(DVec2, f64)> {
        let (columns, dx) = columns(self.x, self.dp);
        let mut points = Vec::new();
        for x in columns {
            let (heights, dz) = column((self.bed)(x, 0.0), top, self.dp);
            points.extend(heights.map(|z| (DVec2::new(x, z), dx * dz)));
        }
        points
    }

    /// Creates the water particles with hydrostatic density and with the velocity field `self.velocity`.
    pub fn fill(&self, tait: &Tait) -> Water {
        let (columns, dx) = columns(self.x, self.dp);
        let mut water = Water::default();
        for x in columns {
            let surface = (self.surface)(x);
            let across: Vec<f64> = self.across.rows(0);
            let heights_at: Vec<(Vec<f64>, f64)> = across
                .iter()
                .map(|y| column((self.bed)(x, *y), surface, self.dp))
                .map(|(heights, dz)| (heights.collect(), dz))
                .collect();
            let highest = heights_at.iter().map(|(heights, _)| heights.len()).max().unwrap_or(0);
            for k in 0..highest {
                for (y, (heights, dz)) in across.iter().zip(&heights_at) {
                    let Some(&z) = heights.get(k) else { continue };
                    let velocity = (self.velocity)(x, z);
                    let density = tait.density(tait.rho0 * self.gravity * (surface - z));
                    water.position.push(DVec3::new(x, *y, z));
                    water.velocity.push(DVec3::new(velocity.x, 0.0, velocity.y));
                    water.density.push(density);
                    // With the local density, the volumes m / rho fill the basin exactly. With rho0 instead, the mass
                    // would be too small and the volumes would not fill the basin, so the water would sink.
                    water.mass.push(density * dx * self.across.spacing() * dz);
                }
            }
        }
        water.id = (0..water.len() as u32).collect();
        water
    }
}

/// If a particle is nearer to a surface than this share of the least distance in [`clear_solid`], it counts as on the
/// surface. At such a small distance, rounding errors hide the side of the particle and the direction in which to move it.
const ON_SURFACE: f64 = 1e-6;

/// Number of points along each edge of a particle's cell at which [`clear_solid`] looks for the solid. Around a unit, a
/// hundred or more cells are cut, so the errors of the single cells cancel.
const SAMPLES: u32 = 4;

/// Largest relative change of a particle's mass in [`clear_solid`]. Usual changes are 1 to 2 %; without a limit, a solid
/// smaller than a particle could change a mass without bound.
const MOST_CHANGE: f64 = 0.2;

/// Removes the water particles inside a solid or on its surface. Moves other particles outwards to the distance
/// [`MIN_DEPTH`] dp from the surface if they are nearer to it. `dp` is the particle spacing [m].
///
/// In general, the removed particles have more or less mass than the water that the solid displaces. The particles
/// nearer than dp to the surface take the difference. Otherwise the buoyancy of the solid would have the same error.
///
/// `locate` returns the surface point nearest to a given point and the distance between them [m], negative inside the
/// solid.
pub fn clear_solid(water: &mut Water, dp: f64, locate: impl Fn(DVec3) -> (DVec3, f64)) {
    let least = MIN_DEPTH * dp;
    let mut keep = vec![true; water.len()];
    let (mut near, mut near_mass, mut surplus) = (Vec::new(), 0.0, 0.0);
    for (i, (position, mass)) in water.position.iter_mut().zip(&water.mass).enumerate() {
        let (nearest, distance) = locate(*position);
        keep[i] = distance > ON_SURFACE * least;
        let removed = if keep[i] { 0.0 } else { 1.0 };
        // Half the diagonal of a cell.
        let is_cut = distance.abs() < 0.5 * 3f64.sqrt() * dp;
        let displaced = if is_cut { share_inside(*position, dp, &locate) } else { removed };
        surplus += mass * (removed - displaced);
        if keep[i] && distance < dp {
            near.push(i);
            near_mass += mass;
        }
        if keep[i] && distance < least {
            *position = nearest + (*position - nearest) * (least / distance);
        }
    }
    if near_mass > 0.0 {
        let factor = 1.0 + (surplus / near_mass).clamp(-MOST_CHANGE, MOST_CHANGE);
        near.into_iter().for_each(|i| water.mass[i] *= factor);
    }
    water.retain(&keep);
    water.id = (0..water.len() as u32).collect();
}

/// Returns the share of a particle's cell, a cube with the edge `dp` [m], that is inside a solid [-].
fn share_inside(centre: DVec3, dp: f64, locate: impl Fn(DVec3) -> (DVec3, f64)) -> f64 {
    let offset = |k: u32| (f64::from(k) + 0.5) / f64::from(SAMPLES) - 0.5;
    let point = |n: u32| DVec3::new(offset(n % SAMPLES), offset(n / SAMPLES % SAMPLES), offset(n / SAMPLES.pow(2)));
    let inside = (0..SAMPLES.pow(3)).filter(|n| locate(centre + dp * point(*n)).1 < 0.0).count();
    inside as f64 / f64::from(SAMPLES.pow(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAIT: Tait = Tait { rho0: 1000.0, c0: 20.0, gamma: 7.0 };

    #[test]
    fn filled_volume_is_exact_over_a_sloping_bed() {
        let basin = Basin {
            x: [0.0, 2.0],
            across: Across { width: 0.1, count: 5, walls: false },
            dp: 0.02,
            bed: &|x, _| 0.1 * x,
            surface: &|_| 0.3,
            velocity: &|_, _| DVec2::ZERO,
            gravity: 9.81,
        };
        let water = basin.fill(&TAIT);
        let volume: f64 = water.mass.iter().zip(&water.density).map(|(m, rho)| m / rho).sum();
        // Limit 1e-9: rounding only, because the midpoint rule is exact for a straight bed.
        assert!((volume / (0.1 * (0.3 * 2.0 - 0.2)) - 1.0).abs() < 1e-9);
        // The shallowest column is 0.1 m high and has five particles. The volume of a particle differs from dp^3 by at
        // most a tenth, and its density from rho0 by at most 1 %.
        assert!(water.mass.iter().all(|m| (m / (1000.0 * 0.02_f64.powi(3)) - 1.0).abs() < 0.12));
        let deepest = water.position.iter().zip(&water.density).min_by(|a, b| a.0.z.total_cmp(&b.0.z)).unwrap();
        assert!((TAIT.pressure(*deepest.1) - 9810.0 * (0.3 - deepest.0.z)).abs() < 1e-6);
    }

    #[test]
    fn water_inside_a_solid_is_removed_and_water_near_it_is_moved_away() {
        let mut water = Water::default();
        for i in 0..100 {
            water.position.push(DVec3::X * f64::from(i) * 0.01);
            water.velocity.push(DVec3::ZERO);
            water.density.push(1000.0);
            water.mass.push(1.0);
        }
        clear_solid(&mut water, 0.01, |p| (DVec3::X * 0.497, p.x - 0.497));
        assert_eq!((water.len(), water.velocity.len(), water.density.len(), water.id.len()), (50, 50, 50, 50));
        assert!(water.position.iter().all(|p| p.x >= 0.5005 - 1e-12));
        // The solid covers a fifth of the cell of the first particle, one of four points along it. The mass of this
        // particle falls by a quarter, but at most by a fifth.
        let total: f64 = water.mass.iter().sum();
        assert!((water.mass[0] - 0.8).abs() < 1e-12 && (total - 49.8).abs() < 1e-12, "{:?}", water.mass);
    }

    #[test]
    fn water_on_the_surface_of_a_solid_is_removed() {
        let mut water = Water {
            position: vec![DVec3::ZERO, DVec3::X],
            velocity: vec![DVec3::ZERO; 2],
            density: vec![1000.0; 2],
            mass: vec![1.0; 2],
            ..Water::default()
        };
        // The solid has a face at x = 0. A rounding error of 1e-17 m gives the first particle a wrong direction.
        clear_solid(&mut water, 0.01, |p| (p + DVec3::Y * 1e-17, if p.x > 0.0 { p.x } else { 1e-17 }));
        assert_eq!(water.position, [DVec3::X]);
    }
}
