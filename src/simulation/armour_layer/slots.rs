//! Positions at which the units of an armour layer are lowered: the nodes of a staggered grid on the slope.

use std::f64::consts::PI;

use glam::DQuat;

use crate::{
    case::{ArmourOrientation, LayerJob, Layers, Sides},
    random::SplitMix64,
    rigid::BodyState,
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
pub(super) fn rows(job: &LayerJob, layers: &Layers) -> Vec<Vec<Slot>> {
    let (armour, unit) = (&layers.armour, job.group(layers).shape().unit());
    let mut random = SplitMix64::new(armour.seed);
    let slope = job.slope(layers);
    let width = job.site.width;
    let margin = margin(job, layers);
    let free = (width - 2.0 * margin).max(0.0);
    let (all, count_of_layers) = (job.count(layers), armour.layers as usize);
    let length = length_of(&slope);
    let mut rows = Vec::new();
    for layer in 0..count_of_layers {
        // If the number of units is not a multiple of the number of layers, the first layers get one more unit each.
        let count = all / count_of_layers + usize::from(layer < all % count_of_layers);
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

/// Returns the smallest distance of the centre of a unit from a side wall [m]; 0 without side walls.
fn margin(job: &LayerJob, layers: &Layers) -> f64 {
    let group = job.group(layers);
    if job.site.sides == Sides::Periodic { 0.0 } else { group.reach().max(FROM_WALL * group.height()) }
}

/// Returns the place on the slope around which the fewest units are, with a random rotation. `units` lists the units of
/// the layers.
pub(super) fn thinnest(job: &LayerJob, layers: &Layers, units: &[BodyState], random: &mut SplitMix64) -> Slot {
    let (slope, width) = (job.slope(layers), job.site.width);
    let margin = margin(job, layers);
    let size = job.group(layers).nominal_diameter;
    let length = length_of(&slope);
    // Candidates half a nominal diameter apart, at random places within their cells.
    let cells = |length: f64| ((2.0 * length / size).round() as usize).max(1);
    let (along, across) = (cells(length), cells(width - 2.0 * margin));
    let mut best: Option<(f64, [f64; 2])> = None;
    for (i, j) in (0..along).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let share =
            |index: usize, count: usize, random: &mut SplitMix64| (index as f64 + random.next_share()) / count as f64;
        let x = along_slope(&slope, share(i, along, random) * length);
        let y = margin + share(j, across, random) * (width - 2.0 * margin);
        // Units count less the further away they are.
        let near = |state: &BodyState| {
            let dx = state.position.x - x;
            let dy = match job.site.sides {
                Sides::Periodic => (state.position.y - y) - width * ((state.position.y - y) / width).round(),
                Sides::Walls | Sides::TwoDimensional => state.position.y - y,
            };
            (1.0 - dx.hypot(dy) / (1.5 * size)).max(0.0)
        };
        let crowd: f64 = units.iter().map(near).sum();
        if best.is_none_or(|(least, _)| crowd < least) {
            best = Some((crowd, [x, y]));
        }
    }
    let [x, y] = best.map_or([slope[0][0], 0.5 * width], |(_, place)| place);
    Slot { x, y, rotation: random.next_rotation() }
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
