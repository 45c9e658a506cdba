//! Tetrapod: four truncated cones on the axes of a tetrahedron (Danel & Greslou 1962).
//!
//! With each cone extended to the centre, the union is star-shaped about the centre. Its surface is r(u) = max over the
//! legs of the distance at which the ray along u leaves the cone. Two legs meet where u is equally far from both axes,
//! in a plane through the centre. Each leg is therefore meshed separately, with exact tip disc, rim and crease, and the
//! legs are joined at the creases.

use std::f64::consts::TAU;

use glam::DVec3;

use super::convex_part::{ConvexPart, TruncatedCone};
use super::section::Section;

/// Radius of the tip over the height H [-].
const TIP_RADIUS: f64 = 0.151;
/// Radius of the base of a leg over the height H [-].
const BASE_RADIUS: f64 = 0.235;
/// Length of a leg from base to tip over the height H [-].
const LEG_LENGTH: f64 = 0.477;
/// Distance from the centre to the tip over the height H [-].
const CENTRE_TO_TIP: f64 = 0.644;
/// Points around a leg: a multiple of 6, so that they include the corners where three legs meet. The polygon's area is
/// 1 - (2 pi / 72)^2 / 6 = 99.87 % of the circle's.
const AROUND: usize = 72;
/// Rows of points from rim to crease.
const ROWS: usize = 6;

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

/// Decrease of a leg's radius per unit of length, the tangent of the half-angle [-].
fn taper() -> f64 {
    (BASE_RADIUS - TIP_RADIUS) / LEG_LENGTH
}

/// Radius of the extended cone at the centre over H [-].
fn centre_radius() -> f64 {
    TIP_RADIUS + CENTRE_TO_TIP * taper()
}

/// Surface of a Tetrapod of height H [m] about its centre: vertices [m] and triangles.
pub fn surface(height_m: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let axes = leg_axes();
    let mut vertices: Vec<DVec3> = Vec::new();
    let mut triangles = Vec::new();
    let mut creases: Vec<u32> = Vec::new();
    for (leg, &axis) in axes.iter().enumerate() {
        let other = axes[(leg + 1) % 4];
        // Azimuth 0 lies in the plane of another leg, a mirror plane of the crease.
        let e1 = (other - axis * axis.dot(other)).normalize();
        let e2 = axis.cross(e1);
        let mut rings: Vec<Vec<u32>> = vec![Vec::new(); ROWS + 1];
        for k in 0..AROUND {
            let angle = TAU * k as f64 / AROUND as f64;
            let out = e1 * angle.cos() + e2 * angle.sin();
            let rim = axis * CENTRE_TO_TIP + out * TIP_RADIUS;
            let end = crease_point(&axes, leg, out);
            for (row, ring) in rings.iter_mut().enumerate() {
                let point = height_m * rim.lerp(end, row as f64 / ROWS as f64);
                ring.push(if row == ROWS {
                    crease_vertex(point, height_m, &mut vertices, &mut creases)
                } else {
                    vertices.push(point);
                    (vertices.len() - 1) as u32
                });
            }
        }
        vertices.push(axis * CENTRE_TO_TIP * height_m);
        let tip = (vertices.len() - 1) as u32;
        for k in 0..AROUND {
            let next = (k + 1) % AROUND;
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

/// Point over H where the generatrix of the cone of `leg` in the direction `out` meets the nearest crease [-].
///
/// On the cone p = s a + (r_0 - s t) n; p is equally far from the axis b when p.(a - b) = 0, which is linear in s.
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

/// Index of the crease vertex at `point`; reuses the vertex of a neighbouring leg.
fn crease_vertex(point: DVec3, height_m: f64, vertices: &mut Vec<DVec3>, creases: &mut Vec<u32>) -> u32 {
    // Crease points of one leg are 0.02 H apart; those of two legs agree within rounding errors.
    let near = |v: &&u32| (vertices[**v as usize] - point).length() < 1e-6 * height_m;
    if let Some(&found) = creases.iter().find(near) {
        return found;
    }
    vertices.push(point);
    let index = (vertices.len() - 1) as u32;
    creases.push(index);
    index
}

/// Largest rounding radius over H for which the rounded cores reach the creases [-].
pub const LARGEST_ROUNDING: f64 = 0.07;

/// Convex parts, one per leg: each cone is shrunk by `rounding_m` [m] at side and tip, so that core plus ball touches
/// both from inside. The core starts one radius above the centre, below the lowest crease point (0.088 H).
pub fn parts(height_m: f64, rounding_m: f64) -> Vec<ConvexPart> {
    let (t, length) = (taper(), CENTRE_TO_TIP * height_m);
    // A line shifted inwards by R is R / cos(half-angle) lower, measured normal to the axis.
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
