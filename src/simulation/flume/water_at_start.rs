//! The water at the start of a run.

use glam::{DVec2, DVec3};

use super::scheme::tait;
use crate::{
    case::{self, Case, Part, PartShape},
    geometry::outline::Outline,
    sph::particles::{
        bed::Across,
        fill::{Basin, clear_solid},
        water::Water,
    },
    waves::flume_model::record::FlumeRecord,
};

/// Returns the region that is filled with water, with these levels of the bed and of the surface [m], and this velocity
/// [m/s].
pub(super) fn basin<'a>(
    case: &Case,
    across: &Across,
    bed: &'a dyn Fn(f64, f64) -> f64,
    surface: &'a dyn Fn(f64) -> f64,
    velocity: &'a dyn Fn(f64, f64) -> DVec2,
) -> Basin<'a> {
    let x = match case.domain.water {
        case::Water::StillLevel => case.domain.x,
        case::Water::Block { x, around_z: None, .. } => x,
        case::Water::Block { .. } => case.domain.x,
    };
    Basin { x, across: *across, dp: case.domain.dp, bed, surface, velocity, gravity: case.fluid.gravity }
}

/// Returns the water at the start: a block, still water, or the flow of the flume model.
pub(super) fn fill(case: &Case, across: &Across, flume: Option<&FlumeRecord>, start: f64) -> Water {
    let bed = |x: f64, y: f64| case.flume.level(x, y);
    let surface = |x: f64| match (case.domain.water, flume) {
        (case::Water::Block { x: [from, to], top_z, around_z }, _) => {
            if (from..to).contains(&x) {
                top_z
            } else {
                around_z.unwrap_or(top_z)
            }
        }
        (case::Water::StillLevel, Some(record)) => record.surface_level_m(x, start),
        (case::Water::StillLevel, None) => case.flume.still_water_level,
    };
    let velocity = |x: f64, z: f64| flume.map_or(DVec2::ZERO, |record| record.velocity(x, z, start).into());
    basin(case, across, &bed, &surface, &velocity).fill(&tait(case))
}

/// Moves the water out of a part, unless the part is a terrain; `outline` is the outline of all sections.
pub(super) fn clear_part(water: &mut Water, part: &Part, outline: &Outline, dp: f64) {
    match &part.shape {
        PartShape::Box(bounds) => clear_solid(water, dp, |point| bounds.locate(point)),
        PartShape::Body(body) if body.terrain_x.is_none() => clear_solid(water, dp, |at| body.locate_within(at, dp)),
        PartShape::Bed(_) | PartShape::Body(_) | PartShape::Porous(..) => (),
        PartShape::Section(polygon) => {
            let [low, high] = polygon.bounds();
            clear_solid(water, dp, |point| {
                let at = DVec2::new(point.x, point.z);
                if at.distance(at.clamp(low, high)) > dp {
                    return (point, f64::INFINITY);
                }
                // Inside the part, the nearest surface is that of the whole outline, without the faces that touch.
                let inside = polygon.contains(at);
                let nearest = if inside { outline.nearest(at) } else { polygon.nearest(at) };
                let distance = nearest.distance(at);
                (DVec3::new(nearest.x, point.y, nearest.y), if inside { -distance } else { distance })
            });
        }
    }
}
