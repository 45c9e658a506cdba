//! Lowers a unit until it touches the ground or another unit.

use glam::{DQuat, DVec3};

use crate::rigid::{BodyState, RigidWorld};

/// Step by which a unit is lowered, divided by the height of the unit [-]. The step is smaller than the thinnest part
/// of a unit, so a unit cannot pass through another unit.
const STEP: f64 = 0.05;
/// Number of bisections of the last step. The error of the level is then 0.05 H / 2^12 = 1.2e-5 H, with the height H of
/// the unit.
const BISECTIONS: u32 = 12;

/// Lowers a unit of the given kind from `from` [m] until it touches the ground or another unit, and returns its state
/// there, at rest. Returns `None` if the unit already overlaps a body at `from`, or if it touches nothing down to one
/// unit height below the level `ground` [m].
pub(super) fn lowered(
    world: &RigidWorld,
    kind: usize,
    from: DVec3,
    rotation: DQuat,
    ground: f64,
    height: f64,
) -> Option<BodyState> {
    let is_free = |z: f64| world.overlap_at(kind, DVec3::new(from.x, from.y, z), rotation) == 0.0;
    if !is_free(from.z) {
        return None;
    }
    let mut free = from.z;
    loop {
        let next = free - STEP * height;
        if !is_free(next) {
            break;
        }
        if next < ground - height {
            return None;
        }
        free = next;
    }
    let mut blocked = free - STEP * height;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (free + blocked);
        if is_free(middle) {
            free = middle;
        } else {
            blocked = middle;
        }
    }
    Some(BodyState::at_rest(DVec3::new(from.x, from.y, free), rotation))
}
