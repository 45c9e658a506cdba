//! Places units at the poses in the case file or in a placement file, and validates the poses.

use std::f64::consts::PI;
use std::path::Path;

use glam::{DQuat, DVec3};

use super::{MAX_UNITS, UnitGroup, UnitPose};
use crate::case::file::{PlacementFile, PoseFile, Sides, UnitsFile};
use crate::case::flume::site::Site;
use crate::case::reading::check::{Checker, as_text, lower_limit, upper_limit};
use crate::case::reading::document::Document;

/// Tolerance on the length of a quaternion [-]. It allows for rounding to three digits in the file; the quaternion is
/// then normalized.
const ROUNDING: f64 = 1e-3;

/// Places the units of a group at the poses in the case file, or in the placement file that it names. The path of the
/// placement file is relative to the folder of the case file.
pub fn place(
    file: &UnitsFile,
    group: &UnitGroup,
    case_name: &str,
    site: &Site,
    check: &mut Checker,
) -> Option<Vec<UnitPose>> {
    for (key, written) in [
        ("count", file.count.is_some()),
        ("pitch_m", file.pitch_m.is_some()),
        ("x_m", file.x_m.is_some()),
        ("first_y_m", file.first_y_m.is_some()),
        ("scatter", file.scatter.is_some()),
        ("centres_m", file.centres_m.is_some()),
    ] {
        if written {
            check.reject(&format!(".{key}"), "...", "left out with poses", "poses give every position");
        }
    }
    let (poses, path) = match (&file.poses, &file.placement_file) {
        (Some(poses), None) => (poses.clone(), ".poses"),
        (None, Some(path)) => (read(path, &group.name, case_name, check)?, ".placement_file"),
        _ => {
            let advice = "keep one of the two keys";
            check.reject(".poses", "[...]", "left out with `placement_file`", advice);
            return None;
        }
    };
    if !(1..=MAX_UNITS as usize).contains(&poses.len()) {
        let advice = "leave out `units` for a case without units";
        check.reject(path, format!("{} poses", poses.len()), format!("1 to {MAX_UNITS}"), advice);
        return None;
    }
    let validate_one = |(index, pose)| validate(&format!("{path}[{index}]"), pose, site, check);
    let placements: Vec<UnitPose> = poses.iter().enumerate().map(validate_one).collect();
    refuse_crowd(&placements, path, group, check);
    Some(placements)
}

/// Refuses units of which so many are near another unit that they must overlap. The search for contacts would need hours
/// and all memory for thousands of units at one position.
fn refuse_crowd(placements: &[UnitPose], path: &str, group: &UnitGroup, check: &mut Checker) {
    let reach = group.reach();
    let least = group.models.iter().map(|model| model.shape.volume()).fold(f64::MAX, f64::min);
    // Units with their centres within two reaches of a centre are inside a sphere with a radius of three reaches.
    let most = (4.0 / 3.0 * PI * (3.0 * reach).powi(3) / least) as usize;
    let near = |a: &UnitPose| {
        placements.iter().filter(|b| a.centre.distance_squared(b.centre) <= (2.0 * reach).powi(2)).count()
    };
    let crowded = placements.iter().map(near).enumerate().find(|(_, count)| *count > most);
    if let Some((index, count)) = crowded {
        check.reject(
            &format!("{path}[{index}].centre_m"),
            format!("a position with {count} units within {} m", as_text(2.0 * reach)),
            format!("a position with at most {most} units, because more units overlap"),
            "move the units apart",
        );
    }
}

fn read(path: &str, group: &str, case_name: &str, check: &mut Checker) -> Option<Vec<PoseFile>> {
    let path = Path::new(case_name).parent().unwrap_or(Path::new("")).join(path);
    match Document::read(&path).and_then(|document| document.parse::<PlacementFile>()) {
        Ok(PlacementFile { groups, poses, .. }) if groups.is_empty() => Some(poses),
        Ok(PlacementFile { groups, .. }) => {
            let names: Vec<String> = groups.iter().map(|group| format!("{:?}", group.name)).collect();
            let found = groups.into_iter().find(|one| one.name == group).map(|one| one.poses);
            if found.is_none() {
                let shown = format!("{:?}", path.display().to_string());
                let allowed = format!("a placement file with the group {group:?} (it has {})", names.join(", "));
                check.reject(".placement_file", shown, allowed, "place the units again, or rename the group");
            }
            found
        }
        Err(reason) => {
            let advice = "`breakwater place CASE` writes a placement file";
            let shown = format!("{:?}", path.display().to_string());
            check.reject(".placement_file", shown, format!("a placement file ({reason})"), advice);
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
                format!("at least {} and at most {} m", lower_limit(low), upper_limit(high)),
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

#[cfg(test)]
mod tests {
    use crate::case::DryTestCase;

    /// Checks a dry test of `count` cubes of 0.1 m with their centres `distance` [m] apart.
    fn check(count: usize, distance: f64) -> Result<(), String> {
        let pose = |i: usize| {
            let at = |i: usize| 0.2 + distance * i as f64;
            format!(r#"{{ "centre_m": [{}, {}, {}] }}"#, at(i % 10), at(i / 10 % 10), at(i / 100))
        };
        let poses: Vec<String> = (0..count).map(pose).collect();
        let text = format!(
            r#"{{ "title": "Cubes", "dry_test": {{ "kind": "settle" }},
            "flume": {{ "bed_m": [[0.0, 0.0], [3.0, 0.0]], "material": "mortar" }},
            "domain": {{ "x_m": [0.0, 3.0], "width_m": 3.0, "sides": "walls", "top_z_m": 3.0 }},
            "units": {{ "shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3, "material": "mortar",
                "poses": [{}] }},
            "materials": [{{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }}],
            "friction": [{{ "between": ["mortar", "mortar"], "coefficient": 0.65 }}],
            "stop": {{ "duration_s": 1.0 }} }}"#,
            poses.join(",")
        );
        DryTestCase::from_str(&text, "cubes.json").map(|_| ()).map_err(|errors| errors.to_string())
    }

    #[test]
    fn units_side_by_side_are_allowed_and_a_crowd_is_refused() {
        check(1000, 0.1).unwrap();
        let message = check(1000, 0.01).unwrap_err();
        // Half the diagonal of the cube is 0.0866 m: a sphere of three times this radius has the volume of 73 cubes.
        let expected = "a position with at most 73 units, because more units overlap; move the units apart";
        assert!(message.starts_with("cubes.json: units.poses[0].centre_m = a position with "), "{message}");
        assert!(message.ends_with(expected), "{message}");
    }
}
