//! Tetrahedral mesh of an armour unit: scaled to the size of the unit, checked against its surface, moved to a pose.

use glam::{DMat3, DQuat, DVec3};

use crate::femdem::mesh::{Body, Mesh, PreparedMesh, TriangleSet};
use crate::geometry::armour_unit::ArmourUnit;

/// Largest allowed distance of a surface node of the mesh from the surface of the unit, divided by the height of the
/// unit [-]. Faces of coarse meshes cut across round legs, but the nodes of these faces lie on the surface.
const OFF_SURFACE: f64 = 0.02;

/// Largest allowed relative difference in volume between mesh and unit [-]. Coarse meshes of units with round legs have
/// a few per cent less volume than the unit.
const OFF_VOLUME: f64 = 0.06;

/// Mesh of one unit in body axes [m], with the size of the unit in the case.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitMesh {
    mesh: Mesh,
    volume: f64,
    centre: DVec3,
    inertia: DMat3,
    edge: f64,
}

/// Pose and scale of a unit; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Rotation from body axes to axes fixed in space.
    pub rotation: DQuat,
    /// Position of the origin of the body axes [m].
    pub position: DVec3,
    /// Factor by which the lengths of the mesh are multiplied [-].
    pub scale: f64,
}

impl UnitMesh {
    /// Scales a mesh to the size of a unit.
    ///
    /// # Errors
    /// If the mesh is not a mesh of the unit. The text gives the reason.
    pub fn fit(prepared: PreparedMesh, unit: &ArmourUnit) -> Result<Self, String> {
        let PreparedMesh { mut mesh, faces, quality } = prepared;
        let [_] = &mesh.bodies[..] else {
            return Err(format!("it has {} bodies; it must have one body, the unit", mesh.bodies.len()));
        };
        let reach = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let scale = reach(unit.solid().vertices()) / reach(&mesh.nodes);
        mesh.nodes.iter_mut().for_each(|node| *node *= scale);
        let expected = unit.solid().volume_properties().volume;
        let volume = quality[0].volume * scale.powi(3);
        if (volume / expected - 1.0).abs() > OFF_VOLUME {
            let percent = 100.0 * (volume / expected - 1.0);
            return Err(format!(
                "scaled to the unit's size, its volume differs from the unit's by {percent:+.1} %; check that it is a \
                 mesh of this unit"
            ));
        }
        for face in &faces.exteriors {
            for node in face.nodes.map(|k| mesh.tets[face.tet as usize][usize::from(k)]) {
                let point = mesh.nodes[node as usize];
                let off = unit.solid().signed_distance(point).abs() / unit.height();
                if off > OFF_SURFACE {
                    return Err(format!(
                        "scaled to the unit's size, its surface node {} is {:.1} % of the height away from the unit's \
                         surface; its origin must be the unit's centre of mass, and its axes the unit's axes \
                         (breakwater unit --gmsh)",
                        mesh.node_tags[node as usize],
                        100.0 * off
                    ));
                }
            }
        }
        mesh.bodies[0].name = Self::NAME.to_owned();
        mesh.sets.retain(TriangleSet::is_crack);
        mesh.node_sets.clear();
        Ok(Self::measured(mesh, volume, quality[0].edge_mean * scale))
    }

    /// Name of the body in the fracture cases.
    pub const NAME: &str = "unit";

    /// Computes the mass properties as in the solver: each corner of a tetrahedron gets a quarter of the volume of the
    /// tetrahedron. `edge` is the mean edge length [m].
    fn measured(mesh: Mesh, volume: f64, edge: f64) -> Self {
        let mut shares = vec![0.0; mesh.nodes.len()];
        for (number, tet) in mesh.tets.iter().enumerate() {
            let [a, b, c, d] = mesh.corners(number);
            let quarter = (b - a).cross(c - a).dot(d - a) / 24.0;
            tet.iter().for_each(|node| shares[*node as usize] += quarter);
        }
        let weighted = || mesh.nodes.iter().zip(&shares);
        let centre = weighted().map(|(x, share)| *x * *share).sum::<DVec3>() / volume;
        let inertia = weighted().fold(DMat3::ZERO, |sum, (x, share)| {
            let r = *x - centre;
            let outer = DMat3::from_cols(r * r.x, r * r.y, r * r.z);
            sum + (DMat3::from_diagonal(DVec3::splat(r.length_squared())) - outer) * *share
        });
        Self { mesh, volume, centre, inertia, edge }
    }

