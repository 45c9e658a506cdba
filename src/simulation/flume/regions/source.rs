//! The water of a neighbouring region, as a buffer sees it.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::buffer::Buffer;
use super::lattice::Lattice;
use crate::simulation::flume::Simulation;
use crate::sph::pairs::rate::Rate;
use crate::sph::solver::sampling::Sampler;

/// Share of the difference of the volumes of buffer and neighbouring region that is corrected in a time step [-]. The
/// correction must be fast compared with waves, and slow compared with the motion of single particles.
const PACKING_RATE: f64 = 0.05;

/// Largest change of the mass of a buffer particle in a time step [-].
const LARGEST_PACKING: f64 = 0.002;

/// State of the neighbouring region at a point.
#[derive(Clone, Copy)]
pub(super) struct Interpolated {
    pub velocity: DVec3,
    pub density: f64,
    pub rate: Rate,
}

/// A column of water of the neighbouring region.
#[derive(Clone, Copy)]
struct Column {
    /// Level of the free surface [m].
    level: f64,
    /// Pressure [Pa] at the depth [`Surface::deep`] below the free surface.
    pressure: f64,
}

/// Pressure near the free surface of the region itself, at one y near the interface.
struct Surface {
    /// Depth below the free surface [m] up to which the pressure of SPH deviates from the pressure of water.
    deep: f64,
    /// Pressure at equal steps of depth from 0 to `deep`, minus the pressure at `deep` [Pa].
    difference: Vec<f64>,
}

impl Surface {
    /// Measures the pressure at (x, y), above the bed level `bed` [m]; `deepest` [m] limits the depth, and `step` is
    /// the step of the depth [m]. Returns `None` if there is no water.
    fn new(sampler: &Sampler, place: DVec2, bed: f64, deepest: f64, step: f64) -> Option<Self> {
        let level = sampler.surface(place, bed)?;
        let deep = deepest.min(0.5 * (level - bed));
        let steps = (deep / step).ceil().max(1.0);
        let pressure = |depth: f64| Some(sampler.sample(place.extend(level - depth))?.pressure);
        let at_deep = pressure(deep)?;
        let at = |k: u32| Some(pressure(deep * f64::from(k) / steps)? - at_deep);
        Some(Self { deep, difference: (0..=steps as u32).map(at).collect::<Option<_>>()? })
    }

    /// Returns the pressure at a depth up to `deep` [m], minus the pressure at `deep` [Pa].
    fn difference_at(&self, depth: f64) -> f64 {
        let last = self.difference.len() - 1;
        let place = (depth / self.deep).clamp(0.0, 1.0) * last as f64;
        let k = (place as usize).min(last - 1);
        self.difference[k] + (place - k as f64) * (self.difference[k + 1] - self.difference[k])
    }
}

/// The water of a neighbouring region near a buffer.
pub(super) struct Source<'a> {
    sampler: Sampler<'a>,
    own_sampler: Sampler<'a>,
    lattice: Lattice,
    /// Pressure near the free surface of the region itself, for each row of columns; `None` where it is dry.
    surfaces: Vec<Option<Surface>>,
    /// x and y of the corner of the first column [m], size of a column [m], and number of columns along x and y.
    low: DVec2,
    size: DVec2,
    count: [usize; 2],
    /// Columns of the neighbouring region; `None` where it is dry.
    columns: Vec<Option<Column>>,
}

