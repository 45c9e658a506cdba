//! The row of armour units, validated.

use std::f64::consts::PI;

use super::check::{Checker, above, from, show};
use super::domain::Domain;
use super::file::{Orientation, Shape, Sides, UnitsFile};
use super::flume::Flume;
use super::materials::{self, FrictionPair, Material};

/// Units in one row at most.
const MOST_UNITS: u32 = 10_000;

/// The armour units; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Shape of a unit.
    pub shape: Shape,
    /// Height H of a unit standing on three legs [m].
    pub height: f64,
    /// Mass of a unit [kg].
    pub mass: f64,
    /// Distance between the units' axes [m].
    pub pitch: f64,
    /// Where each unit stands, from y = 0 upwards.
    pub placements: Vec<Placement>,
    /// A unit is damaged when it has moved further than this [m].
    pub damage_distance: f64,
    /// Material of the units, an index into `Case::materials`.
    pub material: usize,
    /// Material of bed and mound, an index into `Case::materials`.
    pub ground_material: usize,
    /// Friction of unit on unit [-].
    pub friction_unit: f64,
    /// Friction of unit on bed or mound [-].
    pub friction_ground: f64,
}

/// Where a unit stands: on the ground, its axis vertical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Place of the axis along the flume [m].
    pub x: f64,
    /// Place of the axis across the flume [m].
    pub y: f64,
    /// Turn about the vertical [rad]: 0 has a leg seaward, pi a leg shoreward.
    pub azimuth: f64,
}

/// Proportions of a shape that the validation needs, as shares of its height.
struct Proportions {
    /// Volume / H^3.
    volume: f64,
    /// Reach from the axis along the flume, on the side of the leg.
    reach_x: f64,
    /// Reach from the axis across the flume, at azimuth 0 or pi.
    reach_y: f64,
}

/// Tetrapod: legs of 0.644 H from centre to tip, tip radius 0.151 H, on tetrahedral axes. A lying leg (19.5 degrees
/// below the horizontal) then reaches 0.644 cos 19.5 + 0.151 sin 19.5 along itself, and 0.613 across the flume.
fn proportions(shape: Shape) -> Proportions {
    match shape {
        Shape::Tetrapod => Proportions { volume: 0.2799, reach_x: 0.658, reach_y: 0.613 },
    }
}

/// Volume of a unit of the given height [m3].
pub(super) fn volume(shape: Shape, height: f64) -> f64 {
    proportions(shape).volume * height.powi(3)
}

/// What the units need to know of the rest of the case.
pub(super) struct Surroundings<'a> {
    pub flume: Option<&'a Flume>,
    pub domain: Option<&'a Domain>,
    pub materials: &'a [Material],
    pub friction: &'a [FrictionPair],
    pub ground_material: Option<usize>,
    /// `flume.material` is written in the file (perhaps wrongly).
    pub ground_named: bool,
    pub rho0: f64,
}

/// Validate the row.
pub(super) fn validate(file: &UnitsFile, around: &Surroundings, check: &mut Checker) -> Option<Units> {
    let before = check.count();
    validate_numbers(file, around.rho0, check);
    let row_sound = check.count() == before;
    let material = materials::find(around.materials, &file.material, "units.material", check);
    if !around.ground_named {
        check.refuse(
            "flume.material",
            "(missing)",
            "one of `materials` when there are units",
            "write the material of bed and mound",
        );
    }
    let friction = validate_friction(material, around, check);
    let placements = if row_sound { place_row(file, around.flume?, around.domain?, check) } else { Vec::new() };
    if check.count() > before {
        return None;
    }
    let (friction_unit, friction_ground) = friction?;
    Some(Units {
        shape: file.shape,
        height: file.height_m,
        mass: file.mass_kg,
        pitch: file.pitch_m,
        placements,
        damage_distance: file.damage_distance_m.unwrap_or(file.height_m),
        material: material?,
        ground_material: around.ground_material?,
        friction_unit,
        friction_ground,
    })
}

fn validate_numbers(file: &UnitsFile, rho0: f64, check: &mut Checker) {
    if check.number("units.height_m", file.height_m, from(0.005).up_to(20.0), "m", "write the unit's height in metres")
    {
        let volume = volume(file.shape, file.height_m);
        let range = above(100.0 * volume).up_to(20_000.0 * volume);
        let advice = format!("a unit of this height has {volume:.3e} m3; concrete has 2300 to 2400 kg/m3");
        let sound = check.number("units.mass_kg", file.mass_kg, range, "kg", &advice);
        if sound && file.mass_kg < rho0 * volume {
            check.warn(format!("units.mass_kg = {}: lighter than water, the units will float", show(file.mass_kg)));
        }
        check.number(
            "units.pitch_m",
            file.pitch_m,
            above(0.75 * file.height_m).up_to(1000.0),
            "m",
            "units nearer than 0.75 of their height overlap",
        );
    }
    if !(1..=MOST_UNITS).contains(&file.count) {
        check.refuse("units.count", file.count, format!("1 to {MOST_UNITS}"), "leave out `units` for water alone");
    }
    if let Some(distance) = file.damage_distance_m {
        check.number("units.damage_distance_m", distance, above(0.0).up_to(1000.0), "m", "the unit's height is usual");
    }
}

