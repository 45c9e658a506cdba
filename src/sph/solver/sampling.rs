//! Interpolates pressure, velocity and free-surface level of the water at given points.

use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use crate::sph::boundary::{linear_equations::solve, mdbc::DRY_LIMIT};
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::particles::{boundary::Boundary, porosity::PorousField, water::Water};
use crate::sph::terms::equation_of_state::Tait;
use crate::sph::terms::kernel::Wendland;

/// Sum of W V at the free surface [-]: half its value inside the water.
const SURFACE: f64 = 0.5;

/// Smallest determinant of the equations for which the linear fit is used, relative to the determinant of a full
/// neighbourhood with the same sum of W V [-]; compare [`mdbc`](crate::sph::boundary::mdbc).
const MIN_DETERMINANT: f64 = 0.01;

/// Second moment of the kernel along each axis, the integral of W x^2 over the volume [h^2]. The value holds in three
/// dimensions; in two dimensions the exact value is 5/18.
const SECOND_MOMENT: f64 = 4.0 / 15.0;

/// A point counts as a point at a surface if the sum of W V of the boundary around it is larger than this value [-].
/// The sum is 1/2 on a plane wall, 0.2 half a smoothing length away from it, and 0.1 at 0.75 h.
const AT_SURFACE: f64 = 0.1;

/// Smallest share of the space around a point at a surface that counts as free of solids [-]; 1/8 is free in the corner
/// of a bed and two walls.
const LEAST_FREE: f64 = 0.1;

/// Interpolator of pressure, velocity and surface level in the sorted water of a time step.
#[derive(Clone, Copy)]
pub struct Sampler<'a> {
    /// Grid of the bins.
    pub grid: &'a Grid,
    /// Bins of the sorted water.
    pub bins: &'a Bins,
    /// Water, in sorted order.
    pub water: &'a Water,
    /// Boundary particles.
    pub boundary: &'a Boundary,
    /// Bins of the boundary: first of bed, walls and pistons, then of the units. They are empty if a graphics card
    /// computes the water; all points then count as points inside the water.
    pub boundary_bins: [&'a Bins; 2],
    /// Kernel.
    pub kernel: Wendland,
    /// Equation of state.
    pub tait: Tait,
    /// Gravitational acceleration [m/s2].
    pub gravity: f64,
    /// Porous media, if there are any.
    pub porous: Option<&'a PorousField>,
}

/// State of the water at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Pressure [Pa].
    pub pressure: f64,
    /// Velocity [m/s].
    pub velocity: DVec3,
}

