//! A block of the bed under a blow, and where it lies.

use glam::{DMat3, DVec3};

use crate::femdem::mesh::Mesh;
use crate::femdem::mesh::block::{Pattern, block};

/// Name of the body and of its held underside.
pub const NAME: &str = "base";
/// Set of the underside.
pub const BOTTOM: &str = "base_bottom";

/// Depth over width of the block [-].
const DEPTH: f64 = 0.5;

/// Largest width of the block of the bed over the height of the unit [-], where legs reach below the plane of contact.
const WIDEST: f64 = 1.5;

/// Least one [-]: where there is less room between them, the block lies below them all.
const NARROWEST: f64 = 0.15;

/// Nodes so near the plane of contact belong to feet, over the height of the unit [-].
const FOOT: f64 = 0.25;

/// The block of a plane bed reaches so much further than the feet [-].
const MARGIN: f64 = 1.1;

/// Where the bed is not plane, the block leaves out what is lower than the foot that touches by more than the first of
/// these that leaves it room, over the height of the unit [-].
const LEVELS: [f64; 3] = [0.01, 0.02, 0.05];

/// Gap between the bodies at the start over the height of the unit [-].
pub const GAP: f64 = 1e-4;

/// Sharp edges of the unit reach so far below the place where its rounded edges touched, over its height [-].
pub const ROUNDED_OFF: f64 = 0.05;

/// Nodes about the place of contact within this distance over the height of the unit [-] are those that touch.
pub const ABOUT: f64 = 0.12;

/// Where the block lies; lengths from the place of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seat {
    /// Middle of its upper side, in the plane through the place of contact [m].
    pub middle: DVec3,
    /// Width [m].
    pub width: f64,
    /// Upper side along the normal [m].
    pub top: f64,
    /// How far that is below the foot that touches [m].
    pub gap: f64,
}

