//! A simple polygon in x and z: the section of a part of a structure.

use glam::DVec2;
use thiserror::Error;

use super::segments::{closed, crossing, distance, is_even, nearest};

/// Reason why points do not form the section of a part.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PolygonError {
    /// Fewer than three corners.
    #[error("{0} points; a polygon needs at least 3")]
    TooFewPoints(usize),
    /// A coordinate is not a finite number.
    #[error("point {0} has a coordinate that is not a finite number")]
    NotFinite(usize),
    /// Two neighbouring points are equal, or nearly so.
    #[error("point {0} is in the same place as the next point")]
    Repeated(usize),
    /// Two edges cross or touch.
    #[error("the edges that begin at the points {0} and {1} cross or touch")]
    Crossing(usize, usize),
    /// The corners lie on one line.
    #[error("the points lie on one line")]
    NoArea,
}

/// Neighbouring points nearer than this are in the same place, divided by the size of the polygon [-].
const SAME: f64 = 1e-5;

/// A polygon whose edges do not cross. Seen along an edge, the inside lies on the right.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    points: Vec<DVec2>,
}

impl Polygon {
    /// Creates the polygon with the given corners [x, z] [m], in either direction.
    ///
    /// # Errors
    /// If there are fewer than three points, points are equal, edges cross, or the polygon has no area. The numbers of
    /// points in the errors begin with 1.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, PolygonError> {
        let mut points: Vec<DVec2> = points.iter().map(|point| DVec2::from_array(*point)).collect();
        let count = points.len();
        if count < 3 {
            return Err(PolygonError::TooFewPoints(count));
        }
        if let Some(bad) = points.iter().position(|point| !point.is_finite()) {
            return Err(PolygonError::NotFinite(bad + 1));
        }
        let edges: Vec<[DVec2; 2]> = closed(&points).collect();
        let size = points.iter().map(|point| point.distance(points[0])).fold(0.0, f64::max);
        if let Some(bad) = edges.iter().position(|[from, to]| from.distance(*to) <= SAME * size) {
            return Err(PolygonError::Repeated(bad + 1));
        }
        let are_neighbours = |one: usize, other: usize| other - one == 1 || other - one == count - 1;
        for (one, other) in (0..count).flat_map(|one| (one + 1..count).map(move |other| (one, other))) {
            if !are_neighbours(one, other) && touch(&edges[one], &edges[other], 1e-9 * size) {
                return Err(PolygonError::Crossing(one + 1, other + 1));
            }
        }
        let area = signed_area(&points);
        if area.abs() < 1e-9 * size * size {
            return Err(PolygonError::NoArea);
        }
        if area > 0.0 {
            points.reverse();
        }
        Ok(Self { points })
    }

    /// Corners [x, z] [m].
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Edges in their direction.
    pub fn edges(&self) -> impl Iterator<Item = [DVec2; 2]> {
        closed(&self.points)
    }

    /// Area [m2].
    pub fn area(&self) -> f64 {
        signed_area(&self.points).abs()
    }

    /// Lower and upper corner of the box around the polygon [m].
    pub fn bounds(&self) -> [DVec2; 2] {
        let first = self.points[0];
        self.points.iter().fold([first; 2], |[low, high], point| [low.min(*point), high.max(*point)])
    }

    /// Returns true if a point lies inside. Points on an edge may count as either.
    pub fn contains(&self, point: DVec2) -> bool {
        !is_even(self.edges(), point)
    }

    /// Returns the point of the edges nearest to a point.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        let candidates = self.edges().map(|edge| nearest(&edge, point));
        candidates
            .min_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)))
            .expect("a polygon has edges")
    }

    /// Returns the distance of a point from the edges [m], negative inside.
    pub fn distance(&self, point: DVec2) -> f64 {
        let distance = self.nearest(point).distance(point);
        if self.contains(point) { -distance } else { distance }
    }

    /// Returns true if a box between two corners overlaps the polygon or is nearer to it than `gap` [m].
    pub fn is_near_box(&self, low: DVec2, high: DVec2, gap: f64) -> bool {
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let to_box = |point: &DVec2| point.clamp(low, high).distance(*point);
        corners.iter().any(|corner| self.distance(*corner) < gap)
            || self.points.iter().any(|point| to_box(point) < gap)
            || closed(&corners).any(|side| self.edges().any(|edge| crossing(&side, &edge).is_some()))
    }

    /// Returns the highest level of the polygon at x [m], if the polygon is there.
    pub fn top(&self, x: f64) -> Option<f64> {
        let level = |[a, b]: [DVec2; 2]| {
            let is_there = (a.x.min(b.x)..=a.x.max(b.x)).contains(&x);
            is_there.then(|| if a.x == b.x { a.y.max(b.y) } else { a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x) })
        };
        self.edges().filter_map(level).max_by(f64::total_cmp)
    }
}

/// Area inside a closed line [m2], positive if it runs counter-clockwise.
fn signed_area(points: &[DVec2]) -> f64 {
    let first = points[0];
    0.5 * closed(points).map(|[a, b]| (a - first).perp_dot(b - first)).sum::<f64>()
}

/// Returns true if two segments cross, or come nearer to each other than `touch` [m].
fn touch(one: &[DVec2; 2], other: &[DVec2; 2], touch: f64) -> bool {
    crossing(one, other).is_some()
        || one.iter().any(|end| distance(other, *end) <= touch)
        || other.iter().any(|end| distance(one, *end) <= touch)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_inside_and_top_of_an_l_shape() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let (shape, mut reversed) = (Polygon::new(&corners).unwrap(), corners);
        reversed.reverse();
        assert_eq!(Polygon::new(&reversed).unwrap().area(), 4.0);
        assert_eq!(shape.area(), 4.0);
        assert!(shape.contains(DVec2::new(0.5, 2.0)) && !shape.contains(DVec2::new(1.5, 2.0)));
        assert_eq!((shape.top(0.5), shape.top(1.5), shape.top(2.5)), (Some(3.0), Some(1.0), None));
        assert_eq!(shape.distance(DVec2::new(0.25, 2.0)), -0.25);
        // A pile through the upper part, which has no corner near a corner of the shape.
        assert!(shape.is_near_box(DVec2::new(-0.5, 2.0), DVec2::new(1.5, 2.2), 0.1));
        assert!(!shape.is_near_box(DVec2::new(1.2, 2.0), DVec2::new(1.5, 2.2), 0.1));
    }

    #[test]
    fn polygons_without_an_inside_are_refused() {
        assert_eq!(Polygon::new(&[[0.0, 0.0], [1.0, 0.0]]), Err(PolygonError::TooFewPoints(2)));
        assert_eq!(Polygon::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]]), Err(PolygonError::Repeated(2)));
        assert_eq!(Polygon::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1e-6]]), Err(PolygonError::Repeated(2)));
        assert_eq!(Polygon::new(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), Err(PolygonError::NoArea));
        assert_eq!(Polygon::new(&[[0.0, f64::NAN], [1.0, 0.0], [1.0, 1.0]]), Err(PolygonError::NotFinite(1)));
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(Polygon::new(&bow), Err(PolygonError::Crossing(1, 3)));
    }
}
