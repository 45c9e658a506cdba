//! A force and a moment at a point, distributed over the faces near the point: an impact, or the load of water on a
//! unit.
//!
//! Every vertex i of the tetrahedra at the loaded faces gets a share w_i of the force. X_i is its position in the
//! undeformed body, x_i its current position, and P the given point of action in the undeformed body. The shares
//! satisfy sum w_i = 1 and sum w_i X_i = P. For any deformation, the resultant of the forces on the vertices is the
//! given force. It acts at the point p = sum w_i x_i of the deformed body. The first term of w_i is the share A_i / A
//! of a uniform stress on the loaded faces. The second term moves the point of action to P:
//!
//! w_i = A_i / A + m_i (X_i - C) . S^-1 (P - sum A_j X_j / A),  S = sum m_i (X_i - C)(X_i - C)^T
//!
//! A_i is a third of the area of the loaded faces at vertex i, and A the area of all loaded faces. The weight m_i is a
//! quarter of the volume of the tetrahedron of vertex i, divided by the volume of all tetrahedra at the loaded faces. C
//! and c are the centroids, weighted by m_i, in the undeformed and in the current body. A moment M is applied as the
//! forces m_i theta x (x_i - c) (cross product), with theta = J^-1 M. J is the inertia tensor about c of the weights
//! m_i at the positions x_i.

use glam::{DMat3, DVec3};
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle;

use super::history::History;
use super::{Configuration, CornerForce, vertex};
use crate::femdem::mesh::PreparedMesh;
use crate::femdem::mesh::faces::Exterior;

/// Number of iterations of the polar decomposition. The iteration converges quadratically, so this number is sufficient
/// for strains of a few per cent.
const ROUNDS: usize = 12;

/// Axes in which the components of a force are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Axes fixed in space.
    Space,
    /// Axes of the undeformed body, which rotate with the tetrahedra at the loaded faces.
    Body,
}

/// A vertex that receives a share of a load.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    tet: u32,
    corner: u8,
    /// Share of the force, w_i [-]; see the comment of this module.
    share: f64,
    /// Weight m_i [-].
    weight: f64,
    /// Undeformed position relative to the centroid, X_i - C [m].
    arm: DVec3,
}

/// A force and a moment at a point, distributed over the vertices of tetrahedra at the loaded faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    corners: Vec<Corner>,
    /// Inverse of the matrix S in the comment of this module [1/m2].
    inverse_spread: DMat3,
    axes: Axes,
    /// Force [N] and moment about the point [N m].
    history: History<6>,
}

/// Faces near a point.
#[derive(Debug, Clone, PartialEq)]
pub struct NearFaces {
    /// The faces.
    pub faces: Vec<Exterior>,
    /// Distance of the point from the nearest face [m].
    pub distance: f64,
    /// Longest edge of the nearest face [m].
    pub edge: f64,
}

/// Finds those exterior faces of a body that have their centre within a radius [m] around a point [m]. If there is no
/// such face, returns the nearest face.
pub fn faces_near(mesh: &PreparedMesh, body: usize, point: DVec3, radius: f64) -> NearFaces {
    let tets = &mesh.mesh.bodies[body].tets;
    let own = mesh.faces.exteriors.iter().filter(|face| tets.contains(&(face.tet as usize)));
    let corners = |face: &Exterior| {
        face.nodes.map(|corner| mesh.mesh.nodes[mesh.mesh.tets[face.tet as usize][usize::from(corner)] as usize])
    };
    let mut near = NearFaces { faces: Vec::new(), distance: f64::INFINITY, edge: 0.0 };
    let mut nearest = None;
    for face in own {
        let [a, b, c] = corners(face);
        if ((a + b + c) / 3.0).distance(point) <= radius {
            near.faces.push(*face);
        }
        let distance = Triangle::new(a, b, c).distance_to_local_point(point, true);
        if distance < near.distance {
            near.distance = distance;
            near.edge = a.distance(b).max(b.distance(c)).max(c.distance(a));
            nearest = Some(*face);
        }
    }
    if near.faces.is_empty() {
        near.faces.extend(nearest);
    }
    near
}

