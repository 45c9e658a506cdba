//! Contact points of rounded parts with a triangle surface.
//!
//! An end of a part touches a triangle if the foot point of the end lies in the triangle. The part touches a ridge or a
//! corner if no neighbouring element is nearer; the directions from ridge or corner into its neighbours decide this.
//! In a flat valley, an end in front of two triangles touches only the nearer triangle. The contact energy is then the
//! larger of the energies of both triangles. It is continuous, however fine the triangles are.

use glam::{DQuat, DVec3};

use super::ground::{Approach, keep, nearest_to_segment};
use crate::geometry::convex::convex_part::ConvexPart;
use crate::geometry::terrain::{Corner, Face, Ridge, SurfaceElement, Terrain};
use crate::rigid::contact::Feature;

/// Largest distance outside a triangle at which a foot point still counts as inside [m]. Without it, rounding errors
/// could place a foot point between two triangles. [`keep_nearer`] drops duplicates.
const SAME_PLACE: f64 = 1e-12;

/// Largest distance of a core behind a triangle that it touches, divided by the rounding radius [-]. In a substep, a
/// unit moves much less than this distance. If a core lies further behind, the triangle is on the opposite side of a
/// thin body.
const LARGEST_DEPTH_BEHIND: f64 = 0.25;

/// If the cosine of the angle between the normals of two triangles is above this value [-] (angle below 0.2 rad), an
/// end touches only the nearer triangle. In a steeper valley, an end that touches one triangle approaches the other
/// triangle. When its foot point enters the other triangle, the gap to that triangle is still at least 0.02 rounding
/// radii. If the second contact starts with an overlap, this overlap is subtracted.
const VALLEY: f64 = 0.98;

/// Fraction of a ridge at each end where the corner counts instead of the ridge [-]; the resolution of the bisection.
const RIDGE_END: f64 = 1e-14;

/// A part of a body, with the rotation and position of the body.
#[derive(Clone, Copy)]
struct Placed<'a> {
    part: &'a ConvexPart,
    rotation: DQuat,
    position: DVec3,
}

/// Appends to `out` the points where the core of a part of a body at (rotation, position) is nearer than `reach` [m] to
/// the terrain, whose elements have the numbers from `first`.
pub fn approaches(
    (terrain, first): (&Terrain, u32),
    part: &ConvexPart,
    rotation: DQuat,
    position: DVec3,
    reach: f64,
    out: &mut Vec<Approach>,
) {
    let (centre, radius) = part.bounding_sphere();
    let centre = rotation * centre + position;
    let placed = Placed { part, rotation, position };
    let from = out.len();
    let mut near: Vec<(u32, &SurfaceElement)> = terrain.near(centre, radius + reach).collect();
    // Elements are numbered in this order: triangles, ridges, corners.
    near.sort_unstable_by_key(|(number, _)| *number);
    for (number, element) in near {
        let place = first + number;
        match element {
            SurfaceElement::Face(face) => {
                if (centre - face.corners[0]).dot(face.normal).abs() < radius + reach {
                    placed.approaches_to_face(face, place, reach).for_each(|approach| keep_nearer(out, from, approach));
                }
            }
            SurfaceElement::Ridge(ridge) => {
                if let Some(approach) = placed.approach_to_ridge(ridge, place, reach) {
                    keep(out, from, approach);
                }
            }
            SurfaceElement::Corner(corner) => {
                if let Some(approach) = placed.approach_to_corner(corner, place, reach) {
                    keep(out, from, approach);
                }
            }
        }
    }
}

/// Appends the approach of an end of the part to a triangle. Of several triangles with almost the same normal, only the
/// nearest counts. The approaches of the part start at index `from`.
fn keep_nearer(out: &mut Vec<Approach>, from: usize, new: Approach) {
    let end = |approach: &Approach| match approach.feature {
        Feature::Terrain { end, .. } => Some(end),
        _ => None,
    };
    match out[from..].iter_mut().find(|old| end(old) == end(&new) && old.normal.dot(new.normal) > VALLEY) {
        Some(old) if new.distance < old.distance => *old = new,
        Some(_) => {}
        None => out.push(new),
    }
}

