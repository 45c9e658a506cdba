//! Drawings of units as shaded solids.

use super::cover::Cover;
use super::motion::Pose;
use super::window::{Window, path_point};
use crate::output::UnitSurface;
use crate::report::film::Mesh;

/// Number of brightness levels of the faces.
const SHADES: f64 = 7.0;
/// Size of the finest detail that is drawn [px].
const DETAIL: f64 = 1.8;
/// Number of depth layers of a unit. In each layer, faces of the same brightness level are drawn as one SVG path.
const LAYERS: f64 = 16.0;

/// Viewing direction of a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewDirection {
    /// Side view along y: x to the right, z upwards.
    Side,
    /// Top view along -z: x to the right, y upwards.
    Above,
}

impl ViewDirection {
    /// Returns the horizontal and vertical coordinate in the drawing, and the coordinate towards the viewer [m].
    pub fn project(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Side => [x, z, -y],
            Self::Above => [x, y, z],
        }
    }

    fn on_paper(self, window: &Window, point: [f64; 3]) -> [f64; 2] {
        let [x, up, _] = self.project(point);
        window.at(x, up)
    }
}

/// Simplifies a surface to the detail that is visible at `scale` [px/m]. The vertices in each cell of a grid are
/// replaced by their mean.
pub fn coarsened(surface: &UnitSurface, scale: f64) -> UnitSurface {
    let points = surface.vertices_m.iter().map(|vertex| vertex.map(|c| c as f32)).collect();
    let mesh = Mesh { points, triangles: surface.triangles.clone(), values: Vec::new() };
    let merged = mesh.clustered((DETAIL / scale) as f32);
    UnitSurface {
        vertices_m: merged.points.iter().map(|point| point.map(f64::from)).collect(),
        triangles: merged.triangles,
    }
}

/// Largest distance of a vertex of the unit from its centre of mass [m].
pub fn reach(surface: &UnitSurface) -> f64 {
    surface.vertices_m.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).fold(0.0, f64::max)
}

/// A projected face: number of the depth layer (increases towards the viewer), brightness level, corners [px].
type Face = (i64, usize, [[f64; 2]; 3]);

/// Draws the visible faces of a unit with light from the upper left. Faces that `cover` hides are left out; the drawn
/// faces are added to `cover`.
pub fn shaded(surface: &UnitSurface, pose: Pose, window: &Window, eye: ViewDirection, cover: &mut Cover) -> String {
    let reach = reach(surface).max(f64::MIN_POSITIVE);
    let middle = eye.project(pose.position_m)[2];
    let mut faces: Vec<Face> = (placed_triangles(surface, pose))
        .filter_map(|corners| {
            let [nx, nup, towards] = eye.project(normal(corners));
            let light = (-0.35 * nx + 0.62 * nup + 0.70 * towards).max(0.0);
            let depth = corners.iter().map(|c| eye.project(*c)[2] - middle).sum::<f64>() / 3.0;
            let layer = (0.5 * LAYERS * depth / reach).floor() as i64;
            let shade = ((light * SHADES) as usize).min(SHADES as usize - 1);
            (towards > 0.0).then(|| (layer, shade, corners.map(|c| eye.on_paper(window, c))))
        })
        .collect();
    faces.sort_by_key(|(layer, shade, _)| (*layer, *shade));
    let mut layers: Vec<String> = Vec::new();
    for layer in faces.chunk_by(|a, b| a.0 == b.0).rev() {
        let seen: Vec<&Face> = layer.iter().filter(|face| !cover.hides(face.2)).collect();
        let path = |same: &[&Face]| {
            let data: String = same.iter().map(|face| triangle(face.2)).collect();
            format!("<path class=\"s{}\" d=\"{data}\"/>", same[0].1)
        };
        layers.push(seen.chunk_by(|a, b| a.1 == b.1).map(path).collect());
        cover.add(layer.iter().map(|face| face.2));
    }
    layers.into_iter().rev().collect()
}

/// SVG path data of the silhouette of a unit: all faces that are turned towards the viewer.
pub fn silhouette(surface: &UnitSurface, pose: Pose, window: &Window, eye: ViewDirection) -> String {
    (placed_triangles(surface, pose))
        .filter(|corners| eye.project(normal(*corners))[2] > 0.0)
        .map(|corners| triangle(corners.map(|c| eye.on_paper(window, c))))
        .collect()
}

/// Triangles of a unit in flume axes [m].
fn placed_triangles(surface: &UnitSurface, pose: Pose) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let points: Vec<[f64; 3]> = surface.vertices_m.iter().map(|v| pose.place(*v)).collect();
    surface.triangles.iter().map(move |t| t.map(|i| points[i as usize]))
}

/// SVG path data of a triangle: first corner, then the steps to the second and the third corner.
fn triangle(corners: [[f64; 2]; 3]) -> String {
    let tenths = corners.map(|corner| corner.map(|c| (10.0 * c).round()));
    let way = |i: usize| [0, 1].map(|axis| 0.1 * (tenths[i][axis] - tenths[i - 1][axis]));
    format!("M{}l{} {}z", path_point(corners[0]), path_point(way(1)), path_point(way(2)))
}

/// Unit normal of a triangle; zero if the triangle has no area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invisible_detail_is_merged() {
        // The merged points are in single precision: a near point has a coordinate of this precision, and the limit is 1e-7.
        let near = f64::from(0.501_f32);
        // Two triangles with edges of 1 m, and a triangle with edges of 1 mm between them.
        let surface = UnitSurface {
            vertices_m: vec![[0.5; 3], [near, 0.5, 0.5], [0.5, near, 0.5], [1.5, 0.5, 0.5], [0.5, 1.5, 0.5]],
            triangles: vec![[0, 1, 2], [0, 3, 4], [1, 3, 4]],
        };
        assert_eq!(coarsened(&surface, 1e4), surface);
        let coarse = coarsened(&surface, 100.0);
        assert_eq!((coarse.vertices_m.len(), coarse.triangles.len()), (3, 2));
        assert!((coarse.vertices_m[0][0] - 1.501 / 3.0).abs() < 1e-7);
    }
}