impl Sampler<'_> {
    /// Returns the index of each entry of `bins` in the bins that the kernel support around a point reaches along x and
    /// y, and in the rows `z` of bins.
    fn entries(&self, bins: &Bins, point: DVec3, z: RangeInclusive<usize>) -> impl Iterator<Item = usize> {
        let (grid, reach) = (self.grid, self.kernel.support());
        let [nx, ny, _] = grid.count;
        let x = grid.along(0, point.x - reach)..=grid.along(0, point.x + reach);
        let y = grid.rows_across(point.y - reach, point.y + reach);
        let rows = z.flat_map(move |iz| y.clone().map(move |iy| (iz * ny + iy % ny) * nx));
        rows.flat_map(move |row| bins.start[row + x.start()] as usize..bins.start[row + x.end() + 1] as usize)
    }

    /// Returns the range of the rows of bins along z that the kernel support around a point reaches.
    fn rows_near(&self, point: DVec3) -> RangeInclusive<usize> {
        let reach = self.kernel.support();
        self.grid.along(2, point.z - reach)..=self.grid.along(2, point.z + reach)
    }

    /// Returns the vector from a point to a particle [m].
    fn vector(&self, point: DVec3, particle: DVec3) -> DVec3 {
        let r = particle - point;
        if self.kernel.dimensions() == 2 { DVec3 { y: 0.0, ..r } } else { self.grid.nearest_image(r) }
    }

    /// Returns the vector from a point to each water particle [m], and the index of the particle, for the particles of
    /// [`Self::entries`].
    fn near(&self, point: DVec3, z: RangeInclusive<usize>) -> impl Iterator<Item = (DVec3, usize)> {
        self.entries(self.bins, point, z).map(move |b| (self.vector(point, self.water.position[b]), b))
    }

    /// Calls `f` for each water particle within the kernel support of a point, with the vector from the point to the
    /// particle [m] and the index of the particle.
    fn for_each_near(&self, point: DVec3, mut f: impl FnMut(DVec3, usize)) {
        let reach = self.kernel.support();
        self.near(point, self.rows_near(point))
            .filter(|(r, _)| r.length_squared() < reach * reach)
            .for_each(|(r, b)| f(r, b));
    }

    /// Returns the bulk volume m / (n rho) of a particle [m3].
    fn volume(&self, b: usize) -> f64 {
        let porosity = self.porous.map_or(1.0, |porous| porous.at(self.water.position[b]).porosity);
        self.water.mass[b] / (porosity * self.water.density[b])
    }

    /// Returns the weight V W [-] of the particle `b`; `r` is the vector from the point to the particle [m].
    fn weight(&self, r: DVec3, b: usize) -> f64 {
        self.volume(b) * self.kernel.value(self.kernel.closeness(r.length()))
    }

    /// Returns the sum of W V [-]: 1 inside the water, 1/2 at the free surface.
    pub fn occupied(&self, point: DVec3) -> f64 {
        let mut sum = 0.0;
        self.for_each_near(point, |r, b| sum += self.weight(r, b));
        sum
    }

    /// Returns the sum of W V of the boundary particles [-]: 1/2 on a plane wall, 0 far from the boundary.
    fn occupied_by_boundary(&self, point: DVec3) -> f64 {
        let first_unit = self.boundary.walls().end;
        let mut sum = 0.0;
        for (bins, first) in self.boundary_bins.into_iter().zip([0, first_unit]) {
            if bins.order.is_empty() {
                continue;
            }
            for entry in self.entries(bins, point, self.rows_near(point)) {
                let b = first + bins.order[entry] as usize;
                let closeness = self.kernel.closeness(self.vector(point, self.boundary.position[b]).length());
                if closeness > 0.0 {
                    sum += self.boundary.volume[b] * self.kernel.value(closeness);
                }
            }
        }
        sum
    }

    /// Returns the pressure that a sensor shows at a point [Pa]. Returns `None` if the point is dry.
    ///
    /// On a surface, it is the mean over the space that solids leave free, with the kernel as weight, where air has no
    /// pressure:
    ///
    ///   p = sum_b W V_b (p_b + rho0 g (z_b - z)) / (1 - sum_s W V_s)
    ///
    /// with water particles b and boundary particles s. It is exact in still water below the reach of the free surface.
    /// On a plane wall, it is twice the first part of the force per area of equation 1, which has p_b, also if the
    /// water is thin or does not yet touch the wall. A linear fit would not agree with the force there. Away from
    /// surfaces, it is the pressure of [`Self::sample`].
    pub fn sensor_pressure(&self, point: DVec3) -> Option<f64> {
        let solid = self.occupied_by_boundary(point);
        if solid < AT_SURFACE {
            return self.sample(point).map(|sample| sample.pressure);
        }
        let weight_of_water = self.tait.rho0 * self.gravity;
        let (mut wet, mut sum) = (0.0, 0.0);
        self.for_each_near(point, |r, b| {
            let weight = self.weight(r, b);
            wet += weight;
            sum += weight * (self.tait.pressure(self.water.density[b]) + weight_of_water * r.z);
        });
        // One particle at the distance dp contributes more than the limit.
        (wet > DRY_LIMIT).then(|| sum / (1.0 - solid).max(LEAST_FREE))
    }

    /// Returns pressure and velocity at a point, as [`Self::fit`]. Returns `None` if the point is dry.
    pub fn sample(&self, point: DVec3) -> Option<Sample> {
        let [pressure, u, v, w] = self.fit(point, |b| {
            let [u, v, w] = self.water.velocity[b].to_array();
            [self.tait.pressure(self.water.density[b]), u, v, w]
        })?;
        Some(Sample { pressure, velocity: DVec3::new(u, v, w) })
    }

    /// Returns `N` fields at a point from a linear fit with kernel weights (moving least squares), or their weighted
    /// means if the fit is ill-conditioned. `values` returns the fields at a particle. Returns `None` if the point is
    /// dry.
    pub fn fit<const N: usize>(&self, point: DVec3, values: impl Fn(usize) -> [f64; N]) -> Option<[f64; N]> {
        let per_h = 1.0 / self.kernel.h;
        // Sums, with the weight V W, of the products of (1, x, y, z) with (1, x, y, z) and with the fields; x, y, z in
        // units of h.
        let (mut matrix, mut right) = ([[0.0; 4]; 4], [[0.0; N]; 4]);
        self.for_each_near(point, |r, b| {
            let weight = self.weight(r, b);
            let [x, y, z] = (r * per_h).to_array();
            let (bases, values) = ([1.0, x, y, z], values(b));
            for ((row, right), base) in matrix.iter_mut().zip(&mut right).zip(bases) {
                let weight = weight * base;
                row.iter_mut().zip(bases).for_each(|(sum, column)| *sum += weight * column);
                right.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        });
        let occupied = matrix[0][0];
        // The sum of W V is 0.2 slightly above a calm free surface; a point with a smaller sum counts as dry.
        if occupied < 0.2 {
            return None;
        }
        if self.kernel.dimensions() == 2 {
            // Fields do not vary across the flume.
            matrix[2][2] = SECOND_MOMENT * occupied;
        }
        // The matrix is symmetric: its solution for (1, 0, 0, 0) has the weights of the right-hand sides.
        let unit = |k: usize| f64::from(u8::from(k == 0));
        let rows = std::array::from_fn(|k| {
            let [a, b, c, d] = matrix[k];
            [a, b, c, d, unit(k)]
        });
        let weights = solve(rows, MIN_DETERMINANT * SECOND_MOMENT.powi(3) * occupied.powi(4)).unwrap_or([
            1.0 / occupied,
            0.0,
            0.0,
            0.0,
        ]);
        Some(std::array::from_fn(|field| (0..4).map(|k| weights[k] * right[k][field]).sum()))
    }

    /// Returns the level z of the free surface at (x, y) [m]: the highest level above `low` [m] at which the sum of W V
    /// falls to 1/2. Returns `None` if there is no such level.
    pub fn surface(&self, xy: DVec2, low: f64) -> Option<f64> {
        let (count, step) = self.column_steps(xy, low);
        let mut above = 0.0;
        for z in (0..count).rev().map(|k| low + f64::from(k) * step) {
            let occupied = self.occupied(xy.extend(z));
            if occupied >= SURFACE {
                return Some(z + step * (occupied - SURFACE) / (occupied - above));
            }
            above = occupied;
        }
        None
    }

    /// Returns the length of a vertical wire at (x, y) above the level `low` that is under water [m]: the length on which
    /// the sum of W V is at least 1/2. Air below a breaking wave or below splash does not count.
    pub fn wetted_length(&self, xy: DVec2, low: f64) -> f64 {
        let (count, step) = self.column_steps(xy, low);
        // The points are in the middle of the steps: on the bed itself, the sum is 1/2 because water is only above it.
        let excess_at = |k: u32| self.occupied(xy.extend(low + (f64::from(k) + 0.5) * step)) - SURFACE;
        let mut below = excess_at(0);
        let mut length = if below >= 0.0 { 0.5 * step } else { 0.0 };
        for above in (1..=count).map(excess_at) {
            let [dry, wet] = [below.min(above), below.max(above)];
            length += step * (wet.max(0.0) / (wet - dry.min(0.0)).max(f64::MIN_POSITIVE));
            below = above;
        }
        length
    }

    /// Returns the number and the size [m] of the steps along z from the level `low` [m] up to h above the highest
    /// particle near (x, y). There the sum of W V is below 1/2, also if water stands above the walls.
    fn column_steps(&self, xy: DVec2, low: f64) -> (u32, f64) {
        let (step, reach) = (0.25 * self.kernel.h, self.kernel.support());
        let column = self.near(xy.extend(0.0), 0..=self.grid.count[2] - 1);
        let within = column.filter(|(r, _)| r.truncate().length_squared() < reach * reach);
        let highest = within.map(|(r, _)| r.z).fold(f64::NEG_INFINITY, f64::max);
        // The cast gives 0 if there is no particle.
        (((highest + self.kernel.h - low) / step).ceil() as u32, step)
    }

    /// Returns the depth of the water at x [m]: its volume per unit area of a flume of width `width` [m], with the
    /// kernel as weight along x.
    pub fn depth(&self, x: f64, width: f64) -> f64 {
        self.column_mean(x, self.kernel.support(), width, |_| 1.0)
    }

    /// Returns the depth of the water at x [m] whose own weight has the same pressure force on a vertical section:
    /// sqrt(2 S), where S [m2] is the sum of (m / rho) (z - bed) per unit area of a flume of width `width` [m]. It is a
    /// mean over the water within `reach` [m] along x.
    ///
    /// The force is rho g S per unit width if each particle carries the weight of the particles above it. Water flows
    /// until this force is equal everywhere on a horizontal bed, also if the particles are less regular in one place
    /// than in another. Their volume per unit area, and the level at which the sum of W V is 1/2, then differ by up to
    /// a tenth of the particle spacing.
    pub fn hydrostatic_depth(&self, x: f64, reach: f64, width: f64, bed: impl Fn(f64) -> f64) -> f64 {
        (2.0 * self.column_mean(x, reach, width, |at| at.z - bed(at.x)).max(0.0)).sqrt()
    }

    /// Returns the sum over the particles of volume times `value`, per unit area of a flume of width `width` [m], as a
    /// mean over x from `x - reach` to `x + reach` [m] with the kernel as weight.
    fn column_mean(&self, x: f64, reach: f64, width: f64, value: impl Fn(DVec3) -> f64) -> f64 {
        let grid = self.grid;
        let kernel = Wendland::new(0.5 * reach);
        let [nx, ny, nz] = grid.count;
        let bins = grid.along(0, x - reach)..=grid.along(0, x + reach);
        let rows = (0..ny * nz).map(|row| row * nx);
        let members = rows.flat_map(|row| self.bins.start[row + bins.start()]..self.bins.start[row + bins.end() + 1]);
        let part = |b: u32| {
            let b = b as usize;
            let at = self.water.position[b];
            let weight: f64 = kernel.shape(kernel.closeness((at.x - x).abs()));
            weight * value(at) * self.volume(b)
        };
        // The integral of the kernel without its constant factor, (1 - q/2)^4 (2q + 1), over a line is 4 h / 3.
        members.map(part).sum::<f64>() / (4.0 / 3.0 * kernel.h * width)
    }
}
