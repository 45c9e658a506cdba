//! Porosity and drag of porous media as fields, stored at the nodes of a grid.
//!
//! At the surface of a medium, the porosity changes over a distance of some particle spacings: a step would make
//! particles gather there. The share w of a medium at a point follows from the distance d to its surface, negative
//! inside: w = 1 deeper than `half_width`, 0 further outside, and in between a smooth curve with the same integral as a
//! step. The drag is a force on single particles, and needs no such smoothing: its share s changes within one spacing of
//! the grid. A wider change would stop water in front of a fine medium. The fields are sums over the media:
//!
//!   n = 1 - sum w (1 - n_k),   A = n sum s A_k / n_k,   B = n^2 sum s B_k / n_k^2,   c_A = sum s c_k
//!
//! With these factors, the drag of a given flow n u does not depend on the change of the porosity.

use glam::DVec3;
use rayon::prelude::*;

use crate::sph::terms::porous::Pores;

/// Number of nodes of the grid in the smoothing distance `half_width`.
const NODES: f64 = 4.0;

/// Signed distance of a point from the surface of a medium [m], negative inside.
pub type Distance<'a> = Box<dyn Fn(DVec3) -> f64 + Sync + 'a>;

/// Porous media around a flume, with the signed distance to the surface of each one.
pub struct Media<'a> {
    /// Pores and signed distance [m] of each medium.
    pub media: Vec<(Pores, Distance<'a>)>,
    /// Box around all media [m].
    pub bounds: [DVec3; 2],
    /// True if all media are the same across the flume.
    pub is_same_across: bool,
    /// Distance from a surface up to which the fields change [m].
    pub half_width: f64,
}

/// Porosity and drag at any point.
#[derive(Debug, Clone, PartialEq)]
pub struct PorousField {
    low: DVec3,
    spacing: f64,
    count: [usize; 3],
    /// n - 1, A / n, B / n^2 and c_A at each node; x fastest, z slowest.
    nodes: Vec<[f32; 4]>,
}

/// Share of a medium at the distance `d` [m] from its surface, negative inside [-]: the integral of a cosine.
fn share(d: f64, half_width: f64) -> f64 {
    let x = (d / half_width).clamp(-1.0, 1.0);
    0.5 * (1.0 - x) - (std::f64::consts::PI * x).sin() / std::f64::consts::TAU
}

impl PorousField {
    /// Computes the fields of the given media.
    pub fn new(media: &Media) -> Self {
        let spacing = media.half_width / NODES;
        let [low, high] = media.bounds;
        let low = low - media.half_width - spacing;
        let mut count = ((high + media.half_width - low) / spacing).ceil().to_array().map(|n| n as usize + 2);
        if media.is_same_across {
            count[1] = 1;
        }
        let [nx, ny, _] = count;
        let node = |index: usize| {
            let at = [index % nx, index / nx % ny, index / (nx * ny)];
            let at = low + DVec3::from_array(at.map(|k| k as f64)) * spacing;
            let mut sums = [0.0; 4];
            for (pores, distance) in &media.media {
                let distance = distance(at);
                let (w, s) = (share(distance, media.half_width), share(distance, spacing));
                let Pores { porosity: n, linear, quadratic, added_mass } = *pores;
                let terms = [w * (n - 1.0), s * linear / n, s * quadratic / (n * n), s * added_mass];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
            sums.map(|sum| sum as f32)
        };
        let nodes = (0..count.iter().product()).into_par_iter().map(node).collect();
        Self { low, spacing, count, nodes }
    }

    /// Returns the pores at a point: linear between the nodes; open water outside the grid.
    pub fn at(&self, point: DVec3) -> Pores {
        let along = (point - self.low) / self.spacing;
        let [nx, ny, nz] = self.count;
        let across = if ny == 1 { 0.0 } else { along.y };
        let cell = [along.x, across, along.z].map(f64::floor);
        let last = [nx - 1, ny.max(2) - 1, nz - 1];
        if (0..3).any(|k| !(0.0..last[k] as f64).contains(&cell[k])) {
            return Pores::NONE;
        }
        let share = [along.x - cell[0], across - cell[1], along.z - cell[2]];
        let [i, j, k] = cell.map(|c| c as usize);
        let mut sums = [0.0; 4];
        for corner in 0..8 {
            let [a, b, c] = [corner & 1, corner >> 1 & 1, corner >> 2];
            if ny == 1 && b == 1 {
                continue;
            }
            let along = |high: usize, share: f64| if high == 1 { share } else { 1.0 - share };
            let weight = along(a, share[0]) * along(b, share[1]) * along(c, share[2]);
            let node = self.nodes[((k + c) * ny + j + b) * nx + i + a];
            sums.iter_mut().zip(node).for_each(|(sum, value)| *sum += weight * f64::from(value));
        }
        let [less, linear, quadratic, added_mass] = sums;
        let n = 1.0 + less;
        Pores { porosity: n, linear: n * linear, quadratic: n * n * quadratic, added_mass }
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<[f32; 4]>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROCK: Pores = Pores { porosity: 0.4, linear: 2.0, quadratic: 100.0, added_mass: 0.5 };

    fn slab(is_same_across: bool) -> PorousField {
        // A slab from x = 0 to 1 m.
        let distance: Distance = Box::new(|at: DVec3| (at.x - 0.5).abs() - 0.5);
        let bounds = [DVec3::ZERO, DVec3::ONE];
        PorousField::new(&Media { media: vec![(ROCK, distance)], bounds, is_same_across, half_width: 0.1 })
    }

    #[test]
    fn the_field_goes_over_from_open_water_to_the_medium() {
        for field in [slab(false), slab(true)] {
            let at = |x: f64| field.at(DVec3::new(x, 0.5, 0.5));
            assert_eq!(at(-0.2), Pores::NONE);
            // f32 values.
            assert!((at(0.5).porosity - 0.4).abs() < 1e-6 && (at(0.5).quadratic - 100.0).abs() < 1e-4);
            assert!((at(0.0).porosity - 0.7).abs() < 1e-6 && (at(1.0).added_mass - 0.25).abs() < 1e-6);
            // A flow n u = 1 m/s has the drag of a sharp medium 1 m long. Limit: rounding of f32.
            let dx = 1e-3;
            let points = (-300..1300).map(|k| at((f64::from(k) + 0.5) * dx));
            let path: f64 = points.map(|p| (p.linear + p.quadratic / p.porosity) / p.porosity * dx).sum();
            let sharp = (2.0 + 100.0 / 0.4) / 0.4;
            assert!((path / sharp - 1.0).abs() < 1e-5, "{path} {sharp}");
        }
    }
}
