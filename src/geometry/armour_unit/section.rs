//! Critical sections of armour units, for stress estimates by beam theory.

use std::f64::consts::PI;

use glam::DVec3;

/// A plane section through a member of a unit, in body axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// Centre of the section [m].
    pub centre: DVec3,
    /// Unit normal towards the end of the member. The section carries the loads on this side.
    pub outwards: DVec3,
    /// Area A [m2].
    pub area: f64,
    /// Section modulus W [m3].
    pub modulus: f64,
    /// The section carries only loads within this distance from the line along `outwards` through the centre [m].
    pub reach: f64,
}

impl Section {
    /// Section of a round bar with the given radius [m].
    pub fn round(centre: DVec3, outwards: DVec3, radius: f64) -> Self {
        let (area, modulus) = (PI * radius * radius, 0.25 * PI * radius.powi(3));
        Self { centre, outwards, area, modulus, reach: f64::INFINITY }
    }

    /// Rectangular section with the given side lengths [m]. `chamfer` [m] is cut from each side at each corner.
    /// The section modulus is for bending about the axis parallel to the longer side.
    pub fn chamfered(centre: DVec3, outwards: DVec3, sides: [f64; 2], chamfer: f64) -> Self {
        let [height, width] = [sides[0].min(sides[1]), sides[0].max(sides[1])];
        let area = height * width - 2.0 * chamfer * chamfer;
        // Second moment of area of the rectangle, minus the second moment of the four corner triangles.
        let arm = 0.5 * height - chamfer / 3.0;
        let triangles = 4.0 * (chamfer.powi(4) / 36.0 + 0.5 * chamfer * chamfer * arm * arm);
        let moment = width * height.powi(3) / 12.0 - triangles;
        Self { centre, outwards, area, modulus: moment / (0.5 * height), reach: f64::INFINITY }
    }

    /// Returns the section with the given reach [m].
    pub fn with_reach(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// Nominal stress |N| / A + |M| / W [Pa] of a force [N] at a point [m], with the normal force N and the bending
    /// moment M in the section; `None` if the section carries no load at this point. If a rectangle bends about an
    /// oblique axis, the stress at its corner is up to 41 % higher.
    pub fn stress(&self, point: DVec3, force: DVec3) -> Option<f64> {
        let arm = point - self.centre;
        let along = arm.dot(self.outwards);
        if along <= 0.0 || (arm - self.outwards * along).length() > self.reach {
            return None;
        }
        let moment = arm.cross(force);
        let bending = moment - self.outwards * moment.dot(self.outwards);
        Some(force.dot(self.outwards).abs() / self.area + bending.length() / self.modulus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cantilever_has_the_stress_of_beam_theory() {
        let [b, l, f] = [0.2, 1.0, 3e3];
        let root = Section::chamfered(DVec3::ZERO, DVec3::X, [b, b], 0.0);
        let bent = root.stress(DVec3::X * l, DVec3::Z * f).unwrap();
        // A force F at the distance l causes the stress 6 F l / b^3 in bending, or F / b^2 in tension along the axis.
        // 1e-12 allows for rounding errors.
        assert!((bent / (6.0 * f * l / b.powi(3)) - 1.0).abs() < 1e-12);
        let pulled = root.stress(DVec3::X * l, DVec3::X * f).unwrap();
        assert!((pulled / (f / (b * b)) - 1.0).abs() < 1e-12);
        assert_eq!(root.stress(DVec3::NEG_X, DVec3::Z), None);
        // A point outside the reach, for example on an adjacent bar.
        assert_eq!(root.with_reach(b).stress(DVec3::new(l, 2.0 * b, 0.0), DVec3::Z), None);
    }

    #[test]
    fn fully_chamfered_square_equals_a_square_rotated_by_45_degrees() {
        let b = 0.2;
        let cut = Section::chamfered(DVec3::ZERO, DVec3::X, [b, b], 0.5 * b);
        // The rotated square has the side b / sqrt 2. The second moment of a square is side^4 / 12 about any axis.
        let side = b / 2f64.sqrt();
        assert!((cut.area / (side * side) - 1.0).abs() < 1e-12);
        assert!((cut.modulus / (side.powi(4) / 12.0 / (0.5 * b)) - 1.0).abs() < 1e-12);
    }
}
