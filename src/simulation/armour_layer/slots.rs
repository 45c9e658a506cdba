//! Positions at which the units of an armour layer are lowered: the nodes of a staggered grid on the slope.

use std::f64::consts::PI;

use glam::DQuat;

use crate::{
    case::{ArmourOrientation, LayerJob, Sides},
    random::SplitMix64,
};

/// Position [m] and rotation in which a unit is lowered.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    pub x: f64,
    pub y: f64,
    pub rotation: DQuat,
}

/// Smallest distance of the centre of a unit from a side wall, divided by the height of the unit [-]. The tip of a leg
/// has about this distance from the centre.
const FROM_WALL: f64 = 0.68;

/// Returns the rows of all layers in the order of placement: layer by layer, and in each layer from the toe upwards.
pub(super) fn rows(job: &LayerJob) -> Vec<Vec<Slot>> {
    let (armour, unit) = (&job.armour, job.group().shape.unit());
    let mut random = SplitMix64::new(armour.seed);
    let slope = job.slope();
    let width = job.site.width;
    let margin = if job.site.sides == Sides::Periodic { 0.0 } else { FROM_WALL * unit.height() };
    let free = (width - 2.0 * margin).max(0.0);
    let (all, layers) = (job.count(), armour.layers as usize);
    let length = length_of(&slope);
    let mut rows = Vec::new();
    for layer in 0..layers {
        // If the number of units is not a multiple of the number of layers, the first layers get one more unit each.
        let count = all / layers + usize::from(layer < all % layers);
        let pitch = (length * width / count.max(1) as f64).sqrt();
        let across = ((width / pitch).round() as usize).max(1);
        let along = count.div_ceil(across);
        let mut of_layer: Vec<Vec<Slot>> = Vec::new();
        for row in 0..along {
            let in_row = across.min(count - row * across);
            // Shift every second row by half a pitch. In the next layer, shift the other rows, so units lie above gaps.
            let shift = if (row + layer).is_multiple_of(2) { 0.25 } else { 0.75 };
            let x = along_slope(&slope, (row as f64 + 0.5) / along as f64 * length);
            let slot = |column: usize| {
                let rotation = match armour.orientation {
                    ArmourOrientation::Random => random.next_rotation(),
                    ArmourOrientation::Alternating => {
                        unit.standing_rotation(if column.is_multiple_of(2) { 0.0 } else { PI })
                    }
                };
                Slot { x, y: margin + (column as f64 + shift) / in_row as f64 * free, rotation }
            };
            of_layer.push((0..in_row).map(slot).collect());
        }
        // If the slope falls towards the shore, the last row is at the toe. Reverse the order, because placement starts
        // at the toe.
        if slope[0][1] > slope[slope.len() - 1][1] {
            of_layer.reverse();
        }
        rows.extend(of_layer);
    }
    rows
}

fn length_of(slope: &[[f64; 2]]) -> f64 {
    slope.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum()
}

/// Returns x [m] of the point at `distance` [m] along the slope, measured from the seaward end of the slope.
fn along_slope(slope: &[[f64; 2]], distance: f64) -> f64 {
    let mut left = distance;
    for piece in slope.windows(2) {
        let length = length_of(piece);
        if left <= length {
            return piece[0][0] + (piece[1][0] - piece[0][0]) * left / length;
        }
        left -= length;
    }
    slope[slope.len() - 1][0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_measured_along_the_slope() {
        // A horizontal part of 2 m, then a slope that is 4 m wide, 3 m high and 5 m long.
        let slope = [[1.0, 0.0], [3.0, 0.0], [7.0, 3.0]];
        assert!((length_of(&slope) - 7.0).abs() < 1e-12);
        assert!((along_slope(&slope, 1.0) - 2.0).abs() < 1e-12);
        assert!((along_slope(&slope, 4.5) - 5.0).abs() < 1e-12);
        assert_eq!(along_slope(&slope, 8.0), 7.0);
    }
}
