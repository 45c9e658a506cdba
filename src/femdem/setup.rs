//! What a world of deformable bodies is made of.

use std::ops::Range;

use glam::DVec3;

use super::cohesive_law::Cohesion;
use super::history::History;
use super::loads::Load;
use super::material::Elastic;
use super::mesh::PreparedMesh;
use super::mesh::faces::Interface;

/// A body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Its tetrahedra.
    pub tets: Range<usize>,
    /// Elasticity, density, viscosity.
    pub elastic: Elastic,
    /// How its joints hold; without it, the body does not crack.
    pub cohesion: Option<Cohesion>,
    /// It is not deformed: all its nodes move as one. It cannot crack.
    pub rigid: bool,
    /// Stress per potential of its contacts [Pa]; a pair has the smaller one.
    pub contact_penalty: f64,
    /// Velocity at the start [m/s].
    pub velocity: DVec3,
    /// Angular velocity at the start [rad/s] about `pivot`.
    pub angular_velocity: DVec3,
    /// Point that `velocity` belongs to [m].
    pub pivot: DVec3,
}

/// Penalty of contact over Young's modulus [-], where nothing else is given: a contact is then eight times as stiff as the
/// tetrahedron behind it (see [`super::time_step::contact_stiffness`]).
const CONTACT_PENALTY: f64 = 1.0;

/// Velocities that nodes are made to have.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// Nodes of the mesh.
    pub nodes: Vec<u32>,
    /// Velocity along each axis [m/s]; `None` leaves it free.
    pub velocity: [Option<History<1>>; 3],
}

impl Constraint {
    /// Velocity along each axis that stays the same [m/s].
    pub fn constant(nodes: Vec<u32>, velocity: [Option<f64>; 3]) -> Self {
        Self { nodes, velocity: velocity.map(|given| given.map(History::from)) }
    }

    /// No node of it is made to move faster [m/s].
    pub fn fastest(&self) -> f64 {
        let most = |given: &Option<History<1>>| given.as_ref().map_or(0.0, |history| history.largest()[0]);
        DVec3::from_array(self.velocity.each_ref().map(most)).length()
    }

    /// Velocity along each axis at a time [m/s].
    pub fn at(&self, time: f64) -> [Option<f64>; 3] {
        self.velocity.each_ref().map(|given| given.as_ref().map(|history| history.at(time)[0]))
    }
}

/// Everything that a world of deformable bodies is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Places [m].
    pub nodes: Vec<DVec3>,
    /// Nodes of each tetrahedron; seen from the fourth, the first three run anticlockwise.
    pub tets: Vec<[u32; 4]>,
    /// Bodies; their ranges follow each other and hold all tetrahedra.
    pub bodies: Vec<Body>,
    /// Faces between tetrahedra of bodies that crack.
    pub interfaces: Vec<Interface>,
    /// Numbers of the interfaces that are cracked at the start.
    pub cracks: Vec<u32>,
    /// Tetrahedra at the outside and at the cracks of the start, in rising order.
    pub outer: Vec<u32>,
    /// Coulomb's coefficient between two bodies [-]: a row for each; crack faces of a body rub with its own.
    pub friction: Vec<Vec<f64>>,
    /// Nodes with given velocities.
    pub constraints: Vec<Constraint>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Acceleration of gravity [m/s2].
    pub gravity: DVec3,
}

impl Body {
    /// Body at rest that does not crack.
    pub fn at_rest(tets: Range<usize>, elastic: Elastic) -> Self {
        let still = DVec3::ZERO;
        let contact_penalty = CONTACT_PENALTY * elastic.young_modulus;
        Self {
            tets,
            elastic,
            cohesion: None,
            rigid: false,
            contact_penalty,
            velocity: still,
            angular_velocity: still,
            pivot: still,
        }
    }
}

impl Setup {
    /// Coulomb's coefficient between two bodies, by their numbers [-].
    pub fn friction(&self, [a, b]: [usize; 2]) -> f64 {
        self.friction[a][b]
    }

    /// Bodies of a mesh, in its order, without gravity, friction and constraints; the sets of cracks are open.
    pub fn of_mesh(prepared: &PreparedMesh, bodies: Vec<Body>) -> Self {
        let PreparedMesh { mesh, faces, .. } = prepared;
        let cracks = |tet: u32| bodies.iter().any(|b| b.cohesion.is_some() && b.tets.contains(&(tet as usize)));
        let mut number = vec![None; faces.interfaces.len()];
        let mut interfaces = Vec::new();
        for (old, interface) in faces.interfaces.iter().enumerate().filter(|(_, face)| cracks(face.tets[0])) {
            number[old] = Some(interfaces.len() as u32);
            interfaces.push(*interface);
        }
        let mut open: Vec<u32> =
            faces.cracks.iter().flat_map(|set| &set.faces).filter_map(|face| number[*face as usize]).collect();
        open.sort_unstable();
        open.dedup();
        let at_cracks = open.iter().flat_map(|crack| interfaces[*crack as usize].tets);
        let mut outer: Vec<u32> = faces.exteriors.iter().map(|face| face.tet).chain(at_cracks).collect();
        outer.sort_unstable();
        outer.dedup();
        let friction = vec![vec![0.0; bodies.len()]; bodies.len()];
        Self {
            nodes: mesh.nodes.clone(),
            tets: mesh.tets.clone(),
            bodies,
            interfaces,
            cracks: open,
            outer,
            friction,
            constraints: Vec::new(),
            loads: Vec::new(),
            gravity: DVec3::ZERO,
        }
    }
}
