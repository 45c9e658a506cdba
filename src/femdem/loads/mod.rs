//! Loads: tractions and pressures on faces, forces and moments at a point.
//!
//! | file | contents |
//! | --- | --- |
//! | `patch` | a force and a moment at a point, spread over the faces near the point |
//!
//! Forces act on node copies (vertices of tetrahedra), so node splitting does not affect the loads.

use glam::DVec3;

use super::assembly::{Nodes, Tets};
use super::history::History;
use super::mesh::faces::Exterior;
use super::setup::Setup;
use super::world::World;

pub mod patch;

use patch::Patch;

/// A load.
#[derive(Debug, Clone, PartialEq)]
pub enum Load {
    /// A traction on undeformed faces.
    Traction {
        /// Exterior faces.
        faces: Vec<Exterior>,
        /// Force per undeformed area [Pa].
        stress: DVec3,
        /// Factor of the stress over time [-].
        factor: History<1>,
    },
    /// A pressure normal to faces.
    Pressure {
        /// Exterior faces.
        faces: Vec<Exterior>,
        /// Pressure, positive in compression [Pa].
        pressure: f64,
        /// Whether area and normal are current or initial.
        on: Surface,
        /// Factor of the pressure over time [-].
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
    /// The initial surface; the load keeps its direction.
    Undeformed,
}

/// Force on a vertex of a tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerForce {
    /// The tetrahedron.
    pub tet: u32,
    /// The vertex.
    pub corner: u8,
    /// Force [N].
    pub force: DVec3,
}

/// Nodes and tetrahedra on which loads act.
#[derive(Debug, Clone, Copy)]
pub struct Places<'a> {
    pub(super) setup: &'a Setup,
    pub(super) nodes: &'a Nodes,
    pub(super) tets: &'a Tets,
}

impl Places<'_> {
    /// Undeformed position of a vertex [m].
    fn initial(&self, tet: u32, corner: u8) -> DVec3 {
        self.setup.nodes[self.setup.tets[tet as usize][usize::from(corner)] as usize]
    }

    /// Current position of a vertex [m].
    pub(super) fn now(&self, tet: u32, corner: u8) -> DVec3 {
        self.nodes.place[self.tets.nodes[tet as usize][usize::from(corner)] as usize]
    }
}

/// Area of a face times its outward normal [m2].
fn area_vector(face: &Exterior, position: impl Fn(u32, u8) -> DVec3) -> DVec3 {
    let [a, b, c] = face.nodes.map(|corner| position(face.tet, corner));
    (b - a).cross(c - a) * 0.5
}

impl Load {
    /// Appends the forces at a time [s] to a list. Each corner of a face gets a third of its force.
    pub fn forces(&self, places: &Places, time: f64, out: &mut Vec<CornerForce>) {
        let mut spread = |face: &Exterior, force: DVec3| {
            out.extend(face.nodes.map(|corner| CornerForce { tet: face.tet, corner, force: force / 3.0 }));
        };
        match self {
            Self::Traction { faces, stress, factor } => {
                let stress = *stress * factor.at(time)[0];
                for face in faces {
                    spread(face, stress * area_vector(face, |tet, corner| places.initial(tet, corner)).length());
                }
            }
            Self::Pressure { faces, pressure, on, factor } => {
                let pressure = pressure * factor.at(time)[0];
                for face in faces {
                    let area = match on {
                        Surface::Deformed => area_vector(face, |tet, corner| places.now(tet, corner)),
                        Surface::Undeformed => area_vector(face, |tet, corner| places.initial(tet, corner)),
                    };
                    spread(face, area * -pressure);
                }
            }
            Self::Patch(patch) => patch.forces(places, time, out),
        }
    }
}

impl World {
    /// Returns the nodes and tetrahedra on which loads act.
    pub fn places(&self) -> Places<'_> {
        Places { setup: &self.setup, nodes: &self.nodes, tets: &self.tets }
    }

    /// Adds the loads to the forces of the tetrahedra, and stores them to compute their work.
    pub(super) fn apply_loads(&mut self) {
        let Self { setup, nodes, tets, loaded, deformation, time, .. } = self;
        loaded.clear();
        let places = Places { setup, nodes, tets };
        setup.loads.iter().for_each(|load| load.forces(&places, *time, loaded));
        for CornerForce { tet, corner, force } in loaded {
            deformation.forces[*tet as usize][usize::from(*corner)] += *force;
        }
    }

    /// Power of the loads at the current velocities [W].
    pub(super) fn power_of_loads(&self) -> f64 {
        let power = |load: &CornerForce| {
            let node = self.tets.nodes[load.tet as usize][usize::from(load.corner)];
            load.force.dot(self.nodes.velocity[node as usize])
        };
        self.loaded.iter().map(power).sum()
    }
}
