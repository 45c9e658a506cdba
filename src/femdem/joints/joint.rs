//! The joint element between two tetrahedra: six nodes, three integration points (Guo, Latham and Xiang, fig. 3).
//!
//! The mid-surface is the mean of the two faces; its normal n points from side 0 to side 1. The integration points are
//! the midpoints of the edges; each represents a third of the undeformed area of the face. The jump of the positions
//! between the two sides has two parts: the opening along n, and the slip in the mid-surface. Shape functions
//! distribute the tractions to the nodes. The integration is exact if the traction varies linearly over the face.

use glam::DVec3;

use crate::femdem::material::cohesive_law::{CohesiveLaw, PointState};

/// For each integration point, the two corners at the ends of its edge.
const ENDS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// State of a joint element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointState {
    /// States of the three integration points.
    pub points: [PointState; 3],
    /// Opening at which the cohesive law starts when a tied face is released [m]; zero for other joints. The code adds
    /// it to the opening between the two faces.
    pub offset: f64,
    /// True if a point has damage or plastic slip, or if the joint was released from a tied face.
    pub(super) is_damaged: bool,
}

/// Forces and dissipation of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointForces {
    /// Forces on the corners of side 0 [N]; the forces on side 1 are opposite.
    pub forces: [DVec3; 3],
    /// Energy dissipated since the previous call of [`forces`] [J].
    pub dissipated: f64,
    /// Number of failed integration points.
    pub failed: u8,
}

/// Axes of the mid-surface: two tangents and the normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    along: [DVec3; 2],
    /// Normal, towards side 1.
    pub normal: DVec3,
}

impl Axes {
    /// Returns the axes of the mid-surface of two faces with matching corners [m].
    #[inline]
    pub fn of_faces(sides: &[[DVec3; 3]; 2]) -> Self {
        let middle = [0, 1, 2].map(|k| sides[0][k] + sides[1][k]);
        let (a, b) = (middle[1] - middle[0], middle[2] - middle[0]);
        let normal = a.cross(b).normalize();
        let first = a.normalize();
        Self { along: [first, normal.cross(first)], normal }
    }

    /// Splits a vector into its normal component and its two tangential components.
    #[inline]
    pub fn split(&self, v: DVec3) -> (f64, [f64; 2]) {
        (v.dot(self.normal), self.along.map(|axis| v.dot(axis)))
    }

    #[inline]
    fn join(&self, normal: f64, shear: [f64; 2]) -> DVec3 {
        self.normal * normal + self.along[0] * shear[0] + self.along[1] * shear[1]
    }
}

/// Returns the jump of the positions from side 0 to side 1 at each corner [m].
fn jumps(sides: &[[DVec3; 3]; 2]) -> [DVec3; 3] {
    let [a, b] = sides;
    [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
}

/// Computes the forces of a joint from the corners of its two faces, `sides` [m], and its undeformed area [m2]. Updates
/// the state of the joint.
pub fn forces(law: &CohesiveLaw, area: f64, state: &mut JointState, sides: &[[DVec3; 3]; 2]) -> JointForces {
    let jump = jumps(sides);
    let axes = Axes::of_faces(sides);
    let mut out = JointForces::default();
    for (point, [i, j]) in state.points.iter_mut().zip(ENDS) {
        let (opening, slip) = axes.split((jump[i] + jump[j]) * 0.5);
        let traction = law.respond(point, opening + state.offset, slip);
        // Each integration point represents a third of the area. Each end of its edge gets half of its force.
        let force = axes.join(traction.normal, traction.shear) * (area / 6.0);
        out.forces[i] += force;
        out.forces[j] += force;
        out.dissipated += traction.dissipated * (area / 3.0);
        out.failed += u8::from(point.damage >= 1.0);
        state.is_damaged |= !point.is_intact();
    }
    out
}

/// Returns the elastic energy of a joint at the last call of [`forces`] [J].
pub fn stored(law: &CohesiveLaw, area: f64, state: &JointState) -> f64 {
    state.points.iter().map(|point| law.stored(point)).sum::<f64>() * (area / 3.0)
}

impl JointState {
    /// Creates the state of a joint released from a tied face under the given traction on side 0 [Pa].
    pub fn loaded(law: &CohesiveLaw, traction: DVec3, axes: &Axes) -> Self {
        let (normal, shear) = axes.split(traction);
        let (point, offset) = law.loaded(normal, shear);
        Self { points: [point; 3], offset, is_damaged: true }
    }

    /// Returns true if sliding (mode II) has dissipated more energy than opening (mode I).
    pub fn is_mostly_sliding(&self) -> bool {
        self.points.iter().map(|point| point.dissipated[1] - point.dissipated[0]).sum::<f64>() > 0.0
    }
}

/// Returns the mean edge length [m] and the area [m2] of a triangle.
pub fn size(corners: &[DVec3; 3]) -> (f64, f64) {
    let [a, b, c] = *corners;
    let mean = (a.distance(b) + b.distance(c) + c.distance(a)) / 3.0;
    (mean, 0.5 * (b - a).cross(c - a).length())
}
