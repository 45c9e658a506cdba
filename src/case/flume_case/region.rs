//! Regions of different particle spacing: the case of one region, and checks of its contents.

use super::Case;
use crate::case::file::{Boundary, Sides};
use crate::case::flume::bed::Flume;
use crate::case::flume::domain::Domain;
use crate::case::flume::part::{Part, PartShape};
use crate::case::flume::regions::Region;
use crate::case::flume_case::numerics::Numerics;
use crate::case::reading::check::{Checker, as_text};
use crate::case::units::UnitPose;
use crate::case::units::group::{UnitGroup, UnitModel};

impl Case {
    /// Returns the case of one region: its domain includes the buffers beyond the ends where water of other regions
    /// continues. Only the finest region has units, parts and obstacles.
    pub fn of_region(&self, region: &Region) -> Self {
        let coarseness = f64::from(region.coarseness);
        let (dp, h) = (coarseness * self.domain.dp, coarseness * self.numerics.h);
        let buffer = Region::buffer(h, dp);
        let beyond = region.continues.map(|continues| if continues { buffer } else { 0.0 });
        let x = [region.x[0] - beyond[0], region.x[1] + beyond[1]];
        let count = |length: f64| ((length / dp).round() as usize).max(1);
        let ny = if self.domain.sides == Sides::TwoDimensional { 1 } else { count(self.domain.width) };
        let is_finest = region.coarseness == 1;
        let domain = Domain {
            x,
            dp,
            dy: self.domain.width / ny as f64,
            nx: count(x[1] - x[0]),
            ny,
            nz: ((self.domain.top_z - self.domain.bottom_z) / dp).ceil() as usize,
            continues: region.continues,
            own_x: std::array::from_fn(
                |end| if region.continues[end] { region.x[end] } else { self.domain.own_x[end] },
            ),
            ..self.domain.clone()
        };
        let units = if is_finest { self.units.clone() } else { None };
        let parts = if is_finest { self.flume.parts.clone() } else { Vec::new() };
        let flume = Flume { parts, ..self.flume.clone() };
        Self { flume, domain, numerics: Numerics { h, ..self.numerics }, units, ..self.clone() }
    }
}

impl Case {
    /// Returns true if the case has obstacles, or parts that are not part of the bed.
    pub fn has_parts_in_water(&self) -> bool {
        self.flume.parts.iter().any(|part| !matches!(part.shape, PartShape::Bed(_)))
    }
}

/// Smallest distance of units and obstacles from the ends of the finest region, divided by its particle spacing [-].
/// The buffers of the coarser regions end there.
const MARGIN: f64 = 20.0;

/// Checks that units and obstacles are in the finest region, and that the scheme can be used in regions.
pub(super) fn validate_contents(case: &Case, check: &mut Checker) {
    let (Domain { regions, dp, .. }, numerics) = (&case.domain, &case.numerics);
    if regions.len() < 2 {
        return;
    }
    let Region { x, continues, .. } = regions[0];
    let from = if continues[0] { x[0] + MARGIN * dp } else { f64::NEG_INFINITY };
    let to = if continues[1] { x[1] - MARGIN * dp } else { f64::INFINITY };
    let given = format!("[{}, {}]", as_text(x[0]), as_text(x[1]));
    let in_water = case.flume.parts.iter().filter(|part| !matches!(part.shape, PartShape::Bed(_)));
    let of_obstacles = in_water.map(Part::x);
    let of_units = case.units.iter().flat_map(|units| {
        let extent = |(pose, (_, model)): (&UnitPose, (&UnitGroup, &UnitModel))| {
            let tips = 0.5 * model.shape.height();
            [pose.centre.x - tips, pose.centre.x + tips]
        };
        units.placements.iter().zip(units.each()).map(extent)
    });
    for (what, extents) in
        [("parts of the structure and obstacles", of_obstacles.collect::<Vec<_>>()), ("units", of_units.collect())]
    {
        let low = extents.iter().map(|extent| extent[0]).fold(f64::INFINITY, f64::min);
        let high = extents.iter().map(|extent| extent[1]).fold(f64::NEG_INFINITY, f64::max);
        if low < from || high > to {
            check.reject(
                "domain.fine_x_m[0]",
                &given,
                format!("from at most {} to at least {} m", as_text(low - MARGIN * dp), as_text(high + MARGIN * dp)),
                format!("all {what} must be in the finest water, 20 dp_m from its ends"),
            );
        }
    }
    if numerics.boundary == Boundary::Dbc {
        check.reject("numerics.boundary", "dbc", "\"mdbc\" with domain.fine_x_m", "leave the key out");
    }
}
