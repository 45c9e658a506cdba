//! Catalogue of armour units: closed surface, convex parts for contact, mass properties, standing pose.
//!
//! Body axes have their origin at the centre of mass. A new shape is one constructor here and one file with its
//! surface and parts.

use glam::{DMat3, DQuat, DVec3};
use thiserror::Error;

use super::axis_box::AxisBox;
use super::convex_part::ConvexPart;
use super::cuboid;
use super::solid::{Solid, SolidError};
use super::tetrapod;

/// Why a unit cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ArmourUnitError {
    /// A length is not a positive number.
    #[error("height and edges of a unit must be positive, not {0} m")]
    Length(f64),
    /// The rounding does not fit the shape.
    #[error("rounding by {share} of the height does not fit the unit: it must lie between 0 and {largest}")]
    Rounding { share: f64, largest: f64 },
    /// The surface is not closed.
    #[error(transparent)]
    Surface(#[from] SolidError),
}

/// Shape of an armour unit.
#[derive(Debug, Clone)]
pub struct ArmourUnit {
    height: f64,
    rounding: f64,
    solid: Solid,
    parts: Vec<ConvexPart>,
    /// Edges, if it is a cuboid [m].
    edges: Option<DVec3>,
}

impl ArmourUnit {
    /// Tetrapod of height `height_m` [m] whose contact surface is rounded by `rounding_share` of the height [-].
    pub fn tetrapod(height_m: f64, rounding_share: f64) -> Result<Self, ArmourUnitError> {
        if !(height_m > 0.0 && height_m.is_finite()) {
            return Err(ArmourUnitError::Length(height_m));
        }
        let largest = tetrapod::LARGEST_ROUNDING;
        if !(rounding_share > 0.0 && rounding_share <= largest) {
            return Err(ArmourUnitError::Rounding { share: rounding_share, largest });
        }
        let (vertices, triangles) = tetrapod::surface(height_m);
        let rounding = rounding_share * height_m;
        Ok(Self {
            height: height_m,
            rounding,
            solid: Solid::new(vertices, triangles)?,
            parts: tetrapod::parts(height_m, rounding),
            edges: None,
        })
    }

    /// Cuboid with the edges `edges_m` [m] along its axes, the last one being its height; its contact surface is
    /// rounded by `rounding_share` of the height [-].
    pub fn cuboid(edges_m: DVec3, rounding_share: f64) -> Result<Self, ArmourUnitError> {
        if let Some(bad) = edges_m.to_array().into_iter().find(|edge| !(*edge > 0.0 && edge.is_finite())) {
            return Err(ArmourUnitError::Length(bad));
        }
        let height = edges_m.z;
        let largest = cuboid::LARGEST_ROUNDING * edges_m.min_element() / height;
        if !(rounding_share > 0.0 && rounding_share <= largest) {
            return Err(ArmourUnitError::Rounding { share: rounding_share, largest });
        }
        let (vertices, triangles) = cuboid::surface(edges_m);
        let rounding = rounding_share * height;
        Ok(Self {
            height,
            rounding,
            solid: Solid::new(vertices, triangles)?,
            parts: vec![cuboid::part(edges_m, rounding)],
            edges: Some(edges_m),
        })
    }

    /// The unit as a box about its centre of mass, if it is one.
    pub fn as_box(&self) -> Option<AxisBox> {
        self.edges.map(|edges| AxisBox::free(-0.5 * edges, 0.5 * edges))
    }

    /// Height standing [m].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Rounding radius of the contact surface, also the radius in Hertz's law [m].
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// Closed surface in body axes.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Convex parts in body axes.
    pub fn parts(&self) -> &[ConvexPart] {
        &self.parts
    }

    /// Inertia tensor in body axes for the mass `mass_kg` spread evenly over the volume [kg m2].
    pub fn inertia(&self, mass_kg: f64) -> DMat3 {
        let properties = self.solid.volume_properties();
        properties.inertia * (mass_kg / properties.volume)
    }

    /// Rotation in which the unit stands: a Tetrapod on three legs with the fourth one up, a cuboid on a face. At
    /// azimuth 0 one of the lower legs points seaward (-x); the azimuth [rad] turns the unit counter-clockwise seen
    /// from above, so pi points it shoreward.
    pub fn standing_rotation(&self, azimuth: f64) -> DQuat {
        DQuat::from_rotation_z(azimuth)
    }

    /// Height of the centre of mass above a level plane on which the standing unit just rests with its rounded contact
    /// surface [m].
    pub fn standing_height(&self) -> f64 {
        let lowest = self.parts.iter().map(|p| p.support(DVec3::NEG_Z).z - p.rounding());
        -lowest.fold(f64::MAX, f64::min)
    }

