//! Size and shape of the tetrahedra of each body.
//!
//! A tetrahedron with the edges a, b, c at its first corner has the volume V = (a x b).c / 6. Its height over a face of
//! area A is h = 3 V / A. The angle between two faces with outward unit normals m, n has the cosine -m.n.

use glam::DVec3;

use super::defect::{MeshDefect, Spot};
use super::faces::LOCAL_FACES;
use super::{Body, Mesh};

/// A tetrahedron is flat if its volume, divided by the cube of its longest edge, is at most this value [-]. Its height
/// is then about 1e-9 times its longest edge, so rounding of the coordinates decides on which side of the face the
/// fourth corner lies.
const FLAT: f64 = 1e-10;

/// If the angle between two faces of a tetrahedron is below this limit [deg], the program warns. Such slivers have an
/// unrealistic stiffness, and their small height limits the time step. Gmsh's optimiser leaves angles of at least 10
/// deg.
pub const SHARP_DEG: f64 = 5.0;

/// Size and shape of the tetrahedra of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyQuality {
    /// Name of the body.
    pub body: String,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Volume [m3].
    pub volume: f64,
    /// Shortest edge [m].
    pub edge_min: f64,
    /// Mean edge length over all tetrahedra [m]; an edge counts once for each of its tetrahedra.
    pub edge_mean: f64,
    /// Longest edge [m].
    pub edge_max: f64,
    /// Smallest height of a corner over the opposite face [m].
    pub height_min: f64,
    /// Smallest angle between two faces of a tetrahedron [deg].
    pub angle_min_deg: f64,
    /// Number of tetrahedra with an angle below [`SHARP_DEG`].
    pub sharp: usize,
    /// The tetrahedron with the smallest angle.
    pub sharpest: Spot,
}

impl BodyQuality {
    /// Returns a warning if the mesh has slivers.
    pub fn warning(&self) -> Option<String> {
        (self.sharp > 0).then(|| {
            format!(
                "body {:?}: {} of {} tetrahedra have an angle between faces below {SHARP_DEG} deg; the smallest is \
                 {:.2} deg in {}. The smallest height of the body, {:.3e} m, limits the time step. Mesh.Optimize = 1 \
                 or Mesh.OptimizeNetgen = 1 in Gmsh removes most of these tetrahedra",
                self.body, self.sharp, self.tets, self.angle_min_deg, self.sharpest, self.height_min
            )
        })
    }
}