    /// Returns the volume of the tetrahedra [m3].
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Returns the mean edge length [m].
    pub fn edge(&self) -> f64 {
        self.edge
    }

    /// Returns the number of tetrahedra.
    pub fn tets(&self) -> usize {
        self.mesh.tets.len()
    }

    /// Returns the centre of mass of the nodes at a pose [m].
    pub fn centre(&self, pose: &Pose) -> DVec3 {
        pose.place(self.centre)
    }

    /// Returns the angular velocity [rad/s] at which the nodes have the same angular momentum as the rigid unit. The
    /// rigid unit has the inertia tensor per mass `inertia` in body axes [m2], the angular velocity `omega` [rad/s] and
    /// the rotation `rotation` from body axes to axes fixed in space.
    pub fn angular_velocity(&self, inertia: DMat3, rotation: DQuat, omega: DVec3) -> DVec3 {
        let in_body = rotation.inverse() * omega;
        rotation * ((self.inertia * (1.0 / self.volume)).inverse() * (inertia * in_body))
    }

    /// Returns the kinetic energy [J] of the nodes at a pose. The total mass is `mass` [kg], the velocity of the centre
    /// of mass is `velocity` [m/s], and the angular velocity is `omega` [rad/s].
    pub fn kinetic_energy(&self, mass: f64, pose: &Pose, velocity: DVec3, omega: DVec3) -> f64 {
        let in_body = pose.rotation.inverse() * omega;
        let inertia = self.inertia * (mass * pose.scale * pose.scale / self.volume);
        0.5 * (mass * velocity.length_squared() + in_body.dot(inertia * in_body))
    }

    /// Returns the mesh at a pose, with the name of its body.
    pub fn posed(&self, pose: &Pose, name: &str) -> Mesh {
        let nodes = self.mesh.nodes.iter().map(|node| pose.place(*node)).collect();
        let bodies = vec![Body { name: name.to_owned(), tets: 0..self.mesh.tets.len() }];
        let sets = self.mesh.sets.iter().map(|set| TriangleSet {
            // The cracks of two units need different names.
            name: if name == Self::NAME { set.name.clone() } else { format!("{}_{name}", set.name) },
            triangles: set.triangles.clone(),
        });
        Mesh { nodes, bodies, sets: sets.collect(), ..self.mesh.clone() }
    }
}

impl Pose {
    /// Transforms a point from body axes to space [m].
    pub fn place(&self, point: DVec3) -> DVec3 {
        self.position + self.rotation * (point * self.scale)
    }
}

/// Combines two meshes into one, without merging nodes. Tags count from one again.
pub fn combine(mut first: Mesh, second: Mesh) -> Mesh {
    let (nodes, tets) = (first.nodes.len() as u32, first.tets.len());
    first.nodes.extend(second.nodes);
    first.tets.extend(second.tets.iter().map(|tet| tet.map(|node| node + nodes)));
    first.bodies.extend(
        second.bodies.into_iter().map(|body| Body { tets: body.tets.start + tets..body.tets.end + tets, ..body }),
    );
    first.sets.extend(second.sets.into_iter().map(|set| TriangleSet {
        triangles: set.triangles.iter().map(|triangle| triangle.map(|node| node + nodes)).collect(),
        ..set
    }));
    first.node_tags = (1..=first.nodes.len() as u64).collect();
    first.tet_tags = (1..=first.tets.len() as u64).collect();
    first
}
