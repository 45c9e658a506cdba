//! Tetrahedra of a unit: brought to its size, checked against its surface, posed.

use glam::{DMat3, DQuat, DVec3};

use crate::femdem::mesh::{Body, Mesh, PreparedMesh, TriangleSet};
use crate::geometry::armour_unit::ArmourUnit;

/// Nodes of the outside may lie so far from the unit's surface, over its height [-]: faces of coarse meshes cut across
/// round legs, their nodes do not.
const OFF_SURFACE: f64 = 0.02;

/// The volume of the mesh may differ from the unit's by this share: coarse meshes of round legs lack some per cent.
const OFF_VOLUME: f64 = 0.06;

/// Mesh of one unit in body axes, in the size of the case [m].
#[derive(Debug, Clone, PartialEq)]
pub struct UnitMesh {
    mesh: Mesh,
    volume: f64,
    centre: DVec3,
    inertia: DMat3,
    edge: f64,
}

/// Where a unit is and how it moves; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Its rotation.
    pub rotation: DQuat,
    /// Place of the origin of its body axes [m].
    pub position: DVec3,
    /// Factor on the lengths of the mesh [-].
    pub scale: f64,
}

impl UnitMesh {
    /// Bring a mesh to the size of a unit.
    ///
    /// # Errors
    /// If it is not one of the unit, in words that say why.
    pub fn fit(prepared: PreparedMesh, unit: &ArmourUnit) -> Result<Self, String> {
        let PreparedMesh { mut mesh, faces, quality } = prepared;
        let [_] = &mesh.bodies[..] else {
            return Err(format!("it has {} bodies; the mesh of one unit alone is needed", mesh.bodies.len()));
        };
        let reach = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let scale = reach(unit.solid().vertices()) / reach(&mesh.nodes);
        mesh.nodes.iter_mut().for_each(|node| *node *= scale);
        let expected = unit.solid().volume_properties().volume;
        let volume = quality[0].volume * scale.powi(3);
        if (volume / expected - 1.0).abs() > OFF_VOLUME {
            let percent = 100.0 * (volume / expected - 1.0);
            return Err(format!("brought to the unit's size it has {percent:+.1} % of its volume more: another unit?"));
        }
        for face in &faces.exteriors {
            for node in face.nodes.map(|k| mesh.tets[face.tet as usize][usize::from(k)]) {
                let place = mesh.nodes[node as usize];
                let off = unit.solid().signed_distance(place).abs() / unit.height();
                if off > OFF_SURFACE {
                    return Err(format!(
                        "brought to the unit's size, node {} of its outside lies {:.1} % of the height off the unit's \
                         surface; its origin must be the centre of mass and its axes the unit's (breakwater unit --gmsh)",
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

    /// Name of the body in the cases that are written.
    pub const NAME: &str = "unit";

    /// Mass properties as the computation has them: a quarter of each tetrahedron at each of its corners.
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

    /// Volume of the tetrahedra [m3].
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Mean edge [m].
    pub fn edge(&self) -> f64 {
        self.edge
    }

    /// Tetrahedra.
    pub fn tets(&self) -> usize {
        self.mesh.tets.len()
    }

    /// Centre of mass of the nodes [m].
    pub fn centre(&self, pose: &Pose) -> DVec3 {
        pose.place(self.centre)
    }

    /// Angular velocity that gives the nodes the angular momentum of a rigid body with the inertia tensor `inertia` in body
    /// axes, for its mass 1 kg [m2], that turns at `omega` [rad/s].
    pub fn angular_velocity(&self, inertia: DMat3, rotation: DQuat, omega: DVec3) -> DVec3 {
        let in_body = rotation.inverse() * omega;
        rotation * ((self.inertia * (1.0 / self.volume)).inverse() * (inertia * in_body))
    }

    /// Kinetic energy [J] of the nodes with the given mass of all [kg] and factor of lengths.
    pub fn kinetic_energy(&self, mass: f64, pose: &Pose, velocity: DVec3, omega: DVec3) -> f64 {
        let in_body = pose.rotation.inverse() * omega;
        let inertia = self.inertia * (mass * pose.scale * pose.scale / self.volume);
        0.5 * (mass * velocity.length_squared() + in_body.dot(inertia * in_body))
    }

    /// The mesh at a place, its body named.
    pub fn posed(&self, pose: &Pose, name: &str) -> Mesh {
        let nodes = self.mesh.nodes.iter().map(|node| pose.place(*node)).collect();
        let bodies = vec![Body { name: name.to_owned(), tets: 0..self.mesh.tets.len() }];
        let sets = self.mesh.sets.iter().map(|set| TriangleSet {
            // Two units have their own cracks.
            name: if name == Self::NAME { set.name.clone() } else { format!("{}_{name}", set.name) },
            triangles: set.triangles.clone(),
        });
        Mesh { nodes, bodies, sets: sets.collect(), ..self.mesh.clone() }
    }
}

impl Pose {
    /// Where a point of the body axes is [m].
    pub fn place(&self, point: DVec3) -> DVec3 {
        self.position + self.rotation * (point * self.scale)
    }
}

/// Two meshes as one.
pub fn together(mut first: Mesh, second: Mesh) -> Mesh {
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