impl Seat {
    /// Just below a unit with these nodes, this centre and height [m], touched along the unit vector `normal`: under all
    /// feet where the bed is plane, else, where legs reach below the plane of contact, about the place of contact and as
    /// wide as they leave room on their ways, on which `way` [m] leads a node.
    pub fn below(nodes: &[DVec3], way: impl Fn(DVec3) -> DVec3, centre: DVec3, normal: DVec3, height: f64) -> Self {
        let level = |node: &DVec3| node.dot(normal);
        let flat = |place: DVec3| place - normal * place.dot(normal);
        let is_plane = nodes.iter().all(|node| level(node) >= -ROUNDED_OFF * height);
        let about = nodes.iter().filter(|node| node.length() < ABOUT * height);
        let foot = about.map(level).fold(f64::INFINITY, f64::min).min(ROUNDED_OFF * height);
        // Half the diagonal of the block lies within the room.
        let widest_above = |share: f64| {
            let lower = nodes.iter().filter(|node| level(node) < foot - share * height);
            let room = lower.map(|node| nearest(flat(*node), flat(way(*node)))).fold(f64::INFINITY, f64::min);
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
        // On a plane bed another foot may be lower, by what its edges are not rounded off, and touches first.
        let gap = if is_plane { GAP * height } else { (foot - top).max(GAP * height) };
        Self { middle, width, top, gap }
    }

    /// The block, of cells about as long as `cell` [m].
    pub fn block(&self, normal: DVec3, cell: f64) -> Mesh {
        under(self.middle, normal, self.top, self.width, cell)
    }
}

/// How near a way from a place [m] comes to the origin [m].
fn nearest(place: DVec3, way: DVec3) -> f64 {
    let share = (-place.dot(way) / way.length_squared()).clamp(0.0, 1.0);
    // Without a way, the share is no number.
    if share.is_nan() { place.length() } else { (place + share * way).length() }
}

/// A block with its upper side at `level` [m] over the place `middle` along the unit vector `normal`, so wide [m], of cells
/// about as long as `cell` [m].
fn under(middle: DVec3, normal: DVec3, level: f64, width: f64, cell: f64) -> Mesh {
    let across = ((width / cell).ceil() as usize).max(2);
    let down = ((DEPTH * width / cell).ceil() as usize).max(1);
    let lengths = DVec3::new(width, width, DEPTH * width);
    let mut mesh = block(lengths, [across, across, down], Pattern::Centred);
    let u = normal.any_orthonormal_vector();
    // Right-handed, lest the tetrahedra be turned inside out.
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

    /// Nodes of feet, each a small square of four [m].
    fn feet(places: &[[f64; 3]]) -> Vec<DVec3> {
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let foot =
            |place: &[f64; 3]| corners.map(|[x, y]| DVec3::from_array(*place) + DVec3::new(0.01 * x, 0.01 * y, 0.0));
        places.iter().flat_map(foot).collect()
    }

    #[test]
    fn on_a_plane_bed_the_block_lies_under_all_feet() {
        // One foot touches, the edge of another reaches a little lower.
        let nodes = feet(&[[0.0, 0.0, 0.0], [0.8, 0.0, -0.03], [0.4, 0.7, 0.02], [0.4, 0.3, 1.0]]);
        let seat = Seat::below(&nodes, |_| DVec3::ZERO, DVec3::new(0.4, 0.25, 0.4), DVec3::Z, 1.0);
        assert_eq!((seat.top, seat.gap), (-0.03 - GAP, GAP));
        assert!(seat.width > 0.9 && seat.middle == DVec3::new(0.4, 0.25, 0.0));
    }

    #[test]
    fn beyond_an_edge_the_block_lies_under_the_foot_that_touches() {
        // The plane of contact is a slope; towards the crest the unit reaches below it, first a little, then more.
        let nodes = feet(&[[0.0, 0.0, 0.0], [-0.5, 0.0, -0.025], [-0.8, 0.1, -0.13], [0.1, 0.2, 1.0]]);
        let seat = Seat::below(&nodes, |_| DVec3::ZERO, DVec3::new(-0.3, 0.0, 0.4), DVec3::Z, 1.0);
        assert_eq!((seat.top, seat.gap, seat.middle), (-GAP, GAP, DVec3::ZERO));
        // Half its diagonal does not reach the second foot, 0.49 m away.
        assert!(seat.width * std::f64::consts::FRAC_1_SQRT_2 < 0.49 && seat.width > 0.5, "{}", seat.width);
        // Nor does the second foot come to the block, which slides by 0.2 m towards it.
        let slid = Seat::below(&nodes, |_| 0.2 * DVec3::X, DVec3::new(-0.3, 0.0, 0.4), DVec3::Z, 1.0);
        assert!(slid.width * std::f64::consts::FRAC_1_SQRT_2 < 0.29 && slid.width > 0.3, "{}", slid.width);
    }

    #[test]
    fn a_way_comes_nearest_at_its_end_or_on_it() {
        let place = DVec3::new(3.0, 4.0, 0.0);
        assert_eq!([DVec3::ZERO, DVec3::X, -6.0 * DVec3::X].map(|way| nearest(place, way)), [5.0, 5.0, 4.0]);
        assert_eq!(nearest(place, -place), 0.0);
    }

    #[test]
    fn without_room_the_block_lies_below_all_and_is_waited_for() {
        let nodes = feet(&[[0.0, 0.0, 0.0], [-0.05, 0.0, -0.2], [0.1, 0.2, 1.0]]);
        let seat = Seat::below(&nodes, |_| DVec3::ZERO, DVec3::new(0.0, 0.0, 0.4), DVec3::Z, 1.0);
        assert!((seat.top + 0.2 + GAP).abs() < 1e-12, "{seat:?}");
        // From the lowest node about the place of contact, which is the one that is lower here.
        assert!(seat.gap >= GAP && seat.gap <= 0.2 + GAP);
    }
}
