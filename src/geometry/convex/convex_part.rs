//! Convex parts of a body for contact. A part is a core with a rounding radius (Minkowski sum of core and ball).
//!
//! A rounded part has a unique normal at each surface point, so overlap and normal of a contact are continuous. The
//! support function and the nearest point of a core are exact, in closed form.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::polyhedron::Polyhedron;

/// Solid truncated cone about a line through the body's origin, including its end discs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TruncatedCone {
    /// Unit vector along the axis, from the origin to the tip.
    axis: DVec3,
    /// Distances from the origin to the lower and the upper disc along the axis [m].
    along: [f64; 2],
    /// Radii of the lower and the upper disc [m].
    radius: [f64; 2],
}

impl TruncatedCone {
    /// Creates the cone with discs of `radius` [m] at the distances `along` [m] from the origin.
    pub fn new(axis: DVec3, along: [f64; 2], radius: [f64; 2]) -> Self {
        assert!(along[1] > along[0] && radius[0] >= 0.0 && radius[1] >= 0.0, "a cone needs a length and radii >= 0");
        Self { axis: axis.normalize(), along, radius }
    }

    /// Support point of an end disc (0 lower, 1 upper) in `direction` [m]; the centre if `direction` is axial.
    fn disc_support(&self, end: usize, direction: DVec3) -> DVec3 {
        let across = direction - self.axis * self.axis.dot(direction);
        self.axis * self.along[end] + across.normalize_or_zero() * self.radius[end]
    }

    fn support(&self, direction: DVec3) -> DVec3 {
        let [lower, upper] = [self.disc_support(0, direction), self.disc_support(1, direction)];
        if upper.dot(direction) >= lower.dot(direction) { upper } else { lower }
    }

    /// Nearest point of the solid cone [m], found in the plane through `point` and the axis.
    fn nearest(&self, point: DVec3) -> DVec3 {
        let s = self.axis.dot(point);
        let across = point - self.axis * s;
        let rho = across.length();
        let [s_0, s_1] = self.along;
        let [r_0, r_1] = self.radius;
        let radius_at = |s: f64| r_0 + (r_1 - r_0) * (s - s_0) / (s_1 - s_0);
        if (s_0..=s_1).contains(&s) && rho <= radius_at(s) {
            return point;
        }
        let q = DVec2::new(s, rho);
        let candidates = [
            nearest_on_segment(q, DVec2::new(s_0, 0.0), DVec2::new(s_0, r_0)),
            nearest_on_segment(q, DVec2::new(s_0, r_0), DVec2::new(s_1, r_1)),
            nearest_on_segment(q, DVec2::new(s_1, r_1), DVec2::new(s_1, 0.0)),
        ];
        let distance = |c: &DVec2| (*c - q).length_squared();
        let nearest =
            candidates.into_iter().reduce(|a, b| if distance(&b) < distance(&a) { b } else { a }).unwrap_or(q);
        self.axis * nearest.x + across.normalize_or_zero() * nearest.y
    }
}

/// Point of the segment from a to b that is nearest to q.
fn nearest_on_segment(q: DVec2, a: DVec2, b: DVec2) -> DVec2 {
    let ab = b - a;
    let length_squared = ab.length_squared();
    if length_squared == 0.0 {
        return a;
    }
    a + ab * ((q - a).dot(ab) / length_squared).clamp(0.0, 1.0)
}

/// Core of a rounded part.
#[derive(Debug, Clone, PartialEq)]
pub enum Core {
    /// A point: the part is a ball about this centre [m].
    Point(DVec3),
    /// A truncated cone.
    Cone(TruncatedCone),
    /// A polyhedron.
    Polyhedron(Arc<Polyhedron>),
}

/// A convex part of a body, core plus ball, in body axes with the origin at the centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexPart {
    core: Core,
    rounding: f64,
}

impl ConvexPart {
    /// Ball of radius `radius` [m] about `centre` [m].
    pub fn ball(centre: DVec3, radius: f64) -> Self {
        Self { core: Core::Point(centre), rounding: radius }
    }

