//! Validates the landmarks and the cut plane of a fracture case.

use glam::DVec3;

use crate::case::file::{FractureFile, LandmarkFile};
use crate::case::reading::check::{Checker, at_least, more_than};
use crate::femdem::mesh::PreparedMesh;
use crate::femdem::setup::Setup;

/// A box with a name, in the undeformed mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// Name in the report.
    pub name: String,
    /// Corners of the box with the smallest and with the largest coordinates [m].
    pub corners: [DVec3; 2],
}

impl Landmark {
    /// Returns the distance of a point from the box [m]; 0 for a point inside the box.
    pub fn distance(&self, place: DVec3) -> f64 {
        let [low, high] = self.corners;
        place.distance(place.clamp(low, high))
    }
}

/// A plane that cuts the undeformed bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Point in the plane [m].
    pub point: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

impl Plane {
    /// Returns the signed distance of a point from the plane along the normal [m].
    pub fn height(&self, place: DVec3) -> f64 {
        self.normal.dot(place - self.point)
    }
}

pub fn landmarks(file: &FractureFile, check: &mut Checker) -> Vec<Landmark> {
    let validate = |(index, landmark): (usize, &LandmarkFile)| {
        let path = |key: &str| format!("landmarks[{index}].{key}");
        if landmark.name.trim().is_empty() {
            let advice = "write a name that readers understand";
            check.reject(&path("name"), format!("{:?}", landmark.name), "a line of text", advice);
        }
        for axis in 0..3 {
            let (low, high) = (landmark.low_m[axis], landmark.high_m[axis]);
            let advice = "write a coordinate of the undeformed mesh";
            check.number(&path(&format!("low_m[{axis}]")), low, at_least(-1e4).up_to(1e4), "m", advice);
            let advice = "`high_m` must not be less than `low_m`";
            check.number(&path(&format!("high_m[{axis}]")), high, at_least(low).up_to(1e4), "m", advice);
        }
        Landmark {
            name: landmark.name.trim().to_owned(),
            corners: [landmark.low_m, landmark.high_m].map(DVec3::from_array),
        }
    };
    file.landmarks.iter().enumerate().map(validate).collect()
}

/// Returns the cut plane of the case. The default plane is normal to y and passes through the centroid of the bodies
/// that can crack, or of all bodies if no body can crack.
pub fn section(file: &FractureFile, setup: &Setup, mesh: &PreparedMesh, check: &mut Checker) -> Plane {
    let Some(given) = file.output.section else {
        let cracks = |tet: usize| setup.bodies.iter().any(|b| b.cohesion.is_some() && b.tets.contains(&tet));
        let all = !setup.bodies.iter().any(|body| body.cohesion.is_some());
        let (mut volume, mut moment) = (0.0, DVec3::ZERO);
        for (_, tet) in mesh.mesh.tets.iter().enumerate().filter(|(number, _)| all || cracks(*number)) {
            let [a, b, c, d] = tet.map(|node| mesh.mesh.nodes[node as usize]);
            let tet_volume = (b - a).cross(c - a).dot(d - a) / 6.0;
            volume += tet_volume;
            moment += (a + b + c + d) * (0.25 * tet_volume);
        }
        return Plane { point: moment / volume.max(f64::MIN_POSITIVE), normal: DVec3::Y };
    };
    let normal = DVec3::from_array(given.normal);
    let advice = "[0, 1, 0] gives a plane along x and z";
    check.number("output.section.normal (its length)", normal.length(), more_than(0.0).up_to(1e6), "", advice);
    for (axis, value) in given.point_m.into_iter().enumerate() {
        let advice = "write a point of the undeformed mesh inside a body";
        check.number(&format!("output.section.point_m[{axis}]"), value, at_least(-1e4).up_to(1e4), "m", advice);
    }
    Plane { point: DVec3::from_array(given.point_m), normal: normal.normalize_or(DVec3::Y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmark_distance_is_measured_from_its_box() {
        let corners = [DVec3::new(0.0, -0.1, 0.2), DVec3::new(0.1, 0.1, 0.2)];
        let landmark = Landmark { name: "corner".to_owned(), corners };
        assert_eq!(landmark.distance(DVec3::new(0.05, 0.0, 0.2)), 0.0);
        assert!((landmark.distance(DVec3::new(0.13, 0.0, 0.24)) - 0.05).abs() < 1e-15);
    }
}
