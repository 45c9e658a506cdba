//! Validates units at given poses, written in the case or in a placement file.

use std::path::Path;

use glam::{DQuat, DVec3};

use super::check::{Checker, show};
use super::file::{PlacementFile, PoseFile, Sides, UnitsFile};
use super::site::Site;
use super::units::{MOST_UNITS, Placement};

/// Tolerance on the length of a quaternion [-]: rounding to seven written digits.
const ROUNDING: f64 = 1e-6;

/// Places the units at the poses of the file or of its placement file, whose path is relative to the case file.
pub(super) fn place(file: &UnitsFile, case_name: &str, site: &Site, check: &mut Checker) -> Option<Vec<Placement>> {
    for (key, written) in [
        ("count", file.count.is_some()),
        ("pitch_m", file.pitch_m.is_some()),
        ("x_m", file.x_m.is_some()),
        ("first_y_m", file.first_y_m.is_some()),
        ("centres_m", file.centres_m.is_some()),
    ] {
        if written {
            check.refuse(&format!("units.{key}"), "...", "left out with poses", "poses give every position");
        }
    }
    let (poses, path) = match (&file.poses, &file.placement_file) {
        (Some(poses), None) => (poses.clone(), "units.poses"),
        (None, Some(path)) => (read(path, case_name, check)?, "units.placement_file"),
        _ => {
            let advice = "keep one of the two";
            check.refuse("units.poses", "[...]", "left out with `placement_file`", advice);
            return None;
        }
    };
    if !(1..=MOST_UNITS as usize).contains(&poses.len()) {
        let advice = "leave out `units` for a case without units";
        check.refuse(path, format!("{} poses", poses.len()), format!("1 to {MOST_UNITS}"), advice);
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
    let text = std::fs::read_to_string(&path).map_err(|error| error.to_string());
    let file = text.and_then(|text| serde_json::from_str::<PlacementFile>(&text).map_err(|error| error.to_string()));
    match file {
        Ok(file) => Some(file.poses),
        Err(reason) => {
            let advice = "`breakwater place CASE` writes one";
            let shown = format!("{:?}", path.display().to_string());
            check.refuse("units.placement_file", shown, format!("a placement file ({reason})"), advice);
            None
        }
    }
}

fn validate(path: &str, pose: &PoseFile, site: &Site, check: &mut Checker) -> Placement {
    let (centre, rotation) = (DVec3::from_array(pose.centre_m), DQuat::from_array(pose.quaternion_xyzw));
    let y = match site.sides {
        // All periodic images are the same unit.
        Sides::Periodic => [f64::MIN, f64::MAX],
        Sides::Walls => [0.0, site.width],
        // `planar::lay` moves the unit into the layer.
        Sides::TwoDimensional => [f64::MIN, f64::MAX],
    };
    let ground = site.profile.z(centre.x);
    for (axis, [low, high]) in [site.x, y, [ground, site.top_z]].into_iter().enumerate() {
        if !(centre[axis] >= low && centre[axis] <= high) {
            check.refuse(
                &format!("{path}.centre_m[{axis}]"),
                show(centre[axis]),
                format!("at least {} and at most {} m", show(low), show(high)),
                "the centre of a unit must lie above the ground, between the walls and below their top",
            );
        }
    }
    let length = rotation.length();
    if (length - 1.0).abs() > ROUNDING || length.is_nan() {
        let advice = "write x, y, z, w of a rotation; [0, 0, 0, 1] is no rotation";
        check.refuse(&format!("{path}.quaternion_xyzw"), format!("of length {}", show(length)), "of length 1", advice);
    }
    // Do not normalize an exact rotation again, so that a saved case keeps its bits.
    let is_exact = (length - 1.0).abs() < 1e-15;
    Placement { centre, rotation: if is_exact { rotation } else { rotation.normalize() } }
}
