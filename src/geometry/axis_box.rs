//! A box along the axes, some of whose faces the water can touch.

use glam::DVec3;

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisBox {
    /// Lower corner [m].
    pub low: DVec3,
    /// Upper corner [m].
    pub high: DVec3,
    /// Which faces the water can touch: for each axis the lower and the upper one. A face that stands on the bed or
    /// against a wall is not among them.
    pub open: [[bool; 2]; 3],
}

/// Depths nearer to each other than this share of the box count as the same [-].
const SAME: f64 = 1e-9;

impl AxisBox {
    /// Box between two corners [m] with water all round.
    pub fn free(low: DVec3, high: DVec3) -> Self {
        Self { low, high, open: [[true; 2]; 3] }
    }

    /// The middle of the box in y, `thickness` [m] of it, with no water before the cuts.
    pub fn slice(&self, thickness: f64) -> Self {
        let middle = 0.5 * (self.low.y + self.high.y);
        let mut slice = self.closed_across();
        (slice.low.y, slice.high.y) = (middle - 0.5 * thickness, middle + 0.5 * thickness);
        slice
    }

    /// The box with no water before its two faces across y.
    pub fn closed_across(&self) -> Self {
        let mut closed = *self;
        closed.open[1] = [false; 2];
        closed
    }

    /// Lengths of its edges [m].
    pub fn edges(&self) -> DVec3 {
        self.high - self.low
    }

    /// Volume [m3].
    pub fn volume(&self) -> f64 {
        self.edges().element_product()
    }

    /// Nearest point of the box [m]; the point itself inside.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        point.clamp(self.low, self.high)
    }

    /// Depth of a point behind an open face and the vector from the point to that face [m], for each open face.
    fn ways_out(&self, point: DVec3) -> impl Iterator<Item = (f64, DVec3)> + use<> {
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

    /// Depth of a point inside behind the nearest open face [m].
    pub fn depth(&self, point: DVec3) -> f64 {
        self.ways_out(point).map(|(depth, _)| depth).fold(f64::INFINITY, f64::min)
    }

    /// From a point inside to the nearest open face [m]; to the edge or corner where two or three are equally near, so
    /// that the way out does not prefer one of them.
    pub fn way_out(&self, point: DVec3) -> DVec3 {
        let most = self.depth(point) + SAME * self.edges().max_element();
        self.ways_out(point).filter(|(depth, _)| *depth <= most).map(|(_, way)| way).sum()
    }

    /// Nearest point of the open surface [m] and the distance to it [m], negative inside.
    pub fn locate(&self, point: DVec3) -> (DVec3, f64) {
        let nearest = self.nearest(point);
        let distance = nearest.distance(point);
        if distance > 0.0 {
            return (nearest, distance);
        }
        let way = self.way_out(point);
        (point + way, -way.length())
    }

    /// Whether a point lies behind all open faces, and not beyond the others.
    pub fn holds(&self, point: DVec3) -> bool {
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
    fn the_way_out_leads_through_open_faces_only() {
        assert_eq!(on_the_bed().way_out(DVec3::new(0.4, 1.0, 0.1)), DVec3::X * -0.4);
        assert_eq!(AxisBox::free(DVec3::ZERO, DVec3::ONE).way_out(DVec3::new(0.4, 0.5, 0.1)), DVec3::Z * -0.1);
    }

    #[test]
    fn behind_an_edge_or_a_corner_it_leads_there() {
        let way = on_the_bed().way_out(DVec3::new(0.1, 1.9, 1.0));
        assert!((way - DVec3::new(-0.1, 0.1, 0.0)).length() < 1e-12);
        let way = on_the_bed().way_out(DVec3::new(0.1, 1.9, 2.9));
        assert!((way - DVec3::new(-0.1, 0.1, 0.1)).length() < 1e-12);
    }

    #[test]
    fn distances_are_negative_inside() {
        assert_eq!(on_the_bed().locate(DVec3::new(2.0, 1.0, 1.0)), (DVec3::new(1.0, 1.0, 1.0), 1.0));
        assert_eq!(on_the_bed().locate(DVec3::new(0.9, 1.0, 1.0)).1, 0.9 - 1.0);
    }

    #[test]
    fn a_point_on_the_bed_below_is_held_and_one_on_an_open_face_is_not() {
        assert!(on_the_bed().holds(DVec3::new(0.5, 1.0, 0.0)));
        assert!(!on_the_bed().holds(DVec3::new(0.0, 1.0, 1.0)));
        assert!(!on_the_bed().holds(DVec3::new(0.5, 1.0, -0.1)));
    }
}
