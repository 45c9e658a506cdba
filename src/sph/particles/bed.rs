//! Layers of boundary particles behind bed and walls, with their vectors to the surface.
//!
//! The wetted outline of the flume (end wall, bed and mound, end wall) is a polyline in x and z. Layer k = 0, 1, 2
//! consists of points at the distance (k + 1/2) dp behind this outline, on lines parallel to its segments
//! ("parallels"). Under a crest, a parallel ends where another segment is nearer than this distance; the remaining part
//! is called a stretch. Behind a concave corner, an arc joins two parallels. Stretches and arcs are divided into equal
//! pieces, one per particle, so that the particle volumes fill the layers exactly. Every particle stores the exact
//! vector to the nearest point of the outline. Behind a concave corner, this point is the corner (English et al. 2022).

use glam::{DVec2, DVec3};

use super::boundary::BoundaryParticle;
use crate::geometry::outline::Outline;
use crate::geometry::outline::segments::left_normal;
use crate::sph::terms::wall_slip::Mirroring;

/// Tolerance for rounding errors of the distance from the outline, divided by the depth behind the outline [-]. Pieces
/// that are shorter than this value times dp are left out.
const ROUNDING: f64 = 1e-6;

/// Spacing of the points at which the distance from a parallel to the outline is checked [dp].
const CHECK_SPACING: f64 = 0.1;

/// Smallest turn of the outline at which a convex corner counts as an edge [rad]: 20 degrees.
const EDGE_TURN: f64 = 0.35;

/// A bed that is inclined by at least this angle to both the horizontal and the vertical has no free slip [rad]: 14
/// degrees, a slope of 1:4. With free slip on the 1:1 flanks of a wedge, still water begins to circulate, and after ten
/// seconds its kinetic energy doubles every second. Without free slip, its kinetic energy decays. Most beds along which
/// waves travel are flatter and keep free slip.
const FLANK_ANGLE: f64 = 0.245;

/// Number of bisection steps with which the end of a stretch is located. They reduce the error to 1e-7 dp.
const BISECTIONS: u32 = 20;

/// Returns true if a point of the outline is nearer than `reach` [m] to a convex edge.
fn is_at_edge(outline: &Outline, point: DVec2, reach: f64) -> bool {
    outline.corners().any(|[before, after]| {
        let turn = left_normal(&before).angle_to(left_normal(&after));
        turn < -EDGE_TURN && after[0].distance(point) < reach
    })
}

/// Returns points about `dp` [m] apart in all layers, (k + 1/2) dp behind the outline for k < `layers`. Each point
/// is returned with the length of the piece of the layer that it represents [m].
fn layers_behind(outline: &Outline, dp: f64, layers: u32) -> Vec<(DVec2, f64)> {
    let mut all = Vec::new();
    for depth in (0..layers).map(|k| (f64::from(k) + 0.5) * dp) {
        for segment in outline.segments() {
            let (length, behind) = (segment[0].distance(segment[1]), -left_normal(segment) * depth);
            divide(outline, depth, dp, length, |s| segment[0].lerp(segment[1], s / length) + behind, &mut all);
        }
        for [first, second] in outline.corners() {
            let (before, after) = (left_normal(&first), left_normal(&second));
            // Behind a convex corner the two parallels intersect, so there is no arc.
            let length = before.angle_to(after).max(0.0) * depth;
            let arc = |s: f64| second[0] - DVec2::from_angle(s / depth).rotate(before) * depth;
            divide(outline, depth, dp, length, arc, &mut all);
        }
    }
    all
}

/// Divides the stretches of a parallel into equal pieces about `dp` [m] long. Appends the midpoint and the length
/// of each piece [m] to `all`. The parallel is `length` [m] long and lies `depth` [m] behind the outline.
/// `point_at` returns the point of the parallel at a given distance from its start [m].
///
/// The sum of the lengths must equal the length of the layer exactly, also at edges, because sum_b V_b grad W_ab
/// vanishes only if the volumes fill the space behind the surface. In a trial, a particle at the edge of a 45
/// degree wedge was either kept whole or removed. The area error was dp^2 / 2 per layer and flank. Water above the
/// apex was accelerated away with 2.5 g, and water at the toes was accelerated towards the bed with 1 g.
fn divide(
    outline: &Outline,
    depth: f64,
    dp: f64,
    length: f64,
    point_at: impl Fn(f64) -> DVec2,
    all: &mut Vec<(DVec2, f64)>,
) {
    for [from, to] in stretches(outline, depth, dp, length, &point_at) {
        let count = ((to - from) / dp).round().max(1.0);
        let part = (to - from) / count;
        if part > ROUNDING * dp {
            all.extend((0..count as u32).map(|i| (point_at(from + (f64::from(i) + 0.5) * part), part)));
        }
    }
}

