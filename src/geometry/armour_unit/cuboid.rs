//! Cuboid: a block with three pairs of plane faces.

use glam::DVec3;

use super::section::Section;
use crate::geometry::axis_box::AxisBox;
use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};

/// Surface of a cuboid with the given edges [m], centred at the origin: vertices [m] and triangles.
pub fn surface(edges: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    AxisBox::free(-0.5 * edges, 0.5 * edges).surface()
}

/// Convex polyhedron of a cuboid with the given edges [m], centred at the origin.
///
/// # Errors
/// If an edge is negligible compared with the others.
pub fn block(edges: DVec3) -> Result<Polyhedron, PolyhedronError> {
    Polyhedron::hull(&surface(edges).0)
}

/// Sections through the middle of a cuboid with the given edges [m]: for each axis, one section towards each end.
pub fn sections(edges: DVec3) -> Vec<Section> {
    let across = |axis: usize| [edges[(axis + 1) % 3], edges[(axis + 2) % 3]];
    let sections = |axis: usize| {
        [1.0, -1.0].map(|side| Section::chamfered(DVec3::ZERO, DVec3::AXES[axis] * side, across(axis), 0.0))
    };
    (0..3).flat_map(sections).collect()
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::super::ArmourUnit;
    use super::*;

    #[test]
    fn cuboid_has_the_volume_and_inertia_of_its_edges() {
        let edges = DVec3::new(0.1, 0.2, 0.3);
        let unit = ArmourUnit::cuboid(edges, 0.05).unwrap();
        let properties = unit.solid.volume_properties();
        assert!((properties.volume - 0.006).abs() < 1e-15 && properties.centre.length() < 1e-15);
        // The moment of inertia about each axis is m (b^2 + c^2) / 12. Limit 1e-12: rounding errors.
        let mass = 12.0;
        let expected = DMat3::from_diagonal(DVec3::new(0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04));
        assert!(unit.inertia(mass).abs_diff_eq(expected, 1e-12), "{}", unit.inertia(mass));
        assert_eq!(unit.height(), 0.3);
    }

    #[test]
    fn contact_surface_of_a_cuboid_matches_its_faces() {
        let unit = ArmourUnit::cuboid(DVec3::new(0.1, 0.2, 0.3), 0.05).unwrap();
        let [part] = unit.parts() else { panic!("one part") };
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let face = axis * unit.solid.bounds()[1];
            assert!(part.distance(face).abs() < 1e-15);
        }
        // The rounding cuts each corner by R (sqrt 3 - 1), with R = 0.05 x 0.3 m = 0.015 m.
        assert!((part.distance(unit.solid.bounds()[1]) - 0.015 * (3f64.sqrt() - 1.0)).abs() < 1e-12);
        assert!((unit.standing_height() - 0.15).abs() < 1e-15);
    }
}
