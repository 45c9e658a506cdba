//! When a step cannot be trusted: tetrahedra turned inside out, nodes that run away, contacts that go too deep.
//!
//! | what | limit | looked at |
//! | --- | --- | --- |
//! | volume of a tetrahedron | above zero, and a number | in every step |
//! | speed of a node | [`SPEED`] celerities of the stiffest body, and what the case gives | in every step |
//! | place of a node | [`REACH`] diagonals of the mesh from its middle, and the way that the case gives | by [`World::watch`] |
//! | overlap of two tetrahedra | [`DEPTH`] of the smaller one | by [`World::watch`] |

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::Nodes;
use super::setup::{Constraint, Setup};
use super::world::World;

/// Longitudinal celerities that a node may be faster than the case makes it [-]: at one of them strains are of order one,
/// where neither material nor strength mean anything.
pub const SPEED: f64 = 2.0;

/// Diagonals of the mesh that a node may be away from its middle [-]: pieces that flew further touch nothing any more.
pub const REACH: f64 = 50.0;

/// Overlap of two tetrahedra, see [`Contacts::deepest`](super::contact::pairs::Contacts::deepest) [-]: half of the
/// smaller one is then in the other, and little is left that pushes it out on its own side.
pub const DEPTH: f64 = 0.25;

/// Nodes that one thread takes at a time.
const PIECE: usize = 4096;

/// Why a step cannot be trusted. Times [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepError {
    /// A tetrahedron was turned inside out.
    Inverted {
        /// Its number.
        tet: usize,
        /// When.
        time: f64,
    },
    /// The place of a node is no finite number.
    NotFinite {
        /// Its number.
        node: usize,
        /// When.
        time: f64,
    },
    /// A node is too fast.
    TooFast {
        /// Its number.
        node: usize,
        /// Its speed, and the most that is allowed [m/s].
        speed: [f64; 2],
        /// When.
        time: f64,
    },
    /// A node is too far away.
    Escaped {
        /// Its number.
        node: usize,
        /// Its distance from the middle of the mesh, and the most that is allowed [m].
        distance: [f64; 2],
        /// When.
        time: f64,
    },
    /// Two tetrahedra are too deep in each other.
    TooDeep {
        /// Their numbers.
        tets: [u32; 2],
        /// Their overlap over the smaller one [-].
        share: f64,
        /// When.
        time: f64,
    },
}

/// What nodes must not exceed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    /// Middle of the mesh [m].
    centre: DVec3,
    /// Distance from it [m].
    reach: f64,
    /// Speed besides what the case gives [m/s].
    speed: f64,
    /// Largest speed that the case gives at the start, or by a constraint [m/s].
    given: f64,
    /// Acceleration of gravity [m/s2].
    gravity: f64,
}

impl Limits {
    /// Limits of a setup whose nodes are at their start.
    pub fn new(setup: &Setup, nodes: &Nodes) -> Self {
        let low = setup.nodes.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = setup.nodes.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let celerity = setup.bodies.iter().map(|body| body.elastic.celerity()).fold(0.0, f64::max);
        let made = setup.constraints.iter().map(Constraint::fastest);
        Self {
            centre: 0.5 * (low + high),
            reach: REACH * low.distance(high),
            speed: SPEED * celerity,
            given: nodes.velocity.iter().map(|v| v.length()).chain(made).fold(0.0, f64::max),
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
    /// Looks for nodes that have gone too far and for contacts that are too deep. Costs about as much as moving the nodes:
    /// for now and then.
    ///
    /// # Errors
    /// If there is one: the first node, or the deepest contact.
    pub fn watch(&self) -> Result<(), StepError> {
        let (time, reach, centre) = (self.time, self.limits.reach_at(self.time), self.limits.centre);
        let distance = |place: &DVec3| place.distance(centre);
        // Not a number counts, too.
        let outside = |place: &DVec3| !matches!(distance(place).partial_cmp(&reach), Some(order) if order.is_le());
        if let Some(node) = self.nodes.place.par_iter().with_min_len(PIECE).position_first(outside) {
            let place = self.nodes.place[node];
            if !place.is_finite() {
                return Err(StepError::NotFinite { node, time });
            }
            return Err(StepError::Escaped { node, distance: [distance(&place), reach], time });
        }
        match self.contacts.deepest(&self.tets) {
            Some((tets, share)) if share > DEPTH => Err(StepError::TooDeep { tets, share, time }),
            _ => Ok(()),
        }
    }

    /// Compares the square of the largest speed with what is allowed [m2/s2]. Speeds that are not numbers show in the
    /// tetrahedra of the next step.
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

    /// Why a tetrahedron has no volume any more.
    pub(super) fn why_inverted(&self, tet: usize) -> StepError {
        let time = self.time;
        let corners = self.tets.nodes[tet].map(|node| node as usize);
        match corners.into_iter().find(|node| !self.nodes.place[*node].is_finite()) {
            Some(node) => StepError::NotFinite { node, time },
            None => StepError::Inverted { tet, time },
        }
    }
}
