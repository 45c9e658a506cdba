//! Units of the film: shape, motion, and quantities of each unit over time.

use super::super::super::plot::short;
use super::super::folder::RunFolder;
use super::super::motion::UnitMotion;
use super::super::water::round_up;
use crate::output::UnitSurface;
use crate::report::film::{Bodies, Body, Field, Mesh, NO_YES, WARM, bounds};

/// Largest number of triangles of the shape; a shape with more is simplified.
const MOST_TRIANGLES: usize = 6000;
/// Number of cells along the longest side of the box of a simplified shape.
const CELLS: f32 = 60.0;

/// Returns the units at the times of the film [s]; `None` for a run without units, or without their shape.
pub fn bodies(run: &RunFolder, times: &[f64]) -> Option<Bodies> {
    if run.motions.is_empty() || run.surfaces.is_empty() {
        return None;
    }
    let (mut position, mut orientation) = (Vec::new(), Vec::new());
    for time in times {
        for motion in &run.motions {
            let pose = motion.at(*time).unwrap_or_default();
            position.push(pose.position_m.map(|c| c as f32));
            orientation.push(pose.orientation.map(|c| c as f32));
        }
    }
    Some(Bodies {
        name: "Units",
        meshes: run.surfaces.iter().map(shape).collect(),
        position,
        orientation: continuous(orientation, run.motions.len()),
        fields: fields(run, times),
        list: run.motions.iter().map(|motion| body(run, motion.unit)).collect(),
    })
}

fn shape(surface: &UnitSurface) -> Mesh {
    let points = surface.vertices_m.iter().map(|vertex| vertex.map(|c| c as f32)).collect();
    let mesh = Mesh { points, triangles: surface.triangles.clone(), values: Vec::new() };
    if mesh.triangles.len() <= MOST_TRIANGLES {
        return mesh;
    }
    let [low, high] = bounds(&mesh.points);
    let longest = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max);
    mesh.clustered(longest / CELLS)
}

/// Chooses the sign of each quaternion so that it is near to that of the same unit in the frame before: both signs are
/// the same orientation, but their mean is not.
fn continuous(mut orientation: Vec<[f32; 4]>, units: usize) -> Vec<[f32; 4]> {
    for index in units..orientation.len() {
        let before = orientation[index - units];
        let cosine: f32 = before.iter().zip(&orientation[index]).map(|(a, b)| a * b).sum();
        if cosine < 0.0 {
            orientation[index] = orientation[index].map(|part| -part);
        }
    }
    orientation
}

/// Returns quantities and properties of the units, each with its values at all times.
fn fields(run: &RunFolder, times: &[f64]) -> Vec<(Field, Vec<f32>)> {
    let displacement = |motion: &UnitMotion| {
        let start = motion.position_m.first().copied().unwrap_or_default();
        motion.position_m.iter().map(|p| (p[0] - start[0]).hypot(p[1] - start[1])).collect()
    };
    let mut fields = vec![
        quantity("displacement", "m", displacement, run, times),
        quantity("horizontal water force", "N", |motion| motion.fluid_change_n(0), run, times),
        quantity("vertical water force", "N", |motion| motion.fluid_change_n(2), run, times),
        quantity("contact force", "N", UnitMotion::contact_size_n, run, times),
    ];
    let damaged = |unit: u32| run.summary.units.iter().any(|u| u.unit == unit && u.damaged);
    fields.push(property("damage", ["not damaged", "damaged"], damaged, run, times));
    if let Some(breakage) = &run.breakage {
        let broken = |unit: u32| breakage.units.iter().any(|u| u.unit == unit as usize && u.broken == Some(true));
        fields.push(property("breakage", ["not broken", "broken"], broken, run, times));
    }
    fields
}

/// Returns a quantity from a history of each unit.
fn quantity(
    name: &'static str,
    unit: &'static str,
    history: impl Fn(&UnitMotion) -> Vec<f64>,
    run: &RunFolder,
    times: &[f64],
) -> (Field, Vec<f32>) {
    let histories: Vec<Vec<f64>> = run.motions.iter().map(history).collect();
    let value = |time: f64, motion: &UnitMotion, history: &[f64]| {
        let value = motion.nearest(time).map_or(0.0, |index| history[index]) as f32;
        if value.is_finite() { value } else { 0.0 }
    };
    let mut values = Vec::with_capacity(times.len() * histories.len());
    for time in times {
        values.extend(run.motions.iter().zip(&histories).map(|(motion, history)| value(*time, motion, history)));
    }
    let [low, high] = values.iter().fold([0.0_f32, 0.0], |[low, high], value| [low.min(*value), high.max(*value)]);
    let round = |value: f32| if value == 0.0 { 0.0 } else { value.signum() * round_up(f64::from(value.abs())) as f32 };
    let range = if low == high { [0.0, 1.0] } else { [round(low), round(high)] };
    (Field::numbers(name, unit, range, &WARM), values)
}

/// Returns a property that each unit has or has not at the end of the run.
fn property(
    name: &'static str,
    labels: [&'static str; 2],
    has: impl Fn(u32) -> bool,
    run: &RunFolder,
    times: &[f64],
) -> (Field, Vec<f32>) {
    let of_units: Vec<f32> = run.motions.iter().map(|motion| if has(motion.unit) { 1.0 } else { 0.0 }).collect();
    let values = times.iter().flat_map(|_| of_units.iter().copied()).collect();
    (Field::labels(name, labels.into_iter().zip(NO_YES.map(str::to_owned))), values)
}

fn body(run: &RunFolder, number: u32) -> Body {
    let group = run.group_of(number);
    let mesh = run.surface_of(number).min(run.surfaces.len().saturating_sub(1));
    let Some(unit) = run.summary.units.iter().find(|unit| unit.unit == number) else {
        return Body { number, mesh, facts: Vec::new() };
    };
    let mut facts = vec![
        ("displacement", format!("{} m", short(unit.displacement_m, 3))),
        ("rotation", format!("{}\u{b0}", short(unit.rotation_deg, 0))),
        ("damaged", if unit.damaged { "yes" } else { "no" }.to_owned()),
        ("peak water force", format!("{} N", short(unit.peak_fluid_force_n, 2))),
        ("peak contact force", format!("{} N", short(unit.peak_contact_force_n, 2))),
        ("contacts with bed and walls", unit.bed_contacts.to_string()),
        ("contacts with other units", unit.unit_contacts.to_string()),
    ];
    let broken = run.breakage.as_ref().and_then(|b| b.units.iter().find(|u| u.unit == number as usize)?.broken);
    facts.extend(broken.map(|broken| ("broken", if broken { "yes" } else { "no" }.to_owned())));
    if let Some(group) = run.summary.groups.get(group).filter(|_| run.summary.groups.len() > 1) {
        facts.insert(0, ("group", group.name.clone()));
    }
    Body { number, mesh, facts }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_orientation_keeps_its_sign_from_frame_to_frame() {
        let turns = vec![[0.0, 0.0, 0.6, 0.8], [0.0, 0.0, 0.0, 1.0], [0.0, 0.0, -0.6, -0.8], [0.0, 0.0, 0.1, 0.9]];
        let signed = continuous(turns, 2);
        assert_eq!(signed[2], [0.0, 0.0, 0.6, 0.8]);
        assert_eq!(signed[3], [0.0, 0.0, 0.1, 0.9]);
    }
}