fn validate_friction(material: Option<usize>, around: &Surroundings, check: &mut Checker) -> Option<(f64, f64)> {
    let (unit, ground) = (material?, around.ground_material?);
    let mut lookup = |a: usize, b: usize| {
        let found = materials::coefficient(around.friction, a, b);
        if found.is_none() {
            let (a, b) = (&around.materials[a].name, &around.materials[b].name);
            check.refuse(
                "friction",
                format!("no entry for {a:?} on {b:?}"),
                "complete for the pairs that can touch",
                format!("add {{ \"between\": [{a:?}, {b:?}], \"coefficient\": ... }}"),
            );
        }
        found
    };
    let on_unit = lookup(unit, unit);
    let on_ground = if ground == unit { on_unit } else { lookup(unit, ground) };
    Some((on_unit?, on_ground?))
}

/// Place the units of the row and check that it fits into the domain.
fn place_row(file: &UnitsFile, flume: &Flume, domain: &Domain, check: &mut Checker) -> Vec<Placement> {
    let shape = proportions(file.shape);
    let margin = shape.reach_x * file.height_m;
    check.number(
        "units.x_m",
        file.x_m,
        above(domain.x[0] + margin).below(domain.x[1] - margin),
        "m",
        "the whole unit must stand inside `domain.x_m`",
    );
    let top = flume.profile.z(file.x_m) + file.height_m;
    if top > domain.top_z {
        check.refuse(
            "domain.top_z_m",
            show(domain.top_z),
            format!("above the top of the units, {} m", show(top)),
            "raise the walls",
        );
    }
    let length = f64::from(file.count - 1) * file.pitch_m;
    let first_y = file.first_y_m.unwrap_or(0.5 * (domain.width - length));
    match domain.sides {
        Sides::Periodic => validate_periodic_row(file, domain.width, first_y, check),
        Sides::Walls => {
            let reach = shape.reach_y * file.height_m;
            let widest = length + 2.0 * reach;
            if widest > domain.width {
                check.refuse(
                    "units.count",
                    file.count,
                    format!("such that the row, {} m over the outer legs, fits between the walls", show(widest)),
                    format!("write fewer units, a smaller pitch or a width of more than {} m", show(widest)),
                );
            } else if first_y < reach || first_y + length > domain.width - reach {
                let last = domain.width - reach - length;
                check.refuse(
                    "units.first_y_m",
                    show(first_y),
                    format!("at least {} and at most {} m between the walls", show(reach), show(last)),
                    "leave it out to centre the row",
                );
            }
        }
    }
    if file.height_m < 8.0 * domain.dp {
        check.warn(format!(
            "domain.dp_m = {}: {:.1} particles in the height of a unit; below 8 the forces on it are rough",
            show(domain.dp),
            file.height_m / domain.dp
        ));
    }
    let place = |index: u32| Placement {
        x: file.x_m,
        y: first_y + f64::from(index) * file.pitch_m,
        azimuth: azimuth(file.orientation, index),
    };
    (0..file.count).map(place).collect()
}

fn validate_periodic_row(file: &UnitsFile, width: f64, first_y: f64, check: &mut Checker) {
    let row = f64::from(file.count) * file.pitch_m;
    // Rounding of count * pitch only.
    let slack = 1e-9;
    if row > width + slack || f64::from(file.count) != (width / file.pitch_m).round() {
        check.refuse(
            "units.count",
            file.count,
            format!(
                "such that count x pitch = {} m fills the periodic width, {} m",
                show(row),
                show(width)
            ),
            "neighbours across the seam must stand at the pitch too: change `units.count`, `units.pitch_m` or `domain.width_m`",
        );
        return;
    }
    if row < width - 1e-6 {
        check.warn(format!(
            "units.pitch_m = {}: neighbours across the periodic seam stand {} m apart",
            show(file.pitch_m),
            show(width - row + file.pitch_m)
        ));
    }
    let turned = matches!(file.orientation, Orientation::Alternating | Orientation::AlternatingReversed);
    if turned && file.count > 1 && file.count % 2 == 1 {
        check.refuse(
            "units.count",
            file.count,
            "even when the units alternate and the sides are periodic",
            "add or remove one unit, so that neighbours across the seam are turned too",
        );
    }
    let last = width - (row - file.pitch_m);
    if !(first_y >= 0.0 && first_y <= last + slack) {
        check.refuse(
            "units.first_y_m",
            show(first_y),
            format!("at least 0 and at most {} m", show(last)),
            "leave it out to centre the row",
        );
    }
}

/// Turn of the unit at `index` about the vertical [rad].
fn azimuth(orientation: Orientation, index: u32) -> f64 {
    let shoreward = match orientation {
        Orientation::Alternating => !index.is_multiple_of(2),
        Orientation::AlternatingReversed => index.is_multiple_of(2),
        Orientation::Seaward => false,
        Orientation::Shoreward => true,
    };
    if shoreward { PI } else { 0.0 }
}
