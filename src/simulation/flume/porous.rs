//! The fields of the porous parts of a case.

use std::sync::Arc;

use glam::DVec2;

use crate::{
    case::{Case, Part, PartShape, Sides},
    geometry::{axis_box::AxisBox, outline::Outline},
    sph::{
        particles::{
            porosity::{Distance, Media, PorousField},
            water::Water,
        },
        terms::porous::Pores,
    },
};

/// Distance by which a box continues into bed, walls and ends that it touches, in smoothing lengths [-].
const INTO_WALLS: f64 = 4.0;

/// Returns the porosity and the drag around the porous parts; `None` if there are none. `outline` is that of bed, end
/// walls and all solid parts that are the same across the flume.
pub(super) fn porous_field(case: &Case, outline: &Outline) -> Option<Arc<PorousField>> {
    let parts: Vec<&Part> = case.flume.parts.iter().filter(|part| part.medium().is_some()).collect();
    let width = case.domain.width;
    let all = parts.iter().map(|part| part.surface().bounds(width));
    let bounds = all.reduce(|[low, high], [a, b]| [low.min(a), high.max(b)])?;
    let media = parts.iter().copied().filter_map(|part| {
        let pores: Pores = part.medium()?.pores(case.numerics.nu);
        Some((pores, distance(part, case, outline)))
    });
    let media = media.collect();
    let is_same_across =
        parts.iter().all(|part| part.polygon().is_some()) || case.domain.sides == Sides::TwoDimensional;
    Some(Arc::new(PorousField::new(&Media { media, bounds, is_same_across, half_width: case.numerics.h })))
}

/// Returns the signed distance from a porous part. Faces that touch solids do not count: the medium continues there.
fn distance<'a>(part: &'a Part, case: &Case, outline: &Outline) -> Distance<'a> {
    if let Some(polygon) = part.polygon() {
        let outline = outline.with(polygon);
        return Box::new(move |point| {
            let at = DVec2::new(point.x, point.z);
            if polygon.contains(at) { -outline.nearest(at).distance(at) } else { polygon.distance(at) }
        });
    }
    match part.surface() {
        PartShape::Box(bounds) => {
            let bounds = into_walls(*bounds, case);
            Box::new(move |point| bounds.locate(point).1)
        }
        shape => Box::new(move |point| shape.distance(point)),
    }
}

/// Returns a box that continues into the bed, the side walls and the ends of the domain where it touches them.
fn into_walls(bounds: AxisBox, case: &Case) -> AxisBox {
    let (domain, by) = (&case.domain, INTO_WALLS * case.numerics.h);
    let touch = 1e-6 * domain.dp;
    let ([x0, x1], AxisBox { mut low, mut high, .. }) = (domain.x, bounds);
    let bed = case.flume.profile.extremes_between([low.x, high.x]).0;
    for (value, limit) in [(&mut low.x, x0), (&mut low.y, 0.0), (&mut low.z, bed)] {
        if *value <= limit + touch {
            *value -= by;
        }
    }
    for (value, limit) in [(&mut high.x, x1), (&mut high.y, domain.width)] {
        if *value >= limit - touch {
            *value += by;
        }
    }
    AxisBox::free(low, high)
}

/// Leaves only the water in the pores: at first, particles have the mass of open water.
pub(super) fn leave_pores(water: &mut Water, field: &PorousField) {
    water.mass.iter_mut().zip(&water.position).for_each(|(mass, position)| *mass *= field.at(*position).porosity);
}
