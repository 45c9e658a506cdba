//! Bed, mound, obstacles and structure of the film.

use glam::DVec3;

use super::super::folder::RunFolder;
use super::super::scene::bed_in;
use crate::geometry::stl;
use crate::report::film::{Mesh, Series};

/// Thickness of the bed below its lowest point, divided by the width of the domain [-].
const THICKNESS: f64 = 0.15;

/// Returns the bed between the ends of the particle domain: a body with the bed profile as its upper side.
pub fn bed(run: &RunFolder) -> Series {
    let width = run.summary.domain_width_m;
    let profile = bed_in(run, run.summary.domain_x_m);
    let lowest = profile.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    let below = lowest - THICKNESS * width;
    let outline: Vec<[f64; 2]> =
        [profile.first(), profile.last()].into_iter().flatten().map(|p| [p[0], below]).collect();
    let outline = match outline.as_slice() {
        [first, last] => profile.into_iter().chain([*last, *first]).collect(),
        _ => Vec::new(),
    };
    Series::new("Bed", "#b9ae9a", 1.0, vec![extruded(&outline, below, width)])
}

/// Returns obstacles and parts of the structure, half transparent; `None` without them.
pub fn structure(run: &RunFolder) -> Option<Series> {
    let mut mesh = Mesh::default();
    for [low, high] in &run.summary.obstacles_m {
        let first = mesh.points.len() as u32;
        let corner =
            |index: u32| [0, 1, 2].map(|axis| if index >> axis & 1 == 1 { high[axis] } else { low[axis] } as f32);
        mesh.points.extend((0..8).map(corner));
        let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        mesh.triangles.extend(triangles.map(|corners: [u32; 3]| corners.map(|corner| first + corner)));
    }
    for section in &run.summary.sections {
        add_section(&section.points_m, run.summary.domain_width_m, &mut mesh);
    }
    for body in &run.summary.bodies {
        // A film without the body is better than no film.
        let path = run.dir.join(&body.file);
        let Ok(content) = std::fs::read(&path) else { continue };
        let Ok(surface) = stl::parse_terrain(&content, &path, body.scale) else { continue };
        let first = mesh.points.len() as u32;
        let origin = DVec3::from_array(body.origin_m);
        mesh.points.extend(surface.vertices().iter().map(|vertex| (*vertex + origin).as_vec3().to_array()));
        mesh.triangles.extend(surface.triangles().iter().map(|triangle| triangle.map(|corner| first + corner)));
    }
    (!mesh.points.is_empty()).then(|| Series::new("Structure", "#8d8370", 0.45, vec![mesh]))
}

/// Adds the surface of a body with this section between the planes y = 0 and y = `width`. Its ends are divided into
/// trapezoids between vertical lines through the corners.
fn add_section(section: &[[f64; 2]], width: f64, mesh: &mut Mesh) {
    let mut quad = |corners: [[f64; 3]; 4]| {
        let first = mesh.points.len() as u32;
        mesh.points.extend(corners.map(|corner| corner.map(|value| value as f32)));
        mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|corner: u32| first + corner)));
    };
    let edges: Vec<[[f64; 2]; 2]> =
        (0..section.len()).map(|k| [section[k], section[(k + 1) % section.len()]]).collect();
    for [[xa, za], [xb, zb]] in &edges {
        quad([[*xa, 0.0, *za], [*xb, 0.0, *zb], [*xb, width, *zb], [*xa, width, *za]]);
    }
    let mut lines: Vec<f64> = section.iter().map(|point| point[0]).collect();
    lines.sort_by(f64::total_cmp);
    lines.dedup();
    for pair in lines.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let middle = 0.5 * (from + to);
        let is_over = |[a, b]: &&[[f64; 2]; 2]| (a[0] < middle) != (b[0] < middle);
        let level = |[a, b]: &[[f64; 2]; 2], x: f64| a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
        let mut over: Vec<[f64; 2]> =
            edges.iter().filter(is_over).map(|edge| [level(edge, from), level(edge, to)]).collect();
        over.sort_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
        for trapezoid in over.chunks_exact(2) {
            let [low, high] = [trapezoid[0], trapezoid[1]];
            for y in [0.0, width] {
                quad([[from, y, low[0]], [to, y, low[1]], [to, y, high[1]], [from, y, high[0]]]);
            }
        }
    }
}

/// Returns the surface of the body between the planes y = 0 and y = `width` below a profile: the first points of
/// `outline` are the profile from left to right, the last two its ends at the height `below`.
fn extruded(outline: &[[f64; 2]], below: f64, width: f64) -> Mesh {
    let count = outline.len() as u32;
    let mut mesh = Mesh::default();
    for y in [0.0, width] {
        mesh.points.extend(outline.iter().map(|[x, z]| [*x as f32, y as f32, *z as f32]));
    }
    for index in 0..count {
        let (here, next) = (index, (index + 1) % count);
        mesh.triangles.extend([[here, next, next + count], [here, next + count, here + count]]);
    }
    // The two sides: vertical strips from the profile down to the plane below it.
    for index in 0..count.saturating_sub(3) {
        for side in [0, 1] {
            let first = mesh.points.len() as u32;
            let y = width * f64::from(side);
            let ends = [outline[index as usize], outline[index as usize + 1]];
            mesh.points.extend(ends.map(|[x, z]| [x as f32, y as f32, z as f32]));
            mesh.points.extend(ends.map(|[x, _]| [x as f32, y as f32, below as f32]));
            mesh.triangles.extend([[0, 2, 1], [1, 2, 3]].map(|corners| corners.map(|corner: u32| first + corner)));
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bed_has_the_area_of_its_sides() {
        // A step of 1 m on a bed 4 m long: profile of 5 m, two ends of 1 m and 2 m, underside of 4 m, sides of 6 m2.
        let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [4.0, 1.0], [4.0, -1.0], [0.0, -1.0]];
        let mesh = extruded(&outline, -1.0, 0.5);
        let corners = |t: &[u32; 3]| t.map(|corner| glam::Vec3::from_array(mesh.points[corner as usize]));
        let area: f32 = mesh.triangles.iter().map(corners).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
        assert!((area - (0.5 * (5.0 + 1.0 + 2.0 + 4.0) + 2.0 * 6.0)).abs() < 1e-5, "{area}");
        assert!(extruded(&[], 0.0, 0.5).points.is_empty());
    }

    #[test]
    fn a_crown_wall_has_the_area_of_its_faces() {
        // A wall of 0.2 m by 1 m with a nose of 0.1 m by 0.1 m: around it 2.6 m, area 0.21 m2.
        let wall = [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [-0.1, 1.0], [-0.1, 0.9], [0.0, 0.9]];
        let mut mesh = Mesh::default();
        add_section(&wall, 0.5, &mut mesh);
        let corners = |t: &[u32; 3]| t.map(|corner| glam::Vec3::from_array(mesh.points[corner as usize]));
        let area: f32 = mesh.triangles.iter().map(corners).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
        assert!((area - (0.5 * 2.6 + 2.0 * 0.21)).abs() < 1e-5, "{area}");
    }
}
