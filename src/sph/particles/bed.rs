//! Layers of boundary particles behind bed and walls, and their distances to the surface.
//!
//! The wetted outline of the flume (end wall, bed and mound, end wall) is a polyline in x and z. Layer k holds points
//! at the distance (k + 1/2) dp behind it: parallels of the straight pieces, trimmed where they come nearer to another
//! piece (under a crest), joined by arcs where they part (behind a toe or a corner), and only then divided, so that the
//! particles' volumes fill the layers exactly. Every particle knows the exact distance and direction to the true
//! surface; behind a corner that direction points at the corner, as English et al. (2022) ask.

use glam::{DVec2, DVec3};

use super::boundary::BoundaryParticle;

/// Share of its depth by which a point of a parallel may lie nearer to the outline, and share of dp below which a
/// stretch is nothing, for rounding.
const ROUNDING: f64 = 1e-6;

/// Steps in which a parallel is looked along for places where it comes too near to the outline [dp].
const LOOKED_AT: f64 = 0.1;

/// Turn of the bed from which a corner that sticks out into the water is an edge [rad]: 20 degrees.
const EDGE: f64 = 0.35;

/// Slope from which, and up to the same from the vertical, water does not slide along the bed [rad]: 14 degrees, 1:4.
/// Over the 1:1 flanks of a wedge, still water that slides begins to circulate: its kinetic energy doubles every second
/// after ten of them, where it decays if it does not. Waves travel along flatter beds.
const STEEP: f64 = 0.245;

/// Bisections that find the end of a stretch to 1e-7 dp.
const BISECTIONS: u32 = 20;

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

    /// Its straight pieces, from end to end.
    pub fn pieces(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.points.windows(2).map(|piece| [piece[0], piece[1]])
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

    /// Whether a point of the outline is nearer than `reach` [m] to an edge that sticks out into the water.
    fn is_at_edge(&self, point: DVec2, reach: f64) -> bool {
        self.points.windows(3).any(|corner| {
            let turn = left_normal(&corner[0..2]).angle_to(left_normal(&corner[1..3]));
            turn < -EDGE && corner[1].distance(point) < reach
        })
    }

    /// Points behind the outline at distances (k + 1/2) dp for k below `layers`, about dp apart: the point, and the
    /// length of its layer that it stands for [m].
    fn layers(&self, dp: f64, layers: u32) -> Vec<(DVec2, f64)> {
        let mut all = Vec::new();
        for depth in (0..layers).map(|k| (f64::from(k) + 0.5) * dp) {
            for piece in self.points.windows(2) {
                let (length, behind) = (piece[0].distance(piece[1]), -left_normal(piece) * depth);
                self.divide(depth, dp, length, |s| piece[0].lerp(piece[1], s / length) + behind, &mut all);
            }
            for corner in self.points.windows(3) {
                let (before, after) = (left_normal(&corner[0..2]), left_normal(&corner[1..3]));
                // Where the bed turns away from the water the parallels of both pieces meet and there is no arc.
                let length = before.angle_to(after).max(0.0) * depth;
                let arc = |s: f64| corner[1] - DVec2::from_angle(s / depth).rotate(before) * depth;
                self.divide(depth, dp, length, arc, &mut all);
            }
        }
        all
    }

    /// Divide what of a parallel of the outline belongs to its layer evenly into parts about dp long, and add the
    /// middle and the length of each [m]. The parallel is `place`, by the length along it, at the distance `depth` [m].
    ///
    /// The lengths must sum to that of the layer exactly, at edges too: sum_b V_b grad W_ab vanishes only if the
    /// volumes fill the space behind the surface. Whole particles kept or left out at the apex and the toes of a wedge
    /// of 45 degrees, half a dp^2 a layer and flank, pushed the water there away with 2.5 g and drew it in with 1 g.
    fn divide(&self, depth: f64, dp: f64, length: f64, place: impl Fn(f64) -> DVec2, all: &mut Vec<(DVec2, f64)>) {
        for [from, to] in self.stretches(depth, dp, length, &place) {
            let count = ((to - from) / dp).round().max(1.0);
            let part = (to - from) / count;
            if part > ROUNDING * dp {
                all.extend((0..count as u32).map(|i| (place(from + (f64::from(i) + 0.5) * part), part)));
            }
        }
    }

    /// The stretches of a parallel that lie nowhere nearer to the outline than `depth` [m].
    fn stretches(&self, depth: f64, dp: f64, length: f64, place: &impl Fn(f64) -> DVec2) -> Vec<[f64; 2]> {
        let belongs = |s: f64| {
            let point = place(s);
            self.nearest(point).distance(point) >= depth * (1.0 - ROUNDING)
        };
        let steps = (length / (LOOKED_AT * dp)).ceil() as u32;
        let mut stretches = Vec::new();
        let (mut last, mut start) = (0.0, belongs(0.0).then_some(0.0));
        for s in (1..=steps).map(|i| length * f64::from(i) / f64::from(steps)) {
            match (start, belongs(s)) {
                (None, true) => start = Some(change(s, last, belongs)),
                (Some(from), false) => {
                    stretches.push([from, change(last, s, belongs)]);
                    start = None;
                }
                _ => {}
            }
            last = s;
        }
        stretches.extend(start.map(|from| [from, length]));
        stretches
    }
}

