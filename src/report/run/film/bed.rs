//! Bed, mound and obstacles of the film.

use super::super::folder::RunFolder;
use super::super::scene::bed_in;
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

/// Returns the fixed obstacles, half transparent; `None` without obstacles.
pub fn obstacles(run: &RunFolder) -> Option<Series> {
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
    (!mesh.points.is_empty()).then(|| Series::new("Obstacles", "#8d8370", 0.45, vec![mesh]))
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
}
