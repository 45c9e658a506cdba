//! Modified dynamic boundary condition (English et al. 2022; section 2.2 of Mitsui et al. 2023).
//!
//! Each boundary particle has a ghost node: its mirror image in the boundary surface. The density f and its gradient at
//! the ghost node follow from the surrounding water particles, by the first-order consistent correction of Liu & Liu
//! (2006). The four equations
//!
//!   sum_b f_b W V_b      = f sum_b W V_b      + grad f . sum_b r_b W V_b
//!   sum_b f_b grad W V_b = f sum_b grad W V_b + grad f . sum_b r_b (x) grad W V_b,   r_b from the ghost node to b,
//!
//! are solved for f and grad f. W is the kernel at the node, V_b the volume of b, and (x) the tensor product. The
//! density of the boundary particle follows from f and grad f by linear extrapolation from the node to the particle.
//!
//! If too few particles surround the node, the matrix is ill-conditioned. The published fallback is the mean density of
//! the neighbours, extrapolated from their centroid to the boundary particle with the hydrostatic gradient. The code
//! also uses this fallback for thin sheets of water on a dry bed, where all water lies between node and boundary. In
//! such a sheet, a gradient fitted to one or two layers of particles would be extrapolated far behind the sheet, and
//! its errors would drive the sheet apart. If a node has no neighbours, its boundary particle has the reference density
//! rho0.
//!
//! As published, no boundary density is lower than rho0, so that a wall exerts pressure on the water but no suction.
//! With `lowest_density`, a wall also pulls at water that is attached to it: where the fitted gradient is trusted and
//! the mean density around the node is below rho0. The density of the wall is at least this mean. Without this
//! condition, a wall above the surface would pull still water upwards, by the extrapolated hydrostatic gradient.

use glam::DVec3;
use rayon::prelude::*;

use super::linear_equations::solve;
use super::node_sums::{NodeTerms, Pair, sum_around_nodes};
use crate::sph::lanes::{InstructionSet, Lanes};
use crate::sph::neighbours::grid::{Bins, Grid};
use crate::sph::neighbours::lists::{NeighbourLists, Sources};
use crate::sph::neighbours::records::{Record, split_position};
use crate::sph::parameters::Parameters;
use crate::sph::particles::boundary::Boundary;

/// Smallest determinant of the matrix of the four equations, divided by (sum of W V)^4, for which the gradient is
/// fitted [-]. The value is 1 for a full neighbourhood, 0.3 for a node at a plane water surface, 0.1 for a node at a
/// straight edge of the water, and 0 for a single layer of particles.
pub(in crate::sph) const MIN_DETERMINANT: f64 = 0.01;

/// Distance from the node to the centroid of the water around it, positive towards the boundary [h]. From the first to
/// the second value, the trust in the fitted gradient decreases from 1 to 0. The distance is 0.42 h for a node at the
/// free surface of deep water on a bed. It is negative for a node inside the water and for a node next to a wall that
/// pierces the free surface, because most water then lies on the far side of the node. The values are calibrated: with
/// 0.2 and 0.4, the thin tip of a dam break on a dry bed was still driven apart (case with three cubes, dp = 0.03 m).
pub(in crate::sph) const CENTROID_LIMITS: [f64; 2] = [0.1, 0.2];

/// Spread of the water around the node along the wall normal, sum g V r_n^2 / sum W V [h^2]. Here r_n is the distance
/// of a particle from the node along the wall normal. g is not gravity but -h^2 G, with the factor G of the kernel
/// gradient grad_a W_ab = G r_ab. From the first to the second value, the trust in the fitted gradient increases from 0
/// to 1. For nodes of the first layer of boundary particles, the spread is 0.2 to 0.3 for two layers of water
/// particles, 0.5 to 0.65 for three layers and 0.74 for deep water. The values are calibrated with still water on a
/// beach: a gradient from two layers is mostly noise, and the walls amplify this noise.
pub(in crate::sph) const SPREAD_LIMITS: [f64; 2] = [0.4, 0.7];

