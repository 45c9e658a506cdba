//! Distance from rounded parts to the ground (a profile z(x), uniform in y) and to plane walls.
//!
//! The ground is a chain of strips. A part touches a strip if the foot point of one of its ends ([`ConvexPart::ends`])
//! lies on the strip. The part touches a convex corner if the direction from the corner line to the part lies between
//! the normals of the two strips. A contact passes continuously from strip to corner, and never counts for both. In a
//! concave corner, the part touches both strips.

use glam::{DQuat, DVec3};

use crate::geometry::convex::convex_part::ConvexPart;
use crate::geometry::profile::Profile;
use crate::rigid::contact::Feature;

/// A plane strip of the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Strip {
    /// Range along x [m].
    x: [f64; 2],
    /// A point of the strip [m].
    origin: DVec3,
    /// Upward normal.
    normal: DVec3,
}

/// The ground as strips and convex corners.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundSurface {
    profile: Profile,
    strips: Vec<Strip>,
}

/// A point where a part is near a fixed surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Element of the fixed surface.
    pub feature: Feature,
    /// Point of the core that is nearest to the surface [m].
    pub core: DVec3,
    /// Normal from the surface into the body.
    pub normal: DVec3,
    /// Distance of the core from the surface [m].
    pub distance: f64,
}

impl GroundSurface {
    /// Creates the strips of a profile; the ground is level beyond the ends of the profile.
    pub fn new(profile: &Profile) -> Self {
        let points = profile.points();
        let last = points[points.len() - 1];
        let at = |p: [f64; 2]| DVec3::new(p[0], 0.0, p[1]);
        let mut strips = vec![Strip { x: [f64::NEG_INFINITY, points[0][0]], origin: at(points[0]), normal: DVec3::Z }];
        strips.extend(points.windows(2).map(|w| {
            let along = at(w[1]) - at(w[0]);
            Strip { x: [w[0][0], w[1][0]], origin: at(w[0]), normal: DVec3::new(-along.z, 0.0, along.x).normalize() }
        }));
        strips.push(Strip { x: [last[0], f64::INFINITY], origin: at(last), normal: DVec3::Z });
        Self { profile: profile.clone(), strips }
    }

    /// Appends the points where the core of a part is nearer than `reach` [m] to the ground.
    pub fn approaches(&self, part: &ConvexPart, rotation: DQuat, position: DVec3, reach: f64, out: &mut Vec<Approach>) {
        let (centre, radius) = part.bounding_sphere();
        let centre = rotation * centre + position;
        let span = [centre.x - radius - reach, centre.x + radius + reach];
        let first = self.strips.partition_point(|s| s.x[1] < span[0]);
        let from = out.len();
        for (k, strip) in self.strips.iter().enumerate().skip(first) {
            if strip.x[0] > span[1] {
                break;
            }
            if (centre - strip.origin).dot(strip.normal) < radius + reach {
                for approach in self.strip_approaches(k, part, rotation, position, reach) {
                    keep(out, from, approach);
                }
            }
            if let Some(next) = self.strips.get(k + 1)
                && strip.normal.cross(next.normal).y > STRAIGHT
                && let Some(corner) = corner_approach(k, strip, next, part, rotation, position, reach)
            {
                keep(out, from, corner);
            }
        }
    }

    /// Points where the ends of a part are near strip k.
    fn strip_approaches<'a>(
        &'a self,
        k: usize,
        part: &'a ConvexPart,
        rotation: DQuat,
        position: DVec3,
        reach: f64,
    ) -> impl Iterator<Item = Approach> + 'a {
        let strip = &self.strips[k];
        part.ends(rotation.inverse() * -strip.normal).enumerate().filter_map(move |(end, point)| {
            let core = rotation * point + position;
            let distance = (core - strip.origin).dot(strip.normal);
            let foot = core.x - distance * strip.normal.x;
            let above = distance > 0.0 || core.z < self.profile.z(core.x);
            // Without the tolerance, a foot point could fall between two strips. `keep` drops duplicates.
            let inside = (strip.x[0] - SAME_POINT..strip.x[1] + SAME_POINT).contains(&foot);
            let feature = Feature::Ground { place: 2 * k as u32, end: end as u16 };
            (distance < reach && above && inside).then_some(Approach { feature, core, normal: strip.normal, distance })
        })
    }
}

