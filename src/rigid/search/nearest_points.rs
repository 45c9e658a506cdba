//! Nearest points of the cores of two rounded parts.
//!
//! The GJK algorithm of the library parry gives the distance of two convex cores with a relative error of about 5e-8.
//! The error of the direction is larger: the square root of this value. A few alternating projections onto the cores,
//! in closed form, make the direction exact. A contact at rest then has the same normal in every substep.

use glam::{DQuat, DVec3};
use parry3d_f64::math::Pose;
use parry3d_f64::query::gjk::{self, CsoPoint, GJKResult, VoronoiSimplex};
use parry3d_f64::shape::SupportMap;

use crate::geometry::convex::convex_part::ConvexPart;

/// Support function of a part's core for GJK.
struct CoreMap<'a>(&'a ConvexPart);

impl SupportMap for CoreMap<'_> {
    fn local_support_point(&self, direction: DVec3) -> DVec3 {
        self.0.support(direction)
    }
}

/// Nearest points of two cores.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nearest {
    /// The cores are further apart than the given reach.
    Apart,
    /// Nearest points of the first and the second core, world axes [m].
    Points(DVec3, DVec3),
    /// The cores overlap.
    Overlap,
}

/// Placement of a body: rotation and centre of mass.
pub type Placement = (DQuat, DVec3);

/// Computes the nearest points of the cores of two parts if their distance is at most `reach` [m].
pub fn nearest(a: &ConvexPart, (q_a, x_a): Placement, b: &ConvexPart, (q_b, x_b): Placement, reach: f64) -> Nearest {
    // All points are in the axes of the first body.
    let back = q_a.inverse();
    let relative = Pose::from_parts(back * (x_b - x_a), back * q_b);
    let on_b = |p: DVec3| relative.transform_point(b.nearest(relative.inverse_transform_point(p)));
    let mut simplex = VoronoiSimplex::new();
    let (map_a, map_b) = (CoreMap(a), CoreMap(b));
    let towards = relative.transform_point(b.bounding_sphere().0) - a.bounding_sphere().0;
    simplex.reset(CsoPoint::from_shapes(&relative, &map_a, &map_b, towards.try_normalize().unwrap_or(DVec3::X)));
    let p_b = match gjk::closest_points(&relative, &map_a, &map_b, reach, true, &mut simplex) {
        GJKResult::ClosestPoints(_, p_b, _) => p_b,
        GJKResult::Intersection => return Nearest::Overlap,
        // The direction X means that GJK reached its iteration limit: start from the middle of the first core.
        GJKResult::NoIntersection(direction) if direction == DVec3::X => on_b(a.bounding_sphere().0),
        GJKResult::NoIntersection(_) | GJKResult::Proximity(_) => return Nearest::Apart,
    };
    let (_, points) = refine_by_projections(a, on_b, p_b);
    to_world(points, (q_a, x_a), reach)
}

/// Computes the nearest points by projections alone. `start` is the nearest point of the second core in the previous
/// search, in the axes of the second body [m]. From this point, the projections usually converge in a few iterations.
/// Returns `None` if the projections do not converge, for example if two legs are nearly parallel.
pub fn nearest_from(
    a: &ConvexPart,
    (q_a, x_a): Placement,
    b: &ConvexPart,
    (q_b, x_b): Placement,
    start: DVec3,
    reach: f64,
) -> Option<Nearest> {
    let back = q_a.inverse();
    let relative = Pose::from_parts(back * (x_b - x_a), back * q_b);
    let on_b = |p: DVec3| relative.transform_point(b.nearest(relative.inverse_transform_point(p)));
    let (converged, points) = refine_by_projections(a, on_b, relative.transform_point(start));
    converged.then(|| to_world(points, (q_a, x_a), reach))
}