/// Longest horizontal way from the surface point of a boundary particle to its ghost node [h]. Only particles deep inside
/// or below a wide body are further from their surface point. A wave changes little over this way, and it is longer than
/// the way from the corners of walls with three layers of particles, which is 2.5 h in two dimensions.
pub(in crate::sph) const LONGEST_WAY: f64 = 3.0;

/// Smallest number of array entries for which a separate task of the thread pool is worthwhile.
pub(super) const MIN_CHUNK: usize = 1024;

/// A node is dry if its sum of W V is below this value [-]. One particle at the distance dp from the node contributes
/// more than this value.
pub(in crate::sph) const DRY_LIMIT: f64 = 0.01;

/// All ghost nodes, sorted into bins, with their neighbour lists and sums.
#[derive(Debug, Default)]
pub struct GhostNodes {
    points: Vec<DVec3>,
    pub(super) bins: Bins,
    sorted: Vec<DVec3>,
    pub(super) split: Vec<[f32; 4]>,
    pub(super) lists: NeighbourLists,
    pub(super) sums: Vec<NodeSums>,
    /// Place of each boundary particle in the order of the nodes.
    pub(super) place_of: Vec<u32>,
    /// Densities of the boundary particles in the order of the nodes [kg/m3].
    densities: Vec<f64>,
}

/// Sums over the water particles around one ghost node. (x, y, z) is the vector from the node to a particle in units of
/// h; f is rho - rho0 of the particle [kg/m3].
#[derive(Debug, Clone, Copy, Default)]
pub struct NodeSums {
    /// sum W V (1, x, y, z).
    pub(super) value: [f32; 4],
    /// sum W V f.
    value_f: f32,
    /// sum g V (x, y, z) with g = -G h^2.
    first: [f32; 3],
    /// sum g V (xx, yy, zz, xy, xz, yz).
    second: [f32; 6],
    /// sum g V f (x, y, z).
    first_f: [f32; 3],
}

impl GhostNodes {
    /// Creates an empty set of ghost nodes that uses the given instruction set for its sums.
    pub fn new(instructions: InstructionSet) -> Self {
        Self { lists: NeighbourLists::new(instructions), ..Self::default() }
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        let points = (self.points.capacity() + self.sorted.capacity()) * size_of::<DVec3>();
        let sums = self.split.capacity() * size_of::<[f32; 4]>() + self.sums.capacity() * size_of::<NodeSums>();
        let places = self.place_of.capacity() * size_of::<u32>() + self.densities.capacity() * size_of::<f64>();
        points + sums + places + self.bins.bytes() + self.lists.bytes()
    }

    /// Computes the density of each boundary particle from the water around its ghost node.
    pub fn densities(
        &mut self,
        grid: &Grid,
        parameters: &Parameters,
        water: &Sources,
        records: &[Record],
        boundary: &mut Boundary,
    ) {
        let (count, h) = (boundary.len(), parameters.kernel.h);
        self.points.resize(count, DVec3::ZERO);
        (&mut self.points, &boundary.position, &boundary.to_surface)
            .into_par_iter()
            .with_min_len(MIN_CHUNK)
            .for_each(|(point, &position, &to_surface)| *point = position + (to_surface + beyond(to_surface, h)));
        self.bins.sort(grid, &self.points);
        self.sorted.resize(count, DVec3::ZERO);
        self.split.resize(count, [0.0; 4]);
        let points = &self.points;
        (&mut self.sorted, &mut self.split, &self.bins.order).into_par_iter().with_min_len(MIN_CHUNK).for_each(
            |(sorted, split, &i)| {
                *sorted = points[i as usize];
                *split = split_position(grid, *sorted);
            },
        );
        self.lists.build(grid, &self.bins, &self.sorted, std::slice::from_ref(water), parameters.kernel.support());

        self.sums.resize(self.sorted.len(), NodeSums::default());
        let bin_x = grid.size.x as f32;
        let nothing = vec![[0.0; 0]; count];
        sum_around_nodes(parameters, bin_x, &self.split, &nothing, &self.lists, records, &mut self.sums);
        self.densities.resize(count, 0.0);
        (&mut self.densities, &self.sums, &self.bins.order)
            .into_par_iter()
            .with_min_len(MIN_CHUNK)
            .for_each(|(density, sums, &i)| *density = sums.density_at(parameters, boundary.to_surface[i as usize]));
        self.place_of.resize(count, 0);
        for (place, &i) in self.bins.order.iter().enumerate() {
            self.place_of[i as usize] = place as u32;
        }
        let densities = &self.densities;
        (&mut boundary.density, &self.place_of)
            .into_par_iter()
            .with_min_len(MIN_CHUNK)
            .for_each(|(density, &place)| *density = densities[place as usize]);
    }
}

