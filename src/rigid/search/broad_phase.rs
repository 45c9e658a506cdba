//! Broad phase: pairs of bodies near each other, found with a bounding volume tree of parry3d.

use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

/// Two bodies near each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct BodyPair {
    /// Index of the first body, the lower index.
    pub first: usize,
    /// Index of the second body; equal to `first` if a body is near its own image.
    pub second: usize,
    /// Number of flume widths that shift the second body to its image near the first body.
    pub image: i32,
}

/// Sorted pairs of bodies whose centres are nearer than the sum of their radii [m]. `period` is the width [m] of a
/// periodic flume, in which a body can also touch images of other bodies and of itself.
pub fn pairs(position: &[DVec3], radius: impl Fn(usize) -> f64, period: Option<f64>) -> Vec<BodyPair> {
    // Number of the periodic image that contains a body, and the position of the body shifted to image 0.
    let image = |x: &DVec3| period.map_or(0.0, |width| (x.y / width).floor());
    let wrapped: Vec<(DVec3, i32)> = position
        .iter()
        .map(|x| {
            let image = image(x);
            (*x - DVec3::Y * (image * period.unwrap_or(0.0)), image as i32)
        })
        .collect();
    // Each box encloses the sphere of a body. The factor 1 + 1e-6 keeps rounding errors from excluding a pair.
    let half = |body: usize| DVec3::splat(radius(body) * (1.0 + 1e-6));
    let boxes: Vec<Aabb> =
        wrapped.iter().enumerate().map(|(body, (x, _))| Aabb::new(*x - half(body), *x + half(body))).collect();
    let largest = (0..position.len()).map(&radius).fold(0.0, f64::max);
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    // In a narrow flume, a body can be near several images of another body.
    let shifts = period.map_or(0, |width| (2.0 * largest / width).ceil().min(f64::from(MAX_IMAGES)) as i32);
    let mut pairs = Vec::new();
    for (first, (x, own)) in wrapped.iter().enumerate() {
        for shift in -shifts..=shifts {
            let to_image = DVec3::Y * (f64::from(shift) * period.unwrap_or(0.0));
            let about = Aabb::new(*x + to_image - half(first), *x + to_image + half(first));
            for second in tree.intersect_aabb(&about).map(|leaf| leaf as usize).filter(|second| *second >= first) {
                let image = own - wrapped[second].1 - shift;
                // A body and its own image count once; the image on the other side is the same contact.
                let counts = first != second || image > 0;
                let apart = position[second] + DVec3::Y * (f64::from(image) * period.unwrap_or(0.0)) - position[first];
                let near = radius(first) + radius(second);
                if counts && apart.length_squared() < near * near {
                    pairs.push(BodyPair { first, second, image });
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Pairs of one body with bodies of lower index whose centres are nearer than the sum of their radii [m].
pub fn pairs_with(
    body: usize,
    position: &[DVec3],
    radius: impl Fn(usize) -> f64,
    period: Option<f64>,
) -> Vec<BodyPair> {
    let mut pairs = Vec::new();
    for (first, x) in position[..body].iter().enumerate() {
        let width = period.unwrap_or(f64::INFINITY);
        let nearest = if period.is_some() { ((x.y - position[body].y) / width).round() as i32 } else { 0 };
        let others = if period.is_some() { -1..=1 } else { 0..=0 };
        for image in others.map(|other| nearest + other) {
            let shift = if image == 0 { 0.0 } else { f64::from(image) * width };
            let near = radius(first) + radius(body);
            if (position[body] + DVec3::Y * shift - *x).length_squared() < near * near {
                pairs.push(BodyPair { first, second: body, image });
            }
        }
    }
    pairs
}

/// Largest number of images on each side that a body can touch.
const MAX_IMAGES: u32 = 8;

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions scattered in x and z within 1 m, and in y over 4 m.
    fn scattered(count: u32) -> Vec<DVec3> {
        let share = |i: u32, k: f64| (f64::from(i) * k).fract();
        (0..count).map(|i| DVec3::new(share(i, 0.618), 4.0 * share(i, 0.414) - 2.0, share(i, 0.732))).collect()
    }

    fn brute_force(position: &[DVec3], radius: impl Fn(usize) -> f64, period: Option<f64>) -> Vec<BodyPair> {
        let mut pairs = Vec::new();
        for first in 0..position.len() {
            for second in first..position.len() {
                let images = if period.is_some() { -20..=20 } else { 0..=0 };
                for image in images {
                    let shift = DVec3::Y * (f64::from(image) * period.unwrap_or(0.0));
                    let counts = first != second || image > 0;
                    let near = radius(first) + radius(second);
                    if counts && (position[second] + shift - position[first]).length() < near {
                        pairs.push(BodyPair { first, second, image });
                    }
                }
            }
        }
        pairs
    }

    #[test]
    fn pairs_match_a_brute_force_search() {
        let position = scattered(150);
        for (near, period) in [(0.2, None), (0.2, Some(1.0)), (0.7, Some(0.5)), (0.9, Some(0.4))] {
            let radius = |body: usize| near * [0.5, 0.2, 0.8][body % 3];
            assert_eq!(pairs(&position, radius, period), brute_force(&position, radius, period), "{near} {period:?}");
        }
        assert_eq!(pairs(&[], |_| 0.5, Some(1.0)), []);
        assert_eq!(pairs(&[DVec3::ZERO], |_| 0.5, None), []);
    }
}