impl Corner {
    /// Returns the current position of the vertex [m].
    fn current(&self, configuration: &Configuration) -> DVec3 {
        vertex(configuration.current, self.tet, self.corner)
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

impl Patch {
    /// Creates a load on faces of a mesh, with a force that acts at a point [m]. The history contains the force [N] and
    /// the moment about the point [N m].
    ///
    /// # Panics
    /// If there is no face.
    pub fn new(mesh: &PreparedMesh, faces: &[Exterior], point: DVec3, axes: Axes, history: History<6>) -> Self {
        assert!(!faces.is_empty(), "a load needs at least one face");
        let mut tets: Vec<u32> = faces.iter().map(|face| face.tet).collect();
        tets.sort_unstable();
        tets.dedup();
        let corners_of = |tet: u32| mesh.mesh.corners(tet as usize);
        let volume = |tet: u32| {
            let [a, b, c, d] = corners_of(tet);
            (b - a).cross(c - a).dot(d - a) / 6.0
        };
        let all: f64 = tets.iter().map(|tet| volume(*tet)).sum();
        let mut corners = Vec::with_capacity(4 * tets.len());
        for tet in &tets {
            let weight = 0.25 * volume(*tet) / all;
            corners.extend((0..4).zip(corners_of(*tet)).map(|(corner, x)| Corner {
                tet: *tet,
                corner,
                share: 0.0,
                weight,
                arm: x,
            }));
        }
        let centroid: DVec3 = corners.iter().map(|corner| corner.arm * corner.weight).sum();
        corners.iter_mut().for_each(|corner| corner.arm -= centroid);
        let area = |face: &Exterior| {
            let [a, b, c] = face.nodes.map(|corner| corners_of(face.tet)[usize::from(corner)]);
            0.5 * (b - a).cross(c - a).length()
        };
        let total: f64 = faces.iter().map(area).sum();
        for face in faces {
            // `face.tet` is always found, because `tets` contains the tetrahedron of every face.
            let first = 4 * tets.partition_point(|tet| *tet < face.tet);
            for corner in face.nodes {
                corners[first + usize::from(corner)].share += area(face) / (3.0 * total);
            }
        }
        let spread = |corners: &[Corner]| {
            corners.iter().fold(DMat3::ZERO, |sum, corner| sum + outer(corner.arm, corner.arm) * corner.weight)
        };
        let inverse_spread = spread(&corners).inverse();
        // The second pass removes the rounding errors of the first.
        for _ in 0..2 {
            let missing = point - centroid - corners.iter().map(|corner| corner.arm * corner.share).sum::<DVec3>();
            let slope = inverse_spread * missing;
            corners.iter_mut().for_each(|corner| corner.share += corner.weight * slope.dot(corner.arm));
        }
        Self { corners, inverse_spread, axes, history }
    }

    /// Returns the current position of the point of action [m].
    pub fn position(&self, configuration: &Configuration) -> DVec3 {
        self.corners.iter().map(|corner| corner.current(configuration) * corner.share).sum()
    }

    /// Returns the prescribed force [N] and moment about the point [N m] at a time [s], in axes fixed in space.
    pub fn prescribed(&self, configuration: &Configuration, time: f64) -> [DVec3; 2] {
        let values = self.history.at(time);
        let given = [0, 3].map(|k| DVec3::from_slice(&values[k..k + 3]));
        match self.axes {
            Axes::Space => given,
            Axes::Body => {
                let rotation = self.rotation(configuration);
                given.map(|v| rotation * v)
            }
        }
    }

    /// Returns the current centroid of the loaded tetrahedra [m].
    fn centroid(&self, configuration: &Configuration) -> DVec3 {
        self.corners.iter().map(|corner| corner.current(configuration) * corner.weight).sum()
    }

    /// Returns the rotation of the loaded tetrahedra since the start: the rotation in the polar decomposition of the
    /// affine map that best fits the motion of the vertices. The decomposition uses Higham's iteration (1986).
    fn rotation(&self, configuration: &Configuration) -> DMat3 {
        let centroid = self.centroid(configuration);
        let moved = |corner: &Corner| outer(corner.current(configuration) - centroid, corner.arm) * corner.weight;
        let mut rotation =
            self.corners.iter().fold(DMat3::ZERO, |sum, corner| sum + moved(corner)) * self.inverse_spread;
        for _ in 0..ROUNDS {
            rotation = (rotation + rotation.inverse().transpose()) * 0.5;
        }
        rotation
    }

    /// Appends the forces of the load at a time [s] to `out`.
    pub(super) fn forces(&self, configuration: &Configuration, time: f64, out: &mut Vec<CornerForce>) {
        let [force, moment] = self.prescribed(configuration, time);
        let centroid = self.centroid(configuration);
        let arm = |corner: &Corner| corner.current(configuration) - centroid;
        let theta = if moment == DVec3::ZERO {
            DVec3::ZERO
        } else {
            let inertia = self.corners.iter().fold(DMat3::ZERO, |sum, corner| {
                let r = arm(corner);
                sum + (DMat3::IDENTITY * r.length_squared() - outer(r, r)) * corner.weight
            });
            inertia.inverse() * moment
        };
        out.extend(self.corners.iter().map(|corner| {
            let force = force * corner.share + theta.cross(arm(corner)) * corner.weight;
            CornerForce { tet: corner.tet, corner: corner.corner, force }
        }));
    }
}