/// Returns six times the volume of a tetrahedron [m3]; negative for an inverted tetrahedron.
pub fn triple_product([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}

/// Returns size and shape of the tetrahedra of each body, or an error if a tetrahedron is inverted or flat.
pub fn measure(mesh: &Mesh) -> Result<Vec<BodyQuality>, MeshDefect> {
    mesh.bodies.iter().map(|body| check_volumes(mesh, body).map(|()| measure_body(mesh, body))).collect()
}

fn check_volumes(mesh: &Mesh, body: &Body) -> Result<(), MeshDefect> {
    let volumes: Vec<f64> = body.tets.clone().map(|tet| relative_volume(mesh.corners(tet))).collect();
    let inverted = |volume: &f64| *volume < -FLAT;
    // A NaN volume counts as flat.
    let flat = |volume: &f64| volume.is_nan() || volume.abs() <= FLAT;
    let found = |misfit: &dyn Fn(&f64) -> bool| {
        let tet = body.tets.start + volumes.iter().position(misfit)?;
        let first = Spot { tag: mesh.tet_tags[tet], at: mesh.centroid(tet) };
        Some((volumes.iter().filter(|volume| misfit(volume)).count(), first))
    };
    let (name, tets) = (body.name.clone(), body.tets.len());
    match (found(&inverted), found(&flat)) {
        (Some((count, _)), _) if count == tets => Err(MeshDefect::AllInverted { body: name, tets }),
        (Some((count, first)), _) => Err(MeshDefect::Inverted { body: name, count, tets, first }),
        (None, Some((count, first))) => Err(MeshDefect::Flat { body: name, count, tets, limit: FLAT, first }),
        (None, None) => Ok(()),
    }
}

/// Returns the volume divided by the cube of the longest edge [-]; 0.12 for a regular tetrahedron.
fn relative_volume(corners: [DVec3; 4]) -> f64 {
    triple_product(corners) / 6.0 / edges(corners).into_iter().fold(0.0, f64::max).powi(3)
}

fn measure_body(mesh: &Mesh, body: &Body) -> BodyQuality {
    let mut quality = BodyQuality {
        body: body.name.clone(),
        tets: body.tets.len(),
        volume: 0.0,
        edge_min: f64::INFINITY,
        edge_mean: 0.0,
        edge_max: 0.0,
        height_min: f64::INFINITY,
        angle_min_deg: 180.0,
        sharp: 0,
        sharpest: Spot { tag: 0, at: DVec3::ZERO },
    };
    for tet in body.tets.clone() {
        let corners = mesh.corners(tet);
        let volume = triple_product(corners) / 6.0;
        quality.volume += volume;
        for edge in edges(corners) {
            quality.edge_min = quality.edge_min.min(edge);
            quality.edge_max = quality.edge_max.max(edge);
            quality.edge_mean += edge;
        }
        let areas = area_vectors(corners);
        let largest = areas.iter().map(|area| area.length()).fold(0.0, f64::max);
        quality.height_min = quality.height_min.min(3.0 * volume / largest);
        let angle = smallest_angle_deg(areas);
        quality.sharp += usize::from(angle < SHARP_DEG);
        if angle < quality.angle_min_deg {
            quality.angle_min_deg = angle;
            quality.sharpest = Spot { tag: mesh.tet_tags[tet], at: mesh.centroid(tet) };
        }
    }
    quality.edge_mean /= (6 * body.tets.len()) as f64;
    quality
}

/// Returns the lengths of the edges [m].
fn edges([a, b, c, d]: [DVec3; 4]) -> [f64; 6] {
    [b - a, c - a, d - a, c - b, d - b, d - c].map(DVec3::length)
}

/// Returns the outward area vectors of the faces [m2].
fn area_vectors(corners: [DVec3; 4]) -> [DVec3; 4] {
    LOCAL_FACES.map(|face| {
        let [a, b, c] = face.map(|v| corners[v as usize]);
        (b - a).cross(c - a) / 2.0
    })
}

/// Returns the smallest angle between two faces [deg] from the outward area vectors of the faces.
fn smallest_angle_deg(areas: [DVec3; 4]) -> f64 {
    let normals = areas.map(DVec3::normalize_or_zero);
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let cosines = pairs.map(|(i, j)| -normals[i].dot(normals[j]));
    cosines.into_iter().fold(-1.0, f64::max).min(1.0).acos().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::super::block::{Pattern, block};
    use super::*;

    /// Returns the mesh of one tetrahedron with three edges of 1 m along the axes: the corner of a cube.
    fn corner() -> Mesh {
        Mesh {
            nodes: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            node_tags: vec![1, 2, 3, 4],
            tets: vec![[0, 1, 2, 3]],
            tet_tags: vec![7],
            bodies: vec![Body { name: "corner".to_owned(), tets: 0..1 }],
            sets: Vec::new(),
            node_sets: Vec::new(),
        }
    }

    #[test]
    fn sizes_of_a_cube_corner_have_their_textbook_values() {
        let quality = &measure(&corner()).unwrap()[0];
        let close = |value: f64, expected: f64| (value - expected).abs() < 1e-14 * expected;
        assert!(close(quality.volume, 1.0 / 6.0));
        assert_eq!((quality.tets, quality.edge_min), (1, 1.0));
        assert!(close(quality.edge_max, 2f64.sqrt()) && close(quality.edge_mean, (1.0 + 2f64.sqrt()) / 2.0));
        assert!(close(quality.height_min, 1.0 / 3f64.sqrt()));
        assert!(close(quality.angle_min_deg, (1.0 / 3f64.sqrt()).acos().to_degrees()));
        assert_eq!(quality.warning(), None);
    }

    #[test]
    fn a_regular_tetrahedron_has_equal_angles() {
        let mut mesh = corner();
        mesh.nodes =
            vec![DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0), DVec3::new(-1.0, -1.0, 1.0)];
        mesh.tets[0].swap(0, 1);
        let quality = &measure(&mesh).unwrap()[0];
        assert!((quality.angle_min_deg - (1f64 / 3.0).acos().to_degrees()).abs() < 1e-12);
        assert!((quality.height_min - 4.0 / 3f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn slivers_give_a_warning_with_their_position() {
        let mut mesh = corner();
        mesh.nodes[3] = DVec3::new(0.5, 0.5, 0.02);
        let quality = &measure(&mesh).unwrap()[0];
        let warning = quality.warning().unwrap();
        assert!(quality.sharp == 1 && warning.contains("1 of 1") && warning.contains("7 at (0.375"), "{warning}");
        assert!(quality.angle_min_deg < SHARP_DEG);
    }

    #[test]
    fn inverted_and_flat_tetrahedra_are_counted_and_reported() {
        let good = block(DVec3::ONE, [2; 3], Pattern::Diagonal);
        let mut mirrored = good.clone();
        mirrored.nodes.iter_mut().for_each(|node| node.x = -node.x);
        assert_eq!(measure(&mirrored), Err(MeshDefect::AllInverted { body: "block".to_owned(), tets: 48 }));
        let mut some = good.clone();
        some.tets[3].swap(0, 1);
        some.tets[5].swap(0, 1);
        let message = measure(&some).unwrap_err().to_string();
        assert!(message.contains("2 of 48") && message.contains("the first is 4 at ("), "{message}");
        for height in [DVec3::ZERO, DVec3::Z * 1e-12, DVec3::NAN, DVec3::INFINITY, DVec3::MAX] {
            let mut flat = corner();
            flat.nodes[3] = height;
            assert!(matches!(measure(&flat), Err(MeshDefect::Flat { count: 1, .. })), "{height}");
        }
        let mut twice = corner();
        twice.tets[0] = [0, 1, 2, 2];
        assert!(matches!(measure(&twice), Err(MeshDefect::Flat { .. })));
    }
}
