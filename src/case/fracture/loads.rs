//! Validates the loads of a fracture case.

use glam::DVec3;

use crate::case::file::{FractureFile, LoadAxes, LoadFile, LoadedFaces};
use crate::case::reading::check::{Checker, as_text, at_least};
use crate::femdem::loads::history::History;
use crate::femdem::loads::patch::{Axes, Patch, faces_near};
use crate::femdem::loads::{Load, Surface};
use crate::femdem::mesh::PreparedMesh;
use crate::femdem::mesh::faces::Exterior;

/// Largest stress [Pa], force [N] and moment [N m] of a load.
const MAX_MAGNITUDE: f64 = 1e12;

/// Returns the valid loads and adds an error for each invalid load.
pub fn validate(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Vec<Load> {
    let each = file.loads.iter().enumerate();
    each.filter_map(|(index, load)| {
        let path = format!("loads[{index}]");
        match load {
            LoadFile::Traction { set, stress_pa, history } => {
                let faces = faces_of(set, &path, mesh, check);
                let good = numbers(stress_pa, &format!("{path}.stress_pa"), "Pa", check);
                let factor = given_factor(history.as_deref(), &path, check)?;
                let stress = DVec3::from_array(*stress_pa);
                faces.filter(|_| good).map(|faces| Load::Traction { faces, stress, factor })
            }
            LoadFile::Pressure { set, pressure_pa, on, history } => {
                let faces = faces_of(set, &path, mesh, check);
                let good = numbers(&[*pressure_pa], &format!("{path}.pressure_pa"), "Pa", check);
                let factor = given_factor(history.as_deref(), &path, check)?;
                let on = match on {
                    LoadedFaces::Deformed => Surface::Deformed,
                    LoadedFaces::Undeformed => Surface::Undeformed,
                };
                faces.filter(|_| good).map(|faces| Load::Pressure { faces, pressure: *pressure_pa, on, factor })
            }
            LoadFile::Force { body, place_m, radius_m, axes, history } => {
                let axes = match axes {
                    LoadAxes::Space => Axes::Space,
                    LoadAxes::Body => Axes::Body,
                };
                let history = forces(history, &path, check);
                let faces = loaded_faces(body, *place_m, *radius_m, &path, mesh, check)?;
                Some(Load::Patch(Patch::new(mesh, &faces, DVec3::from_array(*place_m), axes, history?)))
            }
        }
    })
    .collect()
}

/// Returns the faces of the physical surface with this name.
fn faces_of(name: &str, path: &str, mesh: &PreparedMesh, check: &mut Checker) -> Option<Vec<Exterior>> {
    let found = mesh.faces.boundaries.iter().find(|set| set.name == name);
    if found.is_none() {
        let names: Vec<&str> = mesh.faces.boundaries.iter().map(|set| set.name.as_str()).collect();
        let allowed = format!("one of {}", names.join(", "));
        let advice = "loaded sets are physical surfaces of the mesh";
        check.reject(&format!("{path}.set"), format!("{name:?}"), allowed, advice);
    }
    found.map(|set| set.faces.iter().map(|face| mesh.faces.exteriors[*face as usize]).collect())
}

/// Returns the faces of the body `name` on which a force at `place_m` acts.
fn loaded_faces(
    name: &str,
    place_m: [f64; 3],
    radius_m: f64,
    path: &str,
    mesh: &PreparedMesh,
    check: &mut Checker,
) -> Option<Vec<Exterior>> {
    let body = mesh.mesh.bodies.iter().position(|body| body.name == name);
    if body.is_none() {
        let names: Vec<&str> = mesh.mesh.bodies.iter().map(|body| body.name.as_str()).collect();
        let allowed = format!("one of {}", names.join(", "));
        check.reject(&format!("{path}.body"), format!("{name:?}"), allowed, "name the body on which the force acts");
    }
    let mut good = true;
    for (axis, x) in place_m.iter().enumerate() {
        good &= check.number(&format!("{path}.place_m[{axis}]"), *x, at_least(-1e4).up_to(1e4), "m", "write metres");
    }
    let advice = "0 loads the nearest face";
    good &= check.number(&format!("{path}.radius_m"), radius_m, at_least(0.0).up_to(1e3), "m", advice);
    let body = body.filter(|_| good)?;
    let near = faces_near(mesh, body, DVec3::from_array(place_m), radius_m);
    let farthest = near.edge.max(radius_m);
    if near.distance > farthest {
        check.reject(
            &format!("{path}.place_m"),
            format!("{place_m:?}"),
            format!(
                "at most {} m from the surface of {name:?}, the larger of face edge and radius; it is {} m away",
                as_text(farthest),
                as_text(near.distance)
            ),
            "give the position in the undeformed mesh",
        );
        return None;
    }
    Some(near.faces)
}

/// Returns the load factor as a function of time; it is 1 if the load has no history.
fn given_factor(rows: Option<&[[f64; 2]]>, path: &str, check: &mut Checker) -> Option<History<1>> {
    let Some(rows) = rows else { return Some(History::from(1.0)) };
    let path = format!("{path}.history");
    let values: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    let good = numbers(&values, &path, "", check);
    factor(rows, &path, check).filter(|_| good)
}

/// Returns the history of one value from rows [time, value]. The times must increase.
pub fn factor(rows: &[[f64; 2]], path: &str, check: &mut Checker) -> Option<History<1>> {
    rising(rows.iter().map(|[t, value]| (*t, [*value])).collect(), path, check)
}

/// Returns the history of force and moment from rows with 4 or 7 numbers.
fn forces(rows: &[Vec<f64>], path: &str, check: &mut Checker) -> Option<History<6>> {
    let path = format!("{path}.history");
    let mut all = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        let path = format!("{path}[{index}]");
        if !matches!(row.len(), 4 | 7) {
            let allowed = "t, F_x, F_y, F_z, or t, F_x, F_y, F_z, M_x, M_y, M_z";
            check.reject(&path, format!("{row:?}"), allowed, "write seconds, newtons and newton metres");
            return None;
        }
        if !numbers(&row[1..], &path, "", check) {
            return None;
        }
        let mut values = [0.0; 6];
        values[..row.len() - 1].copy_from_slice(&row[1..]);
        all.push((row[0], values));
    }
    rising(all, &path, check)
}

