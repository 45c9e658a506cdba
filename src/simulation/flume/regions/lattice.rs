//! Fields of the water of a neighbouring region on a lattice of points in a buffer.
//!
//! At the points, the fields follow from the particles by the linear fit of [`Sampler::fit`]; between the points, they
//! are interpolated linearly. The points are as far apart as the coarser particles of the two regions. The fit does not
//! resolve smaller distances, because its kernel is 4h = 8 particles wide.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::case::Sides;
use crate::simulation::flume::Simulation;

/// Number of fields.
const FIELDS: usize = 8;

/// Velocity [m/s], density [kg/m3], and their rates [m/s2, kg/(m3 s)].
pub(super) type Fields = [f64; FIELDS];

/// Smallest sum of the weights of wet points for which a value counts [-].
const LEAST_WEIGHT: f64 = 0.1;

/// Lattice of points in a buffer.
pub(super) struct Lattice {
    /// The first point [m].
    low: DVec3,
    /// Distances of the points [m].
    step: DVec3,
    /// Number of points along x, y and z.
    count: [usize; 3],
    /// True if the flume is periodic across its width.
    periodic: bool,
    /// Fields at each point; `None` if the point is dry.
    fields: Vec<Option<Fields>>,
}

impl Lattice {
    /// Interpolates the fields of the `water` of a region, up to the level `highest` [m]. The lattice extends over
    /// columns of the given `size` [m]; `number` has their numbers along x and y, and `low` is their first corner [m].
    pub fn new(water: &Simulation, highest: f64, low: DVec2, size: DVec2, number: [usize; 2]) -> Self {
        let profile = &water.case.flume.profile;
        let (step, [nx, ny]) = (size.extend(size.x), [number[0] + 1, number[1]]);
        let beds = (0..nx).map(|ix| profile.z(low.x + ix as f64 * size.x));
        let lowest = beds.fold(f64::INFINITY, f64::min);
        let nz = ((highest - lowest).max(0.0) / step.z).ceil() as usize + 2;
        // Across the flume, the points are in the middle of the columns.
        let low = DVec3::new(low.x, 0.5 * size.y, lowest);
        let (sampler, rates) = (water.sampler(), water.solver().host_rates());
        let (velocity, density) = (&sampler.water.velocity, &sampler.water.density);
        let fields = |point: usize| {
            let [ix, iy, iz] = [point / (ny * nz), point / nz % ny, point % nz].map(|k| k as f64);
            sampler.fit(low + step * DVec3::new(ix, iy, iz), |b| {
                let ([u, v, w], [ax, ay, az]) = (velocity[b].to_array(), rates[b].acceleration.map(f64::from));
                [u, v, w, density[b], ax, ay, az, f64::from(rates[b].density)]
            })
        };
        let fields = (0..nx * ny * nz).into_par_iter().with_min_len(32).map(fields).collect();
        let periodic = water.case.domain.sides == Sides::Periodic;
        Self { low, step, count: [nx, ny, nz], periodic, fields }
    }

    /// Returns the fields at a point; `None` if it is dry.
    pub fn at(&self, point: DVec3) -> Option<Fields> {
        let [nx, ny, nz] = self.count;
        let place = (point - self.low) / self.step;
        let first = place.floor();
        let share = place - first;
        let (mut sum, mut weights) = ([0.0; FIELDS], 0.0);
        for corner in 0..8 {
            let upper = [corner & 1, corner >> 1 & 1, corner >> 2];
            let factor = |axis: usize| if upper[axis] == 1 { share[axis] } else { 1.0 - share[axis] };
            let weight = factor(0) * factor(1) * factor(2);
            let [ix, iy, iz] = std::array::from_fn(|axis| first[axis] as i64 + upper[axis]);
            let inside = |k: i64, n: usize| k.clamp(0, n as i64 - 1) as usize;
            let iy = if self.periodic { iy.rem_euclid(ny as i64) as usize } else { inside(iy, ny) };
            if !(0..nz as i64).contains(&iz) {
                continue;
            }
            if let Some(fields) = self.fields[(inside(ix, nx) * ny + iy) * nz + iz as usize] {
                weights += weight;
                sum.iter_mut().zip(fields).for_each(|(sum, field)| *sum += weight * field);
            }
        }
        (weights > LEAST_WEIGHT).then(|| sum.map(|sum| sum / weights))
    }
}