impl<'a> Placed<'a> {
    /// Points where the ends of the part are near a triangle.
    fn approaches_to_face(self, face: &'a Face, place: u32, reach: f64) -> impl Iterator<Item = Approach> + 'a {
        let ends = self.part.ends(self.rotation.inverse() * -face.normal).enumerate();
        let behind = -LARGEST_DEPTH_BEHIND * self.part.rounding();
        ends.filter_map(move |(end, point)| {
            let core = self.rotation * point + self.position;
            let distance = (core - face.corners[0]).dot(face.normal);
            let feature = Feature::Terrain { place, end: end as u16 };
            ((behind..reach).contains(&distance) && face.has_foot_of(core, SAME_PLACE)).then_some(Approach {
                feature,
                core,
                normal: face.normal,
                distance,
            })
        })
    }

    /// Point where the part is near a ridge; `None` if an adjacent triangle or corner is nearer.
    fn approach_to_ridge(self, ridge: &Ridge, place: u32, reach: f64) -> Option<Approach> {
        let [a, b] = ridge.ends;
        let (share, core) = nearest_to_segment(self.part, self.rotation, self.position, ridge.ends, reach)?;
        let across = core - a.lerp(b, share);
        let within =
            (RIDGE_END..1.0 - RIDGE_END).contains(&share) && ridge.into.iter().all(|into| across.dot(*into) < 0.0);
        within.then(|| self.approach(across, core, place, reach)).flatten()
    }

    /// Point where the part is near a corner; `None` if an adjacent ridge or triangle is nearer.
    fn approach_to_corner(self, corner: &Corner, place: u32, reach: f64) -> Option<Approach> {
        let core =
            self.rotation * self.part.nearest(self.rotation.inverse() * (corner.at - self.position)) + self.position;
        let across = core - corner.at;
        let within = corner.along.iter().all(|along| across.dot(*along) <= SAME_PLACE);
        within.then(|| self.approach(across, core, place, reach)).flatten()
    }

    fn approach(self, across: DVec3, core: DVec3, place: u32, reach: f64) -> Option<Approach> {
        let distance = across.length();
        let feature = Feature::Terrain { place, end: 0 };
        (distance < reach && distance > 0.0).then(|| Approach { feature, core, normal: across / distance, distance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::profile::Profile;
    use crate::geometry::solid::tests::cuboid;
    use crate::geometry::terrain::tests::extruded_profile;
    use crate::rigid::search::ground::GroundSurface;

    const REACH: f64 = 0.3;

    fn near(terrain: &Terrain, part: &ConvexPart, rotation: DQuat, at: DVec3) -> Vec<Approach> {
        let mut out = Vec::new();
        approaches((terrain, 0), part, rotation, at, REACH, &mut out);
        out
    }

    fn ball() -> ConvexPart {
        ConvexPart::ball(DVec3::ZERO, 0.1)
    }

    fn unit_box() -> Terrain {
        let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
        Terrain::new(vertices, triangles).unwrap()
    }

    #[test]
    fn distance_of_a_ball_to_a_box_is_exact() {
        let terrain = unit_box();
        for i in 0..4000 {
            let share = |k: f64| (f64::from(i) * k).fract();
            let at = DVec3::new(share(0.618), share(0.414), share(0.732)) * 1.5 - 0.25;
            let outside = (at - at.clamp(DVec3::ZERO, DVec3::ONE)).length();
            if !(0.01..=0.29).contains(&outside) {
                continue;
            }
            let found = near(&terrain, &ball(), DQuat::IDENTITY, at);
            assert_eq!(found.len(), 1, "{at}: {found:?}");
            // 1e-12 allows for rounding errors.
            assert!((found[0].distance - outside).abs() < 1e-12);
            assert!((found[0].core - found[0].normal * outside - at.clamp(DVec3::ZERO, DVec3::ONE)).length() < 1e-12);
        }
    }

    #[test]
    fn extruded_profile_gives_the_distances_of_the_profile() {
        let points = [[-3.0, 0.0], [-1.0, 1.0], [1.0, 1.0], [3.0, 0.0]];
        let (terrain, ground) = (extruded_profile(&points), GroundSurface::new(&Profile::new(points.to_vec())));
        let leg = ConvexPart::cone(
            crate::geometry::convex::convex_part::TruncatedCone::new(DVec3::Z, [-0.2, 0.2], [0.1, 0.06]),
            0.03,
        );
        let mut compared = 0;
        for i in 0..2000 {
            let share = |k: f64| (f64::from(i) * k).fract();
            let rotation = DQuat::from_euler(glam::EulerRot::XYZ, f64::from(i), 2.3 * f64::from(i), 0.7 * f64::from(i));
            let at = DVec3::new(4.4 * share(0.618) - 2.2, share(0.414) - 0.5, 0.5 + 1.2 * share(0.732));
            let mut expected = Vec::new();
            ground.approaches(&leg, rotation, at, REACH, &mut expected);
            if expected.iter().any(|a| a.distance < 0.0) || !expected.iter().any(|a| a.distance < REACH - 0.01) {
                continue;
            }
            let found = near(&terrain, &leg, rotation, at);
            let deepest = |all: &[Approach]| all.iter().map(|a| a.distance).fold(f64::MAX, f64::min);
            // Limit 1e-9 m: far above the resolution of the bisection along an edge of two metres.
            assert!((deepest(&found) - deepest(&expected)).abs() < 1e-9, "{at}: {found:?} {expected:?}");
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
    }

    #[test]
    fn ball_touches_a_fine_valley_once_and_a_steep_valley_twice() {
        let arc: Vec<[f64; 2]> = (-20..=20).map(|i| 0.05 * f64::from(i)).map(|a| [a.sin(), 1.0 - a.cos()]).collect();
        let bowl = extruded_profile(&arc);
        let mut before = 0.25;
        for i in 0..2000 {
            // The centre of the ball moves at a distance of 0.25 m from the surface of the trough.
            let angle = -0.9 + 9e-4 * f64::from(i);
            let at = DVec3::new(0.75 * angle.sin(), 0.1, 1.0 - 0.75 * angle.cos());
            let found = near(&bowl, &ball(), DQuat::IDENTITY, at);
            assert_eq!(found.len(), 1, "{at}: {found:?}");
            // Limit 4e-4 m: the sagitta of an arc of 0.05 rad and radius 1 m is 3e-4 m. Limit 2e-5 m: in each step the
            // ball moves 6.75e-4 m, at an angle of at most 0.025 rad to the triangle.
            assert!((found[0].distance - 0.25).abs() < 4e-4);
            assert!(i == 0 || (found[0].distance - before).abs() < 2e-5);
            before = found[0].distance;
        }
        let steep = extruded_profile(&[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]);
        assert_eq!(near(&steep, &ball(), DQuat::IDENTITY, DVec3::new(0.0, 0.1, 0.2)).len(), 2);
    }

    #[test]
    fn cube_rests_on_four_corners_and_ignores_the_underside_of_a_plate() {
        let (vertices, triangles) = cuboid(DVec3::new(-1.0, -1.0, -0.05), DVec3::new(1.0, 1.0, 0.0));
        let plate = Terrain::new(vertices, triangles).unwrap();
        let (corners, _) = cuboid(DVec3::splat(-0.1), DVec3::splat(0.1));
        let sharp = crate::geometry::convex::polyhedron::Polyhedron::hull(&corners).unwrap();
        let cube = ConvexPart::polyhedron(&sharp, 0.02).unwrap();
        let found = near(&plate, &cube, DQuat::IDENTITY, DVec3::new(0.31, 0.17, 0.1));
        let touching: Vec<_> = found.iter().filter(|a| a.distance < 0.021).collect();
        assert_eq!(touching.len(), 4, "{touching:?}");
        assert!(touching.iter().all(|a| (a.distance - 0.02).abs() < 1e-12 && a.normal == DVec3::Z));
        assert!(found.iter().all(|a| a.normal.z > 0.0));
    }
}