/// Projects alternately onto two cores, in the axes of the first body, from the point `p_b` of the second core. Returns
/// true if the projections have converged, and the nearest points [m].
fn refine_by_projections(a: &ConvexPart, on_b: impl Fn(DVec3) -> DVec3, mut p_b: DVec3) -> (bool, [DVec3; 2]) {
    let mut p_a = a.nearest(p_b);
    let mut step = DVec3::ZERO;
    for k in 0..MAX_PROJECTIONS {
        let before = p_b;
        p_b = on_b(p_a);
        let last = step;
        step = p_b - before;
        // 1e-14 m is less than the rounding error of a unit's position.
        if step.length_squared() < 1e-28 {
            return (true, [a.nearest(p_b), p_b]);
        }
        // After some iterations, the steps shrink by a constant ratio. Every third step extrapolates to the limit of
        // this series.
        let ratio = step.dot(last) / last.length_squared().max(f64::MIN_POSITIVE);
        let extrapolates = k % 3 == 2 && ratio > 0.0 && ratio < MAX_RATIO;
        p_a = a.nearest(if extrapolates { p_b + step * (ratio / (1.0 - ratio)) } else { p_b });
    }
    (false, [p_a, p_b])
}

/// Transforms the nearest points from the axes of the first body to world axes.
fn to_world([p_a, p_b]: [DVec3; 2], (q_a, x_a): Placement, reach: f64) -> Nearest {
    let distance = (p_b - p_a).length();
    if distance > reach {
        return Nearest::Apart;
    }
    if distance == 0.0 {
        return Nearest::Overlap;
    }
    Nearest::Points(q_a * p_a + x_a, q_a * p_b + x_a)
}

/// Largest number of alternating projections. Each projection reduces the error by a few tens of per cent; the
/// reduction depends on the ratio of the rounding radius to the radius of the cores. 60 projections are needed only if
/// two surfaces are parallel; many pairs of points are then equally near, and any of them is valid.
const MAX_PROJECTIONS: usize = 60;
/// Largest ratio of two consecutive steps for which the limit is extrapolated [-].
const MAX_RATIO: f64 = 0.95;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::armour_unit::ArmourUnit;

    #[test]
    fn nearest_points_of_two_balls_are_their_centres() {
        let ball = ConvexPart::ball(DVec3::ZERO, 0.1);
        let at = |x: f64| (DQuat::IDENTITY, DVec3::X * x);
        assert_eq!(nearest(&ball, at(0.0), &ball, at(0.5), 1.0), Nearest::Points(DVec3::ZERO, DVec3::X * 0.5));
        assert_eq!(nearest(&ball, at(0.0), &ball, at(0.5), 0.4), Nearest::Apart);
        assert_eq!(nearest(&ball, at(0.0), &ball, at(0.0), 0.4), Nearest::Overlap);
    }

    #[test]
    fn nearest_points_of_two_legs_satisfy_the_support_condition() {
        let unit = ArmourUnit::tetrapod(1.0, 0.05).unwrap();
        let (a, b) = (&unit.parts()[0], &unit.parts()[1]);
        for i in 0..400 {
            let t = 0.017 * f64::from(i);
            let turn = DQuat::from_euler(glam::EulerRot::XYZ, t, 1.7 * t, 0.3 * t);
            let shift = DVec3::new((3.0 * t).cos(), (2.0 * t).sin(), (t).cos()).normalize() * 1.5;
            let place_a = (DQuat::IDENTITY, DVec3::ZERO);
            let Nearest::Points(p_a, p_b) = nearest(a, place_a, b, (turn, shift), 10.0) else {
                continue;
            };
            let n = (p_b - p_a).normalize();
            // The plane normal to n through the nearest point of a core has the whole core on one side. This proves
            // that the points are nearest. Limit 1e-9 of the unit height: a thousandth of the overlap at rest.
            assert!(a.support(n).dot(n) - p_a.dot(n) < 1e-9, "{i}");
            let on_b = turn * b.support(turn.inverse() * -n) + shift;
            assert!(p_b.dot(n) - on_b.dot(n) < 1e-9, "{i}");
        }
    }
}
