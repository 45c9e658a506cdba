//! A part of any shape, from an STL file.

use std::sync::Arc;

use glam::DVec3;

use crate::geometry::solid::Solid;
use crate::geometry::terrain::Terrain;

/// Number of columns in the side view of a body.
const COLUMNS: u32 = 100;

/// A part of any shape: its surface in the flume, and the STL file from which it comes.
#[derive(Debug, Clone)]
pub struct BodyPart {
    /// The body [m].
    pub solid: Arc<Solid>,
    /// Its surface as units meet it [m].
    pub surface: Arc<Terrain>,
    /// Content of the STL file. A run saves it next to its case file.
    pub content: Arc<Vec<u8>>,
    /// Name of the STL file in the run folder.
    pub file_name: String,
    /// Metres per length unit of the file [-].
    pub scale: f64,
    /// Position of the origin of the file in the flume [m].
    pub origin: DVec3,
    /// For a terrain, which faces up and continues downwards: x of the two ends of what rises above the bed [m].
    pub terrain_x: Option<[f64; 2]>,
}

impl PartialEq for BodyPart {
    fn eq(&self, other: &Self) -> bool {
        self.content == other.content && self.scale == other.scale && self.origin == other.origin
    }
}

impl BodyPart {
    /// Returns the triangles of the surface, counter-clockwise seen from outside [m].
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.solid.triangles().iter().map(|triangle| triangle.map(|corner| self.solid.vertices()[corner as usize]))
    }

    /// Returns the triangles of the surface as units meet it [m]; for a terrain, without its sides and its lower side.
    pub fn surface_triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.surface.triangles().iter().map(|triangle| triangle.map(|v| self.surface.vertices()[v as usize]))
    }

    /// Returns the nearest point of the surface [m] and the distance from it [m], negative inside. For a point further
    /// than `reach` [m] from the box around the body, the distance is infinite.
    pub fn locate_within(&self, point: DVec3, reach: f64) -> (DVec3, f64) {
        let [low, high] = self.solid.bounds();
        if point.distance_squared(point.clamp(low, high)) > reach * reach {
            return (point, f64::INFINITY);
        }
        self.solid.project(point)
    }

    /// Returns the corners [x, z] of the body in side view: its lower edge from left to right, then its upper edge back.
    pub fn side_view(&self) -> Vec<[f64; 2]> {
        let [low, high] = self.solid.bounds();
        let edges: Vec<[DVec3; 2]> = self.triangles().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        let column = |number: u32| low.x + (high.x - low.x) * f64::from(number) / f64::from(COLUMNS);
        let heights = |x: f64| {
            let crossing = edges.iter().filter(|[a, b]| (a.x - x) * (b.x - x) <= 0.0 && a.x != b.x);
            crossing
                .map(|[a, b]| a.z + (b.z - a.z) * (x - a.x) / (b.x - a.x))
                .fold([f64::MAX, f64::MIN], |[low, high], z| [low.min(z), high.max(z)])
        };
        let columns = (0..=COLUMNS).map(|number| (column(number), heights(column(number))));
        let columns: Vec<(f64, [f64; 2])> = columns.filter(|(_, [low, high])| low <= high).collect();
        let lower = columns.iter().map(|(x, [low, _])| [*x, *low]);
        lower.chain(columns.iter().rev().map(|(x, [_, high])| [*x, *high])).collect()
    }
}
