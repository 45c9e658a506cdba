//! Loads: tractions and pressures on faces, forces and moments at a point.
//!
//! | file | contents |
//! | --- | --- |
//! | `history` | values that change with time |
//! | `patch` | a force and a moment at a point, distributed over the faces near the point |
//!
//! Forces act on node copies (vertices of tetrahedra), so node splitting does not affect the loads.

use glam::DVec3;

use super::mesh::faces::Exterior;

pub mod history;
pub mod patch;

use history::History;
use patch::Patch;

/// A load.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A traction: a force of fixed direction per area of the undeformed faces.
    Traction {
        /// Exterior faces.
        faces: Vec<Exterior>,
        /// Force per undeformed area [Pa].
        stress: DVec3,
        /// Factor by which the stress is multiplied, as a function of time [-].
        factor: History<1>,
    },
    /// A pressure normal to faces.
    Pressure {
        /// Exterior faces.
        faces: Vec<Exterior>,
        /// Pressure, positive in compression [Pa].
        pressure: f64,
        /// Surface that gives area and normal: current or initial.
        on: Surface,
        /// Factor by which the pressure is multiplied, as a function of time [-].
        factor: History<1>,
    },
    /// A force and a moment at a point.
    Patch(Patch),
}

/// Surface whose area and normal a pressure uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// The current surface, as for a fluid pressure.
    Deformed,
    /// The initial surface. The direction of the load then remains constant.
    Undeformed,
}

/// Force on a vertex of a tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerForce {
    /// Number of the tetrahedron.
    pub tet: u32,
    /// Number of the vertex in the tetrahedron (0 to 3).
    pub corner: u8,
    /// Force [N].
    pub force: DVec3,
}

/// Positions of nodes [m], and the nodes of each tetrahedron.
pub type Vertices<'a> = (&'a [DVec3], &'a [[u32; 4]]);

/// Vertices of the tetrahedra on which loads act.
#[derive(Debug, Clone, Copy)]
pub struct Configuration<'a> {
    /// Initial vertices.
    pub initial: Vertices<'a>,
    /// Current vertices.
    pub current: Vertices<'a>,
}

/// Returns the position of a vertex of a tetrahedron [m].
fn vertex((positions, tets): Vertices, tet: u32, corner: u8) -> DVec3 {
    positions[tets[tet as usize][usize::from(corner)] as usize]
}

/// Returns the area of a face times its outward normal [m2].
fn area_vector(face: &Exterior, vertices: Vertices) -> DVec3 {
    let [a, b, c] = face.nodes.map(|corner| vertex(vertices, face.tet, corner));
    (b - a).cross(c - a) * 0.5
}

impl Load {
    /// Appends the forces at a time [s] to `out`. For tractions and pressures, each corner of a face gets a third of
    /// the force on the face.
    pub fn forces(&self, configuration: &Configuration, time: f64, out: &mut Vec<CornerForce>) {
        let mut spread = |face: &Exterior, force: DVec3| {
            out.extend(face.nodes.map(|corner| CornerForce { tet: face.tet, corner, force: force / 3.0 }));
        };
        match self {
            Self::Traction { faces, stress, factor } => {
                let stress = *stress * factor.at(time)[0];
                for face in faces {
                    spread(face, stress * area_vector(face, configuration.initial).length());
                }
            }
            Self::Pressure { faces, pressure, on, factor } => {
                let pressure = pressure * factor.at(time)[0];
                for face in faces {
                    let area = match on {
                        Surface::Deformed => area_vector(face, configuration.current),
                        Surface::Undeformed => area_vector(face, configuration.initial),
                    };
                    spread(face, area * -pressure);
                }
            }
            Self::Patch(patch) => patch.forces(configuration, time, out),
        }
    }
}
