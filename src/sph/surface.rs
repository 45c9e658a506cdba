//! Surface of the water as triangles, reconstructed from the particles for films and pictures.
//!
//! The crate `splashsurf_lib` sums volume times kernel over the particles on the corners of a grid, and lays triangles
//! where the sum passes a threshold (marching cubes). The volume of a particle follows from the density that the crate
//! computes from the positions. The triangles form closed surfaces: they also cover the water at the bed, at the walls
//! and at the ends of the domain.

use splashsurf_lib::{
    Parameters, SpatialDecomposition, SurfaceReconstruction,
    mesh::{Mesh3d, TriMesh3d},
    nalgebra::{SVector, Vector3},
    postprocessing::par_laplacian_smoothing_inplace,
    reconstruct_surface,
    sph_interpolation::SphInterpolator,
};

/// Distance at which the kernel becomes zero [particle spacings].
const SUPPORT: f32 = 2.0;
/// Edge length of the grid cells [particle spacings].
const CELL: f32 = 1.0;
/// Sum of volume times kernel at the surface [-]. With this value, a cube and a sphere have the right volume and area
/// (see the tests).
const THRESHOLD: f32 = 0.55;
/// Number of smoothing passes. Each moves every point to the mean of its neighbours. One pass removes most of the steps
/// that particles on a lattice make in a sloping surface.
const PASSES: usize = 1;

/// Water particles of one spacing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cloud {
    /// Particle spacing [m].
    pub spacing: f32,
    /// Position of each particle [m].
    pub position: Vec<[f32; 3]>,
    /// Velocity of each particle [m/s].
    pub velocity: Vec<[f32; 3]>,
    /// Pressure of each particle [Pa].
    pub pressure: Vec<f32>,
}

/// Surface of the water, with the flow at its points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surface {
    /// Points [m].
    pub points: Vec<[f32; 3]>,
    /// Indices of the three corner points of each triangle, in counter-clockwise order for a viewer outside the water.
    pub triangles: Vec<[u32; 3]>,
    /// Velocity of the water at each point [m/s].
    pub velocity: Vec<[f32; 3]>,
    /// Pressure of the water at each point [Pa].
    pub pressure: Vec<f32>,
}

impl Surface {
    /// Reconstructs the surface of the water. Velocity and pressure are means of the particles nearby, weighted with
    /// the kernel (Shepard interpolation).
    ///
    /// Parallel loops of the crate run in the current thread pool of rayon.
    ///
    /// # Errors
    /// The message of the crate, if it cannot reconstruct the surface.
    pub fn of(water: &Cloud) -> Result<Self, String> {
        if water.position.is_empty() {
            return Ok(Self::default());
        }
        let support = SUPPORT * water.spacing;
        let positions = vectors(&water.position);
        let mut parameters = Parameters::new(0.5 * water.spacing, support, CELL * water.spacing);
        parameters.iso_surface_threshold = THRESHOLD;
        // One thread and one grid: the order of points and triangles is then always the same. Parts of a grid would come
        // in an order that depends on the number of cores.
        parameters.enable_multi_threading = false;
        parameters.spatial_decomposition = SpatialDecomposition::None;
        let made: SurfaceReconstruction<i64, f32> =
            reconstruct_surface(&positions, &parameters).map_err(|error| error.to_string())?;
        let mut mesh: TriMesh3d<f32> = made.into();
        let neighbours = mesh.vertex_vertex_connectivity();
        let weights = vec![1.0; mesh.vertices.len()];
        par_laplacian_smoothing_inplace(&mut mesh, &neighbours, PASSES, 1.0, &weights);

        let interpolator = SphInterpolator::new(&positions, &vec![1.0; positions.len()], 1.0, support);
        // Velocity and pressure together, because the search for the particles nearby takes most of the time.
        let flow: Vec<SVector<f32, 4>> =
            water.velocity.iter().zip(&water.pressure).map(|([x, y, z], p)| SVector::from([*x, *y, *z, *p])).collect();
        let flow = interpolator.interpolate_vector_quantity(&flow, &mesh.vertices, true);
        Ok(Self {
            velocity: flow.iter().map(|values| [values[0], values[1], values[2]]).collect(),
            pressure: flow.iter().map(|values| values[3]).collect(),
            points: mesh.vertices.iter().map(|point| (*point).into()).collect(),
            triangles: mesh.triangles.iter().map(|corners| corners.map(|corner| corner as u32)).collect(),
        })
    }

    /// Appends another surface.
    pub fn append(&mut self, other: &Self) {
        let first = self.points.len() as u32;
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
        self.points.extend(&other.points);
        self.velocity.extend(&other.velocity);
        self.pressure.extend(&other.pressure);
    }

