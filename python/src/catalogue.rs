//! The catalogue of armour units.

use breakwater::case::UnitKind;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::errors::of_run;

/// Radius of the rounded edges divided by the height [-]; it affects contact only.
const ROUNDING: f64 = 0.03;
/// Waist ratio of the Dolos [-].
const WAIST: f64 = 0.34;

/// Returns the units of height 1 m as a JSON list.
#[pyfunction]
pub fn catalogue() -> PyResult<String> {
    let kinds = [
        ("tetrapod", UnitKind::Tetrapod { height: 1.0 }),
        ("dolos", UnitKind::Dolos { height: 1.0, waist: WAIST }),
        ("core_loc", UnitKind::CoreLoc { size: 1.0 }),
        ("grooved_cube", UnitKind::GroovedCube { height: 1.0 }),
        ("cuboid", UnitKind::Cuboid { edges: [1.0; 3] }),
    ];
    let units = kinds.into_iter().map(|(name, kind)| one(name, &kind)).collect::<PyResult<Vec<Value>>>()?;
    Ok(Value::from(units).to_string())
}

fn one(name: &str, kind: &UnitKind) -> PyResult<Value> {
    let unit = kind.build(ROUNDING).map_err(of_run)?;
    let volume = unit.solid().volume_properties().volume;
    let inertia = unit.inertia(volume);
    let vertices: Vec<[f64; 3]> = unit.solid().vertices().iter().map(|vertex| vertex.to_array()).collect();
    Ok(json!({
        "name": name,
        "volume_m3": volume,
        "k_d": kind.stability_coefficient(),
        "vertices_m": vertices,
        "triangles": unit.solid().triangles(),
        "inertia_m5": [inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z],
    }))
}