    /// Height of the centre of mass above a level plane that the sharp-edged surface touches [m].
    pub fn standing_height_sharp(&self) -> f64 {
        -self.solid.bounds()[0].z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> ArmourUnit {
        ArmourUnit::tetrapod(1.0, 0.05).unwrap()
    }

    #[test]
    fn tetrapod_has_the_volume_and_inertia_of_its_dimensions() {
        let properties = unit().solid.volume_properties();
        // 0.5 %: the polygon of 72 sides takes 0.13 % from each leg's section.
        assert!((properties.volume / 0.2799 - 1.0).abs() < 0.005, "volume {}", properties.volume);
        assert!(properties.centre.length() < 1e-9, "centre {}", properties.centre);
        let inertia = unit().inertia(1.0);
        for axis in 0..3 {
            assert!((inertia.col(axis)[axis] / 0.0996 - 1.0).abs() < 0.005, "inertia {inertia}");
        }
        // Tetrahedral symmetry makes the tensor a multiple of the identity, to rounding.
        assert!((inertia - DMat3::IDENTITY * inertia.x_axis.x).abs_diff_eq(DMat3::ZERO, 1e-9));
    }

    #[test]
    fn tetrapod_stands_h_high_and_one_leg_points_seaward() {
        let unit = unit();
        let [low, high] = unit.solid.bounds();
        // The dimensions are given to three digits.
        assert!((high.z - low.z - 1.0).abs() < 0.003, "height {}", high.z - low.z);
        assert!(low.x < -0.6 && high.x < 0.6);
        // Rounding the rim lowers the standing centre by a little, never raises it.
        assert!(unit.standing_height() < unit.standing_height_sharp());
        assert!(unit.standing_height_sharp() - unit.standing_height() < 0.01);
    }

    #[test]
    fn rounded_parts_fill_the_surface_but_do_not_leave_it() {
        let unit = unit();
        let to_parts = |p: DVec3| unit.parts.iter().map(|part| part.distance(p)).fold(f64::MAX, f64::min);
        let rim = unit.solid.vertices().iter().map(|v| to_parts(*v)).fold(0.0, f64::max);
        // Only the sharp rim sticks out of the parts: less than R (sqrt 2 - 1) = 0.0207 at a right angle, more here.
        assert!(rim < 0.025, "{rim}");
        for v in unit.solid.vertices() {
            // The mesh is inscribed in the true cones: its points never lie inside the parts, up to rounding.
            assert!(to_parts(*v) > -1e-9);
        }
        for (leg, part) in unit.parts.iter().enumerate() {
            let axis = tetrapod::leg_axes()[leg];
            let side = axis.any_orthonormal_vector();
            for k in 0..40 {
                let angle = 0.1 * k as f64;
                let n = (axis * angle.cos() + side * angle.sin()).normalize();
                let p = part.support(n) + n * part.rounding();
                // 4e-4: the mesh lies up to 0.26 (1 - cos(pi/72)) = 2.5e-4 inside the true cone.
                assert!(unit.solid.signed_distance(p) < 4e-4, "leg {leg} angle {angle}");
            }
        }
    }

    #[test]
    fn mesh_distance_agrees_with_the_cones_outside() {
        let unit = unit();
        let sharp = tetrapod::parts(1.0, 1e-9);
        for i in 0..500 {
            let (a, b) = (0.7 * i as f64, 0.37 * i as f64);
            let p = DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), b.cos()) * (0.7 + 0.001 * i as f64);
            let exact = sharp.iter().map(|part| part.distance(p)).fold(f64::MAX, f64::min);
            // 3e-4 H: depth of the chord below the circle at 72 points round a leg.
            assert!((unit.solid.signed_distance(p) - exact).abs() < 3e-4);
        }
    }

    #[test]
    fn cuboid_has_the_volume_and_inertia_of_its_edges() {
        let edges = DVec3::new(0.1, 0.2, 0.3);
        let unit = ArmourUnit::cuboid(edges, 0.05).unwrap();
        let properties = unit.solid.volume_properties();
        assert!((properties.volume - 0.006).abs() < 1e-15 && properties.centre.length() < 1e-15);
        // m (b^2 + c^2) / 12 about each axis; 1e-12 is rounding.
        let mass = 12.0;
        let expected = DMat3::from_diagonal(DVec3::new(0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04));
        assert!(unit.inertia(mass).abs_diff_eq(expected, 1e-12), "{}", unit.inertia(mass));
        assert_eq!(unit.height(), 0.3);
    }

    #[test]
    fn cuboid_is_as_large_in_contact_as_its_surface_but_for_its_edges() {
        let unit = ArmourUnit::cuboid(DVec3::new(0.1, 0.2, 0.3), 0.05).unwrap();
        let [part] = unit.parts() else { panic!("one part") };
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let face = axis * unit.solid.bounds()[1];
            assert!(part.distance(face).abs() < 1e-15);
        }
        // A corner is cut by R (sqrt 3 - 1).
        assert!((part.distance(unit.solid.bounds()[1]) - 0.015 * (3f64.sqrt() - 1.0)).abs() < 1e-12);
        assert!((unit.standing_height() - 0.15).abs() < 1e-15);
    }

    #[test]
    fn impossible_units_are_refused() {
        assert!(ArmourUnit::cuboid(DVec3::new(1.0, 0.0, 1.0), 0.05).is_err());
        assert!(ArmourUnit::cuboid(DVec3::new(0.1, 1.0, 1.0), 0.05).unwrap_err().to_string().contains("0.045"));
        assert!(ArmourUnit::tetrapod(-1.0, 0.05).is_err());
        assert!(ArmourUnit::tetrapod(f64::NAN, 0.05).is_err());
        assert!(ArmourUnit::tetrapod(1.0, 0.2).unwrap_err().to_string().contains("0.07"));
    }
}
