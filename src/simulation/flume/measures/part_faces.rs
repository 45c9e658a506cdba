//! Points on the faces of parts, at which force gauges sum the pressure of the water.

use glam::DVec3;

use crate::{
    case::{BodyPart, Case, Domain, Part, PartShape, Quantity},
    geometry::{axis_box::AxisBox, outline::Outline, outline::polygon::Polygon, outline::segments::left_normal},
    rigid::Load,
    simulation::flume::{Simulation, standing::space_around},
};

/// A point on a face that water can reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Position [m].
    pub at: DVec3,
    /// Unit normal into the water, times the area that the point represents [m2].
    pub area: DVec3,
}

/// Distance from a face at which a point must be outside all solids, for the face to be open, divided by dp [-].
const IN_FRONT: f64 = 1e-3;

/// Returns for each part of the case the points on its open faces, about dp apart. A part without a force gauge has
/// none. `outline` is the outline of bed, walls and all parts that are the same across the flume.
pub(in crate::simulation::flume) fn part_faces(case: &Case, outline: &Outline) -> Vec<Vec<FacePoint>> {
    let is_measured = |part: usize| case.gauges.iter().any(|gauge| gauge.quantity == Quantity::PartForce(part));
    let faces = |(index, part): (usize, &Part)| match &part.shape {
        _ if !is_measured(index) => Vec::new(),
        PartShape::Porous(..) => Vec::new(),
        PartShape::Bed(polygon) | PartShape::Section(polygon) => of_section(polygon, outline, case),
        PartShape::Box(bounds) => of_box(bounds, case),
        PartShape::Body(body) => of_body(body, case),
    };
    case.flume.parts.iter().enumerate().map(faces).collect()
}

fn of_section(polygon: &Polygon, outline: &Outline, case: &Case) -> Vec<FacePoint> {
    let Domain { dp, dy, ny, .. } = case.domain;
    let mut points = Vec::new();
    for edge in polygon.edges() {
        let (count, normal) = ((edge[0].distance(edge[1]) / dp).ceil().max(1.0), left_normal(&edge));
        let length = edge[0].distance(edge[1]) / count;
        for at in (0..count as u32).map(|k| edge[0].lerp(edge[1], (f64::from(k) + 0.5) / count)) {
            if outline.is_solid(at + (IN_FRONT * dp).max(2.0 * outline.touch()) * normal) {
                continue;
            }
            let area = length * dy * DVec3::new(normal.x, 0.0, normal.y);
            points.extend((0..ny).map(|j| FacePoint { at: DVec3::new(at.x, (j as f64 + 0.5) * dy, at.y), area }));
        }
    }
    points
}

fn of_box(bounds: &AxisBox, case: &Case) -> Vec<FacePoint> {
    let dp = case.domain.dp;
    let count = (bounds.edges() / dp).ceil().max(DVec3::ONE);
    let spacing = bounds.edges() / count;
    let mut points = Vec::new();
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]).filter(|(axis, side)| bounds.open[*axis][*side])
    {
        let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
        let mut area = DVec3::ZERO;
        area[axis] = [-1.0, 1.0][side] * spacing[one] * spacing[other];
        for (i, j) in (0..count[one] as u32).flat_map(|i| (0..count[other] as u32).map(move |j| (i, j))) {
            let mut at = [bounds.low, bounds.high][side];
            at[one] = bounds.low[one] + (f64::from(i) + 0.5) * spacing[one];
            at[other] = bounds.low[other] + (f64::from(j) + 0.5) * spacing[other];
            // On a slope, a part of a face can be below the bed.
            if at.z > case.flume.profile.z(at.x) - 1e-9 * dp {
                points.push(FacePoint { at, area });
            }
        }
    }
    points
}

fn of_body(body: &BodyPart, case: &Case) -> Vec<FacePoint> {
    let [low, high] = body.solid.bounds();
    let surface = space_around(case, [low.y, high.y], IN_FRONT).part_of(body.triangles());
    let samples = surface.iter().flat_map(|surface| surface.samples(case.domain.dp));
    samples.map(|(at, area)| FacePoint { at, area }).collect()
}

impl Simulation {
    /// Returns force and moment about `about` [m] of the water pressure on a part. Dry faces have no pressure. The
    /// current state must be evaluated and in the memory of the host.
    pub fn part_load(&self, part: usize, about: DVec3) -> Load {
        let points: Vec<DVec3> = self.part_faces[part].iter().map(|point| point.at).collect();
        let mut sum = Load::default();
        for (point, pressure) in self.part_faces[part].iter().zip(self.sensor_pressures(&points)) {
            sum += Load::of_force(-pressure.unwrap_or(0.0) * point.area, point.at - about);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the area of the faces [m2], and the sum of their normals times their areas [m2].
    fn total(points: &[FacePoint]) -> (f64, DVec3) {
        (points.iter().map(|point| point.area.length()).sum(), points.iter().map(|point| point.area).sum())
    }

    #[test]
    fn open_faces_of_a_wall_on_the_bed_have_their_areas() {
        let text = r#"{
            "title": "Wall", "flume": { "bed_m": [[0, 0], [1, 0]], "still_water_level_m": 0.2 },
            "domain": { "x_m": [0, 1], "width_m": 0.2, "sides": "periodic", "top_z_m": 0.5, "dp_m": 0.02 },
            "structure": [
                { "name": "wall", "polygon_m": [[0.5, 0], [0.7, 0], [0.7, 0.4], [0.4, 0.4], [0.4, 0.3], [0.5, 0.3]] },
                { "name": "block", "box": { "low_m": [0.85, 0.05, 0], "high_m": [0.95, 0.15, 0.3] } }
            ],
            "gauges": [
                { "kind": "force", "name": "w", "on": "wall" }, { "kind": "force", "name": "b", "on": "block" }
            ],
            "stop": { "duration_s": 1 }
        }"#;
        let case = Case::from_str(text, "test.json").unwrap_or_else(|errors| panic!("{errors}"));
        let simulation = Simulation::new(std::sync::Arc::new(case)).unwrap();
        let [wall, block] = [0, 1].map(|part| total(&simulation.part_faces[part]));
        // Seaward 0.3 + 0.1 m, nose below 0.1 m, top 0.3 m, rear 0.4 m; the foot is closed.
        assert!(
            (wall.0 - 0.2 * (0.4 + 0.1 + 0.3 + 0.4)).abs() < 1e-12 && (wall.1 - 0.2 * 0.2 * DVec3::Z).length() < 1e-12
        );
        assert!((block.0 - (4.0 * 0.1 * 0.3 + 0.01)).abs() < 1e-12 && (block.1 - 0.01 * DVec3::Z).length() < 1e-12);
    }
}
