//! Layers of boundary particles behind bed and walls, and their distances to the surface.
//!
//! The wetted outline of the flume (end wall, bed and mound, end wall) is a polyline in x and z. Layer k holds points
//! at the distance (k + 1/2) dp behind it: parallels of the straight pieces, trimmed where they come nearer to another
//! piece (under a crest), joined by arcs where they part (behind a toe or a corner). Every particle therefore knows the
//! exact distance and direction to the true surface; behind a corner that direction points at the corner, as English
//! et al. (2022) ask.

use glam::{DVec2, DVec3};

use super::boundary::BoundaryParticle;

/// The outline of the water's container in x and z, with the water to the left when walking along it.
#[derive(Debug, Clone)]
pub struct Outline {
    points: Vec<DVec2>,
}

impl Outline {
    /// Outline through `points` [m].
    pub fn new(points: Vec<DVec2>) -> Self {
        Self { points }
    }

    /// Nearest point of the outline.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        let candidates = self.points.windows(2).map(|piece| {
            let along = piece[1] - piece[0];
            let t = ((point - piece[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            piece[0] + t * along
        });
        candidates
            .min_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)))
            .expect("an outline has pieces")
    }

    /// Normal into the water at the place of the outline nearest to `point`, if that is nearer than `least` [m] or the
    /// point lies behind the outline.
    pub fn normal_within(&self, point: DVec2, least: f64) -> Option<DVec2> {
        let far = |piece: &[DVec2]| {
            let normal = left_normal(piece);
            // A point in front of a piece and further from its line than `least` is not concerned by it.
            (point - piece[0]).dot(normal) > least
        };
        if self.points.windows(2).all(far) {
            return None;
        }
        let mut best: Option<(f64, DVec2)> = None;
        for piece in self.points.windows(2) {
            let along = piece[1] - piece[0];
            let t = ((point - piece[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            let offset = point - (piece[0] + t * along);
            // Of two pieces that meet in the nearest corner the one that the point is further behind decides.
            let side = offset.dot(left_normal(piece));
            let signed = if side < 0.0 { -offset.length() } else { offset.length() };
            if best.is_none_or(|(nearest, _)| signed.abs() < f64::abs(nearest) - 1e-12) {
                best = Some((signed, left_normal(piece)));
            }
        }
        best.filter(|(signed, _)| *signed < least).map(|(_, normal)| normal)
    }

    /// Points behind the outline at distances (k + 1/2) dp for k below `layers`, about dp apart: the point, and the
    /// length of outline that it stands for [m].
    fn layers(&self, dp: f64, layers: u32) -> Vec<(DVec2, f64)> {
        let mut all = Vec::new();
        for depth in (0..layers).map(|k| (f64::from(k) + 0.5) * dp) {
            let nearest_allowed = depth * (1.0 - 1e-6);
            for piece in self.points.windows(2) {
                let length = piece[0].distance(piece[1]);
                let count = (length / dp).round().max(1.0);
                let behind = -left_normal(piece) * depth;
                let samples = (0..count as u32).map(|i| piece[0].lerp(piece[1], (f64::from(i) + 0.5) / count) + behind);
                let kept = samples.filter(|&p| self.nearest(p).distance(p) >= nearest_allowed);
                all.extend(kept.map(|p| (p, length / count)));
            }
            for corner in self.points.windows(3) {
                self.arc_behind(corner, depth, dp, nearest_allowed, &mut all);
            }
        }
        all
    }

    /// Points on the arc behind a corner that is hollow on the water's side.
    fn arc_behind(&self, corner: &[DVec2], depth: f64, dp: f64, nearest_allowed: f64, all: &mut Vec<(DVec2, f64)>) {
        let (before, after) = (left_normal(&corner[0..2]), left_normal(&corner[1..3]));
        let turn = before.angle_to(after);
        let count = (turn * depth / dp).round();
        if turn <= 0.0 || count < 1.0 {
            return;
        }
        for i in 0..count as u32 {
            let angle = turn * (f64::from(i) + 0.5) / count;
            let point = corner[1] - DVec2::from_angle(angle).rotate(before) * depth;
            if self.nearest(point).distance(point) >= nearest_allowed {
                all.push((point, turn * depth / count));
            }
        }
    }
}

/// Unit normal to the left of a piece: into the water.
fn left_normal(piece: &[DVec2]) -> DVec2 {
    (piece[1] - piece[0]).normalize().perp()
}

/// Particles across the flume.
#[derive(Debug, Clone, Copy)]
pub struct Across {
    /// Width [m].
    pub width: f64,
    /// Particles across the width.
    pub count: u32,
    /// Whether walls stand at y = 0 and y = width; else the flume is periodic.
    pub walls: bool,
}

impl Across {
    /// Distance between particles across the flume [m].
    pub fn spacing(&self) -> f64 {
        self.width / f64::from(self.count)
    }

    /// From y to the nearest place between the sides [m].
    pub fn to_inside(&self, y: f64) -> f64 {
        y.clamp(0.0, self.width) - y
    }

    /// y of the particles of an extruded sheet [m]; behind side walls it goes on for `layers`.
    pub fn rows(&self, layers: u32) -> Vec<f64> {
        let beyond = if self.walls { i64::from(layers) } else { 0 };
        (-beyond..i64::from(self.count) + beyond).map(|j| (j as f64 + 0.5) * self.spacing()).collect()
    }
}

/// Boundary particles behind the outline, all across the flume and into the corners behind side walls.
pub fn outline_particles(outline: &Outline, across: &Across, dp: f64, layers: u32) -> Vec<BoundaryParticle> {
    let section = outline.layers(dp, layers);
    let mut particles = Vec::with_capacity(section.len() * across.count as usize);
    for (point, length) in section {
        let to_outline = outline.nearest(point) - point;
        for y in across.rows(layers) {
            particles.push(BoundaryParticle {
                position: DVec3::new(point.x, y, point.y),
                to_surface: DVec3::new(to_outline.x, across.to_inside(y), to_outline.y),
                volume: length * dp * across.spacing(),
            });
        }
    }
    particles
}

/// Boundary particles of the side walls behind the points (x, z) of their water face, each of which stands for an area
/// [m2].
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
        Outline::new(points.map(DVec2::from_array).to_vec())
    }

    #[test]
    fn layers_keep_their_distance_to_the_surface() {
        let (outline, dp) = (tank_with_mound(), 0.02);
        for (point, _) in outline.layers(dp, 3) {
            let layers = outline.nearest(point).distance(point) / dp - 0.5;
            // 1e-5: the trimming allows 1e-6 of the depth.
            assert!((layers - layers.round()).abs() < 1e-5, "{point} {layers}");
        }
    }

    #[test]
    fn layers_fill_the_space_behind_the_surface() {
        let (outline, dp) = (tank_with_mound(), 0.02);
        let area: f64 = outline.layers(dp, 3).iter().map(|(_, length)| length * dp).sum();
        let length: f64 = outline.points.windows(2).map(|p| p[0].distance(p[1])).sum();
        // Parallels give length * 3 dp; hollow corners add an arc of turn * 4.5 dp^2, crests lose turn * dp^2-sized
        // pieces: 1 % of this outline.
        assert!((area / (length * 3.0 * dp) - 1.0).abs() < 0.02, "{area}");
    }

    #[test]
    fn behind_a_corner_the_corner_is_nearest() {
        let across = Across { width: 0.2, count: 10, walls: true };
        let particles = outline_particles(&tank_with_mound(), &across, 0.02, 3);
        let behind = particles.iter().filter(|p| p.position.x < 0.0 && p.position.z < 0.0 && p.position.y < 0.0);
        assert!(behind.clone().count() > 0);
        for particle in behind {
            assert!((particle.position + particle.to_surface).length() < 1e-12);
        }
    }
}
