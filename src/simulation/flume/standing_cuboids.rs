//! Cuboids that can move and stand on bed, parts or walls with a face: no water is below this face.
//!
//! The face counts as closed, as if the cuboid were an obstacle there: the surface vectors of its particles lead to its
//! other faces, and those of the particles below it to its foot. The faces are found again after each time step from
//! the poses of the units alone, so that a run can resume at any time.

use glam::{DVec2, DVec3};

use super::{Units, unit_setup::box_in_place};
use crate::{
    case::{Case, Part, Sides, UnitGroup, UnitModel},
    geometry::{axis_box::AxisBox, outline::Outline},
    rigid::BodyState,
    sph::particles::{boundary::Boundary, standing::TOUCHING},
};

/// The cuboids of a flume that can move, and the surface of bed and walls.
#[derive(Debug, Default)]
pub struct StandingCuboids {
    /// Index and box of each cuboid.
    cuboids: Vec<(usize, AxisBox)>,
    /// Surface point [m] and index of each particle of bed and walls, in the order of x.
    walls: Vec<(DVec3, usize)>,
}

impl StandingCuboids {
    /// Lists the cuboids that can move among the units.
    pub(super) fn new(units: &Units, boundary: &Boundary, case: &Case) -> Self {
        let of_unit = |(unit, (group, model)): (usize, (&UnitGroup, &UnitModel))| {
            let bounds = box_in_place(model.shape.unit(), case).filter(|_| group.moves())?;
            Some((unit, bounds))
        };
        let cuboids: Vec<_> = units.each().enumerate().filter_map(of_unit).collect();
        if cuboids.is_empty() {
            return Self::default();
        }
        let mut walls: Vec<_> = boundary.wall_surface().map(|(particle, point)| (point, particle)).collect();
        walls.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.cmp(&b.1)));
        Self { cuboids, walls }
    }

    /// Closes the faces with which the cuboids stand, and covers the walls below them. The units have these `states`.
    pub(super) fn place(&self, boundary: &mut Boundary, states: &[BodyState], case: &Case, outline: &Outline) {
        let gap = TOUCHING * case.domain.dp;
        let standing: Vec<(&BodyState, AxisBox)> = self
            .cuboids
            .iter()
            .filter_map(|(unit, bounds)| {
                let state = &states[*unit];
                let closed = closed_on(bounds, state, |point| is_solid_within(point, gap, case, outline));
                boundary.stand_unit(*unit, closed);
                Some((state, closed?))
            })
            .collect();
        if !self.cuboids.is_empty() {
            boundary.cover_walls(standing.iter().flat_map(|(state, bounds)| self.covered(state, bounds, gap, case)));
        }
    }

    /// Returns the particles of bed and walls below the closed faces of a cuboid, with vectors from their surface
    /// points to its foot. The surface points are at most `gap` [m] away from these faces.
    fn covered(
        &self,
        state: &BodyState,
        bounds: &AxisBox,
        gap: f64,
        case: &Case,
    ) -> impl Iterator<Item = (usize, DVec3)> {
        let (bounds, state, width) = (*bounds, *state, case.domain.width);
        let is_periodic = case.domain.sides == Sides::Periodic;
        let near = bounds.beyond_closed_faces(gap);
        let corners = near.corners().map(|corner| state.position.x + (state.rotation * corner).x);
        let low = corners.into_iter().fold(f64::INFINITY, f64::min);
        let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let first = self.walls.partition_point(|(point, _)| point.x < low);
        self.walls[first..].iter().take_while(move |(point, _)| point.x <= high).filter_map(move |(point, particle)| {
            let mut from_centre = *point - state.position;
            if is_periodic {
                from_centre.y -= width * (from_centre.y / width).round();
            }
            let place = state.rotation.inverse() * from_centre;
            near.contains(place).then(|| (*particle, state.rotation * bounds.vector_to_surface(place)))
        })
    }
}

/// Returns the box with those faces closed that lie on a solid; `None` if no open face does.
fn closed_on(bounds: &AxisBox, state: &BodyState, is_solid: impl Fn(DVec3) -> bool) -> Option<AxisBox> {
    let mut closed = *bounds;
    for axis in 0..3 {
        for side in (0..2).filter(|side| bounds.open[axis][*side]) {
            let lies = bounds.points_on_face(axis, side).all(|point| is_solid(state.position + state.rotation * point));
            closed.open[axis][side] = !lies;
        }
    }
    (closed != *bounds).then_some(closed)
}

/// Returns true if bed, walls or parts are at most `gap` [m] away from a point.
fn is_solid_within(point: DVec3, gap: f64, case: &Case, outline: &Outline) -> bool {
    let at = DVec2::new(point.x, point.z);
    let beside = |y: f64| case.domain.sides == Sides::Walls && y <= gap;
    let of_part = |part: &Part| {
        part.as_box().is_some_and(|bounds| bounds.locate(point).1 <= gap)
            || part.as_body().is_some_and(|body| body.locate_within(point, gap).1 <= gap)
    };
    outline.is_solid(at)
        || outline.nearest(at).distance(at) <= gap
        || beside(point.y)
        || beside(case.domain.width - point.y)
        || case.flume.parts.iter().any(of_part)
}