impl NodeTerms<17, 0> for NodeSums {
    #[inline(always)]
    fn add<L: Lanes>(sums: &mut [L; 17], _: &[L; 0], pair: &Pair<L>, b: &Record) {
        let Pair { r: [x, y, z], wv, gv } = *pair;
        let f = L::splat(b.excess_density);
        let (gx, gy, gz) = (gv * x, gv * y, gv * z);
        // With one array the compiler keeps the sums in registers; with several arrays it does not.
        let products = [
            (wv, x),
            (wv, y),
            (wv, z),
            (wv, f),
            (gv, x),
            (gv, y),
            (gv, z),
            (gx, x),
            (gy, y),
            (gz, z),
            (gx, y),
            (gx, z),
            (gy, z),
            (gx, f),
            (gy, f),
            (gz, f),
        ];
        sums[0] += wv;
        for (sum, (a, b)) in sums[1..].iter_mut().zip(products) {
            *sum = a.mul_add(b, *sum);
        }
    }

    fn factors(w: f32, g: f32, h: f32) -> [f32; 17] {
        std::array::from_fn(|k| match k {
            0 | 4 => w,
            1..4 => w / h,
            8..14 => g / (h * h),
            _ => g / h,
        })
    }

    fn of_sums(sums: [f32; 17]) -> Self {
        Self {
            value: std::array::from_fn(|k| sums[k]),
            value_f: sums[4],
            first: std::array::from_fn(|k| sums[5 + k]),
            second: std::array::from_fn(|k| sums[8 + k]),
            first_f: std::array::from_fn(|k| sums[14 + k]),
        }
    }
}

/// Returns the vector from the surface point of a boundary particle to its ghost node [m]. `to_surface` is the vector
/// to the surface point [m], and `h` the smoothing length [m].
fn beyond(to_surface: DVec3, h: f64) -> DVec3 {
    let way = to_surface.truncate().length();
    if way <= LONGEST_WAY * h {
        to_surface
    } else {
        (to_surface.truncate() * (LONGEST_WAY * h / way)).extend(to_surface.z)
    }
}

impl NodeSums {
    /// Returns the density of the boundary particle [kg/m3]; `to_surface` [m] is the vector from the particle to its
    /// surface point.
    fn density_at(&self, parameters: &Parameters, to_surface: DVec3) -> f64 {
        let rho0 = parameters.tait.rho0;
        let occupied = f64::from(self.value[0]);
        if occupied < DRY_LIMIT {
            return rho0;
        }
        let h = parameters.kernel.h;
        // Vector from the node to the boundary particle, or to the same level at most `LONGEST_WAY` behind the surface
        // [h].
        let back = -2.0 * beyond(to_surface, h) / h;
        let hydrostatic = -rho0 * parameters.gravity / parameters.tait.c0.powi(2);
        let above_centroid = back.z - f64::from(self.value[3]) / occupied;
        let around = f64::from(self.value_f) / occupied;
        let mean = around + hydrostatic * above_centroid * parameters.kernel.h;
        let trust = self.trust(to_surface);
        let fitted = || self.value_and_gradient(f64::from(self.value_f), self.first_f.map(f64::from));
        let excess = match (trust > 0.0).then(fitted).flatten() {
            Some([f, fx, fy, fz]) => mean + trust * (f + DVec3::new(fx, fy, fz).dot(back) - mean),
            None => mean,
        };
        // A wall pulls no more than the water around the node. Between a wall and a thin sheet, air would enter, so
        // that the wall does not pull there.
        let lowest = parameters.lowest_density.map_or(0.0, |density| trust * around.clamp(density - rho0, 0.0));
        rho0 + excess.max(lowest)
    }

