//! An axis-aligned box with some faces open to the water.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisBox {
    /// Lower corner [m].
    pub low: DVec3,
    /// Upper corner [m].
    pub high: DVec3,
    /// For each axis, true if the lower or the upper face is open to the water. A face on the bed or at a wall is
    /// closed.
    pub open: [[bool; 2]; 3],
}

/// Difference below which two depths count as equal, relative to the size of the box [-].
const SAME: f64 = 1e-9;

impl AxisBox {
    /// Box between two corners [m] with all faces open.
    pub fn free(low: DVec3, high: DVec3) -> Self {
        Self { low, high, open: [[true; 2]; 3] }
    }

    /// The box moved by a vector [m].
    pub fn shifted(&self, by: DVec3) -> Self {
        Self { low: self.low + by, high: self.high + by, open: self.open }
    }

    /// Slice with the given thickness [m] in y from the middle of the box; both cut faces are closed.
    pub fn slice(&self, thickness: f64) -> Self {
        let middle = 0.5 * (self.low.y + self.high.y);
        let mut slice = self.with_closed_sides();
        (slice.low.y, slice.high.y) = (middle - 0.5 * thickness, middle + 0.5 * thickness);
        slice
    }

    /// The box with its two faces normal to y closed.
    pub fn with_closed_sides(&self) -> Self {
        let mut closed = *self;
        closed.open[1] = [false; 2];
        closed
    }

    /// The box with its closed faces moved outwards [m].
    pub fn beyond_closed_faces(&self, by: f64) -> Self {
        let mut wider = *self;
        for axis in 0..3 {
            let [low, high] = self.open[axis];
            wider.low[axis] -= if low { 0.0 } else { by };
            wider.high[axis] += if high { 0.0 } else { by };
        }
        wider
    }

    /// Corners.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|number| {
            DVec3::from_array(std::array::from_fn(|axis| {
                if number >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] }
            }))
        })
    }

    /// Corners, middles of the edges, and middle of the lower (`side` 0) or upper (1) face normal to an axis.
    pub fn points_on_face(&self, axis: usize, side: usize) -> impl Iterator<Item = DVec3> {
        let (low, edges) = (self.low, self.edges());
        (0..9).map(move |number| {
            let mut part = DVec3::ZERO;
            part[axis] = side as f64;
            part[(axis + 1) % 3] = 0.5 * f64::from(number % 3);
            part[(axis + 2) % 3] = 0.5 * f64::from(number / 3);
            low + part * edges
        })
    }

    /// Corners, and triangles that are counter-clockwise seen from outside.
    pub fn surface(&self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        // Corners of each face: -x, +x, -y, +y, -z, +z.
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        (self.corners().to_vec(), faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect())
    }

    /// Edge lengths [m].
    pub fn edges(&self) -> DVec3 {
        self.high - self.low
    }

    /// Volume [m3].
    pub fn volume(&self) -> f64 {
        self.edges().element_product()
    }

    /// Nearest point of the box [m]; `point` itself if it lies inside.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        point.clamp(self.low, self.high)
    }

    /// Returns for each open face the depth of the point behind the face [m], and the vector from the point to the face
    /// [m].
    fn paths_to_open_faces(&self, point: DVec3) -> impl Iterator<Item = (f64, DVec3)> + use<> {
        let (low, high, open) = (self.low, self.high, self.open);
        (0..3).flat_map(move |axis| {
            let to_face = [low[axis] - point[axis], high[axis] - point[axis]];
            let depth = [-to_face[0], to_face[1]];
            (0..2).filter(move |side| open[axis][*side]).map(move |side| {
                let mut way = DVec3::ZERO;
                way[axis] = to_face[side];
                (depth[side], way)
            })
        })
    }

    /// Depth of an inner point behind the nearest open face [m].
    pub fn depth(&self, point: DVec3) -> f64 {
        self.paths_to_open_faces(point).map(|(depth, _)| depth).fold(f64::INFINITY, f64::min)
    }

    /// Vector from an inner point to the nearest open face [m]. If two or three faces are equally near, the vector
    /// leads to their common edge or corner; of two opposite faces, it leads to the lower one.
    pub fn vector_to_surface(&self, point: DVec3) -> DVec3 {
        let most = self.depth(point) + SAME * self.edges().max_element();
        let mut to_surface = DVec3::ZERO;
        for (_, way) in self.paths_to_open_faces(point).filter(|(depth, _)| *depth <= most) {
            // Otherwise, the ways to two opposite faces would cancel each other.
            to_surface += DVec3::select(to_surface.cmpeq(DVec3::ZERO), way, DVec3::ZERO);
        }
        to_surface
    }

    /// Nearest point of the open surface [m] and signed distance to it [m], negative inside.
    pub fn locate(&self, point: DVec3) -> (DVec3, f64) {
        let nearest = self.nearest(point);
        let distance = nearest.distance(point);
        if distance > 0.0 {
            return (nearest, distance);
        }
        let way = self.vector_to_surface(point);
        (point + way, -way.length())
    }

    /// Returns true if a point lies strictly behind all open faces, and behind or on all closed faces.
    pub fn contains(&self, point: DVec3) -> bool {
        let slack = SAME * self.edges().max_element();
        (0..3).all(|axis| {
            let margin = |side: usize| if self.open[axis][side] { slack } else { -slack };
            point[axis] >= self.low[axis] + margin(0) && point[axis] <= self.high[axis] - margin(1)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_the_bed() -> AxisBox {
        let open = [[true; 2], [true; 2], [false, true]];
        AxisBox { low: DVec3::ZERO, high: DVec3::new(1.0, 2.0, 3.0), open }
    }

    #[test]
    fn vector_to_surface_leads_to_an_open_face() {
        assert_eq!(on_the_bed().vector_to_surface(DVec3::new(0.4, 1.0, 0.1)), DVec3::X * -0.4);
        assert_eq!(
            AxisBox::free(DVec3::ZERO, DVec3::ONE).vector_to_surface(DVec3::new(0.4, 0.5, 0.1)),
            DVec3::Z * -0.1
        );
    }

    #[test]
    fn vector_to_surface_leads_to_the_edge_or_corner_between_equally_near_faces() {
        let way = on_the_bed().vector_to_surface(DVec3::new(0.1, 1.9, 1.0));
        assert!((way - DVec3::new(-0.1, 0.1, 0.0)).length() < 1e-12);
        let way = on_the_bed().vector_to_surface(DVec3::new(0.1, 1.9, 2.9));
        assert!((way - DVec3::new(-0.1, 0.1, 0.1)).length() < 1e-12);
        let way = on_the_bed().vector_to_surface(DVec3::new(0.5, 1.0, 0.0));
        assert!((way - DVec3::new(-0.5, 0.0, 0.0)).length() < 1e-12);
    }

    #[test]
    fn distance_is_negative_inside() {
        assert_eq!(on_the_bed().locate(DVec3::new(2.0, 1.0, 1.0)), (DVec3::new(1.0, 1.0, 1.0), 1.0));
        assert_eq!(on_the_bed().locate(DVec3::new(0.9, 1.0, 1.0)).1, 0.9 - 1.0);
    }

    #[test]
    fn box_contains_points_on_closed_faces_but_not_on_open_faces() {
        assert!(on_the_bed().contains(DVec3::new(0.5, 1.0, 0.0)));
        assert!(!on_the_bed().contains(DVec3::new(0.0, 1.0, 1.0)));
        assert!(!on_the_bed().contains(DVec3::new(0.5, 1.0, -0.1)));
    }
}
