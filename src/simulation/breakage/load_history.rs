//! Re-run of an impact by loads: the recorded forces of all contacts and of the water act on the unit alone.

use glam::DVec3;

use super::blow::ScaledImpact;
use super::fracture_case::ImpactScene;
use super::froude::ImpactScale;
use super::model::Role;
use super::reenact::part;
use super::selection::same_collision;
use crate::case::file::{LoadAxes, LoadFile};
use crate::femdem::mesh::unit_mesh::UnitMesh;
use crate::output::{Impact, Impacts};
use crate::rigid::ForceSample;

/// Duration of the ramp between two force samples, divided by the duration of the shorter sample [-].
const RAMP: f64 = 0.2;

/// Smallest time between two rows of a load, divided by the duration of the fracture run [-].
const MIN_ROW_DISTANCE: f64 = 1e-9;

/// Returns mesh and loads of the unit alone. The loads are the forces that were recorded from the start of the impact
/// onwards.
pub fn scene(blow: &ScaledImpact, impacts: &Impacts) -> ImpactScene {
    let (mover, _) = blow.movers();
    let duration = blow.time_after();
    let unit = blow.impact.event.body as usize;
    let mut loads = Vec::new();
    for other in &impacts.impacts {
        for role in Role::of(other).filter(|role| role.unit == unit) {
            let (since, scale) = start_and_scale(blow, other);
            let rows = rows(&other.history, other.event.start, since, scale, role.sign, duration);
            if rows.len() < 2 {
                continue;
            }
            loads.push(LoadFile::Force {
                body: UnitMesh::NAME.to_owned(),
                place_m: mover.pose.place(role.place).to_array(),
                radius_m: blow.settings.mesh.edge() * blow.froude.length(),
                axes: LoadAxes::Space,
                history: rows,
            });
        }
    }
    if let Some(fluid) = &blow.impact.fluid {
        let force = fluid.load.force * blow.froude.mass();
        let moment = fluid.load.torque * blow.froude.moment();
        let row = [[0.0].as_slice(), &force.to_array(), &moment.to_array()].concat();
        loads.push(LoadFile::Force {
            body: UnitMesh::NAME.to_owned(),
            place_m: mover.pose.position.to_array(),
            // This radius includes all faces of the unit.
            radius_m: 2.0 * blow.model.shape.height() * blow.froude.length(),
            axes: LoadAxes::Space,
            history: vec![row],
        });
    }
    let mesh = blow.settings.mesh.posed(&mover.pose, UnitMesh::NAME);
    ImpactScene { mesh, parts: vec![part(blow, UnitMesh::NAME, &mover)], loads, duration }
}

/// Returns the start of the contact `other` in the prototype [s], counted from the start of the impact `blow`, and the
/// scale factors of this contact. If both contacts belong to one collision, [`ScaledImpact::scale`] scales the time
/// between them and the forces. Otherwise, Froude's law scales the time between them. Froude's law also scales the
/// forces of `other` if this contact began before the impact `blow`.
fn start_and_scale(blow: &ScaledImpact, other: &Impact) -> (f64, ImpactScale) {
    let since = other.event.start - blow.impact.event.start;
    let own = ScaledImpact::new(blow.model, blow.settings, other).scale;
    let slow = ImpactScale { force: blow.froude.mass(), time: blow.froude.velocity() };
    if same_collision(blow.impact, other) {
        (since * own.time, own)
    } else {
        (since * slow.time, if since < 0.0 { slow } else { own })
    }
}

/// Returns rows of time [s] and force [N] for the samples of a contact. The contact begins at the recorded time `start`
/// [s], which is the time `since` [s] of the fracture run. Within a sample, the force is the mean force of the sample.
/// Ramps connect the samples; they do not change the total impulse. Forces before time 0 and samples that begin after
/// `until` [s] are omitted.
fn rows(samples: &[ForceSample], start: f64, since: f64, scale: ImpactScale, sign: f64, until: f64) -> Vec<Vec<f64>> {
    let scaled = |sample: &ForceSample| {
        let from = since + (sample.start - start) * scale.time;
        (from.max(0.0), from + sample.duration * scale.time, sample.force() * (sign * scale.force))
    };
    // Omit samples that are too short for two rows.
    let scaled_samples: Vec<(f64, f64, DVec3)> = samples
        .iter()
        .map(scaled)
        .filter(|(from, to, _)| to - from > MIN_ROW_DISTANCE * until && *from < until)
        .collect();
    let mut knots: Vec<(f64, DVec3)> = Vec::new();
    for (index, (from, to, force)) in scaled_samples.iter().enumerate() {
        let half = |other: Option<&(f64, f64, DVec3)>| {
            0.5 * RAMP * (to - from).min(other.map_or(f64::INFINITY, |(from, to, _)| to - from))
        };
        let before = half(index.checked_sub(1).and_then(|index| scaled_samples.get(index)));
        let after = half(scaled_samples.get(index + 1));
        // The force is constant before the first row, so a force that begins at time 0 has no ramp.
        let before = if index == 0 { before.min(*from) } else { before };
        if index == 0 && before > 0.0 {
            knots.push((from - before, DVec3::ZERO));
        }
        knots.push((from + before, *force));
        knots.push((to - after, *force));
        if index + 1 == scaled_samples.len() {
            knots.push((to + after, DVec3::ZERO));
        }
    }
    knots.into_iter().map(|(time, force)| [[time].as_slice(), &force.to_array()].concat()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_the_impulse_of_the_samples() {
        let sample = |start: f64, duration: f64, z: f64| ForceSample { start, duration, impulse: DVec3::Z * z };
        let samples = [sample(5.0, 0.1, 2.0), sample(5.1, 0.4, 30.0), sample(5.5, 0.2, -1.0)];
        let scale = ImpactScale { force: 7.0, time: 3.0 };
        let rows = rows(&samples, 5.0, 0.5, scale, -1.0, 100.0);
        assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]) && rows[0][3] == 0.0);
        let impulse: f64 = rows.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][3] + p[1][3])).sum();
        // The samples have the impulse 31 N s. The scale factors are 7 for force and 3 for time; the sign is -1.
        assert!((impulse / (-31.0 * 21.0) - 1.0).abs() < 1e-9, "{impulse}");
        // The contact began 0.6 s before time 0. Of the second sample, which lasts 1.2 s, 0.9 s are after time 0.
        let late = super::rows(&samples, 5.0, -0.6, scale, 1.0, 100.0);
        assert!(late[0][0] == 0.0 && late.windows(2).all(|pair| pair[0][0] < pair[1][0]), "{late:?}");
        let impulse: f64 = late.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][3] + p[1][3])).sum();
        assert!((impulse / ((0.75 * 30.0 - 1.0) * 21.0) - 1.0).abs() < 1e-9, "{impulse}");
    }
}
