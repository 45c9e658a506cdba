//! Surfaces that face up everywhere, for example a survey of the sea bed: levels in side view, and the body below.

use std::collections::HashSet;

use glam::{DVec2, DVec3};

use super::solid::{Solid, SolidError};
use super::terrain::Terrain;

/// Smallest vertical component of a unit normal that faces up [-].
const UPWARDS: f64 = 1e-3;
/// Points of a line of levels nearer than this along x count as one, divided by the length of the surface [-].
const SAME: f64 = 2e-5;
/// A line across the flume is covered if the triangles cover at least this share of its length [-].
const COVERED: f64 = 1.0 - 1e-6;

/// Returns the centre [m] of a triangle that does not face up, for example of an overhang; `None` if all face up.
pub fn overhang(surface: &Terrain) -> Option<DVec3> {
    let corners = |triangle: &[u32; 3]| triangle.map(|v| surface.vertices()[v as usize]);
    let is_over = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).normalize_or_zero().z < UPWARDS;
    surface.triangles().iter().map(corners).find(is_over).map(|[a, b, c]| (a + b + c) / 3.0)
}

/// Lowest and highest level of a surface across the flume, at one x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Levels {
    /// Position x [m].
    pub x: f64,
    /// Lowest level [m].
    pub lowest: f64,
    /// Highest level [m].
    pub highest: f64,
}

/// Returns the levels of a surface that faces up, between two y [m], as lines: one line for each stretch of x in which
/// the surface covers all y. If both y are equal, the lines are the section of the surface.
///
/// Between two of its points, a line of lowest levels is at or below the surface: each of these levels is the least of
/// linear functions of x.
pub fn levels_across(surface: &Terrain, [y0, y1]: [f64; 2]) -> Vec<Vec<Levels>> {
    let corners = |triangle: &[u32; 3]| triangle.map(|v| surface.vertices()[v as usize]);
    let mut triangles: Vec<[DVec3; 3]> = surface.triangles().iter().map(corners).collect();
    let least = |triangle: &[DVec3; 3]| triangle.iter().map(|corner| corner.x).fold(f64::INFINITY, f64::min);
    triangles.sort_by(|a, b| least(a).total_cmp(&least(b)));
    let knots = knots(surface, &triangles, [y0, y1]);
    let (mut next, mut active) = (0, Vec::new());
    // The triangles at x, for increasing x.
    let mut cut = |x: f64| -> Vec<[DVec2; 2]> {
        while next < triangles.len() && least(&triangles[next]) <= x {
            active.push(triangles[next]);
            next += 1;
        }
        active.retain(|triangle: &[DVec3; 3]| triangle.iter().any(|corner| corner.x >= x));
        active.iter().filter_map(|triangle| cut_at(triangle, x)).filter_map(|line| within(line, [y0, y1])).collect()
    };
    let mut lines: Vec<Vec<Levels>> = Vec::new();
    let mut open = false;
    for (index, x) in knots.iter().copied().enumerate() {
        let pieces = cut(x);
        let levels = || pieces.iter().flatten().map(|point| point.y);
        let (lowest, highest) = (levels().fold(f64::INFINITY, f64::min), levels().fold(f64::NEG_INFINITY, f64::max));
        let at = Levels { x, lowest, highest };
        if open && let Some(line) = lines.last_mut() {
            line.push(at);
        }
        let covers = knots.get(index + 1).is_some_and(|following| {
            let pieces = cut(0.5 * (x + following));
            let length: f64 = pieces.iter().map(|[from, to]| to.x - from.x).sum();
            !pieces.is_empty() && length >= COVERED * (y1 - y0)
        });
        if covers && !open {
            lines.push(vec![at]);
        }
        open = covers;
    }
    lines
}

/// Returns x of the points at which the lines of levels can bend [m], in increasing order: corners between the two y, and
/// edges that cross one of them.
fn knots(surface: &Terrain, triangles: &[[DVec3; 3]], y: [f64; 2]) -> Vec<f64> {
    let between = surface.vertices().iter().filter(|v| v.y >= y[0] && v.y <= y[1]).map(|v| v.x);
    let edges = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let crossing = edges.flat_map(|[a, b]| {
        let crosses = y.into_iter().filter(move |y| (a.y - y) * (b.y - y) < 0.0);
        crosses.map(move |y| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
    });
    let mut knots: Vec<f64> = between.chain(crossing).collect();
    knots.sort_by(f64::total_cmp);
    let [low, high] = surface.bounds();
    knots.dedup_by(|later, kept| *later - *kept <= SAME * (high.x - low.x));
    knots
}

/// Returns the ends [y, z] of the line in which a triangle cuts the plane at x [m], the smaller y first.
fn cut_at(triangle: &[DVec3; 3], x: f64) -> Option<[DVec2; 2]> {
    let mut points = Vec::with_capacity(4);
    for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (triangle[from], triangle[to])) {
        if from.x == x {
            points.push(DVec2::new(from.y, from.z));
        }
        if (from.x - x) * (to.x - x) < 0.0 {
            let at = from.lerp(to, (x - from.x) / (to.x - from.x));
            points.push(DVec2::new(at.y, at.z));
        }
    }
    let least = points.iter().copied().min_by(|a, b| a.x.total_cmp(&b.x))?;
    let most = points.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x))?;
    Some([least, most])
}

