//! Input of a world (all bodies, joints and contacts of a run): mesh, bodies, constraints and loads.

use std::ops::Range;

use glam::DVec3;

use super::loads::Load;
use super::loads::history::History;
use super::material::Elastic;
use super::material::cohesive_law::Cohesion;
use super::mesh::PreparedMesh;
use super::mesh::faces::Interface;

/// A deformable or rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Numbers of the tetrahedra of the body.
    pub tets: Range<usize>,
    /// Elasticity, density, viscosity.
    pub elastic: Elastic,
    /// Cohesive parameters of the joints of the body; `None` for a body that cannot crack.
    pub cohesion: Option<Cohesion>,
    /// True if the body is rigid. A rigid body cannot crack.
    pub rigid: bool,
    /// Contact penalty: stress per unit of contact potential [Pa]. The contact of two bodies uses the smaller of their
    /// penalties.
    pub contact_penalty: f64,
    /// Velocity of the point `pivot` at the start [m/s].
    pub velocity: DVec3,
    /// Angular velocity about `pivot` at the start [rad/s].
    pub angular_velocity: DVec3,
    /// Point to which `velocity` refers [m].
    pub pivot: DVec3,
}

/// Default contact penalty, divided by Young's modulus [-]. With 1, a contact is eight times as stiff as the
/// tetrahedron behind it (see [`super::world::time_step::contact_stiffness`]).
const CONTACT_PENALTY: f64 = 1.0;

/// Prescribed velocities of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraint {
    /// Nodes of the mesh.
    pub nodes: Vec<u32>,
    /// Prescribed velocity along x, y and z [m/s]; `None` leaves the component free.
    pub velocity: [Option<History<1>>; 3],
}

impl Constraint {
    /// Returns an upper limit of the prescribed speed over all times [m/s].
    pub fn fastest(&self) -> f64 {
        let most = |given: &Option<History<1>>| given.as_ref().map_or(0.0, |history| history.largest()[0]);
        DVec3::from_array(self.velocity.each_ref().map(most)).length()
    }

    /// Returns the prescribed velocity along x, y and z [m/s] at a time [s]; `None` for a free component.
    pub fn at(&self, time: f64) -> [Option<f64>; 3] {
        self.velocity.each_ref().map(|given| given.as_ref().map(|history| history.at(time)[0]))
    }
}

/// Input of a world of deformable bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Initial positions of the mesh nodes [m].
    pub nodes: Vec<DVec3>,
    /// Nodes of each tetrahedron. Seen from the fourth node, the first three are in anticlockwise order.
    pub tets: Vec<[u32; 4]>,
    /// Bodies; their ranges are consecutive and cover all tetrahedra.
    pub bodies: Vec<Body>,
    /// Faces between tetrahedra of bodies that can crack.
    pub interfaces: Vec<Interface>,
    /// Numbers of the interfaces that are broken at the start (pre-cracks).
    pub cracks: Vec<u32>,
    /// Numbers of the tetrahedra with a face on the surface or at a pre-crack, in ascending order.
    pub outer: Vec<u32>,
    /// Friction coefficients between bodies [-], one row and one column per body. The diagonal applies to the crack
    /// faces within a body.
    pub friction: Vec<Vec<f64>>,
    /// Constraints: nodes with prescribed velocities.
    pub constraints: Vec<Constraint>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Gravitational acceleration [m/s2].
    pub gravity: DVec3,
}

impl Body {
    /// Creates a deformable body at rest that cannot crack.
    pub fn at_rest(tets: Range<usize>, elastic: Elastic) -> Self {
        let zero = DVec3::ZERO;
        let contact_penalty = CONTACT_PENALTY * elastic.young_modulus;
        Self {
            tets,
            elastic,
            cohesion: None,
            rigid: false,
            contact_penalty,
            velocity: zero,
            angular_velocity: zero,
            pivot: zero,
        }
    }
}

impl Setup {
    /// Returns the friction coefficient [-] between bodies number `a` and `b`.
    pub fn friction(&self, [a, b]: [usize; 2]) -> f64 {
        self.friction[a][b]
    }

    /// Creates a setup without gravity, friction, constraints and loads. `bodies` are in the order of the bodies of the
    /// mesh. In bodies that can crack, the faces of crack sets are broken at the start.
    pub fn of_mesh(prepared: &PreparedMesh, bodies: Vec<Body>) -> Self {
        let PreparedMesh { mesh, faces, .. } = prepared;
        let can_crack = |tet: u32| bodies.iter().any(|b| b.cohesion.is_some() && b.tets.contains(&(tet as usize)));
        let mut number = vec![None; faces.interfaces.len()];
        let mut interfaces = Vec::new();
        for (old, interface) in faces.interfaces.iter().enumerate().filter(|(_, face)| can_crack(face.tets[0])) {
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
