//! Filling the flume with water particles.
//!
//! The particles stand in columns that hang from the water surface, dp apart, down to the bed; so the surface is where
//! it should be, and the bed is approached to within dp at most, dp/2 on average. One common mass makes the total
//! volume exact. The density is hydrostatic.

use glam::{DVec2, DVec3};

use super::{bed::Across, water::Water};
use crate::sph::equation_of_state::Tait;

/// The space to be filled.
pub struct Basin<'a> {
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Across the flume.
    pub across: Across,
    /// Distance between particles along and up [m].
    pub dp: f64,
    /// Bed level z(x) [m].
    pub bed: &'a dyn Fn(f64) -> f64,
    /// Level of the water surface z(x) [m].
    pub surface: &'a dyn Fn(f64) -> f64,
    /// Velocity of the water along and up at (x, z) [m/s].
    pub velocity: &'a dyn Fn(f64, f64) -> DVec2,
    /// Gravitational acceleration [m/s2].
    pub gravity: f64,
}

impl Basin<'_> {
    /// x of the columns [m] and the distance between them [m].
    fn columns(&self) -> (Vec<f64>, f64) {
        let length = self.x[1] - self.x[0];
        let count = (length / self.dp).round().max(1.0);
        let spacing = length / count;
        ((0..count as u32).map(|i| self.x[0] + (f64::from(i) + 0.5) * spacing).collect(), spacing)
    }

    /// Points (x, z) of one lengthwise section that hang from `top` [m] down to the bed, and the area that each
    /// stands for [m2].
    pub fn section(&self, top: &dyn Fn(f64) -> f64) -> (Vec<DVec2>, f64) {
        let (columns, spacing) = self.columns();
        let mut points = Vec::new();
        for x in columns {
            let (bed, top) = ((self.bed)(x), top(x));
            let heights = (0..).map(|k| top - (f64::from(k) + 0.5) * self.dp).take_while(|&z| z > bed);
            points.extend(heights.map(|z| DVec2::new(x, z)));
        }
        (points, spacing * self.dp)
    }

    /// Volume between bed and surface [m3], by the midpoint rule on a tenth of dp.
    fn volume(&self) -> f64 {
        let count = ((self.x[1] - self.x[0]) / self.dp * 10.0).ceil();
        let dx = (self.x[1] - self.x[0]) / count;
        let depth = |x: f64| ((self.surface)(x) - (self.bed)(x)).max(0.0);
        let area: f64 = (0..count as u32).map(|i| depth(self.x[0] + (f64::from(i) + 0.5) * dx) * dx).sum();
        area * self.across.width
    }

    /// The water at rest or moving as `velocity` says, with hydrostatic density.
    pub fn fill(&self, tait: &Tait) -> Water {
        let (section, _) = self.section(self.surface);
        let mut water = Water::default();
        for point in &section {
            let velocity = (self.velocity)(point.x, point.y);
            let depth = (self.surface)(point.x) - point.y;
            let density = tait.density(tait.rho0 * self.gravity * depth);
            for j in 0..self.across.count {
                let y = (f64::from(j) + 0.5) * self.across.spacing();
                water.position.push(DVec3::new(point.x, y, point.y));
                water.velocity.push(DVec3::new(velocity.x, 0.0, velocity.y));
                water.density.push(density);
            }
        }
        water.mass = tait.rho0 * self.volume() / water.len().max(1) as f64;
        water.id = (0..water.len() as u32).collect();
        water
    }
}

/// Take out the water inside a solid and move what is nearer to it than `least` [m] away to that distance.
///
/// `locate` gives the nearest point of the solid's surface [m] and the distance to it [m], negative inside.
pub fn clear_solid(water: &mut Water, least: f64, locate: impl Fn(DVec3) -> (DVec3, f64)) {
    let mut keep = vec![true; water.len()];
    for (position, keep) in water.position.iter_mut().zip(&mut keep) {
        let (nearest, distance) = locate(*position);
        *keep = distance > 0.0;
        if *keep && distance < least {
            *position = nearest + (*position - nearest) * (least / distance);
        }
    }
    let mut flags = keep.iter();
    water.position.retain(|_| *flags.next().expect("one flag a particle"));
    let mut flags = keep.iter();
    water.velocity.retain(|_| *flags.next().expect("one flag a particle"));
    let mut flags = keep.iter();
    water.density.retain(|_| *flags.next().expect("one flag a particle"));
    water.id = (0..water.len() as u32).collect();
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAIT: Tait = Tait { rho0: 1000.0, c0: 20.0, gamma: 7.0 };

    #[test]
    fn volume_is_exact_over_a_sloping_bed() {
        let basin = Basin {
            x: [0.0, 2.0],
            across: Across { width: 0.1, count: 5, walls: false },
            dp: 0.02,
            bed: &|x| 0.1 * x,
            surface: &|_| 0.3,
            velocity: &|_, _| DVec2::ZERO,
            gravity: 9.81,
        };
        let water = basin.fill(&TAIT);
        let volume = water.len() as f64 * water.mass / TAIT.rho0;
        // 1e-9: the midpoint rule is exact for straight lines.
        assert!((volume / (0.1 * (0.3 * 2.0 - 0.2)) - 1.0).abs() < 1e-9);
        // The common mass makes up for the lattice; a per cent of rho0 dp^3 would show in the pressure.
        assert!((water.mass / (1000.0 * 0.02_f64.powi(3)) - 1.0).abs() < 0.01);
        let deepest = water.position.iter().zip(&water.density).min_by(|a, b| a.0.z.total_cmp(&b.0.z)).unwrap();
        assert!((TAIT.pressure(*deepest.1) - 9810.0 * (0.3 - deepest.0.z)).abs() < 1e-6);
    }

    #[test]
    fn solids_are_cleared() {
        let mut water = Water::default();
        for i in 0..100 {
            water.position.push(DVec3::X * f64::from(i) * 0.01);
            water.velocity.push(DVec3::ZERO);
            water.density.push(1000.0);
        }
        clear_solid(&mut water, 0.02, |p| (DVec3::X * 0.495, p.x - 0.495));
        assert_eq!((water.len(), water.velocity.len(), water.density.len(), water.id.len()), (50, 50, 50, 50));
        assert!(water.position.iter().all(|p| p.x >= 0.515 - 1e-12));
    }
}
