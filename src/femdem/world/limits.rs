//! Limits that stop an unstable run: inverted tetrahedra, nodes that are too fast or too far away, too deep contacts.
//!
//! | quantity | limit | checked |
//! | --- | --- | --- |
//! | volume of a tetrahedron | finite and above zero | in every time step |
//! | speed of a node | [`SPEED`] times the largest celerity, plus the expected speed | in every time step |
//! | distance from the middle of the mesh | [`REACH`] mesh diagonals, plus the expected travel | by `check_limits` |
//! | overlap of two tetrahedra | [`DEPTH`] times the smaller volume | by `check_limits` |
//!
//! Expected speed: the largest initial or prescribed speed, plus gravity times time. Expected travel: the integral of
//! the expected speed over time.

use glam::DVec3;
use rayon::prelude::*;

use super::World;
use crate::femdem::assembly::nodes::Nodes;
use crate::femdem::setup::{Constraint, Setup};

/// Limit of the nodal speed, divided by the celerity of longitudinal waves [-]. The expected speed is added to the
/// limit. If nodes move at the celerity relative to each other, strains are of order one, and the material law is not
/// valid.
pub const SPEED: f64 = 2.0;

/// Limit of the distance of a node from the middle of the mesh, divided by the diagonal of the mesh [-]. Fragments at
/// this distance can no longer touch other fragments.
pub const REACH: f64 = 50.0;

/// Limit of the overlap of two tetrahedra [-] as in
/// [`Contacts::deepest_overlap`](crate::femdem::contact::pairs::Contacts::deepest_overlap). At this limit, about half
/// of the smaller tetrahedron is inside the other one, and the contact force can no longer separate the two tetrahedra
/// reliably.
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
        /// Speed of the node and its limit [m/s].
        speed: [f64; 2],
        /// Time [s].
        time: f64,
    },
    /// A node is too far away.
    Escaped {
        /// Number of the node.
        node: usize,
        /// Distance of the node from the middle of the mesh, and its limit [m].
        distance: [f64; 2],
        /// Time [s].
        time: f64,
    },
    /// The overlap of two tetrahedra is too deep.
    TooDeep {
        /// Numbers of the tetrahedra.
        tets: [u32; 2],
        /// Overlap, divided by the volume of the smaller tetrahedron [-].
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
    /// Limit at time 0 of the distance from the middle of the mesh [m]. The limit grows with the expected travel.
    reach: f64,
    /// Limit of the nodal speed [m/s], without the expected speed, which is added to it.
    speed: f64,
    /// Largest initial or prescribed speed [m/s].
    prescribed_speed: f64,
    /// Magnitude of the gravitational acceleration [m/s2].
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
            prescribed_speed: nodes.velocity.iter().map(|v| v.length()).chain(prescribed).fold(0.0, f64::max),
            gravity: setup.gravity.length(),
        }
    }

    fn speed_at(&self, time: f64) -> f64 {
        self.speed + self.prescribed_speed + self.gravity * time
    }

    fn reach_at(&self, time: f64) -> f64 {
        self.reach + (self.prescribed_speed + 0.5 * self.gravity * time) * time
    }
}

impl World {
    /// Checks for nodes that are too far away and for contacts that are too deep. This check costs about as much as
    /// moving the nodes, so the solver does not call it in every time step.
    ///
    /// # Errors
    /// Returns the first node that is too far away, or the deepest contact if it is too deep.
    pub fn check_limits(&self) -> Result<(), StepError> {
        let (time, reach, centre) = (self.time, self.limits.reach_at(self.time), self.limits.centre);
        let distance = |x: &DVec3| x.distance(centre);
        // A NaN position also counts as outside.
        let is_outside = |x: &DVec3| !matches!(distance(x).partial_cmp(&reach), Some(order) if order.is_le());
        if let Some(node) = self.nodes.position.par_iter().with_min_len(CHUNK).position_first(is_outside) {
            let position = self.nodes.position[node];
            if !position.is_finite() {
                return Err(StepError::NotFinite { node, time });
            }
            return Err(StepError::Escaped { node, distance: [distance(&position), reach], time });
        }
        match self.contacts.deepest_overlap(&self.tets) {
            Some((tets, share)) if share > DEPTH => Err(StepError::TooDeep { tets, share, time }),
            _ => Ok(()),
        }
    }

    /// Checks that the largest speed does not exceed the limit. `fastest_squared` is the square of this speed [m2/s2].
    /// A NaN speed is found in the next time step, because a tetrahedron then has no finite volume.
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

    /// Returns the error for a tetrahedron whose volume is not positive or not finite: `NotFinite` if the position of a
    /// node is not finite, else `Inverted`.
    pub(super) fn inversion_error(&self, tet: usize) -> StepError {
        let time = self.time;
        let corners = self.tets.nodes[tet].map(|node| node as usize);
        match corners.into_iter().find(|node| !self.nodes.position[*node].is_finite()) {
            Some(node) => StepError::NotFinite { node, time },
            None => StepError::Inverted { tet, time },
        }
    }
}
