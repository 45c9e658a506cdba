//! Validates the shape of the armour units and computes the dimensions that are needed to place them.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;

use super::rock;
use super::stl::{self, StlUnit};
use crate::case::file::{Shape, UnitsFile};
use crate::case::reading::check::{Checker, as_text, at_least, more_than};
use crate::geometry::armour_unit::{ArmourUnit, ArmourUnitError};

/// Smallest and largest allowed length of a unit [m].
const SMALLEST: f64 = 0.005;
const LARGEST: f64 = 20.0;
/// Largest allowed ratio of the longest to the shortest edge of a cuboid [-]. The rounding radius of the edges is
/// proportional to the height, and must be small compared with the shortest edge.
const LARGEST_EDGE_RATIO: f64 = 5.0;

/// Kind and dimensions of a unit; SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum UnitKind {
    /// Tetrapod of height H when it stands on three legs [m].
    Tetrapod { height: f64 },
    /// Cuboid with its edges along x, y and z [m].
    Cuboid { edges: [f64; 3] },
    /// Dolos of height H [m] with its waist ratio [-].
    Dolos { height: f64, waist: f64 },
    /// Core-Loc of size C [m].
    CoreLoc { size: f64 },
    /// Grooved cube (Antifer block) with its height [m].
    GroovedCube { height: f64 },
    /// A rock of the nominal diameter D_n [m]; the seed gives its shape.
    Rock { nominal_diameter: f64, seed: u64 },
    /// A unit from STL files.
    Stl(StlUnit),
}

impl UnitKind {
    /// Builds the unit. `rounding_share` is the rounding radius of its edges, divided by its height [-].
    ///
    /// # Errors
    /// If lengths, waist ratio or rounding are outside the range in which the unit can be built.
    pub fn build(&self, rounding_share: f64) -> Result<ArmourUnit, ArmourUnitError> {
        match self {
            Self::Tetrapod { height } => ArmourUnit::tetrapod(*height, rounding_share),
            Self::Cuboid { edges } => ArmourUnit::cuboid(DVec3::from_array(*edges), rounding_share),
            Self::Dolos { height, waist } => ArmourUnit::dolos(*height, *waist, rounding_share),
            Self::CoreLoc { size } => ArmourUnit::core_loc(*size, rounding_share),
            Self::GroovedCube { height } => ArmourUnit::grooved_cube(*height, rounding_share),
            Self::Rock { nominal_diameter, seed } => ArmourUnit::rock(*nominal_diameter, *seed, rounding_share),
            Self::Stl(unit) => ArmourUnit::from_parts(unit.solid(), unit.parts(), rounding_share),
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
            Self::Rock { .. } => "rock",
            Self::Stl(_) => "unit from STL",
        }
    }

    /// Returns the stability coefficient K_D of Hudson's formula [-] for two layers of randomly placed units on the
    /// trunk of a breakwater in breaking waves: Shore Protection Manual (1984), table 7-8; Core-Loc: Melby & Turk
    /// (1997). `None` if no handbook has a value.
    pub fn stability_coefficient(&self) -> Option<f64> {
        match self {
            Self::Tetrapod { .. } => Some(7.0),
            Self::Dolos { .. } => Some(15.8),
            Self::CoreLoc { .. } => Some(16.0),
            // The manual lists these shapes as "modified cube".
            Self::Cuboid { .. } | Self::GroovedCube { .. } => Some(6.5),
            Self::Rock { .. } | Self::Stl(_) => None,
        }
    }
}

/// Shape of a unit: its kind and dimensions, its surface and its convex parts.
#[derive(Debug, Clone)]
pub struct UnitShape {
    /// Kind and dimensions of the unit.
    pub kind: UnitKind,
    unit: Arc<ArmourUnit>,
}

impl PartialEq for UnitShape {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind && self.unit.rounding() == other.unit.rounding()
    }
}

/// Rounding share and shape of the unit that was built last. All runs of most sweeps have the same unit, and building a
/// unit takes most of the time in which a case is checked.
static LAST_BUILT: Mutex<Option<(f64, UnitShape)>> = Mutex::new(None);