    /// Keeps the triangles whose centre has an x in the range from the first value to below the second value [m], and
    /// the points of these triangles.
    pub fn between(&self, [from, to]: [f32; 2]) -> Self {
        let mut number = vec![u32::MAX; self.points.len()];
        let mut kept = Self::default();
        for corners in &self.triangles {
            let centre = corners.iter().map(|corner| self.points[*corner as usize][0]).sum::<f32>() / 3.0;
            if !(from..to).contains(&centre) {
                continue;
            }
            kept.triangles.push(corners.map(|corner| {
                let old = corner as usize;
                if number[old] == u32::MAX {
                    number[old] = kept.points.len() as u32;
                    kept.points.push(self.points[old]);
                    kept.velocity.push(self.velocity[old]);
                    kept.pressure.push(self.pressure[old]);
                }
                number[old]
            }));
        }
        kept
    }
}

fn vectors(arrays: &[[f32; 3]]) -> Vec<Vector3<f32>> {
    arrays.iter().map(|array| Vector3::from(*array)).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const SPACING: f32 = 0.01;

    /// Returns particles on a lattice of `count` positions in each direction around the origin, with a velocity and a
    /// pressure that vary linearly in space.
    fn lattice(count: i32, is_water: impl Fn([f32; 3]) -> bool) -> Cloud {
        let at = |index: i32| (index as f32 + 0.5 - 0.5 * count as f32) * SPACING;
        let all = (0..count * count * count).map(|i| [at(i % count), at(i / count % count), at(i / count / count)]);
        let position: Vec<[f32; 3]> = all.filter(|place| is_water(*place)).collect();
        Cloud {
            spacing: SPACING,
            velocity: position.iter().map(|p| [2.0 * p[2], 0.0, 1.0]).collect(),
            pressure: position.iter().map(|p| 500.0 - 1000.0 * p[2]).collect(),
            position,
        }
    }

    /// Area [m2] and enclosed volume [m3] of a surface.
    fn area_and_volume(surface: &Surface) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for corners in &surface.triangles {
            let [a, b, c] = corners.map(|corner| glam::Vec3::from_array(surface.points[corner as usize]).as_dvec3());
            let normal = (b - a).cross(c - a);
            sums[0] += 0.5 * normal.length();
            sums[1] += a.dot(normal) / 6.0;
        }
        sums
    }

    #[test]
    fn a_cube_and_a_sphere_have_their_area_and_volume() {
        let count = 60;
        let side = f64::from(count) * f64::from(SPACING);
        let cube = Surface::of(&lattice(count, |_| true)).unwrap();
        let radius = 0.5 * side;
        let sphere = Surface::of(&lattice(count, |p| glam::Vec3::from_array(p).length() < radius as f32)).unwrap();
        let exact = [[6.0 * side.powi(2), side.powi(3)], [4.0 * PI * radius.powi(2), 4.0 / 3.0 * PI * radius.powi(3)]];
        // Limit 2 %. The edges of the cube become round over about one spacing, which costs 1.7 % of its area.
        for (surface, exact) in [cube, sphere].iter().zip(exact) {
            for (value, exact) in area_and_volume(surface).into_iter().zip(exact) {
                assert!((value / exact - 1.0).abs() < 0.02, "{value} instead of {exact}");
            }
        }
    }

    #[test]
    fn the_flow_at_the_surface_is_that_of_the_particles_nearby() {
        let surface = Surface::of(&lattice(12, |_| true)).unwrap();
        for ((point, velocity), pressure) in surface.points.iter().zip(&surface.velocity).zip(&surface.pressure) {
            // The surface lies outside of the particles, whose mean is nearer to the middle. Limit: one spacing.
            assert!((velocity[0] - 2.0 * point[2]).abs() < 2.0 * SPACING && (velocity[2] - 1.0).abs() < 1e-5);
            assert!((pressure - (500.0 - 1000.0 * point[2])).abs() < 1000.0 * SPACING, "{pressure} at {point:?}");
        }
    }

    #[test]
    fn the_same_water_gives_the_same_bits_and_no_water_gives_no_surface() {
        // 100 spacings along x: the crate would divide a grid of more than 76 cells.
        let water = lattice(100, |p| p[1].abs() < 0.05 && (p[2].abs() < 0.03 || p[0] > 0.4));
        assert_eq!(Surface::of(&water).unwrap(), Surface::of(&water).unwrap());
        assert_eq!(Surface::of(&Cloud::default()).unwrap(), Surface::default());
    }

    #[test]
    fn two_parts_of_a_surface_make_the_whole() {
        let whole = Surface::of(&lattice(12, |_| true)).unwrap();
        let mut both = whole.between([f32::NEG_INFINITY, 0.013]);
        assert!(both.triangles.len() < whole.triangles.len() && both.points.len() < whole.points.len());
        both.append(&whole.between([0.013, f32::INFINITY]));
        assert_eq!(both.triangles.len(), whole.triangles.len());
        let [area, volume] = area_and_volume(&both);
        let [expected_area, expected_volume] = area_and_volume(&whole);
        // Limit 1e-9: the sums have another order.
        assert!((area / expected_area - 1.0).abs() < 1e-9 && (volume / expected_volume - 1.0).abs() < 1e-9);
    }
}