/// Returns the part of a line [y, z] between two y [m].
fn within([from, to]: [DVec2; 2], [y0, y1]: [f64; 2]) -> Option<[DVec2; 2]> {
    if to.x < y0 || from.x > y1 {
        return None;
    }
    let at =
        |y: f64| if to.x > from.x { from.lerp(to, ((y - from.x) / (to.x - from.x)).clamp(0.0, 1.0)) } else { from };
    Some([at(y0), at(y1)])
}

/// Leaves out points of a line that are at most `tolerance` [m] away from the straight line between their remaining
/// neighbours (Douglas & Peucker 1973).
pub fn simplified(line: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let mut keep = vec![false; line.len()];
    let Some(last) = line.len().checked_sub(1) else { return Vec::new() };
    (keep[0], keep[last]) = (true, true);
    let mut left = vec![[0, last]];
    while let Some([from, to]) = left.pop() {
        let (start, along) = (line[from], line[to] - line[from]);
        let off = |point: DVec2| (point.y - start.y - along.y * (point.x - start.x) / along.x).abs();
        let furthest = (from + 1..to).map(|index| (off(line[index]), index)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, index)) = furthest
            && distance > tolerance
        {
            keep[index] = true;
            left.extend([[from, index], [index, to]]);
        }
    }
    line.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

/// Returns the body between a surface that faces up and the level `bottom` [m].
///
/// # Errors
/// If the body is not closed, for example because two parts of the surface meet in one corner.
pub fn body_below(surface: &Terrain, bottom: f64) -> Result<Solid, SolidError> {
    let count = surface.vertices().len() as u32;
    let below = surface.vertices().iter().map(|v| DVec3 { z: bottom, ..*v });
    let vertices = surface.vertices().iter().copied().chain(below).collect();
    let edges = || surface.triangles().iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let known: HashSet<[u32; 2]> = edges().collect();
    let border = edges().filter(|[a, b]| !known.contains(&[*b, *a]));
    let sides = border.flat_map(|[a, b]| [[b, a, a + count], [b, a + count, b + count]]);
    let foot = surface.triangles().iter().map(|[a, b, c]| [a + count, c + count, b + count]);
    Solid::new(vertices, surface.triangles().iter().copied().chain(foot).chain(sides).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::terrain::tests::extruded_profile;

    fn lower_edge(line: &[Levels]) -> Vec<DVec2> {
        line.iter().map(|levels| DVec2::new(levels.x, levels.lowest)).collect()
    }

    #[test]
    fn profile_across_the_flume_is_its_own_lower_edge() {
        let points = [[0.0, 0.1], [1.0, 0.0], [2.0, 0.5], [4.0, 0.5]];
        let surface = extruded_profile(&points);
        assert_eq!(overhang(&surface), None);
        for y in [[-0.5, 0.7], [0.3, 0.3], [-1.0, 1.0]] {
            let lines = levels_across(&surface, y);
            assert_eq!(lines.len(), 1);
            assert!(lines[0].iter().all(|levels| levels.highest - levels.lowest < 1e-12));
            // The diagonals of the strips add points in between.
            let line = simplified(&lower_edge(&lines[0]), 1e-12);
            assert_eq!(line.len(), 4);
            for (found, wanted) in line.iter().zip(points) {
                assert!((*found - DVec2::from_array(wanted)).length() < 1e-12, "{found}");
            }
        }
        // The surface ends at y = 1.
        assert!(levels_across(&surface, [0.0, 1.5]).is_empty());
    }

    #[test]
    fn lower_edge_of_a_pyramid_is_below_it() {
        let vertices = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.2]];
        let height = |index: usize| if index == 4 { 1.0 } else { 0.0 };
        let vertices = vertices.iter().enumerate().map(|(k, [x, y])| DVec3::new(*x, *y, height(k))).collect();
        let surface = Terrain::new(vertices, vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).unwrap();
        let section = lower_edge(&levels_across(&surface, [1.2, 1.2])[0]);
        assert_eq!(section.iter().map(|point| point.y).fold(0.0, f64::max), 1.0);
        let lowest = lower_edge(&levels_across(&surface, [0.6, 1.4])[0]);
        // At the tip of the pyramid, the lowest level is that at y = 0.6, half of the way to the tip.
        let middle = lowest.iter().find(|point| (point.x - 1.0).abs() < 1e-12).unwrap();
        assert!((middle.y - 0.5).abs() < 1e-12, "{middle}");
        for pair in lowest.windows(2) {
            let at = 0.5 * (pair[0] + pair[1]);
            let levels = (0..=80).filter_map(|k| surface.level(at.x, 0.6 + 0.01 * f64::from(k)));
            assert!(levels.fold(f64::INFINITY, f64::min) > at.y - 1e-12);
        }
        // Volume of the pyramid, 4/3, and of the box below it.
        let body = body_below(&surface, -0.5).unwrap();
        assert!((body.volume_properties().volume - (4.0 / 3.0 + 2.0)).abs() < 1e-12);
    }

    #[test]
    fn a_box_has_an_overhang() {
        let (vertices, triangles) = crate::geometry::solid::tests::cuboid(DVec3::ZERO, DVec3::ONE);
        assert!(overhang(&Terrain::new(vertices, triangles).unwrap()).is_some());
    }
}