impl UnitShape {
    /// Builds the unit, or returns the unit that was built last if it is the same.
    fn build(kind: UnitKind, rounding_share: f64) -> Result<Self, ArmourUnitError> {
        let mut last = LAST_BUILT.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((share, shape)) if *share == rounding_share && shape.kind == kind => Ok(shape.clone()),
            _ => {
                let unit = Arc::new(kind.build(rounding_share)?);
                let shape = Self { kind, unit };
                *last = Some((rounding_share, shape.clone()));
                Ok(shape)
            }
        }
    }

    /// Returns the unit with its surface, convex parts and mass properties.
    pub fn unit(&self) -> &Arc<ArmourUnit> {
        &self.unit
    }

    /// Returns the height of a standing unit [m].
    pub fn height(&self) -> f64 {
        self.unit.height()
    }

    /// Returns the volume of a unit [m3].
    pub fn volume(&self) -> f64 {
        self.unit.solid().volume_properties().volume
    }

    /// Returns the nominal diameter D_n = V^(1/3) [m].
    pub fn nominal_diameter(&self) -> f64 {
        self.volume().cbrt()
    }

    /// Returns the largest distance from the centre to the surface along x and along y [m], for a unit that stands at
    /// azimuth 0 or pi.
    pub(in crate::case) fn reach(&self) -> [f64; 2] {
        let q = self.unit.standing_rotation(0.0);
        let reach = |axis: usize| self.unit.solid().vertices().iter().map(|v| (q * *v)[axis].abs()).fold(0.0, f64::max);
        [reach(0), reach(1)]
    }

    /// Returns the height of the centre of a standing unit above the ground [m], for a unit with sharp edges.
    pub(in crate::case) fn centre_height(&self) -> f64 {
        self.unit.standing_height_sharp()
    }

    /// Returns the smallest distance between the centres of two neighbouring units in a row without overlap [m].
    pub(in crate::case) fn least_pitch(&self) -> f64 {
        match &self.kind {
            // If neighbours differ by 180 degrees, the legs of each unit fit between the legs of the other unit.
            UnitKind::Tetrapod { height } => 0.75 * height,
            // The factor allows for rounding of the numbers in the file.
            UnitKind::Cuboid { edges } => edges[1] * (1.0 - 1e-9),
            _ => 2.0 * self.reach()[1],
        }
    }

    /// Returns true if two standing units overlap when their centres differ by `offset` [m]. Cuboids may touch.
    pub(in crate::case) fn overlaps(&self, offset: [f64; 3]) -> bool {
        match &self.kind {
            UnitKind::Cuboid { edges } => {
                offset.iter().zip(edges).all(|(distance, edge)| distance.abs() < edge * (1.0 - 1e-6))
            }
            _ => offset.iter().map(|d| d * d).sum::<f64>() < self.least_pitch().powi(2),
        }
    }
}

/// Validates the dimensions of the units of a group and builds their shapes: several for rocks, otherwise one. `name`
/// is the path of the case file. The names of stored STL files begin with `stem`.
pub fn validate(
    file: &UnitsFile,
    rounding_share: f64,
    name: &str,
    stem: &str,
    check: &mut Checker,
) -> Option<Vec<UnitShape>> {
    let before = check.count();
    refuse_keys_of_other_shapes(file, check);
    let one = match file.shape {
        Shape::Rock => None,
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
                check.reject(".size_m", "(missing)", "the three edges of a cuboid", advice);
                None
            }
        },
        Shape::Stl => match &file.stl {
            Some(stl) => {
                let unit = stl::validate(stl, rounding_share, name, stem, check)?;
                check_stl_size(&unit, stl.scale, check).then_some(UnitKind::Stl(unit))
            }
            None => {
                check.reject(".stl", "(missing)", "the STL files of the unit", "write \"stl\": { \"path\": ... }");
                None
            }
        },
    };
    let kinds = if file.shape == Shape::Rock { rocks(file, check)? } else { vec![one?] };
    if check.count() > before {
        return None;
    }
    kinds.into_iter().map(|kind| build(kind, file, rounding_share, check)).collect()
}

fn rocks(file: &UnitsFile, check: &mut Checker) -> Option<Vec<UnitKind>> {
    let shapes = rock::shapes(file, check)?;
    let advice = "write the median nominal diameter in metres";
    check_length(".rock.d_n50_m", file.rock?.d_n50_m, advice, check);
    let kind = |(nominal_diameter, seed)| UnitKind::Rock { nominal_diameter, seed };
    Some(shapes.into_iter().map(kind).collect())
}

fn build(kind: UnitKind, file: &UnitsFile, rounding_share: f64, check: &mut Checker) -> Option<UnitShape> {
    match UnitShape::build(kind, rounding_share) {
        Ok(shape) => Some(shape),
        Err(error @ ArmourUnitError::Waist { waist, allowed: [low, high] }) => {
            let range = format!("between {low} and {high}");
            check.reject(".waist_ratio", as_text(waist), range, error.to_string());
            None
        }
        Err(ArmourUnitError::Rounding { share, largest }) => {
            let advice = "a larger rounding removes parts of the unit";
            let allowed = format!("at most {largest:.4} for this unit");
            check.reject("contact.rounding_share", as_text(share), allowed, advice);
            None
        }
        Err(error) => {
            check.reject(".shape", format!("{:?}", file.shape.key()), error.to_string(), "change the lengths");
            None
        }
    }
}