/// Where a condition that holds at `inside` and not at `outside` changes, by bisection.
fn change(mut inside: f64, mut outside: f64, holds: impl Fn(f64) -> bool) -> f64 {
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

/// Boundary particles behind the outline, all across the flume and into the corners behind side walls. Those nearer to
/// an edge than `reach` [m], the radius of the kernel's support, stand for both of its sides: water does not slide there.
pub fn outline_particles(
    outline: &Outline,
    across: &Across,
    dp: f64,
    layers: u32,
    reach: f64,
) -> Vec<BoundaryParticle> {
    let section = outline.layers(dp, layers);
    let mut particles = Vec::with_capacity(section.len() * across.count as usize);
    for (point, length) in section {
        let nearest = outline.nearest(point);
        let to_outline = nearest - point;
        let upright = to_outline.normalize_or_zero().y.abs();
        let on_flank = (STEEP.sin()..STEEP.cos()).contains(&upright);
        let slides = !on_flank && !outline.is_at_edge(nearest, reach);
        for y in across.rows(layers) {
            particles.push(BoundaryParticle {
                position: DVec3::new(point.x, y, point.y),
                to_surface: DVec3::new(to_outline.x, across.to_inside(y), to_outline.y),
                volume: length * dp * across.spacing(),
                slides,
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
                    slides: true,
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
        let dp = 0.02;
        let toe = Outline::new([[0.0, 0.0], [1.0, 0.0], [1.3, 0.3]].map(DVec2::from_array).to_vec());
        let apex = Outline::new([[0.0, 0.0], [0.3, 0.3], [0.6, 0.0]].map(DVec2::from_array).to_vec());
        for outline in [tank_with_mound(), toe, apex] {
            let area: f64 = outline.layers(dp, 3).iter().map(|(_, length)| length * dp).sum();
            let length: f64 = outline.points.windows(2).map(|p| p[0].distance(p[1])).sum();
            let turns = outline.points.windows(3).map(|p| left_normal(&p[0..2]).angle_to(left_normal(&p[1..3])));
            // Down to the depth d a hollow corner with the turn t adds the sector t d^2 / 2, a crest loses tan(t / 2)
            // d^2.
            let at_corners: f64 = turns.map(|t| if t > 0.0 { 0.5 * t } else { (0.5 * t).tan() }).sum();
            let depth = 3.0 * dp;
            let exact = length * depth + at_corners * depth * depth;
            // 1e-5: a stretch ends where a point lies nearer by the rounding of 1e-6 of its depth.
            assert!((area / exact - 1.0).abs() < 1e-5, "{area} {exact}");
        }
    }

    #[test]
    fn water_slides_along_bed_and_walls_but_not_at_edges() {
        // A quay: an edge at (1, 0.5), hollow corners at its foot and at the walls.
        let quay = [[0.0, 1.0], [0.0, 0.5], [1.0, 0.5], [1.0, 0.0], [3.0, 0.0], [3.0, 1.0]];
        let outline = Outline::new(quay.map(DVec2::from_array).to_vec());
        let across = Across { width: 0.02, count: 1, walls: false };
        let reach = 0.083;
        for particle in outline_particles(&outline, &across, 0.02, 3, reach) {
            let foot = particle.position + particle.to_surface;
            let from_edge = foot.distance(DVec3::new(1.0, foot.y, 0.5));
            // Behind a hollow corner the way to the surface has any direction.
            let behind_corner = particle.to_surface.x.abs().min(particle.to_surface.z.abs()) > 1e-9;
            assert!(behind_corner || particle.slides == (from_edge >= reach), "{foot}");
        }
        let flank = Outline::new([[0.0, 0.0], [1.0, 0.5], [9.0, 1.5]].map(DVec2::from_array).to_vec());
        for particle in outline_particles(&flank, &across, 0.02, 3, reach) {
            // 1:2 holds, 1:8 lets slide; at the seam the layers go over into each other.
            let x = particle.position.x + particle.to_surface.x;
            assert!((x - 1.0).abs() < 0.1 || particle.slides == (x > 1.0), "{x}");
        }
    }

    #[test]
    fn behind_a_corner_the_corner_is_nearest() {
        let across = Across { width: 0.2, count: 10, walls: true };
        let particles = outline_particles(&tank_with_mound(), &across, 0.02, 3, 0.083);
        let behind = particles.iter().filter(|p| p.position.x < 0.0 && p.position.z < 0.0 && p.position.y < 0.0);
        assert!(behind.clone().count() > 0);
        for particle in behind {
            assert!((particle.position + particle.to_surface).length() < 1e-12);
        }
    }
}