    /// Returns the trust in the fitted gradient, from 0 (only the fallback) to 1 (only the four equations);
    /// `to_surface` [m] is the vector from the boundary particle to its surface point.
    pub(super) fn trust(&self, to_surface: DVec3) -> f64 {
        let [occupied, x, y, z] = self.value.map(f64::from);
        let [xx, yy, zz, xy, xz, yz] = self.second.map(f64::from);
        let normal = to_surface.normalize_or_zero();
        let behind = -DVec3::new(x, y, z).dot(normal) / occupied;
        let along = DVec3::new(
            DVec3::new(xx, xy, xz).dot(normal),
            DVec3::new(xy, yy, yz).dot(normal),
            DVec3::new(xz, yz, zz).dot(normal),
        );
        let spread = along.dot(normal) / occupied;
        let position_trust =
            ((CENTROID_LIMITS[1] - behind) / (CENTROID_LIMITS[1] - CENTROID_LIMITS[0])).clamp(0.0, 1.0);
        let layer_trust = ((spread - SPREAD_LIMITS[0]) / (SPREAD_LIMITS[1] - SPREAD_LIMITS[0])).clamp(0.0, 1.0);
        position_trust * layer_trust
    }

    /// Returns the solution [f, h grad f] of the four equations for the given left-hand sides, or `None` if the
    /// equations are ill-conditioned.
    fn value_and_gradient(&self, value_f: f64, [fx, fy, fz]: [f64; 3]) -> Option<[f64; 4]> {
        let [a, b, c, d] = self.matrix();
        let append = |[k, x, y, z]: [f64; 4], right: f64| [k, x, y, z, right];
        self.solve([append(a, value_f), append(b, fx), append(c, fy), append(d, fz)])
    }

    /// Returns four weights; f at the node is the weighted sum of the four left-hand sides. The weights solve the
    /// transposed equations and are the same for every field.
    pub(super) fn weights(&self) -> Option<[f64; 4]> {
        let matrix = self.matrix();
        let column = |k: usize| [matrix[0][k], matrix[1][k], matrix[2][k], matrix[3][k], f64::from(u8::from(k == 0))];
        self.solve([column(0), column(1), column(2), column(3)])
    }

    fn solve(&self, rows: [[f64; 5]; 4]) -> Option<[f64; 4]> {
        solve(rows, MIN_DETERMINANT * f64::from(self.value[0]).powi(4))
    }

