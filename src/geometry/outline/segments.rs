//! Directed straight segments in x and z.

use glam::DVec2;

/// Returns the unit normal of a segment that points to its left side, where the water lies.
pub fn left_normal(segment: &[DVec2; 2]) -> DVec2 {
    (segment[1] - segment[0]).normalize().perp()
}

/// Returns the edges of a closed line through `points`.
pub(super) fn closed(points: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    (0..points.len()).map(|index| [points[index], points[(index + 1) % points.len()]])
}

/// Returns true if an even number of segments crosses the ray from a point downwards.
pub(super) fn is_even(segments: impl Iterator<Item = [DVec2; 2]>, point: DVec2) -> bool {
    let crosses = |[a, b]: &[DVec2; 2]| {
        (a.x <= point.x) != (b.x <= point.x) && a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x) < point.y
    };
    segments.filter(crosses).count() % 2 == 0
}

/// Returns the point of a segment nearest to `point`.
pub(super) fn nearest([a, b]: &[DVec2; 2], point: DVec2) -> DVec2 {
    let along = b - a;
    let t = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    a + t * along
}

/// Returns the distance of a point from a segment [m].
pub(super) fn distance(segment: &[DVec2; 2], point: DVec2) -> f64 {
    nearest(segment, point).distance(point)
}

/// Returns the point where two segments cross.
pub(super) fn crossing(one: &[DVec2; 2], other: &[DVec2; 2]) -> Option<DVec2> {
    let (along, across) = (one[1] - one[0], other[1] - other[0]);
    let is_parted = |line: &[DVec2; 2], ends: &[DVec2; 2]| {
        let [a, b] = ends.map(|end| (line[1] - line[0]).perp_dot(end - line[0]));
        (a < 0.0) != (b < 0.0)
    };
    let share = (other[0] - one[0]).perp_dot(across) / along.perp_dot(across);
    (is_parted(one, other) && is_parted(other, one)).then_some(one[0] + along * share)
}
