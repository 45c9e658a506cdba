//! Where two rounded boxes are near each other.
//!
//! Two boxes that lie flush touch in an area, of which one pair of nearest points is an arbitrary one. What bears is
//! the polygon that their faces share: its corners are corners of one box over a face of the other, and places where
//! two edges cross. Each of these is a place of contact here. The corners' distances are exact and change smoothly;
//! where a crossing comes to the end of an edge, the edge is taken to be bent back with the rounding's radius, so that
//! the crossing fades as the corner takes over.

use glam::DVec3;

use super::gap::Placement;
use crate::geometry::cuboid::{EDGES, corner};

/// Number of a corner is 0 to 7, of an edge 8 to 19; this is the whole box.
pub const WHOLE: u16 = 20;
/// Number of the first edge.
const FIRST_EDGE: u16 = 8;

/// Square of the sine below which two edges are parallel: 0.6 degrees, at which the corners still bear [-].
const PARALLEL: f64 = 1e-4;
/// A crossing counts if the other edge lies outside both faces of an edge, but for this sine [-].
const BEHIND: f64 = 0.2;

/// A place where two boxes are near each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Corner, edge or whole of the first and of the second box.
    pub features: [u16; 2],
    /// Nearest points of the cores, world axes [m].
    pub points: [DVec3; 2],
    /// How far the surfaces are bent back here [m].
    pub bent: f64,
}

/// A core in the world.
struct Block {
    half: DVec3,
    placement: Placement,
    corners: [DVec3; 8],
}

impl Block {
    fn new(half: DVec3, placement: Placement) -> Self {
        let (q, x) = placement;
        Self { half, placement, corners: std::array::from_fn(|number| q * corner(half, number) + x) }
    }

    fn nearest(&self, point: DVec3) -> DVec3 {
        let (q, x) = self.placement;
        q * (q.inverse() * (point - x)).clamp(-self.half, self.half) + x
    }

    /// Outward normals of the two faces that meet in an edge.
    fn faces_at(&self, edge: usize) -> [DVec3; 2] {
        let [a, b] = EDGES[edge];
        let along = (a ^ b).trailing_zeros() as usize;
        let face = |axis: usize| {
            let mut normal = DVec3::ZERO;
            normal[axis] = if a >> axis & 1 == 1 { 1.0 } else { -1.0 };
            self.placement.0 * normal
        };
        [face((along + 1) % 3), face((along + 2) % 3)]
    }

    /// Whether `direction` points out of the box at an edge.
    fn points_out(&self, edge: usize, direction: DVec3) -> bool {
        self.faces_at(edge).iter().all(|face| face.dot(direction) > -BEHIND)
    }
}

/// Places where two equal boxes of half-edges `half` [m] with the rounding [m] are nearer than `reach` [m], cores
/// measured; a place without distance means that the cores overlap.
pub fn near_places(half: DVec3, rounding: f64, a: Placement, b: Placement, reach: f64) -> Vec<Near> {
    let (a, b) = (Block::new(half, a), Block::new(half, b));
    let mut places = Vec::new();
    let mut keep = |near: Near| {
        if near.points[0].distance_squared(near.points[1]) < reach * reach {
            places.push(near);
        }
    };
    for number in 0..8 {
        let (on_a, on_b) = (a.corners[number], b.corners[number]);
        keep(Near { features: [number as u16, WHOLE], points: [on_a, b.nearest(on_a)], bent: 0.0 });
        keep(Near { features: [WHOLE, number as u16], points: [a.nearest(on_b), on_b], bent: 0.0 });
    }
    for i in 0..12 {
        for j in 0..12 {
            if let Some(near) = crossing(&a, i, &b, j, rounding) {
                keep(near);
            }
        }
    }
    places
}

/// The place where edge i of one box crosses edge j of the other, if each lies on the outer side of the other.
fn crossing(a: &Block, i: usize, b: &Block, j: usize, rounding: f64) -> Option<Near> {
    let ends = |block: &Block, edge: usize| EDGES[edge].map(|number| block.corners[number]);
    let ([a_0, a_1], [b_0, b_1]) = (ends(a, i), ends(b, j));
    let (length_a, length_b) = (a_0.distance(a_1), b_0.distance(b_1));
    let (u, v) = ((a_1 - a_0) / length_a, (b_1 - b_0) / length_b);
    let (between, cosine) = (a_0 - b_0, u.dot(v));
    let sine_squared = 1.0 - cosine * cosine;
    if sine_squared < PARALLEL {
        return None;
    }
    let s = (cosine * v.dot(between) - u.dot(between)) / sine_squared;
    let t = (v.dot(between) - cosine * u.dot(between)) / sine_squared;
    let from_ends = [s, length_a - s, t, length_b - t];
    if from_ends.iter().any(|distance| *distance <= 0.0) {
        return None;
    }
    let (on_a, on_b) = (a_0 + s * u, b_0 + t * v);
    let out = (on_b - on_a).normalize_or_zero();
    if !(a.points_out(i, out) && b.points_out(j, -out)) {
        return None;
    }
    let bent = |distance: &f64| (rounding - distance).max(0.0).powi(2) / (2.0 * rounding);
    Some(Near {
        features: [FIRST_EDGE + i as u16, FIRST_EDGE + j as u16],
        points: [on_a, on_b],
        bent: from_ends.iter().map(bent).sum(),
    })
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    const HALF: DVec3 = DVec3::splat(0.45);
    const ROUNDING: f64 = 0.05;

    fn above(x: f64, z: f64, turn: f64) -> Vec<Near> {
        let upper = (DQuat::from_rotation_z(turn), DVec3::new(x, 0.0, z));
        near_places(HALF, ROUNDING, (DQuat::IDENTITY, DVec3::ZERO), upper, 0.2)
    }

    #[test]
    fn boxes_that_lie_flush_touch_at_the_corners_of_the_common_face() {
        let places = above(0.3, 1.0, 0.0);
        // Two corners of each are over the other's face; the others are 0.3 away.
        assert_eq!(places.len(), 4);
        for near in places {
            assert!((near.points[1] - near.points[0] - DVec3::Z * 0.1).length() < 1e-12);
        }
    }

    #[test]
    fn turned_boxes_touch_where_their_edges_cross() {
        let places = above(0.0, 1.0, 0.25 * std::f64::consts::PI);
        // The square over the square turned by an eighth: an octagon, no corner of one over the other.
        let crossings = places.iter().filter(|near| near.features[0] >= FIRST_EDGE && near.features[0] != WHOLE);
        assert_eq!((crossings.count(), places.len()), (8, 8));
        for near in places {
            assert!((near.points[1] - near.points[0] - DVec3::Z * 0.1).length() < 1e-12 && near.bent == 0.0);
        }
    }

    #[test]
    fn a_crossing_fades_before_it_leaves_an_edge() {
        let edge_up = DQuat::from_rotation_x(0.25 * std::f64::consts::PI);
        for shift in [0.0, 0.3, 0.41, 0.4499] {
            let lower = (edge_up, DVec3::ZERO);
            let across = DQuat::from_rotation_z(0.5 * std::f64::consts::PI);
            let upper = (across * edge_up, DVec3::new(shift, 0.0, 0.9 * 2f64.sqrt() + 0.1));
            let places = near_places(HALF, ROUNDING, lower, upper, 0.15);
            let near = places.iter().find(|near| near.features[0] >= FIRST_EDGE && near.features[0] != WHOLE).unwrap();
            let past = (shift - 0.4f64).max(0.0);
            assert!((near.bent - past * past / 0.1).abs() < 1e-9, "{shift}: {}", near.bent);
        }
    }
}