    /// Cone with edges rounded by `rounding` [m].
    pub fn cone(core: TruncatedCone, rounding: f64) -> Self {
        Self { core: Core::Cone(core), rounding }
    }

    /// Polyhedron with unchanged faces and edges rounded by `rounding` [m]; `None` if it is too thin for this radius.
    pub fn polyhedron(sharp: &Polyhedron, rounding: f64) -> Option<Self> {
        Some(Self { core: Core::Polyhedron(Arc::new(sharp.shrunk(rounding)?)), rounding })
    }

    /// The core if it is a polyhedron, otherwise `None`.
    pub fn as_polyhedron(&self) -> Option<&Polyhedron> {
        if let Core::Polyhedron(core) = &self.core { Some(core) } else { None }
    }

    /// Rounding radius R [m].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Support point of the core: the point furthest in `direction` [m].
    pub fn support(&self, direction: DVec3) -> DVec3 {
        match &self.core {
            Core::Point(centre) => *centre,
            Core::Cone(cone) => cone.support(direction),
            Core::Polyhedron(core) => core.support(direction),
        }
    }

    /// Points of the core that can touch a plane with outward normal `-direction`. A cone has one such point per end
    /// disc, so a lying leg rests on both ends. A polyhedron has all its corners, so a cube rests on four corners.
    pub fn ends(&self, direction: DVec3) -> impl Iterator<Item = DVec3> {
        let (ends, count, corners) = match &self.core {
            Core::Point(centre) => ([*centre; 2], 1, &[][..]),
            Core::Cone(cone) => ([0, 1].map(|end| cone.disc_support(end, direction)), 2, &[][..]),
            Core::Polyhedron(core) => ([DVec3::ZERO; 2], 0, core.corners()),
        };
        ends.into_iter().take(count).chain(corners.iter().copied())
    }

    /// Nearest point of the core [m]; `point` itself if it lies inside.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        match &self.core {
            Core::Point(centre) => *centre,
            Core::Cone(cone) => cone.nearest(point),
            Core::Polyhedron(core) => core.nearest(point),
        }
    }

    /// Distance to the surface of the rounded part [m]; negative inside, at least -R.
    pub fn distance(&self, point: DVec3) -> f64 {
        (self.nearest(point) - point).length() - self.rounding
    }

    /// Centre [m] and radius [m] of a bounding sphere of the rounded part.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match &self.core {
            Core::Point(centre) => (*centre, self.rounding),
            Core::Cone(cone) => {
                let half = 0.5 * (cone.along[1] - cone.along[0]);
                let reach = half.hypot(cone.radius[0].max(cone.radius[1]));
                (cone.axis * (cone.along[0] + half), reach + self.rounding)
            }
            Core::Polyhedron(core) => {
                let (centre, radius) = core.bounding_sphere();
                (centre, radius + self.rounding)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cone() -> TruncatedCone {
        TruncatedCone::new(DVec3::Z, [0.1, 0.6], [0.3, 0.2])
    }

    #[test]
    fn nearest_point_of_a_cone_satisfies_the_support_condition() {
        let part = ConvexPart::cone(cone(), 0.0);
        // A point p of the core is nearest to q if p is a support point in the direction q - p. 1e-12: rounding errors.
        for i in 0..200 {
            let (a, b) = (0.7 * i as f64, 0.37 * i as f64);
            let q = DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos()) * 1.2;
            let p = part.nearest(q);
            let n = (q - p).normalize();
            assert!(part.support(n).dot(n) - p.dot(n) < 1e-12);
        }
        assert_eq!(part.nearest(DVec3::new(0.1, 0.0, 0.3)), DVec3::new(0.1, 0.0, 0.3));
    }

    #[test]
    fn ends_of_a_cone_lie_on_its_discs() {
        let part = ConvexPart::cone(cone(), 0.05);
        let ends: Vec<DVec3> = part.ends(DVec3::X).collect();
        assert_eq!(ends, [DVec3::new(0.3, 0.0, 0.1), DVec3::new(0.2, 0.0, 0.6)]);
        assert_eq!(ConvexPart::ball(DVec3::Y, 0.1).ends(DVec3::X).count(), 1);
    }
}
