//! Validates the shape of the armour units and provides the proportions that their placement needs.

use std::sync::Arc;

use glam::DVec3;

use super::check::{Checker, above, from, show};
use super::file::{Shape, UnitsFile};
use super::stl_unit::{self, StlUnit};
use crate::geometry::armour_unit::{ArmourUnit, ArmourUnitError};

/// Longest over shortest edge of a cuboid, at most [-]: the contact rounding, a share of the height, must fit all
/// edges.
const MOST_SLENDER: f64 = 5.0;

/// Kind and dimensions of a unit; SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum UnitKind {
    /// Tetrapod of height H standing on three legs [m].
    Tetrapod { height: f64 },
    /// Cuboid with its edges along x, y and z [m].
    Cuboid { edges: [f64; 3] },
    /// Dolos of height H [m] with its waist ratio [-].
    Dolos { height: f64, waist: f64 },
    /// Core-Loc of size C [m].
    CoreLoc { size: f64 },
    /// Grooved cube (Antifer block) of a height [m].
    GroovedCube { height: f64 },
    /// A unit from STL files.
    Stl(StlUnit),
}

impl UnitKind {
    /// Builds the unit with edges rounded by a share of its height [-].
    ///
    /// # Errors
    /// If lengths, waist or rounding do not make a unit.
    pub fn build(&self, rounding_share: f64) -> Result<ArmourUnit, ArmourUnitError> {
        match self {
            Self::Tetrapod { height } => ArmourUnit::tetrapod(*height, rounding_share),
            Self::Cuboid { edges } => ArmourUnit::cuboid(DVec3::from_array(*edges), rounding_share),
            Self::Dolos { height, waist } => ArmourUnit::dolos(*height, *waist, rounding_share),
            Self::CoreLoc { size } => ArmourUnit::core_loc(*size, rounding_share),
            Self::GroovedCube { height } => ArmourUnit::grooved_cube(*height, rounding_share),
            Self::Stl(unit) => ArmourUnit::of_parts(unit.solid(), unit.parts(), rounding_share),
        }
    }

    /// Returns the common name of the unit.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Tetrapod { .. } => "Tetrapod",
            Self::Cuboid { .. } => "cuboid",
            Self::Dolos { .. } => "Dolos",
            Self::CoreLoc { .. } => "Core-Loc",
            Self::GroovedCube { .. } => "grooved cube",
            Self::Stl(_) => "unit from STL",
        }
    }

    /// Returns the stability coefficient K_D of Hudson's formula [-] for two layers, random placement, trunk, breaking
    /// waves: Shore Protection Manual (1984), table 7-8; Core-Loc: Melby & Turk (1997). `None` without a handbook
    /// value.
    pub fn stability_coefficient(&self) -> Option<f64> {
        match self {
            Self::Tetrapod { .. } => Some(7.0),
            Self::Dolos { .. } => Some(15.8),
            Self::CoreLoc { .. } => Some(16.0),
            // Listed as "modified cube".
            Self::Cuboid { .. } | Self::GroovedCube { .. } => Some(6.5),
            Self::Stl(_) => None,
        }
    }
}

/// Shape of a unit: its kind, surface and convex parts.
#[derive(Debug, Clone)]
pub struct UnitShape {
    /// Kind and dimensions.
    pub kind: UnitKind,
    unit: Arc<ArmourUnit>,
}

impl PartialEq for UnitShape {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind && self.unit.rounding() == other.unit.rounding()
    }
}

impl UnitShape {
    /// Returns surface, convex parts and mass properties.
    pub fn unit(&self) -> &Arc<ArmourUnit> {
        &self.unit
    }

    /// Returns the height of the standing unit [m].
    pub fn height(&self) -> f64 {
        self.unit.height()
    }

    /// Returns the volume [m3].
    pub fn volume(&self) -> f64 {
        self.unit.solid().volume_properties().volume
    }

    /// Returns the nominal diameter D_n = V^(1/3) [m].
    pub fn nominal_diameter(&self) -> f64 {
        self.volume().cbrt()
    }

    /// Returns the reach from the centre along and across the flume [m], for a unit standing at azimuth 0 or pi.
    pub(super) fn reach(&self) -> [f64; 2] {
        let q = self.unit.standing_rotation(0.0);
        let reach = |axis: usize| self.unit.solid().vertices().iter().map(|v| (q * *v)[axis].abs()).fold(0.0, f64::max);
        [reach(0), reach(1)]
    }

    /// Returns the height of the centre above the foot of the standing unit [m].
    pub(super) fn centre_height(&self) -> f64 {
        self.unit.standing_height_sharp()
    }

    /// Returns the smallest distance between the centres of two units side by side [m].
    pub(super) fn least_pitch(&self) -> f64 {
        match &self.kind {
            // Units turned by half a circle fit between each other's legs.
            UnitKind::Tetrapod { height } => 0.75 * height,
            // Rounding of the numbers in the file.
            UnitKind::Cuboid { edges } => edges[1] * (1.0 - 1e-9),
            _ => 2.0 * self.reach()[1],
        }
    }

    /// Returns whether two standing units at this offset from each other overlap; cuboids may touch.
    pub(super) fn overlaps(&self, offset: [f64; 3]) -> bool {
        match &self.kind {
            UnitKind::Cuboid { edges } => {
                offset.iter().zip(edges).all(|(distance, edge)| distance.abs() < edge * (1.0 - 1e-6))
            }
            _ => offset.iter().map(|d| d * d).sum::<f64>() < self.least_pitch().powi(2),
        }
    }
}

