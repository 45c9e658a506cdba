//! An impact as loads: the recorded forces of all contacts, and the water's, act on the unit alone.

use glam::DVec3;

use super::blow::Blow;
use super::fracture_case::Scene;
use super::froude::BlowScale;
use super::model::Role;
use super::reenact::part;
use super::selection::same_collision;
use crate::case::file::{LoadAxes, LoadFile};
use crate::femdem::mesh::unit_mesh::UnitMesh;
use crate::output::{Impact, Impacts};
use crate::rigid::ForceSample;

/// A force goes from one sample to the next within this share of the shorter one [-].
const RAMP: f64 = 0.2;

/// Rows of one time are apart by this share of the run at least [-].
const APART: f64 = 1e-9;

/// Scene of the unit alone under what was recorded from the start of the impact on.
pub fn scene(blow: &Blow, impacts: &Impacts) -> Scene {
    let (mover, _) = blow.movers();
    let duration = blow.time_after();
    let unit = blow.impact.event.body as usize;
    let mut loads = Vec::new();
    for other in &impacts.impacts {
        for role in Role::of(other).filter(|role| role.unit == unit) {
            let (since, scale) = clock(blow, other);
            let rows = rows(&other.history, other.event.start, since, scale, role.sign, duration);
            if rows.len() < 2 {
                continue;
            }
            loads.push(LoadFile::Force {
                body: UnitMesh::NAME.to_owned(),
                place_m: mover.pose.place(role.place).to_array(),
                radius_m: blow.handover.mesh.edge() * blow.froude.length(),
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
            // All faces.
            radius_m: 2.0 * blow.model.shape.height() * blow.froude.length(),
            axes: LoadAxes::Space,
            history: vec![row],
        });
    }
    let mesh = blow.handover.mesh.posed(&mover.pose, UnitMesh::NAME);
    Scene { mesh, parts: vec![part(blow, UnitMesh::NAME, &mover)], loads, duration }
}

/// When a contact begins on the clock of the prototype's blow [s], and its scale: blows change by Hertz's law, those of one
/// collision together; what lasted already when the blow began is pressed by other loads, and follows Froude's law.
fn clock(blow: &Blow, other: &Impact) -> (f64, BlowScale) {
    let since = other.event.start - blow.impact.event.start;
    let own = Blow::new(blow.model, blow.handover, other).scale;
    let slow = BlowScale { force: blow.froude.mass(), time: blow.froude.velocity() };
    if same_collision(blow.impact, other) {
        (since * own.time, own)
    } else {
        (since * slow.time, if since < 0.0 { slow } else { own })
    }
}

/// Rows of time [s] and force [N] of the samples of a contact that begins at `since` [s]: each sample's mean force, with
/// ramps about their ends that keep its impulse. Nothing before time 0, and nothing that begins after `until`.
fn rows(samples: &[ForceSample], start: f64, since: f64, scale: BlowScale, sign: f64, until: f64) -> Vec<Vec<f64>> {
    let of = |sample: &ForceSample| {
        let from = since + (sample.start - start) * scale.time;
        (from.max(0.0), from + sample.duration * scale.time, sample.force() * (sign * scale.force))
    };
    // What is shorter than rows can be apart is left out.
    let pieces: Vec<(f64, f64, DVec3)> =
        samples.iter().map(of).filter(|(from, to, _)| to - from > APART * until && *from < until).collect();
    let mut knots: Vec<(f64, DVec3)> = Vec::new();
    for (index, (from, to, force)) in pieces.iter().enumerate() {
        let half = |other: Option<&(f64, f64, DVec3)>| {
            0.5 * RAMP * (to - from).min(other.map_or(f64::INFINITY, |(from, to, _)| to - from))
        };
        let before = half(index.checked_sub(1).and_then(|index| pieces.get(index)));
        let after = half(pieces.get(index + 1));
        // The force is constant before the first row: one that begins at time 0 has no ramp.
        let before = if index == 0 { before.min(*from) } else { before };
        if index == 0 && before > 0.0 {
            knots.push((from - before, DVec3::ZERO));
        }
        knots.push((from + before, *force));
        knots.push((to - after, *force));
        if index + 1 == pieces.len() {
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
        let scale = BlowScale { force: 7.0, time: 3.0 };
        let rows = rows(&samples, 5.0, 0.5, scale, -1.0, 100.0);
        assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]) && rows[0][3] == 0.0);
        let impulse: f64 = rows.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][3] + p[1][3])).sum();
        // Sign, force and time; rounding.
        assert!((impulse / (-31.0 * 21.0) - 1.0).abs() < 1e-9, "{impulse}");
        // Begun before: 0.9 of the 1.2 s of the second sample are left.
        let late = super::rows(&samples, 5.0, -0.6, scale, 1.0, 100.0);
        assert!(late[0][0] == 0.0 && late.windows(2).all(|pair| pair[0][0] < pair[1][0]), "{late:?}");
        let impulse: f64 = late.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][3] + p[1][3])).sum();
        assert!((impulse / ((0.75 * 30.0 - 1.0) * 21.0) - 1.0).abs() < 1e-9, "{impulse}");
    }
}
