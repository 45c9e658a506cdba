//! Tetrapod: four truncated cones on the axes of a tetrahedron (Danel & Greslou 1962).
//!
//! Each cone is extended to the centre of the unit. A ray from the centre along the unit vector u then leaves the unit
//! only once, at the largest distance at which it leaves one of the cones. Two legs meet at a crease. There, u has the
//! same angle to the axes of both legs, so the crease lies in a plane through the centre. Each leg is therefore meshed
//! separately, with exact tip disc, rim and crease, and the legs are joined at the creases.

use std::f64::consts::TAU;

use glam::DVec3;

use super::section::Section;
use crate::geometry::convex::convex_part::{ConvexPart, TruncatedCone};

/// Radius of the tip, divided by the height H [-].
const TIP_RADIUS: f64 = 0.151;
/// Radius of the base of a leg, divided by the height H [-].
const BASE_RADIUS: f64 = 0.235;
/// Length of a leg from base to tip, divided by the height H [-].
const LEG_LENGTH: f64 = 0.477;
/// Distance from the centre to the tip, divided by the height H [-].
const CENTRE_TO_TIP: f64 = 0.644;
/// Detail of a mesh: number of points around a leg, and of rows between the rim of the tip and the crease. A multiple
/// of 6 points includes the corners where three legs meet.
pub struct Detail {
    around: usize,
    rows: usize,
}

/// Detail of the exact surface. The area of the polygon is 1 - (2 pi / 72)^2 / 6 = 99.87 % of the area of the circle.
pub const FINE: Detail = Detail { around: 72, rows: 6 };

/// Detail for films.
pub const COARSE: Detail = Detail { around: 12, rows: 1 };

/// Axes of the four legs: unit vectors to the corners of a tetrahedron, the first upwards, the second towards -x.
pub fn leg_axes() -> [DVec3; 4] {
    let (lower, flat) = (-1.0 / 3.0, (8.0f64 / 9.0).sqrt());
    let lower_axis = |angle: f64| DVec3::new(-flat * angle.cos(), -flat * angle.sin(), lower);
    [DVec3::Z, lower_axis(0.0), lower_axis(TAU / 3.0), lower_axis(2.0 * TAU / 3.0)]
}

/// Radii [m] of a leg's cone at the centre and at the tip, and the length between them [m].
pub fn cone(height_m: f64) -> ([f64; 2], f64) {
    ([centre_radius() * height_m, TIP_RADIUS * height_m], CENTRE_TO_TIP * height_m)
}

/// Critical sections of a Tetrapod of height H [m], at the roots of the legs.
pub fn sections(height_m: f64) -> Vec<Section> {
    let root_section = |axis: DVec3| {
        let root = (CENTRE_TO_TIP - LEG_LENGTH) * height_m;
        Section::round(axis * root, axis, BASE_RADIUS * height_m)
    };
    leg_axes().map(root_section).to_vec()
}

/// Decrease of the radius of a leg per unit of length: the tangent of the half-angle of the cone [-].
fn taper() -> f64 {
    (BASE_RADIUS - TIP_RADIUS) / LEG_LENGTH
}

/// Radius of the extended cone at the centre, divided by H [-].
fn centre_radius() -> f64 {
    TIP_RADIUS + CENTRE_TO_TIP * taper()
}

/// Surface of a Tetrapod of height H [m] about its centre: vertices [m] and triangles.
pub fn surface(height_m: f64, Detail { around, rows }: Detail) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let axes = leg_axes();
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut triangles = Vec::new();
    let mut creases: Vec<u32> = Vec::new();
    for (leg, &axis) in axes.iter().enumerate() {
        let other = axes[(leg + 1) % 4];
        // Azimuth 0 points towards another leg, in a mirror plane of the crease.
        let e1 = (other - axis * axis.dot(other)).normalize();
        let e2 = axis.cross(e1);
        let mut rings: Vec<Vec<u32>> = vec![Vec::new(); rows + 1];
        for k in 0..around {
            let angle = TAU * k as f64 / around as f64;
            let out = e1 * angle.cos() + e2 * angle.sin();
            let rim = axis * CENTRE_TO_TIP + out * TIP_RADIUS;
            let end = crease_point(&axes, leg, out);
            for (row, ring) in rings.iter_mut().enumerate() {
                let point = height_m * rim.lerp(end, row as f64 / rows as f64);
                ring.push(if row == rows {
                    crease_vertex(point, height_m, &mut vertices, &mut creases)
                } else {
                    vertices.push(point);
                    (vertices.len() - 1) as u32
                });
            }
        }
        vertices.push(axis * CENTRE_TO_TIP * height_m);
        let tip = (vertices.len() - 1) as u32;
        for k in 0..around {
            let next = (k + 1) % around;
            triangles.push([tip, rings[0][k], rings[0][next]]);
            for pair in rings.windows(2) {
                let [upper, lower] = [&pair[0], &pair[1]];
                triangles.push([upper[k], lower[k], lower[next]]);
                triangles.push([upper[k], lower[next], upper[next]]);
            }
        }
    }
    (vertices, triangles)
}

/// Point where the generatrix of the cone of `leg` in the direction `out` meets the nearest crease, relative to H [-].
///
/// A point of the generatrix is p = s a + (r_0 - s t) n, with the axis a, the distance s along it, the radius r_0 at
/// the centre, the taper t and n = `out`. p is equally far from the axes a and b if p.(a - b) = 0, which is linear in
/// s.
fn crease_point(axes: &[DVec3; 4], leg: usize, out: DVec3) -> DVec3 {
    let a = axes[leg];
    let (r_0, t) = (centre_radius(), taper());
    let s = axes
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != leg)
        .map(|(_, b)| {
            let (along, across) = ((a - *b).dot(a), (a - *b).dot(out));
            -r_0 * across / (along - t * across)
        })
        .fold(f64::MIN, f64::max);
    a * s + out * (r_0 - s * t)
}