impl<'a> Source<'a> {
    /// Measures levels and fields of the water of `neighbour` in the `buffer` of a `region`.
    pub fn new(region: &'a Simulation, neighbour: &'a Simulation, buffer: &Buffer) -> Self {
        let (sampler, own_sampler) = (neighbour.sampler(), region.sampler());
        let (domain, profile) = (&region.case.domain, &region.case.flume.profile);
        let coarsest = if domain.dp > neighbour.case.domain.dp { domain } else { &neighbour.case.domain };
        let (from, to) = (buffer.interface.min(buffer.edge), buffer.interface.max(buffer.edge));
        let count = [((to - from) / coarsest.dp - 1e-6).ceil().max(1.0) as usize, coarsest.ny];
        let (low, size) = (DVec2::new(from, 0.0), DVec2::new((to - from) / count[0] as f64, coarsest.dy));
        let deepest = sampler.kernel.support().max(own_sampler.kernel.support());
        let surface = |iy: usize| {
            let x = buffer.interface - buffer.outwards * own_sampler.kernel.support();
            let place = DVec2::new(x, (iy as f64 + 0.5) * size.y);
            Surface::new(&own_sampler, place, profile.z(x), deepest, 0.5 * domain.dp)
        };
        let surfaces: Vec<Option<Surface>> = (0..count[1]).into_par_iter().map(surface).collect();
        let column = |number: usize| {
            let [ix, iy] = [number / count[1], number % count[1]];
            let centre = low + size * (DVec2::new(ix as f64, iy as f64) + 0.5);
            let level = sampler.surface(centre, profile.z(centre.x))?;
            let deep = surfaces[iy].as_ref().map_or(0.0, |surface| surface.deep);
            Some(Column { level, pressure: sampler.sample(centre.extend(level - deep))?.pressure })
        };
        let columns: Vec<Option<Column>> = (0..count[0] * count[1]).into_par_iter().map(column).collect();
        let highest = columns.iter().flatten().map(|column| column.level).fold(f64::NEG_INFINITY, f64::max);
        let lattice = Lattice::new(neighbour, highest, low, size, count);
        Self { sampler, own_sampler, surfaces, low, size, count, columns, lattice }
    }

    /// Returns the level of the free surface at a point [m]; `None` if it is dry.
    pub fn level(&self, point: DVec3) -> Option<f64> {
        self.columns[self.column(point)].map(|column| column.level)
    }

    /// Returns the number of the column nearest to a point.
    fn column(&self, point: DVec3) -> usize {
        self.along(point.x) * self.count[1] + self.across(point.y)
    }

    /// Returns the number of the row of columns at x.
    pub fn along(&self, x: f64) -> usize {
        (((x - self.low.x) / self.size.x).max(0.0) as usize).min(self.count[0] - 1)
    }

    /// Returns the factors by which the masses in each row of columns change, so that the buffer approaches the volume
    /// of water that the neighbouring region has at the same x.
    pub fn packing_corrections(&self, buffer: &Buffer) -> Vec<f64> {
        let width = self.count[1] as f64 * self.size.y;
        let reach = self.own_sampler.kernel.support();
        let correction = |ix: usize| {
            // Near the outer edge, the sum over the volumes of the buffer is incomplete: use the nearest complete sum.
            let x = self.low.x + (ix as f64 + 0.5) * self.size.x;
            let inside = buffer.outwards * (buffer.edge - x);
            let x = if inside < reach { buffer.edge - buffer.outwards * reach } else { x };
            let [own, given] = [self.own_sampler, self.sampler].map(|sampler| sampler.depth(x, width));
            let error = if own > 0.0 && given > 0.0 { given / own - 1.0 } else { 0.0 };
            1.0 + (PACKING_RATE * error).clamp(-LARGEST_PACKING, LARGEST_PACKING)
        };
        (0..self.count[0]).into_par_iter().map(correction).collect()
    }

    /// Returns the number of the row of columns at y.
    fn across(&self, y: f64) -> usize {
        ((y / self.size.y).max(0.0) as usize).min(self.count[1] - 1)
    }

    /// Returns the state of the water at a point; `None` if it is dry.
    ///
    /// Near a free surface, the pressure of SPH deviates from the pressure of water by a few tenths of rho g dp. This
    /// deviation keeps the truncated sums at the surface in balance, and depends on the particle spacing. Near the
    /// surface, the neighbouring region therefore gives only the pressure at the depth where the deviation ends. Above
    /// this depth, the pressure differs from it as much as in the water of the region itself.
    pub fn state(&self, point: DVec3) -> Option<Interpolated> {
        let [u, v, w, density, ax, ay, az, change] = self.lattice.at(point)?;
        let (column, surface) = (self.columns[self.column(point)], &self.surfaces[self.across(point.y)]);
        let density = match (column, surface) {
            (Some(Column { level, pressure }), Some(surface)) if level - point.z < surface.deep => {
                self.sampler.tait.density(pressure + surface.difference_at(level - point.z))
            }
            _ => density,
        };
        let rate = Rate { acceleration: [ax, ay, az].map(|a| a as f32), density: change as f32, ..Rate::default() };
        Some(Interpolated { velocity: DVec3::new(u, v, w), density, rate })
    }
}
