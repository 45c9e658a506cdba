//! Block that represents the bed under an impact: mesh and position.

use glam::{DMat3, DVec3};

use crate::femdem::mesh::Mesh;
use crate::femdem::mesh::block::{Pattern, block};

/// Name of the block in the mesh.
pub const NAME: &str = "base";
/// Name of the set of faces at the fixed underside of the block.
pub const BOTTOM: &str = "base_bottom";

/// Depth of the block, divided by its width [-].
const DEPTH: f64 = 0.5;

/// Largest width of the block, divided by the height of the unit [-], if legs reach below the contact plane.
const WIDEST: f64 = 1.5;

/// Smallest width of the block, divided by the height of the unit [-]. If the legs leave less room, the block lies
/// below all legs.
const NARROWEST: f64 = 0.15;

/// Nodes below this level belong to feet: level above the contact plane, divided by the height of the unit [-].
const FOOT: f64 = 0.25;

/// Width of the block on a plane bed, divided by the width that the feet need [-].
const MARGIN: f64 = 1.1;

/// Depths below the foot at the contact point, divided by the height of the unit [-]. On a bed that is not plane, the
/// block avoids the parts of the unit below such a depth. The first depth that leaves room for the block is used.
const LEVELS: [f64; 3] = [0.01, 0.02, 0.05];

/// Initial gap between the bodies, divided by the height of the unit [-].
pub const GAP: f64 = 1e-4;

/// Largest depth below the contact plane that the sharp edges of the unit's mesh reach, divided by the height of the
/// unit [-]. The contact point was computed for rounded edges.
pub const ROUNDED_OFF: f64 = 0.05;

/// Nodes closer than this to the contact point count as touching: distance, divided by the height of the unit [-].
pub const TOUCHING_DISTANCE: f64 = 0.12;

/// Position and size of the block, relative to the contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockPosition {
    /// Centre of the upper side, projected onto the contact plane [m].
    pub middle: DVec3,
    /// Width of the block [m].
    pub width: f64,
    /// Level of the upper side along the contact normal [m].
    pub top: f64,
    /// Distance from the upper side up to the foot that touches it first [m].
    pub gap: f64,
}

impl BlockPosition {
    /// Returns the position of a block just below a unit with these `nodes`, `centre` and `height` [m]; `normal` is the
    /// contact normal. On a plane bed, the block lies under all feet. If legs reach below the contact plane, the block
    /// lies around the contact point, and is as wide as the moving legs allow; `path` returns the displacement of a
    /// node [m].
    pub fn below(nodes: &[DVec3], path: impl Fn(DVec3) -> DVec3, centre: DVec3, normal: DVec3, height: f64) -> Self {
        let level = |node: &DVec3| node.dot(normal);
        let flat = |point: DVec3| point - normal * point.dot(normal);
        let is_plane = nodes.iter().all(|node| level(node) >= -ROUNDED_OFF * height);
        let about = nodes.iter().filter(|node| node.length() < TOUCHING_DISTANCE * height);
        let foot = about.map(level).fold(f64::INFINITY, f64::min).min(ROUNDED_OFF * height);
        // Half the diagonal of the block must be shorter than the distance to the parts that it avoids.
        let widest_above = |share: f64| {
            let lower = nodes.iter().filter(|node| level(node) < foot - share * height);
            let room = lower.map(|node| distance_of_path(flat(*node), flat(path(*node)))).fold(f64::INFINITY, f64::min);
            (0.9 * std::f64::consts::SQRT_2 * room).min(WIDEST * height)
        };
        let room = LEVELS.map(widest_above).into_iter().find(|width| *width >= NARROWEST * height);
        let (middle, width) = match room {
            Some(width) if !is_plane => (DVec3::ZERO, width),
            _ => {
                let middle = flat(centre);
                let feet = nodes.iter().filter(|node| level(node) < FOOT * height);
                let reach = feet.map(|node| flat(*node - middle).length()).fold(NARROWEST * height, f64::max);
                (middle, 2.0 * MARGIN * reach)
            }
        };
        let half_diagonal = width * std::f64::consts::FRAC_1_SQRT_2;
        let over = nodes.iter().filter(|node| flat(**node - middle).length() <= half_diagonal);
        let lowest = over.map(level).fold(f64::INFINITY, f64::min);
        let top = if lowest.is_finite() { lowest } else { 0.0 } - GAP * height;
        // The contact point was computed for rounded edges, but the edges of the mesh are sharp. On a plane bed, the
        // foot at the contact point is therefore not always the lowest foot, which touches the block first.
        let gap = if is_plane { GAP * height } else { (foot - top).max(GAP * height) };
        Self { middle, width, top, gap }
    }

    /// Meshes the block with cells of about the length `cell` [m].
    pub fn block(&self, normal: DVec3, cell: f64) -> Mesh {
        block_under(self.middle, normal, self.top, self.width, cell)
    }
}

