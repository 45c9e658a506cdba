//! Shape of the armour units, validated, and the proportions that the placement needs.

use super::check::{Checker, above, from, show};
use super::file::{Shape, UnitsFile};

/// Longest edge of a cuboid over its shortest: the contact's rounding, a share of the height, must fit all edges.
const MOST_SLENDER: f64 = 5.0;

/// Shape of a unit; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnitShape {
    /// Tetrapod.
    Tetrapod {
        /// Height H standing on three legs [m].
        height: f64,
    },
    /// Cuboid.
    Cuboid {
        /// Edges along x, y and z [m].
        edges: [f64; 3],
    },
}

impl UnitShape {
    /// Height standing [m].
    pub fn height(&self) -> f64 {
        match self {
            Self::Tetrapod { height } => *height,
            Self::Cuboid { edges } => edges[2],
        }
    }

    /// Volume [m3].
    pub fn volume(&self) -> f64 {
        match self {
            Self::Tetrapod { height } => 0.2799 * height.powi(3),
            Self::Cuboid { edges } => edges.iter().product(),
        }
    }

    /// Reach from the centre along the flume and across it, standing at azimuth 0 or pi [m].
    ///
    /// Tetrapod: legs of 0.644 H from centre to tip, tip radius 0.151 H, on tetrahedral axes. A lying leg (19.5 degrees
    /// below the horizontal) then reaches 0.644 cos 19.5 + 0.151 sin 19.5 along itself, and 0.613 across the flume.
    pub(super) fn reach(&self) -> [f64; 2] {
        match self {
            Self::Tetrapod { height } => [0.658 * height, 0.613 * height],
            Self::Cuboid { edges } => [0.5 * edges[0], 0.5 * edges[1]],
        }
    }

    /// Height of the centre over the foot, standing [m].
    pub(super) fn centre_height(&self) -> f64 {
        match self {
            // The upper leg ends 0.644 H above the centre.
            Self::Tetrapod { height } => 0.356 * height,
            Self::Cuboid { edges } => 0.5 * edges[2],
        }
    }

    /// Least distance between the centres of two units side by side [m].
    pub(super) fn least_pitch(&self) -> f64 {
        match self {
            Self::Tetrapod { height } => 0.75 * height,
            // Rounding of the numbers in the file only.
            Self::Cuboid { edges } => edges[1] * (1.0 - 1e-9),
        }
    }

    /// Whether two standing units at this distance from each other overlap; cuboids may touch.
    pub(super) fn overlaps(&self, apart: [f64; 3]) -> bool {
        match self {
            Self::Tetrapod { .. } => apart.iter().map(|d| d * d).sum::<f64>() < self.least_pitch().powi(2),
            Self::Cuboid { edges } => {
                apart.iter().zip(edges).all(|(distance, edge)| distance.abs() < edge * (1.0 - 1e-6))
            }
        }
    }
}

/// Validate the lengths that belong to the shape.
pub(super) fn validate(file: &UnitsFile, check: &mut Checker) -> Option<UnitShape> {
    match (file.shape, file.height_m, file.size_m) {
        (Shape::Tetrapod, Some(height), None) => {
            let sound = length("units.height_m", height, "write the unit's height in metres", check);
            sound.then_some(UnitShape::Tetrapod { height })
        }
        (Shape::Tetrapod, None, _) => {
            check.refuse(
                "units.height_m",
                "(missing)",
                "the height of a tetrapod",
                "write the unit's height in metres",
            );
            None
        }
        (Shape::Tetrapod, Some(_), Some(_)) => {
            check.refuse("units.size_m", "[...]", "left out with \"tetrapod\"", "write `height_m` only");
            None
        }
        (Shape::Cuboid, None, Some(edges)) => validate_cuboid(edges, check),
        (Shape::Cuboid, _, None) => {
            check.refuse("units.size_m", "(missing)", "the three edges of a cuboid", "write the edges along x, y, z");
            None
        }
        (Shape::Cuboid, Some(height), Some(_)) => {
            check.refuse(
                "units.height_m",
                show(height),
                "left out with \"cuboid\"",
                "the third edge of `size_m` is the height",
            );
            None
        }
    }
}

fn validate_cuboid(edges: [f64; 3], check: &mut Checker) -> Option<UnitShape> {
    let before = check.count();
    for (axis, edge) in edges.into_iter().enumerate() {
        length(&format!("units.size_m[{axis}]"), edge, "write the edge in metres", check);
    }
    let (shortest, longest) = edges.iter().fold((f64::MAX, 0.0_f64), |(a, b), e| (a.min(*e), b.max(*e)));
    if check.count() == before && longest > MOST_SLENDER * shortest {
        check.refuse(
            "units.size_m",
            format!("{} to {} m", show(shortest), show(longest)),
            format!("edges that differ by a factor of {MOST_SLENDER} at most"),
            "the rounding of the edges would not fit a slenderer block",
        );
    }
    (check.count() == before).then_some(UnitShape::Cuboid { edges })
}

fn length(path: &str, value: f64, advice: &str, check: &mut Checker) -> bool {
    check.number(path, value, from(0.005).up_to(20.0), "m", advice)
}

/// Validate the mass of a unit against its volume.
pub(super) fn validate_mass(mass: f64, shape: &UnitShape, rho0: f64, check: &mut Checker) {
    let volume = shape.volume();
    let range = above(100.0 * volume).up_to(20_000.0 * volume);
    let advice = format!("a unit of this size has {volume:.3e} m3; concrete has 2300 to 2400 kg/m3");
    let sound = check.number("units.mass_kg", mass, range, "kg", &advice);
    if sound && mass < rho0 * volume {
        check.warn(format!("units.mass_kg = {}: lighter than water, the units will float", show(mass)));
    }
}