/// Validates the dimensions of the shape and builds it; `name` is the case file.
pub(super) fn validate(file: &UnitsFile, rounding_share: f64, name: &str, check: &mut Checker) -> Option<UnitShape> {
    let before = check.count();
    refuse_keys_of_other_shapes(file, check);
    let kind = match file.shape {
        Shape::Tetrapod => height(file, check).map(|height| UnitKind::Tetrapod { height }),
        Shape::Dolos => {
            let height = height(file, check);
            let waist = file.waist_ratio.unwrap_or(0.34);
            height.map(|height| UnitKind::Dolos { height, waist })
        }
        Shape::CoreLoc => height(file, check).map(|size| UnitKind::CoreLoc { size }),
        Shape::GroovedCube => height(file, check).map(|height| UnitKind::GroovedCube { height }),
        Shape::Cuboid => match file.size_m {
            Some(edges) => validate_cuboid(edges, check),
            None => {
                let advice = "write the edges along x, y, z";
                check.refuse("units.size_m", "(missing)", "the three edges of a cuboid", advice);
                None
            }
        },
        Shape::Stl => match &file.stl {
            Some(stl) => stl_unit::validate(stl, rounding_share, name, check).map(UnitKind::Stl),
            None => {
                check.refuse("units.stl", "(missing)", "the STL files of the unit", "write \"stl\": { \"path\": ... }");
                None
            }
        },
    }?;
    if check.count() > before {
        return None;
    }
    match kind.build(rounding_share) {
        Ok(unit) => Some(UnitShape { kind, unit: Arc::new(unit) }),
        Err(error @ ArmourUnitError::Waist { waist, allowed: [low, high] }) => {
            let range = format!("between {low} and {high}");
            check.refuse("units.waist_ratio", show(waist), range, error.to_string());
            None
        }
        Err(ArmourUnitError::Rounding { share, largest }) => {
            let advice = "a larger rounding removes parts of the unit";
            let allowed = format!("at most {largest:.4} for this unit");
            check.refuse("contact.rounding_share", show(share), allowed, advice);
            None
        }
        Err(error) => {
            check.refuse("units.shape", format!("{:?}", file.shape.key()), error.to_string(), "change its lengths");
            None
        }
    }
}

/// Refuses keys that belong to other shapes.
fn refuse_keys_of_other_shapes(file: &UnitsFile, check: &mut Checker) {
    let shape = file.shape;
    let mut refuse = |key: &str, written: Option<String>, advice: &str| {
        if let Some(value) = written {
            check.refuse(&format!("units.{key}"), value, format!("left out with \"{}\"", shape.key()), advice);
        }
    };
    let by_size = shape == Shape::Cuboid;
    let by_height = !by_size && shape != Shape::Stl;
    let advice = if by_size { "the third edge of `size_m` is the height" } else { "the STL file gives the dimensions" };
    refuse("height_m", file.height_m.filter(|_| !by_height).map(show), advice);
    refuse("size_m", file.size_m.filter(|_| !by_size).map(|_| "[...]".to_owned()), "`size_m` belongs to a cuboid");
    refuse("waist_ratio", file.waist_ratio.filter(|_| shape != Shape::Dolos).map(show), "only a Dolos has a waist");
    let stl = file.stl.as_ref().filter(|_| shape != Shape::Stl).map(|_| "{ ... }".to_owned());
    refuse("stl", stl, "write \"shape\": \"stl\" to use the files");
}

fn height(file: &UnitsFile, check: &mut Checker) -> Option<f64> {
    let advice = "write the unit's height in metres";
    let Some(height) = file.height_m else {
        check.refuse("units.height_m", "(missing)", format!("the height of a {}", file.shape.key()), advice);
        return None;
    };
    check_length("units.height_m", height, advice, check).then_some(height)
}

fn validate_cuboid(edges: [f64; 3], check: &mut Checker) -> Option<UnitKind> {
    let before = check.count();
    for (axis, edge) in edges.into_iter().enumerate() {
        check_length(&format!("units.size_m[{axis}]"), edge, "write the edge in metres", check);
    }
    let (shortest, longest) = edges.iter().fold((f64::MAX, 0.0_f64), |(a, b), e| (a.min(*e), b.max(*e)));
    if check.count() == before && longest > MOST_SLENDER * shortest {
        check.refuse(
            "units.size_m",
            format!("{} to {} m", show(shortest), show(longest)),
            format!("edges that differ by a factor of {MOST_SLENDER} at most"),
            "the rounding of the edges does not fit a more slender block",
        );
    }
    (check.count() == before).then_some(UnitKind::Cuboid { edges })
}

fn check_length(path: &str, value: f64, advice: &str, check: &mut Checker) -> bool {
    check.number(path, value, from(0.005).up_to(20.0), "m", advice)
}

/// Validates the mass of a unit against its volume. `rho0` is the water density; `None` without water.
pub(super) fn validate_mass(mass: f64, shape: &UnitShape, rho0: Option<f64>, check: &mut Checker) {
    let volume = shape.volume();
    let range = above(100.0 * volume).up_to(20_000.0 * volume);
    let advice = format!("a unit of this size has {volume:.3e} m3; concrete has 2300 to 2400 kg/m3");
    let sound = check.number("units.mass_kg", mass, range, "kg", &advice);
    if sound && rho0.is_some_and(|rho0| mass < rho0 * volume) {
        check.warn(format!("units.mass_kg = {}: lighter than water, the units will float", show(mass)));
    }
}
