//! Volume that a body and its convex parts do not have in common.

use glam::DVec3;

use crate::geometry::convex::polyhedron::Polyhedron;
use crate::geometry::solid::Solid;

/// Number of vertical lines along the longer horizontal edge of the bounding box.
const LINES: f64 = 128.0;

/// Boundary points of body and parts on a vertical line.
type Line = Vec<Crossing>;

/// A point at which a line, followed upwards, enters (1) or leaves (-1) the body or a part.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    z: f64,
    body: i32,
    parts: i32,
}

/// Volume of the symmetric difference of body and parts, divided by the volume of the body [-]. The lengths along the
/// vertical lines of a lattice are exact.
pub(super) fn volume_error(solid: &Solid, parts: &[Polyhedron]) -> f64 {
    let [low, high] = solid.bounds();
    let step = (high - low).truncate().max_element() / LINES;
    let [columns, rows] = [(high.x - low.x) / step, (high.y - low.y) / step].map(|n| n.ceil() as usize + 2);
    // Faces often lie at coordinates with few digits. The offsets keep the lines off the faces.
    let x = |i: usize| low.x + step * (i as f64 - 0.47);
    let y = |j: usize| low.y + step * (j as f64 - 0.53);
    let range = |from: f64, to: f64, start: f64, count: usize| {
        let first = ((from - start) / step).floor().max(0.0) as usize;
        first..(((to - start) / step).ceil().max(0.0) as usize + 2).min(count)
    };
    let mut lines: Vec<Line> = vec![Line::new(); columns * rows];
    for triangle in solid.triangles() {
        let corners = triangle.map(|v| solid.vertices()[v as usize]);
        let [from, to] = [corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2])];
        for i in range(from.x, to.x, low.x, columns) {
            for j in range(from.y, to.y, low.y, rows) {
                lines[i * rows + j].extend(triangle_crossing(triangle, corners, x(i), y(j)));
            }
        }
    }
    for part in parts {
        let (centre, radius) = part.bounding_sphere();
        for i in range(centre.x - radius, centre.x + radius, low.x, columns) {
            for j in range(centre.y - radius, centre.y + radius, low.y, rows) {
                lines[i * rows + j].extend(part_crossings(part, x(i), y(j)).into_iter().flatten());
            }
        }
    }
    let (mut different, mut inside) = (0.0, 0.0);
    for line in &mut lines {
        line.sort_by(|a, b| a.z.total_cmp(&b.z));
        let (mut in_body, mut in_parts) = (0, 0);
        for pair in line.windows(2) {
            in_body += pair[0].body;
            in_parts += pair[0].parts;
            let length = pair[1].z - pair[0].z;
            inside += if in_body > 0 { length } else { 0.0 };
            different += if (in_body > 0) != (in_parts > 0) { length } else { 0.0 };
        }
    }
    if inside > 0.0 { different / inside } else { f64::INFINITY }
}

/// Crossing of the vertical line through (x, y) with a triangle.
fn triangle_crossing(triangle: &[u32; 3], corners: [DVec3; 3], x: f64, y: f64) -> Option<Crossing> {
    // Twice the area of the triangle of an edge and the line, seen from above. Two triangles compute the same value for
    // their common edge, so that a line never passes between them.
    let side = |a: usize, b: usize| {
        let (sign, a, b) = if triangle[a] < triangle[b] { (1.0, a, b) } else { (-1.0, b, a) };
        let ([ax, ay], [bx, by]) = ([corners[a].x - x, corners[a].y - y], [corners[b].x - x, corners[b].y - y]);
        sign * if ax * by >= ay * bx { (ax * by - ay * bx).max(f64::MIN_POSITIVE) } else { ax * by - ay * bx }
    };
    let weights = [side(1, 2), side(2, 0), side(0, 1)];
    let faces_up = weights.iter().all(|w| *w > 0.0);
    if !faces_up && !weights.iter().all(|w| *w < 0.0) {
        return None;
    }
    let z = (0..3).map(|k| weights[k] * corners[k].z).sum::<f64>() / weights.iter().sum::<f64>();
    Some(Crossing { z, body: if faces_up { -1 } else { 1 }, parts: 0 })
}

/// Crossings of the vertical line through (x, y) with a convex part.
fn part_crossings(part: &Polyhedron, x: f64, y: f64) -> Option<[Crossing; 2]> {
    let (mut bottom, mut top) = (f64::MIN, f64::MAX);
    for plane in part.faces().iter().map(|face| face.plane) {
        let height = -plane.distance(DVec3::new(x, y, 0.0));
        match plane.normal.z {
            slope if slope > 0.0 => top = top.min(height / slope),
            slope if slope < 0.0 => bottom = bottom.max(height / slope),
            _ if height < 0.0 => return None,
            _ => {}
        }
    }
    let crossing = |z: f64, parts: i32| Crossing { z, body: 0, parts };
    (bottom < top).then(|| [crossing(bottom, 1), crossing(top, -1)])
}