/// Index of the crease vertex at `point` [m]; the vertex of a neighbouring leg is reused.
fn crease_vertex(point: DVec3, height_m: f64, vertices: &mut Vec<DVec3>, creases: &mut Vec<u32>) -> u32 {
    // Crease points of one leg are 0.02 H apart; the crease points of two legs agree within rounding errors.
    let near = |v: &&u32| (vertices[**v as usize] - point).length() < 1e-6 * height_m;
    if let Some(&found) = creases.iter().find(near) {
        return found;
    }
    vertices.push(point);
    let index = (vertices.len() - 1) as u32;
    creases.push(index);
    index
}

/// Largest rounding radius, divided by H, for which the rounded cores reach the creases [-].
pub const LARGEST_ROUNDING: f64 = 0.07;

/// Convex parts, one per leg. The core is the cone, shrunk by `rounding_m` [m] at side and tip; core plus ball then
/// touches side and tip from inside. The core starts one rounding radius from the centre of the unit. This start is
/// nearer to the centre than all crease points (0.088 H along the axis).
pub fn parts(height_m: f64, rounding_m: f64) -> Vec<ConvexPart> {
    let (t, length) = (taper(), CENTRE_TO_TIP * height_m);
    // Moving the side of the cone inwards by R reduces its radius by R / cos(half-angle).
    let lowered = rounding_m * (1.0 + t * t).sqrt();
    let radius_at = |s: f64| centre_radius() * height_m - s * t - lowered;
    let (start, end) = (rounding_m, length - rounding_m);
    leg_axes()
        .iter()
        .map(|&axis| {
            let core = TruncatedCone::new(axis, [start, end], [radius_at(start), radius_at(end)]);
            ConvexPart::cone(core, rounding_m)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::super::ArmourUnit;
    use super::*;

    fn unit() -> ArmourUnit {
        ArmourUnit::tetrapod(1.0, 0.05).unwrap()
    }

    #[test]
    fn tetrapod_has_the_volume_and_inertia_of_its_dimensions() {
        let properties = unit().solid.volume_properties();
        // Limit 0.5 %: the polygon of 72 sides reduces the sectional area of each leg by 0.13 %.
        assert!((properties.volume / 0.2799 - 1.0).abs() < 0.005, "volume {}", properties.volume);
        assert!(properties.centre.length() < 1e-9, "centre {}", properties.centre);
        let inertia = unit().inertia(1.0);
        for axis in 0..3 {
            assert!((inertia.col(axis)[axis] / 0.0996 - 1.0).abs() < 0.005, "inertia {inertia}");
        }
        // Tetrahedral symmetry: the tensor is a multiple of the identity, except for rounding.
        assert!((inertia - DMat3::IDENTITY * inertia.x_axis.x).abs_diff_eq(DMat3::ZERO, 1e-9));
    }

    #[test]
    fn standing_tetrapod_has_height_h_and_one_leg_seaward() {
        let unit = unit();
        let [low, high] = unit.solid.bounds();
        // Limit 0.003: the dimensions have three digits.
        assert!((high.z - low.z - 1.0).abs() < 0.003, "height {}", high.z - low.z);
        assert!(low.x < -0.6 && high.x < 0.6);
        // The rounded rim of the tips lowers the centre of mass slightly.
        assert!(unit.standing_height() < unit.standing_height_sharp());
        assert!(unit.standing_height_sharp() - unit.standing_height() < 0.01);
    }

    #[test]
    fn rounded_tetrapod_parts_fill_the_surface_from_inside() {
        let unit = unit();
        let distance_to = |p: DVec3| unit.parts.iter().map(|part| part.distance(p)).fold(f64::MAX, f64::min);
        let rim = unit.solid.vertices().iter().map(|v| distance_to(*v)).fold(0.0, f64::max);
        // Only the sharp rim protrudes from the parts: by R (sqrt 2 - 1) = 0.0207 at a right angle, and by more at this
        // rim.
        assert!(rim < 0.025, "{rim}");
        for v in unit.solid.vertices() {
            // The vertices lie on the exact cones, so none lies inside a part; 1e-9 allows for rounding errors.
            assert!(distance_to(*v) > -1e-9);
        }
        for (leg, part) in unit.parts.iter().enumerate() {
            let axis = leg_axes()[leg];
            let side = axis.any_orthonormal_vector();
            for k in 0..40 {
                let angle = 0.1 * k as f64;
                let n = (axis * angle.cos() + side * angle.sin()).normalize();
                let p = part.support(n) + n * part.rounding();
                // Limit 4e-4: the mesh lies up to 0.26 (1 - cos(pi/72)) = 2.5e-4 inside the true cone.
                assert!(unit.solid.signed_distance(p) < 4e-4, "leg {leg} angle {angle}");
            }
        }
    }

    #[test]
    fn mesh_distance_matches_the_cones_outside() {
        let unit = unit();
        let sharp = parts(1.0, 1e-9);
        for i in 0..500 {
            let (a, b) = (0.7 * i as f64, 0.37 * i as f64);
            let p = DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos()) * (0.7 + 0.001 * i as f64);
            let exact = sharp.iter().map(|part| part.distance(p)).fold(f64::MAX, f64::min);
            // Limit 3e-4 H: the distance between chord and circle with 72 points around a leg.
            assert!((unit.solid.signed_distance(p) - exact).abs() < 3e-4);
        }
    }
}