fn rising<const N: usize>(rows: Vec<(f64, [f64; N])>, path: &str, check: &mut Checker) -> Option<History<N>> {
    let times: Vec<f64> = rows.iter().map(|row| row.0).collect();
    let finite = times.iter().all(|t| t.is_finite());
    let history = History::new(rows).filter(|_| finite);
    if history.is_none() {
        let bad = times.windows(2).position(|pair| pair[1].is_nan() || pair[0] >= pair[1]);
        let value = bad.map_or("no row".to_owned(), |row| {
            format!("{} s after {} s", as_text(times[row + 1]), as_text(times[row]))
        });
        check.reject(path, value, "at least one row, each later than the one before", "sort the rows by time");
    }
    history
}

/// Checks that the magnitude of each number is at most [`MAX_MAGNITUDE`].
fn numbers(values: &[f64], path: &str, unit: &str, check: &mut Checker) -> bool {
    let mut good = true;
    for (index, value) in values.iter().enumerate() {
        let path = if values.len() == 1 { path.to_owned() } else { format!("{path}[{index}]") };
        good &= check.number(
            &path,
            *value,
            at_least(-MAX_MAGNITUDE).up_to(MAX_MAGNITUDE),
            unit,
            "check the number and its unit",
        );
    }
    good
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::super::super::file::FractureFile;
    use super::super::FractureCase;

    /// Returns a case with one bar and the given constraints and loads, or the error messages.
    fn case(rigid: bool, constraints: Value, loads: Value) -> Result<FractureCase, String> {
        let file = json!({
            "title": "bar",
            "fracture": { "mesh": "meshes/bar_single-coarse.msh" },
            "bodies": [{ "name": "bar", "material": "concrete", "cracks": !rigid, "rigid": rigid }],
            "constraints": constraints,
            "loads": loads,
            "materials": [{
                "name": "concrete", "density_kg_m3": 2340, "young_modulus_pa": 26e9, "poisson_ratio": 0.2,
                "strength": {
                    "tensile_pa": 3.3e6, "cohesion_pa": 16.5e6, "friction_angle_deg": 30, "fracture_energy_j_m2": 50
                }
            }],
            "output": { "surfaces_interval_s": 0, "energy_interval_s": 1e-4 },
            "stop": { "duration_s": 1e-3 }
        });
        let name = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/fracture/test.json");
        FractureCase::from_str(&file.to_string(), name).map_err(|errors| errors.to_string())
    }

    #[test]
    fn loads_and_constraints_reach_the_solver_setup() {
        let loads = json!([
            { "kind": "traction", "set": "right", "stress_pa": [1e6, 0, 0], "history": [[0, 0], [1e-3, 1]] },
            { "kind": "pressure", "set": "right", "pressure_pa": 1e5, "on": "undeformed" },
            {
                "kind": "force", "body": "bar", "place_m": [0.25, 0.025, 0.05], "radius_m": 0.03, "axes": "body",
                "history": [[0, 0, 0, 0], [1e-3, 0, 0, -1e3, 0, 5, 0]]
            }
        ]);
        let constraints = json!([{ "set": "left", "velocity_m_s": [0, null, [[0, 0], [1e-3, -0.1]]] }]);
        let found = case(false, constraints.clone(), loads.clone()).unwrap();
        assert_eq!((found.setup.loads.len(), found.setup.constraints.len()), (3, 1));
        assert_eq!(found.setup.constraints[0].at(5e-4), [Some(0.0), None, Some(-0.05)]);
        // The case text that the run stores has the same loads.
        let kept: FractureFile = serde_json::from_str(&found.text).unwrap();
        assert_eq!(kept.loads.len(), 3);
        assert!(case(true, constraints, loads).unwrap().setup.bodies[0].rigid);
    }

    #[test]
    fn errors_name_the_key_and_the_allowed_values() {
        let refused = |constraints: Value, loads: Value| case(false, constraints, loads).unwrap_err();
        let force = |history: Value, place: Value| {
            refused(json!([]), json!([{ "kind": "force", "body": "bar", "place_m": place, "history": history }]))
        };
        let middle = json!([0.25, 0.025, 0.05]);
        for (message, expected) in [
            (
                force(json!([[0, 1, 2]]), middle.clone()),
                "loads[0].history[0] = [0.0, 1.0, 2.0]: must be t, F_x, F_y, F_z",
            ),
            (force(json!([]), middle.clone()), "loads[0].history = no row: must be at least one row"),
            (
                force(json!([[1, 0, 0, 0], [1, 0, 0, 0]]), middle.clone()),
                "loads[0].history = 1 s after 1 s: must be at least one row, each later than the one before",
            ),
            (force(json!([[0, 0, 0, 1e99]]), middle), "loads[0].history[0][2] = 1e99: must be at least"),
            (force(json!([[0, 0, 0, 1]]), json!([0.25, 0.0, 1.0])), "m from the surface of \"bar\""),
            (
                refused(json!([]), json!([{ "kind": "traction", "set": "top", "stress_pa": [0, 0, 1] }])),
                "loads[0].set = \"top\": must be one of left, right",
            ),
            (
                refused(json!([{ "set": "left", "velocity_m_s": ["fast", null, null] }]), json!([])),
                "must be a velocity [m/s], rows [[time [s], velocity [m/s]], ...], or null",
            ),
            (
                refused(json!([{ "set": "left", "velocity_m_s": [[[1, 0], [0, 1]], null, null] }]), json!([])),
                "constraints[0].velocity_m_s[0] = 0 s after 1 s",
            ),
        ] {
            assert!(message.contains(expected), "{message}\n  expected: {expected}");
        }
    }
}