/// Returns the numbers of the first and the last ground element ([`Feature::Ground`]) between two points of the profile,
/// given by their x [m]. Corners at the two points themselves do not count.
pub fn places_between(profile: &Profile, x: [f64; 2]) -> [u32; 2] {
    let [first, last] = x.map(|x| profile.points().partition_point(|p| p[0] < x - SAME_POINT) as u32);
    // Strip k lies between the points k - 1 and k.
    [2 * (first + 1), 2 * last]
}

/// Largest distance in x outside a strip at which a foot point still counts as on the strip [m].
const SAME_POINT: f64 = 1e-12;
/// Sine of the angle below which two strips count as one plane [-].
const STRAIGHT: f64 = 1e-6;

/// Appends an approach of a part, unless an approach of this part has the same foot point and normal; then the nearer
/// approach is kept. The approaches of the part start at index `from`.
pub(super) fn keep(out: &mut Vec<Approach>, from: usize, new: Approach) {
    let foot = |a: &Approach| a.core - a.normal * a.distance;
    let same = |old: &&mut Approach| {
        // Foot points less than 1e-6 m apart count as the same. Over this distance, two planes at an angle below
        // STRAIGHT differ by less than a picometre.
        foot(old).distance_squared(foot(&new)) < 1e-12 && old.normal.cross(new.normal).length() < STRAIGHT
    };
    match out[from..].iter_mut().find(same) {
        Some(old) if new.distance < old.distance => *old = new,
        Some(_) => {}
        None => out.push(new),
    }
}

/// Point where a part is near the convex corner between two strips; `None` if a strip is nearer.
fn corner_approach(
    k: usize,
    left: &Strip,
    right: &Strip,
    part: &ConvexPart,
    rotation: DQuat,
    position: DVec3,
    reach: f64,
) -> Option<Approach> {
    let corner = right.x[0];
    let line = if right.x[0] == right.origin.x { right.origin } else { left.origin };
    let (centre, radius) = part.bounding_sphere();
    let centre = rotation * centre + position;
    let to_centre = DVec3::new(centre.x - corner, 0.0, centre.z - line.z);
    if to_centre.length() > radius + reach {
        return None;
    }
    let ends = [centre.y - radius, centre.y + radius].map(|y| DVec3::new(corner, y, line.z));
    let (_, core) = nearest_to_segment(part, rotation, position, ends, reach)?;
    let across = DVec3::new(core.x - corner, 0.0, core.z - line.z);
    let distance = across.length();
    // Tangents of the strips towards +x.
    let [t_left, t_right] = [left.normal, right.normal].map(|n| DVec3::new(n.z, 0.0, -n.x));
    let within = across.dot(t_left) >= 0.0 && across.dot(t_right) < 0.0;
    (within && distance < reach).then(|| Approach {
        feature: Feature::Ground { place: 2 * k as u32 + 1, end: 0 },
        core,
        normal: across / distance,
        distance,
    })
}

/// Finds where a part of a body at (rotation, position) is nearest to the segment from a to b. Returns the position
/// along the segment, from 0 at a to 1 at b [-], and the nearest point of the part's core [m]; `None` if segment and
/// core are farther apart than `reach` [m].
pub(super) fn nearest_to_segment(
    part: &ConvexPart,
    rotation: DQuat,
    position: DVec3,
    [a, b]: [DVec3; 2],
    reach: f64,
) -> Option<(f64, DVec3)> {
    let back = rotation.inverse();
    let length = a.distance(b);
    let [mut low, mut high] = [0.0, 1.0];
    // 50 bisections of a segment shorter than a metre resolve 1e-15 m.
    for _ in 0..50 {
        let middle: f64 = 0.5 * (low + high);
        let on_segment = a.lerp(b, middle);
        let core = rotation * part.nearest(back * (on_segment - position)) + position;
        // Between two points of the segment, the distance to the part changes by at most their distance.
        if on_segment.distance(core) - 0.5 * (high - low) * length > reach {
            return None;
        }
        // The distance is convex along the segment. The sign of its slope shows on which side the nearest point lies.
        if (core - on_segment).dot(b - a) > 0.0 { low = middle } else { high = middle }
    }
    let fraction = 0.5 * (low + high);
    Some((fraction, rotation * part.nearest(back * (a.lerp(b, fraction) - position)) + position))
}

/// A plane wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWall {
    /// Number of the wall, as in [`Feature::Wall`].
    pub index: u8,
    /// A point of the plane [m].
    pub origin: DVec3,
    /// Normal into the domain.
    pub normal: DVec3,
}