/// Returns the smallest distance from the origin on the straight path from `start` to `start + path` [m].
fn distance_of_path(start: DVec3, path: DVec3) -> f64 {
    let share = (-start.dot(path) / path.length_squared()).clamp(0.0, 1.0);
    // A path of length zero gives NaN.
    if share.is_nan() { start.length() } else { (start + share * path).length() }
}

/// Meshes a block with cells of about the length `cell` [m]. Its upper side is at `level` [m] above the point `middle`,
/// along the unit vector `normal`.
fn block_under(middle: DVec3, normal: DVec3, level: f64, width: f64, cell: f64) -> Mesh {
    let across = ((width / cell).ceil() as usize).max(2);
    let down = ((DEPTH * width / cell).ceil() as usize).max(1);
    let lengths = DVec3::new(width, width, DEPTH * width);
    let mut mesh = block(lengths, [across, across, down], Pattern::Centred);
    let u = normal.any_orthonormal_vector();
    // The axes must be right-handed: otherwise the tetrahedra are inverted.
    let axes = DMat3::from_cols(u, normal.cross(u), normal);
    let origin = DVec3::new(0.5 * width, 0.5 * width, DEPTH * width - level);
    mesh.nodes.iter_mut().for_each(|node| *node = middle + axes * (*node - origin));
    mesh.bodies[0].name = NAME.to_owned();
    mesh.sets.retain(|set| set.name == "zmin");
    mesh.sets.iter_mut().for_each(|set| set.name = BOTTOM.to_owned());
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the nodes of feet; each foot is a small square of four nodes [m].
    fn feet(centres: &[[f64; 3]]) -> Vec<DVec3> {
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let foot =
            |centre: &[f64; 3]| corners.map(|[x, y]| DVec3::from_array(*centre) + DVec3::new(0.01 * x, 0.01 * y, 0.0));
        centres.iter().flat_map(foot).collect()
    }

    #[test]
    fn on_a_plane_bed_the_block_lies_under_all_feet() {
        // One foot is at the contact point; another foot is slightly lower.
        let nodes = feet(&[[0.0, 0.0, 0.0], [0.8, 0.0, -0.03], [0.4, 0.7, 0.02], [0.4, 0.3, 1.0]]);
        let seat = BlockPosition::below(&nodes, |_| DVec3::ZERO, DVec3::new(0.4, 0.25, 0.4), DVec3::Z, 1.0);
        assert_eq!((seat.top, seat.gap), (-0.03 - GAP, GAP));
        assert!(seat.width > 0.9 && seat.middle == DVec3::new(0.4, 0.25, 0.0));
    }

    #[test]
    fn where_legs_reach_below_the_contact_plane_the_block_lies_under_the_touching_foot() {
        // The contact plane is a slope. Near the contact point, the unit reaches slightly below this plane; further
        // away, it reaches deeper.
        let nodes = feet(&[[0.0, 0.0, 0.0], [-0.5, 0.0, -0.025], [-0.8, 0.1, -0.13], [0.1, 0.2, 1.0]]);
        let seat = BlockPosition::below(&nodes, |_| DVec3::ZERO, DVec3::new(-0.3, 0.0, 0.4), DVec3::Z, 1.0);
        assert_eq!((seat.top, seat.gap, seat.middle), (-GAP, GAP, DVec3::ZERO));
        // Half the diagonal of the block is shorter than 0.49 m, the distance of the second foot.
        assert!(seat.width * std::f64::consts::FRAC_1_SQRT_2 < 0.49 && seat.width > 0.5, "{}", seat.width);
        // The block is narrower if the second foot slides 0.2 m towards the contact point.
        let slid = BlockPosition::below(&nodes, |_| 0.2 * DVec3::X, DVec3::new(-0.3, 0.0, 0.4), DVec3::Z, 1.0);
        assert!(slid.width * std::f64::consts::FRAC_1_SQRT_2 < 0.29 && slid.width > 0.3, "{}", slid.width);
    }

    #[test]
    fn smallest_distance_of_a_path_is_at_an_end_or_between_the_ends() {
        let start = DVec3::new(3.0, 4.0, 0.0);
        assert_eq!([DVec3::ZERO, DVec3::X, -6.0 * DVec3::X].map(|p| distance_of_path(start, p)), [5.0, 5.0, 4.0]);
        assert_eq!(distance_of_path(start, -start), 0.0);
    }

    #[test]
    fn if_legs_leave_no_room_the_block_lies_below_all_nodes() {
        let nodes = feet(&[[0.0, 0.0, 0.0], [-0.05, 0.0, -0.2], [0.1, 0.2, 1.0]]);
        let seat = BlockPosition::below(&nodes, |_| DVec3::ZERO, DVec3::new(0.0, 0.0, 0.4), DVec3::Z, 1.0);
        assert!((seat.top + 0.2 + GAP).abs() < 1e-12, "{seat:?}");
        // The gap is measured from the foot at the contact point, which is 0.2 m above the lower foot.
        assert!(seat.gap >= GAP && seat.gap <= 0.2 + GAP);
    }
}
