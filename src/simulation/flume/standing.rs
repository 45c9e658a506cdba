//! Fixed bodies that stand on the bed: parts of any shape, and units with a face on the bed.

use std::borrow::Cow;

use glam::DVec3;

use super::Units;
use crate::{
    case::{self, BodyPart, Case, group},
    geometry::{open_space::OpenSpace, solid::Solid},
    rigid::BodyState,
    sph::{
        particles::{
            bed::Across,
            boundary::BoundaryParticle,
            fill::{column, columns},
            standing::{TOUCHING, cover_below, cover_body},
            unit::unit_particles,
        },
        terms::wall_slip::Mirroring,
    },
};

/// Gap between a body and the sides of a periodic flume below which the body crosses the flume, divided by dp [-].
const ACROSS: f64 = 0.25;

/// Returns the space that water can reach next to a body between two y [m]. The space ends `inset` dp in front of bed
/// and walls.
pub(super) fn space_around(case: &Case, y: [f64; 2], inset: f64) -> OpenSpace {
    let case::Domain { x, width, sides, dp, .. } = case.domain;
    let crosses = y[1] - y[0] > width - 2.0 * ACROSS * dp;
    let has_sides = sides != case::Sides::Periodic || crosses;
    OpenSpace::new(&case.flume.profile, x, has_sides.then_some([0.0, width]), inset * dp)
}

/// Adds the particles of a body to those of bed and walls, whose surface vectors it changes. Where bed or side walls
/// have particles, the body has none.
pub(super) fn add_body(walls: &mut Vec<BoundaryParticle>, body: &BodyPart, across: &Across, case: &Case) {
    let case::Domain { dp, width, .. } = case.domain;
    let [low, high] = body.solid.bounds();
    let space = space_around(case, [low.y, high.y], TOUCHING);
    let Some(surface) = space.part_of(body.surface_triangles()) else { return };
    cover_below(walls, &surface, dp, |point| body.locate_within(point, dp).1);
    let mut own = if body.terrain_x.is_some() {
        columns_below(body, across, case)
    } else {
        let volume = body.solid.volume_properties().volume;
        unit_particles(|point| body.solid.project(point), low, high, volume, dp)
    };
    own.retain(|particle| {
        let DVec3 { x, y, z } = particle.position;
        z > case.flume.profile.z(x) && (0.0..width).contains(&y)
    });
    cover_body(&mut own, &surface, &space);
    let thickness = case.numerics.boundary_layers as f64 * dp;
    walls.extend(own.into_iter().filter(|particle| particle.to_surface.length() < thickness));
}

/// Returns the particles of a terrain: columns that fill the space between the profile of the bed and the terrain, as
/// water fills a basin. So they follow the surface, and their volumes are exact.
fn columns_below(body: &BodyPart, across: &Across, case: &Case) -> Vec<BoundaryParticle> {
    let (profile, dp) = (&case.flume.profile, case.domain.dp);
    let (along, dx) = columns(case.domain.x, dp);
    let mut particles = Vec::new();
    for (x, y) in along.into_iter().flat_map(|x| across.rows(0).into_iter().map(move |y| (x, y))) {
        let Some(level) = body.surface.level(x, y) else { continue };
        let (heights, dz) = column(profile.z(x), level, dp);
        particles.extend(heights.map(|z| {
            let position = DVec3::new(x, y, z);
            BoundaryParticle {
                position,
                to_surface: body.solid.project(position).0 - position,
                volume: dx * across.spacing() * dz,
                mirroring: Mirroring::Normal,
            }
        }));
    }
    particles
}

/// Changes the surface vectors at the units that stand on the bed. `walls` lists the particles of bed and walls, and
/// `of_models` those of each model of units in body axes. Returns the particles of each unit in body axes.
pub(super) fn cover_standing_units<'a>(
    walls: &mut [BoundaryParticle],
    of_models: &'a [Vec<BoundaryParticle>],
    units: &Units,
    case: &Case,
) -> Vec<Cow<'a, [BoundaryParticle]>> {
    let mut of_each = Vec::new();
    let each = units.each().zip(units.states()).zip(group::model_of_each(&units.groups));
    for (((group, model), state), number) in each {
        let mut own = Cow::from(&of_models[number]);
        if !group.moves() {
            cover_unit(walls, own.to_mut(), model.shape.unit().solid(), state, case);
        }
        of_each.push(own);
    }
    of_each
}

fn cover_unit(
    walls: &mut [BoundaryParticle],
    own: &mut [BoundaryParticle],
    solid: &Solid,
    state: &BodyState,
    case: &Case,
) {
    let dp = case.domain.dp;
    let to_world = |point: DVec3| state.position + state.rotation * point;
    let corners: Vec<DVec3> = solid.vertices().iter().map(|vertex| to_world(*vertex)).collect();
    let low = corners.iter().copied().reduce(DVec3::min).unwrap_or_default() - dp;
    let high = corners.iter().copied().reduce(DVec3::max).unwrap_or_default() + dp;
    let distance = |point: DVec3| {
        if point.clamp(low, high) != point {
            return f64::INFINITY;
        }
        solid.signed_distance(state.rotation.inverse() * (point - state.position))
    };
    if !stands(walls, case, distance) {
        return;
    }
    let space = space_around(case, [low.y + dp, high.y - dp], TOUCHING);
    let triangles = solid.triangles().iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
    let Some(surface) = space.part_of(triangles) else { return };
    cover_below(walls, &surface, dp, distance);
    let place = |particle: &mut BoundaryParticle, position: DVec3, rotation: glam::DQuat| {
        particle.position = position;
        particle.to_surface = rotation * particle.to_surface;
    };
    let mut placed = own.to_vec();
    placed.iter_mut().for_each(|particle| place(particle, to_world(particle.position), state.rotation));
    let free = placed.clone();
    cover_body(&mut placed, &surface, &space);
    for ((particle, placed), free) in own.iter_mut().zip(placed).zip(free) {
        // Rotations there and back would change the last bits of the other vectors.
        if placed != free {
            particle.to_surface = state.rotation.inverse() * placed.to_surface;
        }
    }
}

/// Returns true if a body touches the bed with a face that has room for a disc with the radius dp. Bodies that touch it
/// with edges or tips keep the vectors of all particles: the water around them reaches most ghost nodes.
fn stands(walls: &[BoundaryParticle], case: &Case, distance: impl Fn(DVec3) -> f64) -> bool {
    let (dp, bed) = (case.domain.dp, &case.flume.profile);
    let touches = |at: DVec3| distance(at) <= TOUCHING * dp;
    let along = |at: DVec3, step: f64| DVec3::new(at.x + step, at.y, bed.z(at.x + step));
    walls.iter().filter(|particle| particle.to_surface.z > 0.0).any(|particle| {
        let at = particle.position + particle.to_surface;
        touches(at)
            && [-dp, dp].iter().all(|step| {
                touches(along(at, *step)) && {
                    // In a narrow flume, the body can end at its sides.
                    case.domain.ny < 3 || touches(at + DVec3::Y * *step)
                }
            })
    })
}
