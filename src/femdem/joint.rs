//! The joint element between two tetrahedra: six nodes, three integration points (Guo, Latham and Xiang, fig. 3).
//!
//! The mid-surface is the mean of the two faces; its normal n points from side 0 to side 1. The integration points are
//! the middles of the edges, each with the undeformed area A/3. The jump of the positions is split into the opening
//! along n and the slip across. Shape functions distribute the tractions to the nodes, exactly for linear jumps.

use glam::DVec3;

use super::cohesive_law::{CohesiveLaw, Point};

/// Corners at the ends of the edge of each integration point.
const ENDS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// State of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// States of the three integration points.
    pub points: [Point; 3],
    /// Opening in the cohesive law at which a tied joint was released [m].
    pub offset: f64,
    /// Whether a point has damage or plastic slip, or the joint was released from a tied face.
    pub(super) is_worn: bool,
}

/// Forces and dissipation of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Answer {
    /// Forces on the corners of side 0 [N]; side 1 has the negative.
    pub forces: [DVec3; 3],
    /// Energy dissipated since the last call [J].
    pub dissipated: f64,
    /// Number of failed integration points.
    pub failed: u8,
}

/// Axes of the mid-surface: two tangents and the normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    along: [DVec3; 2],
    normal: DVec3,
}

impl Axes {
    /// Returns the axes of the mean of two faces with matching corners [m].
    #[inline]
    pub fn of_faces(sides: &[[DVec3; 3]; 2]) -> Self {
        let middle = [0, 1, 2].map(|k| sides[0][k] + sides[1][k]);
        let (a, b) = (middle[1] - middle[0], middle[2] - middle[0]);
        let normal = a.cross(b).normalize();
        let first = a.normalize();
        Self { along: [first, normal.cross(first)], normal }
    }

    /// Normal, towards side 1.
    pub fn normal(&self) -> DVec3 {
        self.normal
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

/// Jump of the positions at the corners [m].
fn jumps(sides: &[[DVec3; 3]; 2]) -> [DVec3; 3] {
    let [a, b] = sides;
    [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
}

/// Computes the forces of a joint from the corners of its faces, `sides` [m], and its undeformed area [m2].
pub fn forces(law: &CohesiveLaw, area: f64, memory: &mut Memory, sides: &[[DVec3; 3]; 2]) -> Answer {
    let jump = jumps(sides);
    let axes = Axes::of_faces(sides);
    let mut out = Answer::default();
    for (point, [i, j]) in memory.points.iter_mut().zip(ENDS) {
        let (opening, slip) = axes.split((jump[i] + jump[j]) * 0.5);
        let traction = law.respond(point, opening + memory.offset, slip);
        // Each point has a third of the area; each end of its edge gets half of the force.
        let force = axes.join(traction.normal, traction.shear) * (area / 6.0);
        out.forces[i] += force;
        out.forces[j] += force;
        out.dissipated += traction.dissipated * (area / 3.0);
        out.failed += u8::from(point.damage >= 1.0);
        memory.is_worn |= !point.is_whole();
    }
    out
}

/// Elastic energy of a joint in the state of the last call [J].
pub fn stored(law: &CohesiveLaw, area: f64, memory: &Memory) -> f64 {
    memory.points.iter().map(|point| law.stored(point)).sum::<f64>() * (area / 3.0)
}

impl Memory {
    /// Creates the state of a joint released from a tied face under the given traction on side 0 [Pa].
    pub fn loaded(law: &CohesiveLaw, traction: DVec3, axes: &Axes) -> Self {
        let (normal, shear) = axes.split(traction);
        let (point, offset) = law.loaded(normal, shear);
        Self { points: [point; 3], offset, is_worn: true }
    }

    /// Whether a point has damage or plastic slip, or the joint was released from a tied face.
    pub fn is_worn(&self) -> bool {
        self.is_worn
    }

    /// Whether sliding (mode II) has dissipated more energy than opening (mode I).
    pub fn is_mostly_slid(&self) -> bool {
        self.points.iter().map(|point| point.lost[1] - point.lost[0]).sum::<f64>() > 0.0
    }
}

/// Mean edge length and area of a triangle [m, m2].
pub fn size(corners: &[DVec3; 3]) -> (f64, f64) {
    let [a, b, c] = *corners;
    let mean = (a.distance(b) + b.distance(c) + c.distance(a)) / 3.0;
    (mean, 0.5 * (b - a).cross(c - a).length())
}
