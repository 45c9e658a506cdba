//! Places units at the poses in the case file or in a placement file, and validates the poses.

use std::path::Path;

use glam::{DQuat, DVec3};

use super::{MAX_UNITS, UnitPose};
use crate::case::file::{PlacementFile, PoseFile, Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text};
use crate::case::reading::document::Document;

/// Tolerance on the length of a quaternion [-]. It allows for rounding to three digits in the file; the quaternion is
/// then normalized.
const ROUNDING: f64 = 1e-3;

/// Places the units at the poses in the case file, or in the placement file that it names. The path of the placement
/// file is relative to the folder of the case file.
pub fn place(file: &UnitsFile, case_name: &str, site: &Site, check: &mut Checker) -> Option<Vec<UnitPose>> {
    for (key, written) in [
        ("count", file.count.is_some()),
        ("pitch_m", file.pitch_m.is_some()),
        ("x_m", file.x_m.is_some()),
        ("first_y_m", file.first_y_m.is_some()),
        ("centres_m", file.centres_m.is_some()),
    ] {
        if written {
            check.reject(&format!("units.{key}"), "...", "left out with poses", "poses give every position");
        }
    }
    let (poses, path) = match (&file.poses, &file.placement_file) {
        (Some(poses), None) => (poses.clone(), "units.poses"),
        (None, Some(path)) => (read(path, case_name, check)?, "units.placement_file"),
        _ => {
            let advice = "keep one of the two keys";
            check.reject("units.poses", "[...]", "left out with `placement_file`", advice);
            return None;
        }
    };
    if !(1..=MAX_UNITS as usize).contains(&poses.len()) {
        let advice = "leave out `units` for a case without units";
        check.reject(path, format!("{} poses", poses.len()), format!("1 to {MAX_UNITS}"), advice);
        return None;
    }
    Some(
        poses
            .iter()
            .enumerate()
            .map(|(index, pose)| validate(&format!("{path}[{index}]"), pose, site, check))
            .collect(),
    )
}

fn read(path: &str, case_name: &str, check: &mut Checker) -> Option<Vec<PoseFile>> {
    let path = Path::new(case_name).parent().unwrap_or(Path::new("")).join(path);
    match Document::read(&path).and_then(|document| document.parse::<PlacementFile>()) {
        Ok(file) => Some(file.poses),
        Err(reason) => {
            let advice = "`breakwater place CASE` writes a placement file";
            let shown = format!("{:?}", path.display().to_string());
            check.reject("units.placement_file", shown, format!("a placement file ({reason})"), advice);
            None
        }
    }
}

fn validate(path: &str, pose: &PoseFile, site: &Site, check: &mut Checker) -> UnitPose {
    let (centre, rotation) = (DVec3::from_array(pose.centre_m), DQuat::from_array(pose.quaternion_xyzw));
    let y = match site.sides {
        // Any y is allowed, because all periodic images are the same unit.
        Sides::Periodic => [f64::MIN, f64::MAX],
        Sides::Walls => [0.0, site.width],
        // Any y is allowed, because `planar::lay` moves the unit into the particle layer.
        Sides::TwoDimensional => [f64::MIN, f64::MAX],
    };
    let ground = site.profile.z(centre.x);
    for (axis, [low, high]) in [site.x, y, [ground, site.top_z]].into_iter().enumerate() {
        if !(centre[axis] >= low && centre[axis] <= high) {
            check.reject(
                &format!("{path}.centre_m[{axis}]"),
                as_text(centre[axis]),
                format!("at least {} and at most {} m", as_text(low), as_text(high)),
                "the centre of a unit must lie above the ground, between the walls and below their top",
            );
        }
    }
    let length = rotation.length();
    if (length - 1.0).abs() > ROUNDING || length.is_nan() {
        let advice = "write x, y, z, w of a rotation; [0, 0, 0, 1] means no rotation";
        check.reject(
            &format!("{path}.quaternion_xyzw"),
            format!("of length {}", as_text(length)),
            "of length 1",
            advice,
        );
    }
    // Quaternions of length 1 are not normalized again, so that a resumed run has exactly the same poses.
    let is_exact = (length - 1.0).abs() < 1e-15;
    UnitPose { centre, rotation: if is_exact { rotation } else { rotation.normalize() } }
}
