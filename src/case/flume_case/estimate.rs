//! Estimates the size of a run before any particle is created.

use glam::DVec3;

use super::Case;
use super::numerics::Numerics;
use crate::case::file::{Sides, Viscosity, WallSlip};
use crate::case::flume::body::BodyPart;
use crate::case::flume::domain::Water;
use crate::case::flume::part::Part;
use crate::case::flume::regions::Region;
use crate::case::units::Units;
use crate::case::units::group::{UnitGroup, UnitModel};
use crate::case::units::shape::UnitShape;
use crate::geometry::{axis_box::AxisBox, outline::polygon::Polygon, profile::Profile};
use crate::sph::solver::time_step::viscous_limit;

/// Memory per particle, including its neighbour list [bytes].
const BYTES_PER_PARTICLE: f64 = 600.0;

/// Cost of an interpolation between regions at one point, including its share of the search for the surface, in
/// evaluations of a particle. The value makes the estimate agree with the measured saving in the Fudo slice at 7 mm.
const EVALUATIONS_PER_POINT: f64 = 25.0;

/// Size of a run, estimated from areas and volumes with an error of about 10 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Number of water particles.
    pub fluid: f64,
    /// Number of particles in bed, walls, wavemaker and obstacles.
    pub boundary: f64,
    /// Number of particles in the armour units.
    pub units: f64,
    /// Memory that the run needs [bytes].
    pub bytes: f64,
    /// Time step [s]: cfl h / c0 with smoothing length h and speed of sound c0, or the viscous limit of laminar models
    /// if this limit is smaller.
    pub dt: f64,
    /// Number of time steps of the whole run; coarser regions make half as many.
    pub steps: f64,
    /// Number of evaluations of the rates of a particle in the whole run.
    pub evaluations: f64,
}

impl Estimate {
    /// Returns the number of all particles.
    pub fn particles(&self) -> f64 {
        self.fluid + self.boundary + self.units
    }
}

impl Case {
    /// Returns x of the two ends of the initial water, and its level z [m].
    fn water_at_start(&self) -> ([f64; 2], f64) {
        match self.domain.water {
            Water::StillLevel => (self.domain.x, self.flume.still_water_level),
            Water::Block { x, top_z, .. } => (x, top_z),
        }
    }

    /// Returns the share of the initial water volume that is inside a box [-]. `[low, high]` are the lower and the
    /// upper corner of the box [m].
    pub fn share_of_water_in(&self, [low, high]: [[f64; 3]; 2]) -> f64 {
        let (profile, (x, top)) = (&self.flume.profile, self.water_at_start());
        let overlap = |[a0, a1]: [f64; 2], [b0, b1]: [f64; 2]| [a0.max(b0), a1.min(b1).max(a0.max(b0))];
        let [x0, x1] = overlap(x, [low[0], high[0]]);
        let [y0, y1] = overlap([0.0, self.domain.width], [low[1], high[1]]);
        let area_below = |level: f64| if x1 > x0 { area_under(profile, [x0, x1], level.min(top)) } else { 0.0 };
        let (in_box, all) = (area_below(high[2]) - area_below(low[2]), area_under(profile, x, top));
        if all > 0.0 { in_box / all * (y1 - y0) / self.domain.width } else { 0.0 }
    }

    /// Estimates number of particles, memory and number of time steps of the run.
    pub fn estimate(&self) -> Estimate {
        let regions = &self.domain.regions;
        let mut all = self.of_region(&regions[0]).estimate_region();
        for region in &regions[1..] {
            let Estimate { fluid, boundary, bytes, evaluations, .. } = self.of_region(region).estimate_region();
            all.fluid += fluid;
            all.boundary += boundary;
            all.bytes += bytes;
            // The regions with four times the spacing make the same time steps as those with twice the spacing.
            all.evaluations += evaluations * f64::from(region.coarseness) / 2.0;
        }
        all.evaluations += EVALUATIONS_PER_POINT * self.points_between_regions() * all.steps / 2.0;
        all
    }

    /// Returns the number of points at which the buffers of all regions interpolate the water of their neighbours.
    fn points_between_regions(&self) -> f64 {
        let (regions, dp, h) = (&self.domain.regions, self.domain.dp, self.numerics.h);
        let in_buffer = |region: &Region, end: usize| {
            let x = region.x[end];
            let neighbour = regions.iter().find(|other| other.x[1 - end] == x)?;
            let coarse = f64::from(region.coarseness.max(neighbour.coarseness)) * dp;
            let own = f64::from(region.coarseness);
            let along = Region::buffer(own * h, own * dp) / coarse + 1.0;
            let across = if self.domain.sides == Sides::TwoDimensional { 1.0 } else { self.domain.width / coarse };
            let depth = (self.flume.still_water_level - self.flume.profile.z(x)).max(0.0);
            Some(along * across * (depth / coarse + 2.0))
        };
        let ends = regions.iter().flat_map(|region| [0, 1].map(|end| (region, end)));
        ends.filter(|(region, end)| region.continues[*end]).filter_map(|(region, end)| in_buffer(region, end)).sum()
    }

