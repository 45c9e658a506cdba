//! The joint between two tetrahedra: six nodes, three integration points (Guo, Latham and Xiang, fig. 3).
//!
//! The mid-surface is the mean of the two faces, its normal n points from side 0 to side 1. At the middle of an edge the
//! jump of the places is split into the opening along n and the slip across; the stresses there go to the nodes with the
//! shape functions of the undeformed area, A/3 to a point. For jumps that are linear over the face this is exact.

use glam::DVec3;

use super::cohesive_law::{CohesiveLaw, Point};

/// Corners of the face at the ends of the edge on whose middle a point lies.
const ENDS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Memory of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// Of the three points.
    pub points: [Point; 3],
    /// Opening that a joint had, in terms of its law, when it came free [m].
    pub offset: f64,
    /// A point has damage or slip behind it, or came free under load.
    pub(super) is_worn: bool,
}

/// Forces of a joint and its energy.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Answer {
    /// On the corners of side 0 [N]; side 1 has the negative.
    pub forces: [DVec3; 3],
    /// Energy lost since the last call [J].
    pub dissipated: f64,
    /// Points that carry nothing any more.
    pub failed: u8,
}

/// Axes of the mid-surface: two along it and its normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    along: [DVec3; 2],
    normal: DVec3,
}

impl Axes {
    /// Axes of the mean of two faces with matching corners [m].
    #[inline]
    pub fn of_faces(sides: &[[DVec3; 3]; 2]) -> Self {
        let middle = [0, 1, 2].map(|k| sides[0][k] + sides[1][k]);
        let (a, b) = (middle[1] - middle[0], middle[2] - middle[0]);
        let normal = a.cross(b).normalize();
        let first = a.normalize();
        Self { along: [first, normal.cross(first)], normal }
    }

    /// Towards side 1.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Part along the normal, and the two across.
    #[inline]
    pub fn split(&self, v: DVec3) -> (f64, [f64; 2]) {
        (v.dot(self.normal), self.along.map(|axis| v.dot(axis)))
    }

    #[inline]
    fn join(&self, normal: f64, shear: [f64; 2]) -> DVec3 {
        self.normal * normal + self.along[0] * shear[0] + self.along[1] * shear[1]
    }
}

/// Jump of the places at the corners [m].
fn jumps(sides: &[[DVec3; 3]; 2]) -> [DVec3; 3] {
    let [a, b] = sides;
    [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
}

/// Forces of a joint whose faces have their corners at `sides` [m], on the undeformed area [m2].
pub fn forces(law: &CohesiveLaw, area: f64, memory: &mut Memory, sides: &[[DVec3; 3]; 2]) -> Answer {
    let jump = jumps(sides);
    let axes = Axes::of_faces(sides);
    let mut out = Answer::default();
    for (point, [i, j]) in memory.points.iter_mut().zip(ENDS) {
        let (opening, slip) = axes.split((jump[i] + jump[j]) * 0.5);
        let traction = law.respond(point, opening + memory.offset, slip);
        // A third of the area; half of it to each end of the edge.
        let force = axes.join(traction.normal, traction.shear) * (area / 6.0);
        out.forces[i] += force;
        out.forces[j] += force;
        out.dissipated += traction.dissipated * (area / 3.0);
        out.failed += u8::from(point.damage >= 1.0);
        memory.is_worn |= !point.is_whole();
    }
    out
}

/// Energy that a joint would give back where its faces were at the last call [J].
pub fn stored(law: &CohesiveLaw, area: f64, memory: &Memory) -> f64 {
    memory.points.iter().map(|point| law.stored(point)).sum::<f64>() * (area / 3.0)
}

impl Memory {
    /// Memory of a tied joint that comes free under the given stress vector [Pa] on side 0.
    pub fn loaded(law: &CohesiveLaw, traction: DVec3, axes: &Axes) -> Self {
        let (normal, shear) = axes.split(traction);
        let (point, offset) = law.loaded(normal, shear);
        Self { points: [point; 3], offset, is_worn: true }
    }

    /// Whether a point has damage or slip behind it, or came free under load.
    pub fn is_worn(&self) -> bool {
        self.is_worn
    }

    /// Whether sliding (mode II) has taken more energy than opening (mode I).
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
