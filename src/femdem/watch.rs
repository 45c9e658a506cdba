//! Limits that stop an unstable run: inverted tetrahedra, nodes that are too fast or too far away, too deep contacts.
//!
//! | quantity | limit | checked |
//! | --- | --- | --- |
//! | volume of a tetrahedron | finite and above zero | in every time step |
//! | speed of a node | [`SPEED`] times the largest celerity, plus the speed that the case causes | in every time step |
//! | distance from mesh middle | [`REACH`] mesh diagonals, plus the motion that the case causes | by [`World::watch`] |
//! | overlap of two tetrahedra | [`DEPTH`] of the smaller one | by [`World::watch`] |

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::Nodes;
use super::setup::{Constraint, Setup};
use super::world::World;

/// Limit of the node speed in longitudinal celerities, in addition to the speed that the case causes [-]. At one
/// celerity strains are of order one, where material law and strength are no longer valid.
pub const SPEED: f64 = 2.0;

/// Limit of the distance of a node from the middle of the mesh in mesh diagonals [-]; fragments beyond touch nothing.
pub const REACH: f64 = 50.0;

/// Limit of the overlap of two tetrahedra, see [`Contacts::deepest`](super::contact::pairs::Contacts::deepest) [-]:
/// half of the smaller one is then inside the other, and the contact force hardly pushes it back out.
pub const DEPTH: f64 = 0.25;

/// Nodes per task of the thread pool.
const CHUNK: usize = 4096;

/// Reason why the run is unstable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepError {
    /// A tetrahedron is inverted.
    Inverted {
        /// Number of the tetrahedron.
        tet: usize,
        /// Time [s].
        time: f64,
    },
    /// The position of a node is not finite.
    NotFinite {
        /// Number of the node.
        node: usize,
        /// Time [s].
        time: f64,
    },
    /// A node is too fast.
    TooFast {
        /// Number of the node.
        node: usize,
        /// Its speed and the limit [m/s].
        speed: [f64; 2],
        /// Time [s].
        time: f64,
    },
    /// A node is too far away.
    Escaped {
        /// Number of the node.
        node: usize,
        /// Its distance from the middle of the mesh and the limit [m].
        distance: [f64; 2],
        /// Time [s].
        time: f64,
    },
    /// The overlap of two tetrahedra is too deep.
    TooDeep {
        /// Numbers of the tetrahedra.
        tets: [u32; 2],
        /// Overlap over the volume of the smaller one [-].
        share: f64,
        /// Time [s].
        time: f64,
    },
}

/// Limits of the motion of nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    /// Middle of the mesh [m].
    centre: DVec3,
    /// Distance limit from the middle, without the motion that the case causes [m].
    reach: f64,
    /// Speed limit, without the speed that the case causes [m/s].
    speed: f64,
    /// Largest initial or prescribed speed [m/s].
    given: f64,
    /// Gravitational acceleration [m/s2].
    gravity: f64,
}

impl Limits {
    /// Creates the limits of a setup with its initial nodes.
    pub fn new(setup: &Setup, nodes: &Nodes) -> Self {
        let low = setup.nodes.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = setup.nodes.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let celerity = setup.bodies.iter().map(|body| body.elastic.celerity()).fold(0.0, f64::max);
        let prescribed = setup.constraints.iter().map(Constraint::fastest);
        Self {
            centre: 0.5 * (low + high),
            reach: REACH * low.distance(high),
            speed: SPEED * celerity,
            given: nodes.velocity.iter().map(|v| v.length()).chain(prescribed).fold(0.0, f64::max),
            gravity: setup.gravity.length(),
        }
    }

    fn speed_at(&self, time: f64) -> f64 {
        self.speed + self.given + self.gravity * time
    }

    fn reach_at(&self, time: f64) -> f64 {
        self.reach + (self.given + 0.5 * self.gravity * time) * time
    }
}

impl World {
    /// Checks for nodes that are too far away and for contacts that are too deep. This costs about as much as moving
    /// the nodes, so it is not done in every time step.
    ///
    /// # Errors
    /// Returns the first such node, or the deepest contact.
    pub fn watch(&self) -> Result<(), StepError> {
        let (time, reach, centre) = (self.time, self.limits.reach_at(self.time), self.limits.centre);
        let distance = |x: &DVec3| x.distance(centre);
        // A NaN position counts as outside, too.
        let is_outside = |x: &DVec3| !matches!(distance(x).partial_cmp(&reach), Some(order) if order.is_le());
        if let Some(node) = self.nodes.place.par_iter().with_min_len(CHUNK).position_first(is_outside) {
            let position = self.nodes.place[node];
            if !position.is_finite() {
                return Err(StepError::NotFinite { node, time });
            }
            return Err(StepError::Escaped { node, distance: [distance(&position), reach], time });
        }
        match self.contacts.deepest(&self.tets) {
            Some((tets, share)) if share > DEPTH => Err(StepError::TooDeep { tets, share, time }),
            _ => Ok(()),
        }
    }

    /// Checks the square of the largest speed [m2/s2] against the limit. NaN speeds show as inverted tetrahedra in the
    /// next time step.
    pub(super) fn check_speed(&self, fastest_squared: f64) -> Result<(), StepError> {
        let (time, limit) = (self.time, self.limits.speed_at(self.time));
        if fastest_squared <= limit * limit {
            return Ok(());
        }
        let speeds = self.nodes.velocity.iter().map(|v| v.length()).enumerate();
        let fastest = speeds.filter(|(_, speed)| !speed.is_nan()).max_by(|a, b| a.1.total_cmp(&b.1));
        let (node, speed) = fastest.unwrap_or((0, f64::NAN));
        Err(StepError::TooFast { node, speed: [speed, limit], time })
    }

    /// Returns the error for a tetrahedron without volume: inverted, or with a node that is not finite.
    pub(super) fn why_inverted(&self, tet: usize) -> StepError {
        let time = self.time;
        let corners = self.tets.nodes[tet].map(|node| node as usize);
        match corners.into_iter().find(|node| !self.nodes.place[*node].is_finite()) {
            Some(node) => StepError::NotFinite { node, time },
            None => StepError::Inverted { tet, time },
        }
    }
}
