//! Sets up the units of a validated case: rigid bodies, their boundary particles, and the water beside them.

use glam::DVec3;

use super::{
    Units,
    measures::{mean_loads::MeanLoads, water_at_impacts::WaterAtImpacts},
};
use crate::simulation::{
    bodies::rigid_setup,
    settling::{COARSE_STEPS, LONGEST, REST_SPEED, Surroundings},
};
use crate::{
    case::{self, Case, UnitGroup, group},
    geometry::{armour_unit::ArmourUnit, axis_box::AxisBox},
    rigid::{BodyState, Load, RigidError, RigidSetup, RigidWorld},
    sph::{
        particles::{
            boundary::BoundaryParticle, fill::clear_solid, obstacle::box_particles, unit::unit_particles, water::Water,
        },
        terms::wall_slip::Mirroring,
    },
};

/// Narrowest gap between a unit and its periodic image that water can pass, divided by the particle spacing [-]. A
/// narrower gap has no room for water particles.
const NARROWEST_GAP: f64 = 0.5;

/// Returns the units at their start positions, and a warning if placed units do not stay there. `case` is the case of
/// all regions: units collide with the end walls of the domain, not with the ends of the finest region. Placed units
/// settle first if `settles` is true.
pub(super) fn set_up_units(
    case: &Case,
    units: &case::Units,
    settles: bool,
) -> Result<(Units, Option<String>), RigidError> {
    let setup = rigid_setup(units, &case.site(), &case.materials, case.contact.law, case.fluid.gravity);
    let (world, warning) = if settles && units.groups.iter().any(|group| group.is_placed) {
        settled(setup, units, case)?
    } else {
        (RigidWorld::new(setup)?, None)
    };
    let start = world.states().to_vec();
    let (fluid_loads, mean_loads) = (vec![Load::default(); start.len()], MeanLoads::new(start.len()));
    let groups = units.groups.clone();
    let UnitGroup { members, models, .. } = &groups[case.breakage.as_ref().map_or(0, |settings| settings.group)];
    let recorded = if models.len() == 1 { members.clone() } else { members.start..members.start + 1 };
    let water_at_impacts = WaterAtImpacts::default();
    Ok((Units { groups, recorded, world, start, fluid_loads, mean_loads, water_at_impacts }, warning))
}

/// Largest way of a placed unit while it settles before a run, divided by the height of the highest unit [-]. Units that
/// only load their contacts move by less than the overlap, for which 1 % is the limit, too.
const FURTHEST: f64 = 0.01;

/// Lets placed units settle, and returns all bodies at rest with loaded contacts. A placement file has poses, but no
/// tangential springs: without this, the units would sink into their contacts when the run releases them. If they do
/// not come to rest near their poses, they keep these, and the result has a warning.
fn settled(setup: RigidSetup, units: &case::Units, case: &Case) -> Result<(RigidWorld, Option<String>), RigidError> {
    let mut held = setup.clone();
    for (kind, (group, _)) in held.kinds.iter_mut().zip(group::models(&units.groups)) {
        kind.is_fixed |= !group.is_placed;
    }
    let mut world = RigidWorld::new(held)?;
    world.set_steps_per_period(COARSE_STEPS);
    let around = Surroundings { units, gravity: case.fluid.gravity, water: case.still_water() };
    let is_at_rest = around.settle(&mut world, REST_SPEED, LONGEST)?;
    let ways = world.states().iter().zip(&setup.bodies).map(|(now, body)| now.position.distance(body.state.position));
    let furthest = ways.fold(0.0, f64::max);
    if !is_at_rest || furthest > FURTHEST * units.tallest() {
        let warning = format!(
            "units with `armour` or `heap`: they do not stay in their poses in still water; a unit moves by {:.1} mm before \
             the run starts. The run starts from the poses of the case; place the units again with its friction and water \
             level",
            1e3 * furthest
        );
        return Ok((RigidWorld::new(setup)?, Some(warning)));
    }
    let mut loaded = setup;
    for (body, state) in loaded.bodies.iter_mut().zip(world.states()) {
        body.state = BodyState::at_rest(state.position, state.rotation);
    }
    let mut at_rest = RigidWorld::new(loaded)?;
    at_rest.adopt_contacts(&world);
    Ok((at_rest, None))
}