impl PlaneWall {
    /// Appends the points where the core of a part is nearer than `reach` [m] to the wall.
    pub fn approaches(&self, part: &ConvexPart, rotation: DQuat, position: DVec3, reach: f64, out: &mut Vec<Approach>) {
        let (centre, radius) = part.bounding_sphere();
        if (rotation * centre + position - self.origin).dot(self.normal) >= radius + reach {
            return;
        }
        for (end, point) in part.ends(rotation.inverse() * -self.normal).enumerate() {
            let core = rotation * point + position;
            let distance = (core - self.origin).dot(self.normal);
            if distance < reach {
                let feature = Feature::Wall { wall: self.index, end: end as u16 };
                out.push(Approach { feature, core, normal: self.normal, distance });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: f64 = 0.3;

    fn near(surface: &GroundSurface, at: DVec3) -> Vec<Approach> {
        let mut out = Vec::new();
        surface.approaches(&ConvexPart::ball(DVec3::ZERO, 0.1), DQuat::IDENTITY, at, REACH, &mut out);
        out
    }

    fn trapezoid() -> GroundSurface {
        GroundSurface::new(&Profile::new(vec![[-3.0, 0.0], [-1.0, 1.0], [1.0, 1.0], [3.0, 0.0]]))
    }

    #[test]
    fn distance_is_unique_and_continuous_at_a_convex_corner() {
        let surface = trapezoid();
        let (mut before, mut turned) = (0.1, 0.0);
        for i in 0..=4000 {
            // The ball moves horizontally, 0.1 m above the crest, and passes its shoreward edge.
            let at = DVec3::new(0.8 + 1e-4 * f64::from(i), 0.3, 1.1);
            let found = near(&surface, at);
            if found.is_empty() {
                assert!(at.x > 1.1);
                break;
            }
            assert_eq!(found.len(), 1, "{at}");
            // In each step the ball moves 1e-4 m. The distance changes by less than this path, the normal by
            // 1e-4 / 0.1 rad.
            assert!((found[0].distance - before).abs() < 1.01e-4);
            let angle = found[0].normal.x.atan2(found[0].normal.z);
            assert!((angle - turned).abs() < 1.1e-3);
            (before, turned) = (found[0].distance, angle);
        }
        assert!(turned > 0.4);
    }

    #[test]
    fn concave_corner_has_two_contacts_and_straight_joint_has_one() {
        let valley = GroundSurface::new(&Profile::new(vec![[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]));
        assert_eq!(near(&valley, DVec3::new(0.0, 0.0, 0.2)).len(), 2);
        let straight = GroundSurface::new(&Profile::new(vec![[-1.0, -0.5], [0.0, 0.0], [1.0, 0.5]]));
        for i in -100..100 {
            let x = 1e-3 * f64::from(i);
            let found = near(&straight, DVec3::new(x, 0.0, 0.5 * x + 0.1));
            assert_eq!(found.len(), 1);
            // The distance of the centre from the slope is 0.1 m times cos(atan 0.5).
            assert!((found[0].distance - 0.0894427191).abs() < 1e-9);
        }
    }

    #[test]
    fn elements_between_the_toes_are_the_two_flanks_the_crest_and_its_edges() {
        let points = vec![[-9.0, 0.0], [-3.0, 0.0], [-1.0, 1.0], [1.0, 1.0], [3.0, 0.0], [9.0, 0.0]];
        let profile = Profile::new(points);
        let [first, last] = places_between(&profile, [-3.0, 3.0]);
        let surface = GroundSurface::new(&profile);
        let inside = |x: f64, z: f64| {
            let found = near(&surface, DVec3::new(x, 0.0, z));
            assert_eq!(found.len(), 1, "{x}, {z}");
            let Feature::Ground { place, .. } = found[0].feature else { panic!("{:?}", found[0]) };
            (first..=last).contains(&place)
        };
        // Bed, flank, crest, edge of the crest, flank, bed.
        let at = [(-4.0, 0.1), (-2.0, 0.6), (0.0, 1.1), (1.02, 1.1), (2.0, 0.6), (4.0, 0.1)];
        assert_eq!(at.map(|(x, z)| inside(x, z)), [false, true, true, true, true, false]);
    }

    #[test]
    fn ball_does_not_touch_the_far_flank_of_a_mound_from_inside() {
        let found = near(&trapezoid(), DVec3::new(-1.6, 0.0, 0.75));
        assert!(found.iter().all(|a| a.distance > 0.0));
        assert_eq!(found.len(), 1);
    }
}