    /// Estimates one region of the run.
    fn estimate_region(&self) -> Estimate {
        let domain = &self.domain;
        let profile = &self.flume.profile;
        let per_volume = 1.0 / (domain.dp * domain.dp * domain.dy);
        let thickness = self.numerics.boundary_layers as f64 * domain.dp;
        let (water_x, water_top) = self.water_at_start();
        let water_area = area_under(profile, water_x, water_top);
        let wall = |end: usize| (domain.top_z - profile.z(domain.x[end])).max(0.0);
        let end_walls = (0..2).filter(|&end| !domain.continues[end]).map(wall).sum::<f64>();
        let bed = length_along(profile, domain.x);
        let mut solid = (bed + end_walls) * thickness * domain.width;
        if domain.sides == Sides::Walls {
            solid += 2.0 * thickness * area_under(profile, domain.x, domain.top_z);
        }
        let shell = |obstacle: &AxisBox| {
            let core = (obstacle.edges() - 2.0 * thickness).max(DVec3::ZERO);
            obstacle.volume() - core.element_product()
        };
        solid += self.flume.parts.iter().filter_map(Part::as_box).map(shell).sum::<f64>();
        let of_body = |body: &BodyPart| {
            let area: f64 = body.triangles().map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
            body.solid.volume_properties().volume.min(area * thickness)
        };
        let bodies = self.flume.parts.iter().filter_map(Part::as_body);
        // A terrain raises the particles of the bed, and adds few.
        solid += bodies.filter(|body| body.terrain_x.is_none()).map(of_body).sum::<f64>();
        let of_section = |polygon: &Polygon| {
            let around: f64 = polygon.edges().map(|[a, b]| a.distance(b)).sum();
            polygon.area().min(around * thickness) * domain.width
        };
        solid += self.flume.parts.iter().filter_map(Part::section).map(of_section).sum::<f64>();
        // With inviscid walls, units that are not cuboids have particles of half the spacing.
        let finer = |shape: &UnitShape| {
            let is_finer = self.numerics.wall_slip == WallSlip::Inviscid && shape.unit().as_box().is_none();
            if is_finer { 8.0 } else { 1.0 }
        };
        let of_unit =
            |(group, model): (&UnitGroup, &UnitModel)| finer(&model.shape) * model.shape.volume() / group.slices;
        // Without units, the sum is -0.
        let unit_volume: f64 = 0.0 + self.units.iter().flat_map(Units::each).map(of_unit).sum::<f64>();
        let (fluid, boundary, units) =
            (water_area * domain.width * per_volume, solid * per_volume, unit_volume * per_volume);
        let Numerics { h, cfl, viscosity, nu, .. } = self.numerics;
        let courant = cfl * h / self.fluid.sound_speed;
        let dt = if viscosity == Viscosity::Artificial { courant } else { courant.min(viscous_limit(h, nu)) };
        let steps = (self.stop.duration / dt).ceil();
        Estimate {
            fluid: fluid.round(),
            boundary: boundary.round(),
            units: units.round(),
            bytes: BYTES_PER_PARTICLE * (fluid + boundary + units),
            dt,
            steps,
            evaluations: 2.0 * (fluid + boundary + units) * steps,
        }
    }
}

/// Returns the points (x, z) of the ground between two x coordinates: both ends and the corner points between them [m].
fn ground_points(profile: &Profile, [x0, x1]: [f64; 2]) -> Vec<[f64; 2]> {
    let inner = profile.points().iter().copied().filter(|p| p[0] > x0 && p[0] < x1);
    [[x0, profile.z(x0)]].into_iter().chain(inner).chain([[x1, profile.z(x1)]]).collect()
}

/// Returns the area below `level` and above the ground, between two x coordinates [m2].
fn area_under(profile: &Profile, x: [f64; 2], level: f64) -> f64 {
    let wet_area = |pair: &[[f64; 2]]| {
        let (a, b) = (level - pair[0][1], level - pair[1][1]);
        let length = pair[1][0] - pair[0][0];
        match (a > 0.0, b > 0.0) {
            (true, true) => 0.5 * (a + b) * length,
            // The wet part of a segment that crosses the level is a triangle.
            (true, false) => 0.5 * a * length * a / (a - b),
            (false, true) => 0.5 * b * length * b / (b - a),
            (false, false) => 0.0,
        }
    };
    ground_points(profile, x).windows(2).map(wet_area).sum()
}

/// Returns the length of the ground surface between two x coordinates [m].
fn length_along(profile: &Profile, x: [f64; 2]) -> f64 {
    ground_points(profile, x).windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_above_the_ground_and_length_of_the_ground_are_exact() {
        let bed = Profile::new(vec![[0.0, 0.0], [2.0, 0.0], [4.0, 2.0]]);
        assert!((area_under(&bed, [0.0, 4.0], 1.0) - 2.5).abs() < 1e-12);
        assert!((area_under(&bed, [1.0, 4.0], 3.0) - 7.0).abs() < 1e-12);
        assert!((length_along(&bed, [1.0, 3.0]) - (1.0 + 2f64.sqrt())).abs() < 1e-12);
    }
}