/// Returns start and end of each stretch of a parallel, as distances from the start of the parallel [m]. On a
/// stretch, no point is nearer to the outline than `depth` [m].
fn stretches(outline: &Outline, depth: f64, dp: f64, length: f64, point_at: &impl Fn(f64) -> DVec2) -> Vec<[f64; 2]> {
    let is_in_layer = |s: f64| {
        let point = point_at(s);
        outline.nearest(point).distance(point) >= depth * (1.0 - ROUNDING)
    };
    let steps = (length / (CHECK_SPACING * dp)).ceil() as u32;
    let mut stretches = Vec::new();
    let (mut last, mut start) = (0.0, is_in_layer(0.0).then_some(0.0));
    for s in (1..=steps).map(|i| length * f64::from(i) / f64::from(steps)) {
        match (start, is_in_layer(s)) {
            (None, true) => start = Some(find_change(s, last, is_in_layer)),
            (Some(from), false) => {
                stretches.push([from, find_change(last, s, is_in_layer)]);
                start = None;
            }
            _ => {}
        }
        last = s;
    }
    stretches.extend(start.map(|from| [from, length]));
    stretches
}

/// Finds by bisection the position where a condition changes. The condition is true at `inside` and false at `outside`.
fn find_change(mut inside: f64, mut outside: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (inside + outside);
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// Arrangement of the particles across the flume.
#[derive(Debug, Clone, Copy)]
pub struct Across {
    /// Width [m].
    pub width: f64,
    /// Number of particles across the width.
    pub count: u32,
    /// True if there are walls at y = 0 and y = width; false if the flume is periodic.
    pub walls: bool,
}

impl Across {
    /// Returns the particle spacing across the flume [m].
    pub fn spacing(&self) -> f64 {
        self.width / f64::from(self.count)
    }

    /// Returns the vector along y from `y` to the nearest side [m], for a point outside the flume; zero between the
    /// sides.
    pub fn to_inside(&self, y: f64) -> f64 {
        y.clamp(0.0, self.width) - y
    }

    /// Returns the y positions of the particles [m]. If there are side walls, the positions include `layers` rows
    /// behind each wall.
    pub fn rows(&self, layers: u32) -> Vec<f64> {
        let beyond = if self.walls { i64::from(layers) } else { 0 };
        (-beyond..i64::from(self.count) + beyond).map(|j| (j as f64 + 0.5) * self.spacing()).collect()
    }
}

/// Returns the boundary particles behind the outline, across the whole flume and in the corners behind side walls.
/// `reach` is the kernel support radius [m]. A particle has no free slip if its surface point is nearer to a convex
/// edge than `reach`, because it then represents both faces of the edge.
pub fn outline_particles(
    outline: &Outline,
    across: &Across,
    dp: f64,
    layers: u32,
    reach: f64,
) -> Vec<BoundaryParticle> {
    let section = layers_behind(outline, dp, layers);
    let mut particles = Vec::with_capacity(section.len() * across.count as usize);
    for (point, length) in section {
        let nearest = outline.nearest(point);
        let to_outline = nearest - point;
        let upright = to_outline.normalize_or_zero().y.abs();
        let on_flank = (FLANK_ANGLE.sin()..FLANK_ANGLE.cos()).contains(&upright);
        let mirroring =
            if on_flank || is_at_edge(outline, nearest, reach) { Mirroring::Normal } else { Mirroring::Full };
        for y in across.rows(layers) {
            particles.push(BoundaryParticle {
                position: DVec3::new(point.x, y, point.y),
                to_surface: DVec3::new(to_outline.x, across.to_inside(y), to_outline.y),
                volume: length * dp * across.spacing(),
                mirroring,
            });
        }
    }
    particles
}

/// Returns the boundary particles of the side walls. `section` lists points (x, z) of the wetted face, each with the
/// area that it represents [m2].
pub fn side_wall_particles(section: &[(DVec2, f64)], across: &Across, layers: u32) -> Vec<BoundaryParticle> {
    if !across.walls {
        return Vec::new();
    }
    let mut particles = Vec::new();
    for (point, area) in section {
        for layer in 0..layers {
            let behind = (f64::from(layer) + 0.5) * across.spacing();
            for (y, to_wall) in [(-behind, behind), (across.width + behind, -behind)] {
                particles.push(BoundaryParticle {
                    position: DVec3::new(point.x, y, point.y),
                    to_surface: DVec3::Y * to_wall,
                    volume: area * across.spacing(),
                    mirroring: Mirroring::Full,
                });
            }
        }
    }
    particles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tank_with_mound() -> Outline {
        let points = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.2, 0.1], [1.5, 0.1], [1.7, 0.0], [3.0, 0.0], [3.0, 1.0]];
        Outline::new(&points.map(DVec2::from_array))
    }

    #[test]
    fn layers_keep_their_distance_to_the_surface() {
        let (outline, dp) = (tank_with_mound(), 0.02);
        for (point, _) in layers_behind(&outline, dp, 3) {
            let layers = outline.nearest(point).distance(point) / dp - 0.5;
            // Limit 1e-5: the distance of a point to the outline has a tolerance of 1e-6 of its depth.
            assert!((layers - layers.round()).abs() < 1e-5, "{point} {layers}");
        }
    }

    #[test]
    fn layers_fill_the_space_behind_the_surface() {
        let dp = 0.02;
        let toe = Outline::new(&[[0.0, 0.0], [1.0, 0.0], [1.3, 0.3]].map(DVec2::from_array));
        let apex = Outline::new(&[[0.0, 0.0], [0.3, 0.3], [0.6, 0.0]].map(DVec2::from_array));
        for outline in [tank_with_mound(), toe, apex] {
            let area: f64 = layers_behind(&outline, dp, 3).iter().map(|(_, length)| length * dp).sum();
            let length: f64 = outline.segments().iter().map(|[a, b]| a.distance(*b)).sum();
            let turns = outline.corners().map(|[before, after]| left_normal(&before).angle_to(left_normal(&after)));
            // `exact` is the area of layers that reach the depth d behind the outline. A concave corner that turns by
            // the angle t adds t d^2 / 2 to length times d, and a convex corner removes tan(t / 2) d^2.
            let at_corners: f64 = turns.map(|t| if t > 0.0 { 0.5 * t } else { (0.5 * t).tan() }).sum();
            let depth = 3.0 * dp;
            let exact = length * depth + at_corners * depth * depth;
            // Limit 1e-5: the end of a stretch has a tolerance, because its points can be nearer to the outline by
            // 1e-6 of their depth.
            assert!((area / exact - 1.0).abs() < 1e-5, "{area} {exact}");
        }
    }

    #[test]
    fn free_slip_is_allowed_on_flat_beds_and_walls_but_not_at_edges_and_flanks() {
        // The outline is a quay with an edge at (1, 0.5), and with concave corners at its foot and at the end walls.
        let quay = [[0.0, 1.0], [0.0, 0.5], [1.0, 0.5], [1.0, 0.0], [3.0, 0.0], [3.0, 1.0]];
        let outline = Outline::new(&quay.map(DVec2::from_array));
        let across = Across { width: 0.02, count: 1, walls: false };
        let reach = 0.083;
        for particle in outline_particles(&outline, &across, 0.02, 3, reach) {
            let foot = particle.position + particle.to_surface;
            let from_edge = foot.distance(DVec3::new(1.0, foot.y, 0.5));
            // Behind a concave corner, `to_surface` can have any direction, so free slip is not checked there.
            let behind_corner = particle.to_surface.x.abs().min(particle.to_surface.z.abs()) > 1e-9;
            assert!(behind_corner || (particle.mirroring == Mirroring::Full) == (from_edge >= reach), "{foot}");
        }
        let flank = Outline::new(&[[0.0, 0.0], [1.0, 0.5], [9.0, 1.5]].map(DVec2::from_array));
        for particle in outline_particles(&flank, &across, 0.02, 3, reach) {
            // There is no free slip on the 1:2 slope (x < 1) and free slip on the 1:8 slope (x > 1). Particles near
            // x = 1 are not checked, because the layers of both slopes meet there.
            let x = particle.position.x + particle.to_surface.x;
            assert!((x - 1.0).abs() < 0.1 || (particle.mirroring == Mirroring::Full) == (x > 1.0), "{x}");
        }
    }

    #[test]
    fn surface_vectors_behind_a_corner_point_to_the_corner() {
        let across = Across { width: 0.2, count: 10, walls: true };
        let particles = outline_particles(&tank_with_mound(), &across, 0.02, 3, 0.083);
        let behind = particles.iter().filter(|p| p.position.x < 0.0 && p.position.z < 0.0 && p.position.y < 0.0);
        assert!(behind.clone().count() > 0);
        for particle in behind {
            assert!((particle.position + particle.to_surface).length() < 1e-12);
        }
    }
}