/// Refuses keys that belong to other shapes.
fn refuse_keys_of_other_shapes(file: &UnitsFile, check: &mut Checker) {
    let shape = file.shape;
    let mut refuse = |key: &str, written: Option<String>, advice: &str| {
        if let Some(value) = written {
            check.reject(&format!(".{key}"), value, format!("left out with \"{}\"", shape.key()), advice);
        }
    };
    let by_size = shape == Shape::Cuboid;
    let by_height = !by_size && !matches!(shape, Shape::Stl | Shape::Rock);
    let advice = match shape {
        Shape::Cuboid => "the third edge of `size_m` is the height",
        Shape::Rock => "`rock.d_n50_m` is the size",
        _ => "the STL file gives the dimensions",
    };
    refuse("height_m", file.height_m.filter(|_| !by_height).map(as_text), advice);
    refuse("size_m", file.size_m.filter(|_| !by_size).map(|_| "[...]".to_owned()), "`size_m` belongs to a cuboid");
    refuse("waist_ratio", file.waist_ratio.filter(|_| shape != Shape::Dolos).map(as_text), "only a Dolos has a waist");
    let rock = file.rock.filter(|_| shape != Shape::Rock).map(|_| "{ ... }".to_owned());
    refuse("rock", rock, "write \"shape\": \"rock\" for rocks");
    let stl = file.stl.as_ref().filter(|_| shape != Shape::Stl).map(|_| "{ ... }".to_owned());
    refuse("stl", stl, "write \"shape\": \"stl\" to use the files");
}

fn height(file: &UnitsFile, check: &mut Checker) -> Option<f64> {
    let advice = "write the unit's height in metres";
    let Some(height) = file.height_m else {
        check.reject(".height_m", "(missing)", format!("the height of a {}", file.shape.key()), advice);
        return None;
    };
    check_length(".height_m", height, advice, check).then_some(height)
}

fn validate_cuboid(edges: [f64; 3], check: &mut Checker) -> Option<UnitKind> {
    let before = check.count();
    for (axis, edge) in edges.into_iter().enumerate() {
        check_length(&format!(".size_m[{axis}]"), edge, "write the edge in metres", check);
    }
    let (shortest, longest) = edges.iter().fold((f64::MAX, 0.0_f64), |(a, b), e| (a.min(*e), b.max(*e)));
    if check.count() == before && longest > LARGEST_EDGE_RATIO * shortest {
        check.reject(
            ".size_m",
            format!("{} to {} m", as_text(shortest), as_text(longest)),
            format!("edges that differ by a factor of {LARGEST_EDGE_RATIO} at most"),
            "the rounding of the edges does not fit more slender blocks",
        );
    }
    (check.count() == before).then_some(UnitKind::Cuboid { edges })
}

/// Checks the size of a unit from an STL file: a wrong size probably means a wrong unit of length.
fn check_stl_size(unit: &StlUnit, scale: f64, check: &mut Checker) -> bool {
    let [low, high] = unit.solid().bounds();
    let size = (high - low).max_element();
    let fits = (SMALLEST..=LARGEST).contains(&size);
    if !fits {
        check.reject(
            ".stl.path",
            format!("a unit of {} m with `stl.scale` = {}", as_text(size), as_text(scale)),
            format!("a unit of {SMALLEST} to {LARGEST} m"),
            "write `scale` 0.001 for a file in millimetres, 1 for a file in metres",
        );
    }
    fits
}

fn check_length(path: &str, value: f64, advice: &str, check: &mut Checker) -> bool {
    check.number(path, value, at_least(SMALLEST).up_to(LARGEST), "m", advice)
}

/// Validates the mass of a unit [kg] of the given volume [m3]: its density must be between 100 and 20,000 kg/m3. `rho0`
/// is the water density [kg/m3]; `None` without water.
pub fn validate_mass(mass: f64, volume: f64, rho0: Option<f64>, check: &mut Checker) {
    let range = more_than(100.0 * volume).up_to(20_000.0 * volume);
    let advice = format!("a unit of this size has a volume of {volume:.3e} m3; concrete has 2300 to 2400 kg/m3");
    let sound = check.number(".mass_kg", mass, range, "kg", &advice);
    if sound && rho0.is_some_and(|rho0| mass < rho0 * volume) {
        check.warn(format!(
            ".mass_kg = {}: the units are lighter than water; they float where it is deep enough",
            as_text(mass)
        ));
    }
}
