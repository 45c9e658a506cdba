//! Loads: tractions and pressures on faces, forces about a place.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `patch` | a force and a moment about a place, spread over the faces near it |
//!
//! Forces go to copies of nodes, the vertices of tetrahedra: nothing changes for a load when nodes come apart.

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
    /// A stress vector on undeformed faces.
    Traction {
        /// Faces at the outside.
        faces: Vec<Exterior>,
        /// Force over undeformed area [Pa].
        stress: DVec3,
        /// Factor of the stress [-].
        factor: History<1>,
    },
    /// A pressure normal to faces.
    Pressure {
        /// Faces at the outside.
        faces: Vec<Exterior>,
        /// Positive where it presses [Pa].
        pressure: f64,
        /// On which faces it acts.
        on: Surface,
        /// Factor of the pressure [-].
        factor: History<1>,
    },
    /// A force and a moment about a place.
    Patch(Patch),
}

/// Faces whose area and normal count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// As they are now: the pressure of a fluid.
    Deformed,
    /// As they were at first: a load that keeps its direction.
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

/// Places that loads act on.
#[derive(Debug, Clone, Copy)]
pub struct Places<'a> {
    pub(super) setup: &'a Setup,
    pub(super) nodes: &'a Nodes,
    pub(super) tets: &'a Tets,
}

impl Places<'_> {
    /// Undeformed place of a vertex [m].
    fn first(&self, tet: u32, corner: u8) -> DVec3 {
        self.setup.nodes[self.setup.tets[tet as usize][usize::from(corner)] as usize]
    }

    /// Present place of a vertex [m].
    pub(super) fn now(&self, tet: u32, corner: u8) -> DVec3 {
        self.nodes.place[self.tets.nodes[tet as usize][usize::from(corner)] as usize]
    }
}

/// Area of a face times its normal outwards [m2].
fn area_vector(face: &Exterior, place: impl Fn(u32, u8) -> DVec3) -> DVec3 {
    let [a, b, c] = face.nodes.map(|corner| place(face.tet, corner));
    (b - a).cross(c - a) * 0.5
}

impl Load {
    /// Adds the forces at a time [s] to a list. The shape functions of a face are a third each over its area.
    pub fn forces(&self, places: &Places, time: f64, out: &mut Vec<CornerForce>) {
        let mut spread = |face: &Exterior, force: DVec3| {
            out.extend(face.nodes.map(|corner| CornerForce { tet: face.tet, corner, force: force / 3.0 }));
        };
        match self {
            Self::Traction { faces, stress, factor } => {
                let stress = *stress * factor.at(time)[0];
                for face in faces {
                    spread(face, stress * area_vector(face, |tet, corner| places.first(tet, corner)).length());
                }
            }
            Self::Pressure { faces, pressure, on, factor } => {
                let pressure = pressure * factor.at(time)[0];
                for face in faces {
                    let area = match on {
                        Surface::Deformed => area_vector(face, |tet, corner| places.now(tet, corner)),
                        Surface::Undeformed => area_vector(face, |tet, corner| places.first(tet, corner)),
                    };
                    spread(face, area * -pressure);
                }
            }
            Self::Patch(patch) => patch.forces(places, time, out),
        }
    }
}

impl World {
    /// What loads act on.
    pub fn places(&self) -> Places<'_> {
        Places { setup: &self.setup, nodes: &self.nodes, tets: &self.tets }
    }

    /// Adds the loads to the forces of the tetrahedra, and keeps them for their work.
    pub(super) fn apply_loads(&mut self) {
        let Self { setup, nodes, tets, loaded, deformation, time, .. } = self;
        loaded.clear();
        let places = Places { setup, nodes, tets };
        setup.loads.iter().for_each(|load| load.forces(&places, *time, loaded));
        for CornerForce { tet, corner, force } in loaded {
            deformation.forces[*tet as usize][usize::from(*corner)] += *force;
        }
    }

    /// Power of the loads at the velocities as they are [W].
    pub(super) fn power_of_loads(&self) -> f64 {
        let power = |load: &CornerForce| {
            let node = self.tets.nodes[load.tet as usize][usize::from(load.corner)];
            load.force.dot(self.nodes.velocity[node as usize])
        };
        self.loaded.iter().map(power).sum()
    }
}