/// Returns the boundary particles of a unit in body axes; in two dimensions, those of a slice of the unit. If a cuboid
/// fills the width of a periodic flume, its side faces touch its periodic images. The vectors `to_surface` of its
/// boundary particles then never point to these faces.
///
/// With inviscid walls, units that are not cuboids have particles of half the spacing, because their legs are only a
/// few spacings thick.
pub(super) fn unit_in_place(shape: &ArmourUnit, case: &Case) -> Vec<BoundaryParticle> {
    let dp = case.domain.dp;
    let mut particles = match box_in_place(shape, case) {
        Some(bounds) => box_particles(&bounds, dp, f64::INFINITY),
        None if case.numerics.wall_slip == case::WallSlip::Inviscid => particles_of(shape, 0.5 * dp),
        None => particles_of(shape, dp),
    };
    if case.numerics.slip_on_units {
        particles.iter_mut().for_each(|particle| particle.mirroring = Mirroring::Full);
    }
    particles
}

/// Returns the box of a cuboid in body axes, with the faces that water can reach; `None` for other shapes.
pub(super) fn box_in_place(shape: &ArmourUnit, case: &Case) -> Option<AxisBox> {
    let case::Domain { dp, width, sides, .. } = case.domain;
    let bounds = shape.as_box()?;
    Some(match sides {
        case::Sides::TwoDimensional => bounds.slice(width),
        case::Sides::Periodic if width - bounds.edges().y < NARROWEST_GAP * dp => bounds.with_closed_sides(),
        _ => bounds,
    })
}

/// Returns the boundary particles of a unit in body axes, for the particle spacing `dp` [m].
pub fn particles_of(shape: &ArmourUnit, dp: f64) -> Vec<BoundaryParticle> {
    if let Some(bounds) = shape.as_box() {
        return box_particles(&bounds, dp, f64::INFINITY);
    }
    let solid = shape.solid();
    let [low, high] = solid.bounds();
    unit_particles(|point| solid.project(point), low, high, solid.volume_properties().volume, dp)
}

/// Removes the water particles inside the units and their periodic images. Moves other particles outwards if they are
/// too near to the surface of a unit.
pub(super) fn clear_units(water: &mut Water, units: &Units, case: &Case) {
    let images = if case.domain.sides == case::Sides::Periodic { vec![-1.0, 0.0, 1.0] } else { vec![0.0] };
    for (solid, state) in units.solids() {
        let [low, high] = solid.bounds().map(|corner| corner.abs().max_element());
        let reach = 2.0 * low.max(high) + case.domain.dp;
        for image in &images {
            let centre = state.position + DVec3::Y * (image * case.domain.width);
            clear_solid(water, case.domain.dp, |point| {
                let from_centre = point - centre;
                if from_centre.length_squared() > reach * reach {
                    return (point, f64::INFINITY);
                }
                let (nearest, distance) = solid.project(state.rotation.inverse() * from_centre);
                (centre + state.rotation * nearest, distance)
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tetrapods_have_free_slip_only_if_the_case_sets_slip_on_units() {
        let given = include_str!("../../../cases/fudo/H4.5-slice.json");
        for slides in [false, true] {
            let wanted = format!(r#""wall_slip": "free_slip", "slip_on_units": {slides}"#);
            let text = given.replace(r#""scheme": "mitsui_2023""#, &wanted);
            let case = Case::from_str(&text, "cases/fudo/test.json").unwrap_or_else(|errors| panic!("{errors}"));
            let units = case.units.as_ref().expect("the slice has two units");
            let particles = unit_in_place(units.groups[0].shape().unit(), &case);
            let wanted = if slides { Mirroring::Full } else { Mirroring::Normal };
            assert!(!particles.is_empty() && particles.iter().all(|particle| particle.mirroring == wanted));
        }
    }
}
