//! A member of a Dolos or Core-Loc: a bar with chamfered edges, tapered from the middle to both ends.

use glam::{DVec2, DVec3};

use super::section::Section;
use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};

/// A bar, symmetric about its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// Middle of the bar [m].
    pub centre: DVec3,
    /// Unit vector along the bar.
    pub axis: DVec3,
    /// Unit vector across the bar, normal to a pair of faces.
    pub across: DVec3,
    /// Half of the length [m].
    pub half_length: f64,
    /// Width between opposite faces, in the middle and at the ends [m].
    pub width: [f64; 2],
    /// Length of a chamfer along a side of the square section, in the middle and at the ends [m].
    pub chamfer: [f64; 2],
}

impl Member {
    /// Convex blocks: the two halves of the bar, or a single block if it is not tapered.
    ///
    /// # Errors
    /// If a block is flat.
    pub fn blocks(&self) -> Result<Vec<Polyhedron>, PolyhedronError> {
        let [middle, end] = [0, 1].map(|k| octagon(self.width[k], self.chamfer[k]));
        let ring = |section: &[DVec2; 8], s: f64| section.map(|p| self.point(p, s)).to_vec();
        let l = self.half_length;
        if self.width[0] == self.width[1] && self.chamfer[0] == self.chamfer[1] {
            return Ok(vec![Polyhedron::hull_of_polygons(&ring(&end, -l), &ring(&end, l))?]);
        }
        Ok(vec![
            Polyhedron::hull_of_polygons(&ring(&middle, 0.0), &ring(&end, l))?,
            Polyhedron::hull_of_polygons(&ring(&end, -l), &ring(&middle, 0.0))?,
        ])
    }

    /// Two sections, one on each side of the middle at the given distance [m].
    pub fn sections(&self, distance: f64) -> [Section; 2] {
        let share = distance / self.half_length;
        let interpolate = |ends: [f64; 2]| ends[0] + (ends[1] - ends[0]) * share;
        let (width, chamfer) = (interpolate(self.width), interpolate(self.chamfer));
        [1.0, -1.0].map(|side| {
            let outwards = self.axis * side;
            Section::chamfered(self.centre + outwards * distance, outwards, [width; 2], chamfer)
        })
    }

    fn point(&self, section: DVec2, along: f64) -> DVec3 {
        self.centre + self.across * section.x + self.axis.cross(self.across) * section.y + self.axis * along
    }
}

/// Square section of the given width [m] with chamfered corners.
fn octagon(width: f64, chamfer: f64) -> [DVec2; 8] {
    let (w, s) = (0.5 * width, 0.5 * width - chamfer);
    [[w, -s], [w, s], [s, w], [-s, w], [-w, s], [-w, -s], [-s, -w], [s, -w]].map(DVec2::from_array)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_a_tapered_member_have_the_frustum_volume() {
        let member = Member {
            centre: DVec3::ONE,
            axis: DVec3::Z,
            across: DVec3::Y,
            half_length: 3.0,
            width: [2.0, 1.0],
            chamfer: [0.2, 0.1],
        };
        let blocks = member.blocks().unwrap();
        assert_eq!(blocks.len(), 2);
        let area = |w: f64, c: f64| w * w - 2.0 * c * c;
        // A frustum with similar end sections A and B has the volume h/3 (A + B + sqrt(A B)); here h = 3.
        let (a, b) = (area(2.0, 0.2), area(1.0, 0.1));
        let expected = a + b + (a * b).sqrt();
        for block in blocks {
            assert!((block.volume() / expected - 1.0).abs() < 1e-9, "{} {expected}", block.volume());
            assert_eq!(block.faces().len(), 10);
        }
    }

    #[test]
    fn untapered_member_is_one_block() {
        let member = Member {
            centre: DVec3::ZERO,
            axis: DVec3::X,
            across: DVec3::Z,
            half_length: 1.0,
            width: [1.0; 2],
            chamfer: [0.25; 2],
        };
        let [block] = &member.blocks().unwrap()[..] else { panic!("one block") };
        assert!((block.volume() - 2.0 * (1.0 - 0.125)).abs() < 1e-12);
    }
}
