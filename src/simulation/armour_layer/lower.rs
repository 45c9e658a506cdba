//! Lowers a unit until it touches something.

use glam::{DQuat, DVec3};

use crate::rigid::{BodyState, RigidWorld};

/// Step of the search over the height of a unit [-]: less than the thinnest part, so that units cannot pass each other.
const STEP: f64 = 0.05;
/// Bisections of the last step: 0.05 H / 2^12 is a hundred-thousandth of the height.
const BISECTIONS: u32 = 12;

/// Returns a unit at rest where it first touches something on its way down from `from` [m]. Returns `None` if it
/// overlaps something at `from`, or touches nothing down to one unit height below `ground` [m].
pub(super) fn lowered(world: &RigidWorld, from: DVec3, rotation: DQuat, ground: f64, height: f64) -> Option<BodyState> {
    let is_free = |z: f64| world.overlap_at(DVec3::new(from.x, from.y, z), rotation) == 0.0;
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