    /// Returns the matrix of the four equations.
    fn matrix(&self) -> [[f64; 4]; 4] {
        let [w, wx, wy, wz] = self.value.map(f64::from);
        let [gx, gy, gz] = self.first.map(f64::from);
        let [xx, yy, zz, xy, xz, yz] = self.second.map(f64::from);
        // In a two-dimensional flume all neighbours lie in the plane of the node, so sum g V yy is zero. Use the value
        // of a full neighbourhood.
        let yy = if yy == 0.0 { w } else { yy };
        [[w, wx, wy, wz], [gx, xx, xy, xz], [gy, xy, yy, yz], [gz, xz, yz, zz]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns sums over water that has its centroid at (0, 0, z) h from the node, the `spread` along z [h2] and the
    /// excess density `f` [kg/m3].
    fn layer(z: f32, spread: f32, f: f32) -> NodeSums {
        let second = [0.3, 0.3, 0.3 * spread, 0.0, 0.0, 0.0];
        NodeSums { value: [0.3, 0.0, 0.0, 0.3 * z], value_f: 0.3 * f, second, ..NodeSums::default() }
    }

    #[test]
    fn gradients_are_trusted_inside_the_water_and_not_above_a_thin_sheet() {
        let bed = DVec3::new(0.0, 0.0, 0.01);
        for (z, trust) in [(0.3, 1.0), (-0.1, 1.0), (-0.15, 0.5), (-0.2, 0.0), (-0.5, 0.0)] {
            assert!((layer(z, 0.74, 0.0).trust(bed) - trust).abs() < 1e-6, "{z}");
        }
        // If the boundary is a ceiling, the same water lies on the far side of the node, and the trust is 1.
        assert_eq!(layer(-0.5, 0.74, 0.0).trust(-bed), 1.0);
        // The spreads occur with two layers of particles, three layers and deep water.
        for (spread, trust) in [(0.3, 0.0), (0.55, 0.5), (0.74, 1.0)] {
            assert!((layer(0.3, spread, 0.0).trust(bed) - trust).abs() < 1e-6, "{spread}");
        }
    }

    #[test]
    fn node_weights_give_the_same_value_as_the_equations() {
        let sums = NodeSums {
            value: [0.8, 0.05, -0.02, 0.1],
            first: [0.06, -0.03, 0.12],
            second: [0.8, 0.7, 0.6, 0.01, 0.02, -0.03],
            ..NodeSums::default()
        };
        let (value, first) = (0.3, [0.2, -0.1, 0.4]);
        let [f, ..] = sums.value_and_gradient(value, first).unwrap();
        let [a, b, c, d] = sums.weights().unwrap();
        // Limit 1e-12: rounding errors of two solutions.
        assert!((a * value + b * first[0] + c * first[1] + d * first[2] - f).abs() < 1e-12);
    }

    #[test]
    fn walls_pull_at_attached_water_that_is_under_suction() {
        let mut parameters = Parameters::published(0.01, 0.02, 30.0, 0.0, None);
        let (rho0, bed) = (parameters.tait.rho0, DVec3::new(0.0, 0.0, 0.005));
        for (lowest, densities) in [(None, [0.0; 3]), (Some(rho0 - 2.0), [-2.0, -1.0, 0.0])] {
            parameters.lowest_density = lowest;
            // Deep water, a sheet between deep and thin, and a thin sheet.
            for (z, expected) in [0.3, -0.15, -0.5].into_iter().zip(densities) {
                let density = layer(z, 0.74, -3.0).density_at(&parameters, bed);
                // Limit 1e-4: rounding of the sums, which are numbers of 32 bits.
                assert!((density - rho0 - expected).abs() < 1e-4, "{lowest:?}, {z}: {density}");
            }
        }
        // Weaker suction than the limit is not changed.
        let sums = layer(0.3, 0.74, -1.0);
        assert!((sums.density_at(&parameters, bed) - rho0 + 1.0).abs() < 1e-4);
        // The gradient lowers the density towards the boundary. It is not lower than the mean around the node, so
        // there is no suction if this mean is above rho0.
        for (mean, expected) in [(-1.0, -1.0), (0.5, 0.0)] {
            let sums = NodeSums { value_f: 0.3 * mean, first_f: [0.0, 0.0, 2.0], ..sums };
            assert!((sums.density_at(&parameters, bed) - rho0 - expected).abs() < 1e-4);
        }
    }

    #[test]
    fn walls_exert_pressure_but_no_suction_on_a_thin_sheet() {
        let parameters = Parameters::published(0.01, 0.02, 30.0, 9.81, None);
        let to_surface = DVec3::new(0.0, 0.0, 0.005);
        let rho0 = parameters.tait.rho0;
        let pressed = layer(-0.5, 0.0, 3.0).density_at(&parameters, to_surface);
        // `height` is from the boundary particle up to the centroid, which lies h / 2 below the ghost node.
        let height = 2.0 * to_surface.z - 0.5 * parameters.kernel.h;
        let expected = 3.0 + rho0 * parameters.gravity / parameters.tait.c0.powi(2) * height;
        assert!((pressed - rho0 - expected).abs() < 1e-6);
        assert_eq!(layer(-0.5, 0.0, -3.0).density_at(&parameters, to_surface), rho0);
    }
}
